#include "core/geom/plant/leaf_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/plant/leaflet_placement.h"
#include "core/geom/plant/leafy_twig.h"
#include "core/geom/plant/needle_twig.h"

namespace seedmesh {
namespace {

using glm::dvec2;

constexpr std::array<std::string_view, leaf_shape_count> names{
    "simple",   "willow",  "birch",   "cordate",      "lobed", "maple", "ginkgo",
    "compound", "palmate", "needles", "pine_needles", "palm",  "kite",  "petal"};

/// A point of the right margin. At a corner the curve has two directions.
struct Point {
  double x, y;
  bool is_corner = false;
};

// Right margins from base to tip, measured from typical leaves of each kind.
constexpr Point ovate[] = {{0, .12, true}, {.16, .2},  {.30, .38},  {.31, .55},
                           {.2, .78},      {.07, .94}, {0, 1, true}};
constexpr Point lanceolate[] = {{0, .06, true}, {.05, .14}, {.09, .32},
                                {.092, .52},    {.055, .8}, {0, 1, true}};
constexpr Point triangular[] = {{0, .2, true}, {.2, .22},  {.35, .33}, {.37, .42},
                                {.28, .6},     {.13, .82}, {.04, .94}, {0, 1, true}};
constexpr Point heart[] = {{0, .24, true}, {.07, .17}, {.2, .13},  {.36, .2},   {.45, .36},
                           {.4, .55},      {.22, .8},  {.06, .95}, {0, 1, true}};
constexpr Point oak[] = {{0, .1, true}, {.05, .15}, {.07, .2},  {.17, .22}, {.19, .28},
                         {.1, .33},     {.12, .38}, {.27, .42}, {.28, .5},  {.14, .54},
                         {.15, .59},    {.32, .66}, {.31, .74}, {.17, .77}, {.17, .81},
                         {.22, .88},    {.17, .94}, {.07, .98}, {0, 1}};
constexpr Point maple_shape[] = {
    {0, .3, true},    {.12, .27}, {.18, .23, true}, {.33, .22, true}, {.28, .33},  {.4, .37, true},
    {.5, .52, true},  {.37, .55}, {.36, .64, true}, {.25, .6},        {.16, .58},  {.14, .64},
    {.24, .75, true}, {.15, .78}, {.11, .87, true}, {.05, .9},        {0, 1, true}};
constexpr Point fan_shape[] = {{0, .3, true}, {.12, .41}, {.3, .53}, {.48, .62}, {.5, .7, true},
                               {.42, .83},    {.28, .94}, {.1, 1.0}, {.03, .95}, {0, .78, true}};
constexpr Point leaflet[] = {{0, 0, true}, {.11, .14}, {.19, .4}, {.16, .66}, {.06, .92}, {0, 1, true}};
constexpr Point obovate[] = {{0, 0, true}, {.06, .2}, {.17, .5}, {.21, .72}, {.14, .88}, {0, 1, true}};
constexpr Point strap[] = {{0, 0, true}, {.035, .2}, {.04, .5}, {0, 1, true}};
constexpr Point deltoid[] = {{0, 0, true}, {.35, .4, true}, {0, 1, true}};
constexpr Point petal_shape[] = {{0, 0, true}, {.08, .1},  {.22, .4},  {.36, .7},
                                 {.34, .9},    {.19, 1.0}, {.06, .98}, {0, .95}};

dvec2 unit(dvec2 way) { return way / std::sqrt(way.x * way.x + way.y * way.y); }

enum class Venation { pinnate, palmate, fan, none };

struct Margin {
  std::span<const Point> points;
  double petiole;  ///< where the blade begins
  double teeth;    ///< height of a tooth as a share of its length; 0: entire
  Venation venation;
};

Margin margin_of(LeafShape shape) {
  switch (shape) {
    case LeafShape::simple:
      return {ovate, .12, 0, Venation::pinnate};
    case LeafShape::willow:
      return {lanceolate, .06, 0, Venation::pinnate};
    case LeafShape::birch:
      return {triangular, .2, 0.5, Venation::pinnate};
    case LeafShape::cordate:
      return {heart, .24, 0, Venation::palmate};
    case LeafShape::lobed:
      return {oak, .1, 0, Venation::pinnate};
    case LeafShape::maple:
      return {maple_shape, .3, 0, Venation::palmate};
    case LeafShape::ginkgo:
      return {fan_shape, .3, 0, Venation::fan};
    case LeafShape::kite:
      return {deltoid, 0, 0, Venation::none};
    case LeafShape::petal:
      return {petal_shape, 0, 0, Venation::fan};
    case LeafShape::palmate:
      return {obovate, 0, 0.35, Venation::pinnate};
    case LeafShape::palm:
      return {strap, 0, 0, Venation::none};
    case LeafShape::compound:
    case LeafShape::needles:
    case LeafShape::pine_needles:
      return {leaflet, 0, 0, Venation::pinnate};
  }
  return {ovate, .12, 0, Venation::pinnate};
}

/// A Catmull-Rom curve through the points, interrupted at corners.
std::vector<dvec2> curve_through(std::span<const Point> points, int steps) {
  std::vector<dvec2> curve;
  const auto place = [&](std::size_t i) { return dvec2(points[i].x, points[i].y); };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const dvec2 a = place(i), b = place(i + 1);
    const dvec2 before = points[i].is_corner || i == 0 ? b - a : 0.5 * (b - place(i - 1));
    const bool ends = points[i + 1].is_corner || i + 2 == points.size();
    const dvec2 after = ends ? b - a : 0.5 * (place(i + 2) - a);
    const bool is_straight = points[i].is_corner && ends;
    const int pieces = is_straight ? 1 : steps;
    for (int k = 0; k < pieces; ++k) {
      const double t = static_cast<double>(k) / pieces, t2 = t * t, t3 = t2 * t;
      curve.push_back(a * (2 * t3 - 3 * t2 + 1) + b * (3 * t2 - 2 * t3) + before * (t3 - 2 * t2 + t) +
                      after * (t3 - t2));
    }
  }
  curve.push_back(place(points.size() - 1));
  for (dvec2& p : curve) p.x = std::max(p.x, 0.0);
  return curve;
}

/// Serrate teeth, which point to the tip, along the whole margin except its ends.
std::vector<dvec2> saw(const std::vector<dvec2>& curve, double height) {
  std::vector<dvec2> sawn{curve.front()};
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    const dvec2 along = curve[i + 1] - curve[i - 1];
    const dvec2 out{along.y, -along.x};  // to the right of the direction from base to tip
    sawn.push_back(i % 2 == 1 ? curve[i] + 0.3 * height * out + 0.15 * along : curve[i] - 0.1 * height * out);
    sawn.back().x = std::max(sawn.back().x, 0.0);
  }
  sawn.push_back(curve.back());
  return sawn;
}

