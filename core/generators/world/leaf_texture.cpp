#include "core/generators/world/leaf_texture.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/generators/world/noise.h"
#include "core/generators/world/store.h"

namespace seedmesh::world {
namespace {

constexpr int texels = 256, half = texels / 2;
constexpr std::uint64_t key = 0x4C454146U;

struct Texel {
  double light = 1;  ///< linear
  double alpha = 0;
};

struct Leaf {
  glm::dvec2 middle{0}, along{1, 0};  ///< in cells; the second has length 1
  double length = 0, light = 1;       ///< half of the blade
};

/// A blade with two pointed ends, lighter on one side of its midrib.
void cover(const Leaf& leaf, const glm::dvec2& at, Texel& texel) {
  const glm::dvec2 d = at - leaf.middle;
  const double along = (d.x * leaf.along.x + d.y * leaf.along.y) / leaf.length;
  const double across = (d.y * leaf.along.x - d.x * leaf.along.y) / leaf.length;
  if (std::abs(along) >= 1 || std::abs(across) >= 0.42 * (1 - along * along)) return;
  texel = {leaf.light * (across > 0 ? 1 : 0.86), 1};
}

/// Leaves from the lowest to the topmost one; lower ones are darker.
std::vector<Leaf> leaves_of(std::uint64_t list_key, int count, double length, double disc) {
  std::vector<Leaf> leaves;
  Rng rng(list_key);
  while (static_cast<int>(leaves.size()) < count) {
    Leaf leaf;
    leaf.middle = {rng.unit(), rng.unit()};
    const glm::dvec2 out = leaf.middle - 0.5;
    if (disc > 0 && out.x * out.x + out.y * out.y > disc * disc) continue;
    const math::SinCos turn = math::sincos_degrees(360 * rng.unit());
    leaf.along = {turn.cos, turn.sin};
    leaf.length = length * rng.uniform(0.75, 1.2);
    const double rank = static_cast<double>(leaves.size()) / count;
    leaf.light = (0.32 + 0.5 * rank) * rng.uniform(0.85, 1.2);
    leaves.push_back(leaf);
  }
  return leaves;
}

constexpr int samples = 2;  ///< along the side of a texel

/// Leaves painted over each other, by samples of a cell in rows.
class Painting {
 public:
  Painting(const std::vector<Leaf>& leaves, double background)
      : texels_(static_cast<std::size_t>(side) * side, Texel{0.3, background}) {
    for (const Leaf& leaf : leaves) paint(leaf);
  }
  Texel at(const glm::dvec2& p) const {
    return texels_[static_cast<std::size_t>(index(p.y) * side + index(p.x))];
  }

 private:
  static constexpr int side = half * samples;
  static int index(double v) { return std::clamp(math::to_int32(std::floor(v * side)), 0, side - 1); }

  void paint(const Leaf& leaf) {
    for (int row = index(leaf.middle.y - leaf.length); row <= index(leaf.middle.y + leaf.length); ++row) {
      for (int column = index(leaf.middle.x - leaf.length); column <= index(leaf.middle.x + leaf.length);
           ++column) {
        cover(leaf, glm::dvec2(column + 0.5, row + 0.5) / static_cast<double>(side),
              texels_[static_cast<std::size_t>(row * side + column)]);
      }
    }
  }

