#include "core/geom/plant/leafy_twig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/geom/plant/leaflet_placement.h"

namespace seedmesh {
namespace {

using glm::dvec2;

constexpr double usual_width = 0.25, most_stretch = 2.5;

/// A shoot of a twig: where it begins, its direction in degrees to the right of +y, its length and its leaves.
struct Shoot {
  dvec2 at{0};
  double degrees = 0, length = 1;
  int leaves = 1;
};

/// How much of a leaf's length and width is seen, in turn: leaves hang by 20 to 50 degrees, and are rolled.
constexpr double seen_length[] = {1, 0.9, 0.97, 0.8, 0.94},
                 seen_width[] = {1, 0.74, 0.92, 0.62, 0.84, 0.96, 0.7};

/// Leaves along a shoot, larger towards its middle, that ends in a leaf.
void add_shoot(LeafDrawing& drawing, const LeafDrawing& leaf, const Shoot& shoot, double size,
               Phyllotaxis phyllotaxis) {
  const math::SinCos turn = math::sincos_degrees(shoot.degrees);
  const dvec2 along = dvec2{turn.sin, turn.cos} * shoot.length;
  drawing.stalks.push_back({shoot.at, shoot.at + along, 0.016, 0.007});
  const auto add = [&](const LeafletPlacement& placement) {
    for (const LeafLine& line : leaf.stalks) drawing.stalks.push_back(moved(line, placement));
    for (const LeafBlade& blade : leaf.blades) add_blade(drawing, blade, placement);
  };
  const bool is_opposite = phyllotaxis == Phyllotaxis::opposite;
  for (int i = 0; i + 1 < shoot.leaves; ++i) {
    const int node = is_opposite ? i / 2 * 2 : i;
    const double share = (node + (is_opposite ? 1 : 0.6)) / shoot.leaves;
    const double angle = (i % 2 == 0 ? 1 : -1) * (64 - 26 * share + 9 * (i % 3 - 1));
    const double rise = 0.78 + 0.22 * math::sincos(math::pi * share).sin;
    add({shoot.at + along * share, shoot.degrees + angle, size * rise * seen_length[i % 5],
         seen_width[i % 7]});
  }
  add({shoot.at + along, shoot.degrees, size * 0.85});
}

/// A hanging shoot: where on the first shoot it begins, its directions there and at its end, in degrees to the right of
/// +y, its length and its share of the leaves.
struct HangingShoot {
  double start, degrees, end_degrees, length, share;
};
constexpr std::array<HangingShoot, 7> hanging{{{0, 6, -4, 0.84, 0.2},
                                               {0.05, 30, 2, 0.77, 0.18},
                                               {0.09, -30, -3, 0.71, 0.17},
                                               {0.02, 60, 1, 0.68, 0.15},
                                               {0.03, -56, -4, 0.64, 0.14},
                                               {0.01, 80, 6, 0.54, 0.09},
                                               {0.02, -76, -9, 0.44, 0.07}}};
constexpr int pieces = 6;
constexpr double hanging_leaf = 0.205, narrow = 0.64;

/// The points of a shoot, which soon bends to the direction of its end.
struct Curve {
  std::array<dvec2, pieces + 1> at{};
  std::array<double, pieces> degrees{};

