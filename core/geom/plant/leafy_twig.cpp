#include "core/geom/plant/leafy_twig.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

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