  std::vector<Texel> texels_;
};

/// Needles on twigs that leave a branch at about 50 degrees. `at`: along the branch, and across it from -1 to 1.
Texel branch_at(const glm::dvec2& at) {
  constexpr double twigs = 9;
  const double side = std::abs(at.y),
               outline = 0.92 * (1 - at.x * at.x) * (0.35 + 0.65 * std::min(1.0, 4 * at.x + 0.3));
  const double twig = at.x * twigs - side * 0.85 * twigs / 2 + (at.y > 0 ? 0.5 : 0) + 100;
  const double from_twig = std::abs(twig - std::floor(twig) - 0.5) * 2;
  const int number = math::to_int32(std::floor(twig));
  Rng rng(cell_key(key + 1, number, at.y > 0 ? 1 : 0));
  const double reach = outline * rng.uniform(0.75, 1.05);
  if (side < 0.035) return {0.5, at.x < 0.97 ? 1.0 : 0.0};
  if (side > reach || from_twig > 0.8 * (1.05 - 0.55 * side / std::max(reach, 0.1))) return {0.45, 0};
  return {(0.42 + 0.4 * side + 0.18 * (1 - from_twig)) * rng.uniform(0.85, 1.15), 1};
}

/// Leaflets on both sides of the midrib.
Texel palm_at(const glm::dvec2& at) {
  constexpr double leaflets = 22;
  const double side = std::abs(at.y),
               outline = 0.95 * (1 - at.x * at.x * at.x) * std::min(1.0, 5 * at.x + 0.1);
  const double leaflet = at.x * leaflets - side * 6 + (at.y > 0 ? 0.5 : 0) + 100;
  const double from_rib = std::abs(leaflet - std::floor(leaflet) - 0.5) * 2;
  if (side < 0.05) return {0.7, 1};
  if (side > outline || from_rib > 0.95 - 0.5 * side) return {0.6, 0};
  return {0.5 + 0.3 * (1 - from_rib), 1};
}

/// Fills a quarter of the picture. `at`: texel in the quarter, from 0 to 1.
template <class Fill>
void fill(std::vector<std::byte>& bytes, int left, int top, const Job& job, const Fill& fill_at) {
  constexpr int steps = 32;  // few steps of grey keep the file small
  for (int row = 0; row < half; ++row) {
    job.check();
    for (int column = 0; column < half; ++column) {
      Texel sum{0, 0};
      double opaque = 0, all = 0;
      for (int k = 0; k < samples * samples; ++k) {
        const int down = k / samples;
        const double x = (column + (k % samples + 0.5) / samples) / half,
                     y = (row + (down + 0.5) / samples) / half;
        const Texel texel = fill_at(glm::dvec2(x, y));
        sum.alpha += texel.alpha / (samples * samples);
        opaque += texel.alpha * texel.light;
        all += texel.light / (samples * samples);
      }
      // transparent texels have the colour of leaves, so that filters do not darken edges
      const double covered = sum.alpha * samples * samples;
      const double light = covered > 0 ? opaque / covered : all;
      const double grey = std::sqrt(std::clamp(light, 0.0, 1.0));  // about the transfer function of sRGB
      const auto at = 2 * static_cast<std::size_t>((top + row) * texels + left + column);
      bytes[at] = static_cast<std::byte>(math::to_int32(255 * std::floor(grey * steps + 0.5) / steps + 0.5));
      bytes[at + 1] = static_cast<std::byte>(math::to_int32(255 * sum.alpha + 0.5));
    }
  }
}

SharedImage make(const Job& job) {
  std::vector<std::byte> bytes(2 * static_cast<std::size_t>(texels) * texels);
  const Painting dense(leaves_of(key + 2, 560, 0.06, 0), 1), cluster(leaves_of(key + 3, 190, 0.068, 0.42), 0);
  fill(bytes, 0, 0, job, [&](const glm::dvec2& at) { return dense.at(at); });
  fill(bytes, half, 0, job, [&](const glm::dvec2& at) { return cluster.at(at); });
  fill(bytes, 0, half, job, [](const glm::dvec2& at) { return branch_at({at.x, 2 * at.y - 1}); });
  fill(bytes, half, half, job, [](const glm::dvec2& at) {
    constexpr double palm_end = 0.8, plain_begin = 0.86;
    if (at.y > plain_begin) return Texel{1, 1};
    return at.y < palm_end ? palm_at({at.x, 2 * at.y / palm_end - 1}) : Texel{0.6, 0};
  });
  return shared_image({texels, texels, 2, 8, bytes}, job);
}

}  // namespace

std::shared_ptr<const SharedImage> leaf_texture(const World& world, const Job& job) {
  return world.store->get<SharedImage>({0, Store::Layer::file, -1, 2, 0}, job,
                                       [&job] { return std::make_shared<const SharedImage>(make(job)); });
}

}  // namespace seedmesh::world
