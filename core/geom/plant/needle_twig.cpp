#include "core/geom/plant/needle_twig.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

using glm::dvec2;

/// Short needles on both sides of a shoot, dense enough to hide what is behind them.
void add_needles(LeafDrawing& drawing, dvec2 from, dvec2 to, double length) {
  constexpr double gap = 0.0165, wide = 0.0105;
  const dvec2 way = to - from;
  const double size = std::sqrt(way.x * way.x + way.y * way.y);
  const int pairs = std::max(2, static_cast<int>(size / gap));
  for (int i = 0; i <= pairs; ++i) {
    const double share = static_cast<double>(i) / pairs;
    const double angle = 62 - 34 * share + (i % 4 - 1.5) * 9, reach = length * (0.86 + 0.07 * (i * 2 % 5));
    for (const double side : {1.0, -1.0}) {
      const math::SinCos turn = math::sincos_degrees(side * (angle + (i % 3 - 1) * 4 * side));
      const dvec2 ahead = way / size;
      const dvec2 out{ahead.x * turn.cos + ahead.y * turn.sin, ahead.y * turn.cos - ahead.x * turn.sin};
      const dvec2 at = from + way * share;
      drawing.stalks.push_back({at, at + out * reach, wide, 0.0035});
    }
  }
  drawing.stalks.push_back({to - way * (0.02 / size), to + way * (0.8 * length / size), wide, 0.0035});
}

}  // namespace

LeafDrawing needle_twig(int count) {
  LeafDrawing drawing;
  constexpr double end = 0.89, length = 0.125;
  std::vector<LeafLine> shoots{{{0, 0}, {0, end}, 0.022, 0.009}};
  for (int i = 0; i + 1 < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const math::SinCos turn = math::sincos_degrees((i % 2 == 0 ? 1 : -1) * (56 - 14 * share));
    const dvec2 at{0, 0.07 + 0.66 * share};
    shoots.push_back({at, at + dvec2{turn.sin, turn.cos} * (0.4 - 0.2 * share * share), 0.014, 0.007});
  }
  drawing.stalks = shoots;
  drawing.woody = shoots.size();
  for (const LeafLine& shoot : shoots) add_needles(drawing, shoot.from, shoot.to, length);
  return drawing;
}

}  // namespace seedmesh
