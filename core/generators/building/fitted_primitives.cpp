/// Built-in solids that touch all sides of the scope, and level polygons: those of ShapeML.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "core/base/math.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/round_solids.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building::operators {
namespace {

constexpr double most_sides = 256;
constexpr std::size_t most_corners = 1'000;

/// A smooth form whose first side faces +z.
RoundForm front_form(std::uint32_t sides) {
  return {.sides = sides, .first = 270 - 180.0 / sides, .is_smooth = true};
}

/// The tube has a side, not a corner, on the outside.
Solid torus(double radius, double tube, std::uint32_t sides, std::uint32_t tube_sides) {
  Solid solid;
  solid.is_closed = true;
  const RoundForm form = front_form(sides);
  for (std::uint32_t j = 0; j < tube_sides; ++j) {
    const math::SinCos at = math::sincos_degrees(360.0 * (j - 0.5) / tube_sides);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const glm::dvec2 p = (corner_of(form, i) - 0.5) * (2 * (radius + tube * at.cos));
      solid.points.emplace_back(p.x, tube * at.sin, p.y);
    }
  }
  for (std::uint32_t j = 0; j < tube_sides; ++j) {
    const std::uint32_t low = j * sides, high = (j + 1) % tube_sides * sides;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t next = (i + 1) % sides;
      add_face(solid, std::array{low + i, low + next, high + next, high + i}, true);
    }
  }
  return solid;
}

std::uint32_t sides_at(Derivation& d, const Step& step, std::uint32_t i, double least) {
  const double sides = std::trunc(number_or(d, step, i, 0));
  if (!(sides >= least && sides <= most_sides)) {
    reject(d, step.offset,
           "found " + text_of_number(sides) + ", expected " + text_of_number(least) + " to 256");
  }
  return math::to_uint32(sides);
}

Solid solid_named(Derivation& d, const Step& step, const std::string& name) {
  const std::uint32_t count = step.argument_count;
  const bool has_rows = name == "sphere", is_torus = name == "torus";
  if (count != (is_torus ? 5U : has_rows ? 3U : 2U))
    reject(d, step.offset, "found another number of arguments than " + lang::in_quotes(name) + " takes");
  if (is_torus) {
    const double radius = number_or(d, step, 1, 0), tube = number_or(d, step, 2, 0);
    if (!(tube > 0 && radius >= tube && radius <= 1e6))
      reject(d, step.offset, "expected a radius of the torus that is at least that of its tube, above 0");
    return torus(radius, tube, sides_at(d, step, 3, 3), sides_at(d, step, 4, 3));
  }
  const RoundForm form = front_form(sides_at(d, step, 1, 3));
  if (name == "disk") return disk_of(form);
  if (name == "cylinder") return cylinder_of(form);
  if (name == "cone") return cone_of(form);
  if (has_rows) return sphere_of(form, sides_at(d, step, 2, 2));
  reject(d, step.offset,
         "found " + lang::in_quotes(name) + ", expected disk, cylinder, cone, sphere or torus");
}

/// Sizes of 0 follow from the proportions of the solid and the mean scale of the other axes.
void fill_scope(const glm::dvec3& extent, ShapeState& state) {
  double sum = 0;
  int given = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (state.size[axis] == 0) continue;
    sum += extent[axis] > 0 ? state.size[axis] / extent[axis] : 1;
    ++given;
  }
  const double scale = given > 0 ? sum / given : 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (state.size[axis] == 0) state.size[axis] = extent[axis] * scale;
  }
  if (extent.y == 0) state.size.y = 0;
}

void take_fitted(Derivation& d, Solid solid, const std::string& key, ShapeState& state) {
  glm::dvec3 low(0), extent(0);
  fit(solid, low, extent);
  state.roof_up = no_roof;
  fill_scope(extent, state);
  const auto found = d.named_solids.find(key);
  if (found != d.named_solids.end()) {
    state.geometry = found->second;
    return;
  }
  state.geometry = add_solid(d, std::move(solid));
  d.named_solids.emplace(key, state.geometry);
}

/// Twice the area of a polygon seen from above, with z against y.
double area_of_corners(const std::vector<glm::dvec3>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 &a = points[i], &b = points[(i + 1) % points.size()];
    twice += a.z * b.x - a.x * b.z;
  }
  return twice;
}

/// Which side of the line from `a` to `b` the point is on.
double side_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p) {
  return (b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x);
}

bool has_crossing_sides(const std::vector<glm::dvec3>& points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 &a = points[i], &b = points[(i + 1) % count];
    for (std::size_t k = i + 2; k < count; ++k) {
      const glm::dvec3 &c = points[k], &e = points[(k + 1) % count];
      if (side_of(a, b, c) * side_of(a, b, e) < 0 && side_of(c, e, a) * side_of(c, e, b) < 0) return true;
    }
  }
  return false;
}

}  // namespace

void primitive_fitted(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const std::string name = word_at(d, step, 0);
  std::string key = "fitted " + name;
  for (std::uint32_t i = 1; i < step.argument_count; ++i)
    key += " " + text_of_number(number_or(d, step, i, 0));
  take_fitted(d, solid_named(d, step, name), key, state);
}

void primitive_polygon(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Evaluation at{d, step.offset};
  const std::vector<lang::TaggedValue> values =
      array_in(at, evaluate(d, argument_at(d, step, 0).value)).values;
  if (values.size() % 2 != 0 || values.size() < 6 || values.size() > 2 * most_corners)
    reject(d, step.offset, "expected an array of 3 to 1000 corners x and y");
  Solid solid;
  std::string key = "polygon";
  for (std::size_t i = 0; i < values.size(); i += 2) {
    const double x = number_in(at, values[i]), y = number_in(at, values[i + 1]);
    solid.points.emplace_back(x, 0, -y);
    key += " " + text_of_number(x) + " " + text_of_number(y);
  }
  const double area = area_of_corners(solid.points);
  if (!(std::abs(area) > 1e-12 && std::abs(area) < 1e12))
    reject(d, step.offset, "found corners without an area between them");
  if (!d.named_solids.contains(key) && has_crossing_sides(solid.points))
    reject(d, step.offset, "the sides of the polygon cross");
  if (area < 0) {
    warn(d, step.offset, "the corners of a polygon run clockwise; it faces up all the same");
    std::ranges::reverse(solid.points);
  }
  std::vector<std::uint32_t> corners(solid.points.size());
  std::iota(corners.begin(), corners.end(), 0U);
  add_face(solid, corners);
  take_fitted(d, std::move(solid), key, state);
}

}  // namespace seedmesh::building::operators
