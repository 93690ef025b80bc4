#include "core/geom/plant/foliage_shade.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/job.h"
#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/plant/tube_formulas.h"

namespace seedmesh {
namespace {

// Share of light that a layer of leaves with its own area takes, as an exponent; leaves lie at all angles.
constexpr double extinction = 0.35;
constexpr int most_cells = 16;
// Names of random numbers.
constexpr std::uint64_t tint_name = 0x7147, hue_name = 0x4875, withered_name = 0x5769;
constexpr float withered_share = 0.02F;
constexpr glm::vec3 withered_color{1, 0.62F, 0.5F};
// Square roots of the shares of the variance: limb, twig, leaf.
constexpr float limb_share = 0.6396F, twig_share = 0.6396F, leaf_share = 0.4264F;

/// A random number of mean 0 and deviation 1 between -3.5 and 3.5: the sum of four uniform ones.
float deviate(std::uint64_t key) {
  const std::uint64_t bits = mix(key);
  float sum = -2;
  for (unsigned i = 0; i < 4; ++i)
    sum += (static_cast<float>(bits >> (16 * i) & 0xFFFFU) + 0.5F) * (1.0F / 65'536);
  return sum * 1.7320508F;
}

/// The directions to the sky: steps of cells along x and z for each step up, and their weights.
struct Ray {
  int x, z;
  float weight;
};
constexpr std::array<Ray, 5> rays{{{0, 0, 2}, {1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}}};
constexpr float weight_of_all = 6;

}  // namespace

FoliageShade::FoliageShade(const Limbs& limbs, const Organs& organs, const Options& options, const Job& job)
    : options_(options), light_(job), hue_(job) {
  if (options.occlusion > 0 && !organs.organ.empty()) add_occlusion(organs, job);
  if (options.hue > 0) add_hues(limbs, job);
  // The derivative of a rotation about the grey axis, divided by the colour.
  const glm::vec3 color = glm::max(options.color, glm::vec3(0.02F));
  const glm::vec3 across{color.z - color.y, color.x - color.z, color.y - color.x};
  const auto a_degree = static_cast<float>(math::pi / 180 / std::sqrt(3.0));
  ratio_a_degree_ = across / color * a_degree;
}

std::size_t FoliageShade::cell_at(int x, int y, int z) const {
  return static_cast<std::size_t>(x + count_[0] * (y + count_[1] * z));
}

void FoliageShade::add_occlusion(const Organs& organs, const Job& job) {
  glm::vec3 high = low_ = organs.organ[0].position;
  for (const Organ& organ : organs.organ) {
    low_ = glm::min(low_, organ.position);
    high = glm::max(high, organ.position);
  }
  const glm::vec3 size = high - low_;
  cell_ = std::max({size.x, size.y, size.z, 1e-6F}) / most_cells;
  for (int axis = 0; axis < 3; ++axis) {
    count_[axis] =
        std::clamp(math::to_int32(static_cast<double>(std::ceil(size[axis] / cell_))), 1, most_cells);
  }
  // Leaf area of each cell divided by the area of its face.
  Array<float> layer(job, cell_at(0, 0, count_[2]), 0.0F);
  const float by_face = options_.leaf_area / (cell_ * cell_);
  for (std::size_t i = 0; i < organs.organ.size(); ++i) {
    if (i % 65'536 == 0) job.check();
    const Organ& organ = organs.organ[i];
    const glm::vec3 at = (organ.position - low_) / cell_;
    int cell[3];
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = std::clamp(static_cast<int>(at[axis]), 0, count_[axis] - 1);
    layer[cell_at(cell[0], cell[1], cell[2])] += organ.scale.x * organ.scale.y * by_face;
  }
  light_ = Array<float>(job, layer.size(), 0.0F);
  Array<float> above(job, layer.size(), 0.0F);
  for (const Ray& ray : rays) {
    const float length = ray.x != 0 || ray.z != 0 ? 1.4142136F : 1.0F;
    for (int y = count_[1] - 1; y >= 0; --y) {
      for (int z = 0; z < count_[2]; ++z) {
        for (int x = 0; x < count_[0]; ++x) {
          const std::size_t here = cell_at(x, y, z);
          const int nx = x + ray.x, nz = z + ray.z;
          above[here] = 0.5F * length * layer[here];
          if (y + 1 < count_[1] && nx >= 0 && nx < count_[0] && nz >= 0 && nz < count_[2]) {
            const std::size_t next = cell_at(nx, y + 1, nz);
            above[here] += above[next] + 0.5F * length * layer[next];
          }
          const double passed = math::exp(-extinction * static_cast<double>(above[here]));
          light_[here] += ray.weight / weight_of_all * static_cast<float>(passed);
        }
      }
    }
  }
  for (float& light : light_) light = 1 - options_.occlusion * (1 - light);
}

void FoliageShade::add_hues(const Limbs& limbs, const Job& job) {
  hue_ = Array<float>(job, limbs.size(), 0.0F);
  Array<float> main(job, limbs.size(), 0.0F);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % 65'536 == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    main[i] = main[parent];
    hue_[i] = hue_[parent];
    if (!limbs.starts_limb[i]) continue;
    const float own = deviate(key_at(limbs.key.empty() ? i : limbs.key[i], hue_name));
    const bool leaves_trunk = limbs.order.empty() || limbs.order[i] <= 1;
    if (leaves_trunk) main[i] = limb_share * options_.hue * own;
    hue_[i] = main[i] + (leaves_trunk ? 0 : twig_share * options_.hue * own);
  }
}

float FoliageShade::light_at(const glm::vec3& point) const {
  if (light_.empty()) return 1;
  const glm::vec3 at = (point - low_) / cell_ - 0.5F;
  int first[3], second[3];
  float share[3];
  for (int axis = 0; axis < 3; ++axis) {
    const float within = std::clamp(at[axis], 0.0F, static_cast<float>(count_[axis] - 1));
    first[axis] = static_cast<int>(within);
    second[axis] = std::min(first[axis] + 1, count_[axis] - 1);
    share[axis] = within - static_cast<float>(first[axis]);
  }
  const auto mixed = [](float a, float b, float by) { return a + (b - a) * by; };
  const auto row = [&](int y, int z) {
    return mixed(light_[cell_at(first[0], y, z)], light_[cell_at(second[0], y, z)], share[0]);
  };
  return mixed(mixed(row(first[1], first[2]), row(second[1], first[2]), share[1]),
               mixed(row(first[1], second[2]), row(second[1], second[2]), share[1]), share[2]);
}

std::uint32_t FoliageShade::color_of(const Organ& organ) const {
  const float shade =
      (1 - options_.tint * fraction_of(key_at(organ.key, tint_name))) * light_at(organ.position);
  glm::vec3 color(1);
  if (options_.hue > 0) {
    float degrees = leaf_share * options_.hue * deviate(key_at(organ.key, hue_name));
    if (organ.limb_joint < hue_.size()) degrees += hue_[organ.limb_joint];
    color = glm::clamp(1.0F + degrees * ratio_a_degree_, 0.7F, 1.4F);
    color /= std::max({color.x, color.y, color.z});
    if (fraction_of(key_at(organ.key, withered_name)) < withered_share) color *= withered_color;
  }
  std::uint32_t word = 0xFF000000U;
  for (int i = 0; i < 3; ++i) {
    const float rounded = 255.0F * color[i] * shade + 0.5F;
    word |= static_cast<std::uint32_t>(rounded) << (8U * static_cast<unsigned>(i));
  }
  return word;
}

}  // namespace seedmesh