  Curve(const HangingShoot& shoot, dvec2 from) {
    at[0] = from;
    for (std::size_t i = 0; i < pieces; ++i) {
      const double left = 1 - (static_cast<double>(i) + 0.5) / pieces;
      degrees[i] = shoot.end_degrees + (shoot.degrees - shoot.end_degrees) * left * left;
      const math::SinCos turn = math::sincos_degrees(degrees[i]);
      at[i + 1] = at[i] + dvec2{turn.sin, turn.cos} * (shoot.length / pieces);
    }
  }
  /// The piece at a share of the length.
  static std::size_t piece_at(double share) {
    return std::min(static_cast<std::size_t>(share * pieces), std::size_t{pieces - 1});
  }
  dvec2 point_at(double share) const {
    const std::size_t piece = piece_at(share);
    return at[piece] + (at[piece + 1] - at[piece]) * (share * pieces - static_cast<double>(piece));
  }
};

/// The leaves of a hanging shoot. `turn` makes shoots differ.
void add_hanging_leaves(LeafDrawing& drawing, const LeafDrawing& leaf, const Curve& curve, int leaves,
                        int turn) {
  constexpr double seen[] = {1, 0.7, 0.94, 0.5, 0.84, 1, 0.6}, apart[] = {0, 9, -7, 4, -11};
  const auto add = [&](const LeafletPlacement& placement) {
    for (const LeafLine& line : leaf.stalks) drawing.stalks.push_back(moved(line, placement));
    for (const LeafBlade& blade : leaf.blades) add_blade(drawing, blade, placement);
  };
  for (int i = 0; i + 1 < leaves; ++i) {
    const int number = i + turn;
    const double share = (i + 0.7) / leaves, side = number % 2 == 0 ? 1 : -1;
    const double along = curve.degrees[Curve::piece_at(share)];
    const double angle = 34 - 12 * share + apart[number % 5];
    const double size = (0.72 + 0.28 * math::sincos(math::pi * std::min(1.4 * share, 1.0)).sin) *
                        (1 - 0.03 * (number * 3 % 5)) * hanging_leaf;
    add({curve.point_at(share), along + side * angle, size, narrow * seen[number % 7], -0.11 * side});
  }
  add({curve.at.back(), curve.degrees.back(), 0.75 * hanging_leaf, narrow});
}

}  // namespace

LeafDrawing hanging_twig(const LeafDrawing& leaf, int count) {
  LeafDrawing drawing;
  std::vector<Curve> curves;
  for (const HangingShoot& shoot : hanging) {
    const dvec2 from = curves.empty() ? dvec2(0) : curves.front().point_at(shoot.start / hanging[0].length);
    const Curve& curve = curves.emplace_back(shoot, from);
    const double width = curves.size() == 1 ? 0.011 : 0.008, thinner = 0.006 / pieces;
    for (std::size_t i = 0; i < pieces; ++i) {
      const double here = width - thinner * static_cast<double>(i);
      drawing.stalks.push_back({curve.at[i], curve.at[i + 1], here, here - thinner});
    }
  }
  drawing.woody = drawing.stalks.size();
  int left = count;
  for (std::size_t i = curves.size(); i-- > 0;) {
    const int own = i == 0 ? left : static_cast<int>(hanging[i].share * count + 0.5);
    add_hanging_leaves(drawing, leaf, curves[i], std::max(own, 1), static_cast<int>(2 * i));
    left -= own;
  }
  return drawing;
}

LeafDrawing leafy_twig(const LeafDrawing& leaf, int count, Phyllotaxis phyllotaxis) {
  LeafDrawing drawing;
  // Narrow leaves are longer, so that they cover as much.
  const double width = leaf.blades.empty() ? usual_width : leaf.blades.front().half_width;
  const double stretch = std::sqrt(std::clamp(usual_width / std::max(width, 1e-3), 1.0, most_stretch));
  const double size = 1.5 * stretch / std::sqrt(static_cast<double>(count)), end = 1 - 0.85 * size;
  const int aside = count / 4;
  const Shoot shoots[] = {{{0, 0}, 0, end, count - 2 * aside},
                          {{0, 0.16 * end}, 46, 0.62 * end, aside},
                          {{0, 0.3 * end}, -44, 0.55 * end, aside}};
  std::size_t woody = 0;
  for (const Shoot& shoot : shoots) {
    if (shoot.leaves < 1) continue;
    LeafDrawing own;
    add_shoot(own, leaf, shoot, size, phyllotaxis);
    drawing.stalks.insert(drawing.stalks.begin() + static_cast<std::ptrdiff_t>(woody), own.stalks.front());
    ++woody;
    drawing.stalks.insert(drawing.stalks.end(), own.stalks.begin() + 1, own.stalks.end());
    drawing.blades.insert(drawing.blades.end(), own.blades.begin(), own.blades.end());
  }
  drawing.woody = woody;
  return drawing;
}

}  // namespace seedmesh