/// The length of a ray from `from` in the direction `way` inside the margin, at most `most`.
double run_inside(const std::vector<dvec2>& margin, dvec2 from, dvec2 way, double most) {
  double nearest = most;
  for (std::size_t i = 0; i + 1 < margin.size(); ++i) {
    const dvec2 edge = margin[i + 1] - margin[i], to = margin[i] - from;
    const double cross = way.x * edge.y - way.y * edge.x;
    if (std::abs(cross) < 1e-12) continue;
    const double along = (to.x * edge.y - to.y * edge.x) / cross, at = (to.x * way.y - to.y * way.x) / cross;
    if (along > 1e-6 && at >= 0 && at <= 1) nearest = std::min(nearest, along);
  }
  return nearest;
}

void add_vein(LeafBlade& blade, dvec2 from, dvec2 to, double width) {
  blade.veins.push_back({from, to, width, 0.25 * width});
  if (to.x != from.x) blade.veins.push_back({{-from.x, from.y}, {-to.x, to.y}, width, 0.25 * width});
}

void draw_pinnate(LeafBlade& blade, double from) {
  constexpr int pairs = 7;
  const double length = blade.tip.y - from;
  add_vein(blade, blade.base, blade.tip, 0.022);
  for (int i = 0; i < pairs; ++i) {
    const dvec2 start{0, from + length * (0.06 + 0.82 * i / pairs)};
    const dvec2 way = unit(dvec2{1, 0.75});
    const double run = run_inside(blade.right, start, way, 0.6);
    add_vein(blade, start, start + way * (0.94 * run), 0.010);
  }
}

