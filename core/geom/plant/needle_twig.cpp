// Needles of spruces stand all around their shoot, are 1 to 2.5 cm long, and hide it. Those of Scots pines grow in pairs, are
// 4 to 7 cm long, and remain for two or three years, so that old parts of a shoot are bare.
#include "core/geom/plant/needle_twig.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

using glm::dvec2;

/// Lengths are shares of the length of the twig, angles are degrees from the direction of the shoot.
struct Form {
  double length, gap, wide, thin;  ///< of needles; `gap` is along the shoot
  double first, last, spread;      ///< angles of needles at the base and at the end, and their spread
  std::array<double, 4> around;    ///< sines of needles' positions around the shoot, seen from above
  double bare;                     ///< share of a shoot without needles at its base
  double pair;                     ///< angle between both needles of a pair; 0: no pairs
  int tuft;                        ///< needles at the end of a shoot
  double fan;                      ///< angle between two of them
  double end, fork, fork_fall;     ///< end of the stem; angles of its side shoots and by how much they fall
  double start, span, longest, shortening;  ///< where side shoots begin, and their lengths
};

constexpr Form single{0.076, 0.012, 0.0082, 0.004, 64,   36,  4,   {1, 0.55, 0.85, 0.25}, 0, 0, 3, 22,
                      0.92,  58,    16,     0.06,  0.72, 0.4, 0.22};
constexpr Form paired{0.155, 0.0165, 0.0072, 0.004, 58,  26,   5,   {1, 0.6, 0.9, 0.3}, 0.1, 7, 5, 14,
                      0.8,   50,     14,     0.16,  0.5, 0.36, 0.14};

dvec2 turned(dvec2 ahead, double degrees) {
  const math::SinCos turn = math::sincos_degrees(degrees);
  return {ahead.x * turn.cos + ahead.y * turn.sin, ahead.y * turn.cos - ahead.x * turn.sin};
}

/// Needles on both sides of a shoot and at its end.
void add_needles(LeafDrawing& drawing, const LeafLine& shoot, const Form& form) {
  const dvec2 way = shoot.to - shoot.from;
  const double size = std::sqrt(way.x * way.x + way.y * way.y);
  const dvec2 ahead = way / size;
  const auto add = [&](dvec2 at, dvec2 reach) {
    drawing.stalks.push_back({at, at + reach, form.wide, form.thin});
  };
  const int rows = std::max(2, static_cast<int>(size * (1 - form.bare) / form.gap));
  for (int i = 0; i <= rows; ++i) {
    const double share = form.bare + (1 - form.bare) * i / rows;
    const double around = form.around[static_cast<std::size_t>(i) % form.around.size()];
    const double length = form.length * (0.85 + 0.05 * (i * 3 % 7));
    const dvec2 at = shoot.from + way * share;
    for (const int side : {1, -1}) {
      const double angle = form.first + (form.last - form.first) * share +
                           ((i * 5 + (side > 0 ? 0 : 2)) % 7 - 3) * form.spread;
      const math::SinCos turn = math::sincos_degrees(angle);
      const dvec2 across{ahead.y * side, -ahead.x * side};
      const dvec2 reach = length * (ahead * turn.cos + across * (turn.sin * around));
      add(at, reach);
      if (form.pair > 0) add(at, 0.95 * turned(reach, side * form.pair));
    }
  }
  for (int i = 0; i < form.tuft; ++i)
    add(shoot.to, 0.9 * form.length * turned(ahead, (i - 0.5 * (form.tuft - 1)) * form.fan));
}

}  // namespace

LeafDrawing needle_twig(NeedleKind kind, int count) {
  const Form& form = kind == NeedleKind::single ? single : paired;
  LeafDrawing drawing;
  std::vector<LeafLine> shoots{{{0, 0}, {0, form.end}, 0.022, 0.009}};
  for (int i = 0; i + 1 < count; ++i) {
    const double share = count > 2 ? static_cast<double>(i) / (count - 2) : 0;
    const math::SinCos turn =
        math::sincos_degrees((i % 2 == 0 ? 1 : -1) * (form.fork - form.fork_fall * share));
    const dvec2 at{0, form.start + form.span * share};
    const double length = form.longest - form.shortening * share * share;
    shoots.push_back({at, at + dvec2{turn.sin, turn.cos} * length, 0.014, 0.007});
  }
  drawing.stalks = shoots;
  drawing.woody = shoots.size();
  for (const LeafLine& shoot : shoots) add_needles(drawing, shoot, form);
  return drawing;
}

}  // namespace seedmesh