void draw_palmate(LeafBlade& blade) {
  constexpr double degrees[] = {28, 62, 102};
  add_vein(blade, blade.base, blade.tip, 0.02);
  for (const double angle : degrees) {
    const math::SinCos turn = math::sincos_degrees(angle);
    const dvec2 way{turn.sin, turn.cos};
    const double run = 0.92 * run_inside(blade.right, blade.base + way * 0.02, way, 0.7);
    const dvec2 end = blade.base + way * run;
    add_vein(blade, blade.base, end, 0.014);
    for (const double share : {0.35, 0.6}) {
      const math::SinCos inner = math::sincos_degrees(angle - 32);
      const dvec2 start = blade.base + way * (run * share), side{inner.sin, inner.cos};
      const double reach = run_inside(blade.right, start, side, 0.6);
      add_vein(blade, start, start + side * (0.55 * reach), 0.006);
    }
  }
  for (const double share : {0.4, 0.6, 0.78}) {
    const dvec2 start = blade.base + (blade.tip - blade.base) * share, way = unit(dvec2{0.8, 1});
    add_vein(blade, start, start + way * (0.8 * run_inside(blade.right, start, way, 0.4)), 0.007);
  }
}

void draw_fan(LeafBlade& blade) {
  for (int i = 0; i < 12; ++i) {
    const math::SinCos turn = math::sincos_degrees(2 + 4.6 * i);
    const dvec2 way{turn.sin, turn.cos};
    const double run = run_inside(blade.right, blade.base + way * 0.02, way, 1);
    if (run < 0.05 || run > 0.99) continue;
    add_vein(blade, blade.base, blade.base + way * (0.96 * run), 0.005);
  }
}

/// The blade in its own leaf frame.
LeafBlade blade_of(const Margin& margin, const LeafDetail& detail) {
  LeafBlade blade;
  blade.right = curve_through(margin.points, detail.steps);
  if (margin.teeth > 0 && detail.teeth && detail.steps > 2) blade.right = saw(blade.right, margin.teeth);
  for (const dvec2& p : blade.right) {
    blade.left.emplace_back(-p.x, p.y);
    blade.half_width = std::max(blade.half_width, p.x);
  }
  blade.base = blade.right.front();
  blade.tip = blade.right.back();
  if (!detail.veins) return blade;
  switch (margin.venation) {
    case Venation::pinnate:
      draw_pinnate(blade, margin.petiole);
      break;
    case Venation::palmate:
      draw_palmate(blade);
      break;
    case Venation::fan:
      draw_fan(blade);
      break;
    case Venation::none:
      break;
  }
  return blade;
}

/// Leaflets in pairs along a rachis, and one at its end where `ends` is set.
struct Pinnate {
  int pairs;
  double from, to;             ///< of the rachis
  double degrees;              ///< of the leaflets
  double first, middle, last;  ///< lengths along the rachis
  bool ends;
};

void draw_pairs(LeafDrawing& drawing, const LeafBlade& blade, const Pinnate& plan) {
  drawing.stalks.push_back({{0, 0}, {0, plan.to}, 0.022, 0.008});
  for (int i = 0; i < plan.pairs; ++i) {
    const double share = plan.pairs == 1 ? 0 : static_cast<double>(i) / (plan.pairs - 1);
    const double length = share < 0.5 ? plan.first + (plan.middle - plan.first) * 2 * share
                                      : plan.middle + (plan.last - plan.middle) * (2 * share - 1);
    const dvec2 at{0, plan.from + (plan.to - plan.from) * share};
    const double angle = plan.degrees * (1 - 0.35 * share);
    add_blade(drawing, blade, {at, angle, length});
    add_blade(drawing, blade, {at, -angle, length});
  }
  if (plan.ends) add_blade(drawing, blade, {{0, plan.to}, 0, 1 - plan.to});
}

void draw_fingers(LeafDrawing& drawing, const LeafBlade& blade) {
  constexpr double lengths[] = {0.5, 0.52, 0.6, 0.62};
  const dvec2 hub{0, 0.38};
  drawing.stalks.push_back({{0, 0}, hub, 0.022, 0.016});
  for (int i = 0; i < 3; ++i) {
    const double angle = 126 - 42 * i;
    const double length = lengths[i] * (i == 0 ? 0.72 : 1);
    add_blade(drawing, blade, {hub, angle, length});
    add_blade(drawing, blade, {hub, -angle, length});
  }
  add_blade(drawing, blade, {hub, 0, lengths[3]});
}

/// `reach`: the length of the needles at the base of the shoot. `degrees`: their angle to the shoot.
void draw_needles(LeafDrawing& drawing, double reach, double degrees) {
  constexpr int pairs = 22;
  drawing.stalks.push_back({{0, 0}, {0, 0.84}, 0.03, 0.012});
  for (int i = 0; i < pairs; ++i) {
    const double share = static_cast<double>(i) / (pairs - 1);
    const dvec2 at{0, 0.03 + 0.8 * share};
    const double length = reach - 0.1 * share * share, angle = degrees - 34 * share + (i % 3 - 1) * 5;
    for (const double side : {1.0, -1.0}) {
      const math::SinCos turn = math::sincos_degrees(side * angle);
      drawing.stalks.push_back({at, at + dvec2{turn.sin, turn.cos} * length, 0.017, 0.004});
    }
  }
  drawing.stalks.push_back({{0, 0.8}, {0, 1}, 0.017, 0.004});
}

LeafDrawing single(LeafShape shape, const LeafDetail& detail) {
  LeafDrawing drawing;
  const Margin margin = margin_of(shape);
  const LeafBlade blade = blade_of(margin, detail);
  switch (shape) {
    case LeafShape::compound:
      draw_pairs(drawing, blade, {5, 0.2, 0.68, 62, 0.28, 0.34, 0.3, true});
      break;
    case LeafShape::palm:
      draw_pairs(drawing, blade, {22, 0.14, 0.88, 66, 0.3, 0.42, 0.16, true});
      break;
    case LeafShape::palmate:
      draw_fingers(drawing, blade);
      break;
    case LeafShape::needles:
      draw_needles(drawing, 0.26, 58);
      break;
    case LeafShape::pine_needles:
      draw_needles(drawing, 0.42, 50);
      break;
    default:
      if (margin.petiole > 0) drawing.stalks.push_back({{0, 0}, blade.base, 0.026, 0.02});
      drawing.blades.push_back(blade);
      break;
  }
  return drawing;
}

/// A spray of `count` blossoms of five petals, on stalks along its stem.
LeafDrawing spray(const LeafDetail& detail, int count) {
  constexpr int petals = 5;
  LeafDrawing drawing;
  const LeafBlade blade = blade_of(margin_of(LeafShape::petal), detail);
  drawing.stalks.push_back({{0, 0}, {0, 0.72}, 0.022, 0.01});
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 1;
    const math::SinCos turn =
        math::sincos_degrees(i + 1 == count ? 0.0 : (i % 2 == 0 ? 1 : -1) * (74 - 26 * share));
    const dvec2 from{0, 0.1 + 0.56 * share};
    const dvec2 middle = from + dvec2{turn.sin, turn.cos} * (0.16 + 0.06 * (i * 3 % 4));
    drawing.stalks.push_back({from, middle, 0.009, 0.009});
    for (int k = 0; k < petals; ++k)
      add_blade(drawing, blade, {middle, 360.0 * k / petals + 31.0 * i, 0.125 + 0.012 * (i % 3)});
  }
  return drawing;
}

LeafDrawing twig(LeafShape shape, const LeafDetail& detail, int count) {
  if (shape == LeafShape::needles) return needle_twig(NeedleKind::single, count);
  if (shape == LeafShape::pine_needles) return needle_twig(NeedleKind::paired, count);
  if (shape == LeafShape::petal) return spray(detail, count);
  if (shape == LeafShape::willow) return hanging_twig(single(shape, detail), count);
  // Maples bear their leaves in pairs.
  return leafy_twig(single(shape, detail), count,
                    shape == LeafShape::maple ? Phyllotaxis::opposite : Phyllotaxis::alternate);
}

void measure(LeafDrawing& drawing) {
  dvec2 low{1e9}, high{-1e9};
  const auto grow = [&](dvec2 p, double by) {
    low = {std::min(low.x, p.x - by), std::min(low.y, p.y - by)};
    high = {std::max(high.x, p.x + by), std::max(high.y, p.y + by)};
  };
  for (const LeafBlade& blade : drawing.blades) {
    for (const dvec2& p : blade.right) grow(p, 0);
    for (const dvec2& p : blade.left) grow(p, 0);
  }
  for (const LeafLine& line : drawing.stalks) {
    grow(line.from, 0.5 * line.width);
    grow(line.to, 0.5 * line.end_width);
  }
  constexpr double room = 0.02;  // so that nothing crosses the border of the texture
  const dvec2 extent = high - low;
  drawing.low = low - room * extent;
  drawing.high = high + room * extent;
}

}  // namespace

std::span<const std::string_view> leaf_shape_names() { return names; }

LeafDrawing draw_leaf(LeafShape shape, const LeafDetail& detail, int count) {
  LeafDrawing drawing = count > 1 ? twig(shape, detail, count) : single(shape, detail);
  measure(drawing);
  return drawing;
}

}  // namespace seedmesh
