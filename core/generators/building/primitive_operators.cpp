/// Built-in solids with a number of sides, and parts placed along texture coordinates.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/math.h"
#include "core/generators/building/containment.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/projections.h"
#include "core/generators/building/round_solids.h"

namespace seedmesh::building::operators {
namespace {

constexpr std::uint32_t most_sphere_faces = 50'000;
constexpr double most_sides = 1'000, most_copies = 10'000;

RoundForm smooth_above_8(std::uint32_t sides) { return {.sides = sides, .is_smooth = sides > 8}; }

std::uint32_t sides_at(Derivation& d, const Step& step, std::uint32_t i, double other) {
  const double sides = number_or(d, step, i, other);
  if (!(sides >= 3 && sides <= most_sides))
    reject(d, step.offset, "found " + text_of_number(sides) + " sides, expected 3 to 1000");
  return math::to_uint32(std::floor(sides));
}

double length_at(Derivation& d, const Step& step, std::uint32_t i) {
  double length = number_or(d, step, i, 0);
  if (length < 0 && d.grammar.is_cityengine) {
    warn(d, step.offset, "found a negative length; its absolute value is used");
    length = -length;
  }
  if (!(length > 0))
    reject(d, step.offset, "found a length of " + text_of_number(length) + " m, expected more than 0");
  return length;
}

/// The number of an equal solid, made once.
std::uint32_t stored(Derivation& d, const std::string& name, Solid (*make)(std::uint32_t, std::uint32_t),
                     std::uint32_t a, std::uint32_t b) {
  const std::string key = name + " " + std::to_string(a) + " " + std::to_string(b);
  const auto found = d.named_solids.find(key);
  if (found != d.named_solids.end()) return found->second;
  const std::uint32_t made = add_solid(d, make(a, b));
  d.named_solids.emplace(key, made);
  return made;
}

/// The normal of a quad or a disk: y, or in files of CityEngine the axis along which a face has no size.
int flat_primitive_axis(const Derivation& d, const glm::dvec3& scope) {
  return d.grammar.is_cityengine && dimension(scope) == 2 ? flat_axis(scope) : 1;
}

/// The sizes of a quad or a disk of this normal: the first one is along x, or along y if that is the normal's.
glm::dvec3 flat_size(int normal, double width, double length) {
  glm::dvec3 size(0);
  size[normal == 0 ? 1 : 0] = width;
  size[normal == 2 ? 1 : 2] = length;
  return size;
}

Solid disk_across(std::uint32_t sides, std::uint32_t normal) {
  Solid disk = disk_of({.sides = sides});
  for (glm::dvec3& p : disk.points) {
    const glm::dvec3 level = p;
    for (std::uint32_t k = 0; k < 3; ++k)
      p[static_cast<int>((normal + k) % 3)] = level[static_cast<int>((1 + k) % 3)];
  }
  return disk;
}

/// Sizes of 0 become those of the unit solid in proportion to the others, as for i(); a flat solid has a normal.
void fill_scope(ShapeState& state, std::optional<int> normal) {
  double sum = 0;
  int given = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == normal) continue;
    sum += state.size[axis];
    given += state.size[axis] != 0;
  }
  const double other = given > 0 ? sum / given : 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (state.size[axis] == 0) state.size[axis] = other;
  }
  if (normal) state.size[*normal] = 0;
}

/// Moves a solid of a given size to the middle of the scope, except along the axis `up`, where it begins at 0.
void center_on(Derivation& d, ShapeState& state, const glm::dvec3& scope, int up) {
  const glm::dmat3& axes = d.out.axes[state.axes];
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != up) state.origin += axes[axis] * (0.5 * (scope[axis] - state.size[axis]));
  }
}

}  // namespace

void primitive(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const std::uint32_t count = step.argument_count;
  const glm::dvec3 scope = state.size;
  state.roof_up = no_roof;
  const auto radius_and_height = [&](std::uint32_t at) {
    const double r = length_at(d, step, at), h = length_at(d, step, at + 1);
    state.size = {2 * r, h, 2 * r};
  };
  std::optional<int> normal;
  if (step.op == Op::primitive_quad || step.op == Op::primitive_disk) normal = flat_primitive_axis(d, scope);
  bool has_size = false;
  switch (step.op) {
    case Op::primitive_quad:
      has_size = count == 2;
      if (count == 1) reject(d, step.offset, "primitiveQuad takes a width and a length");
      if (has_size) state.size = flat_size(*normal, length_at(d, step, 0), length_at(d, step, 1));
      state.geometry = box_geometry;
      break;
    case Op::primitive_cube:
      has_size = count == 3;
      if (count == 1 || count == 2)
        reject(d, step.offset, "primitiveCube takes a width, a height and a depth");
      if (has_size) state.size = {length_at(d, step, 0), length_at(d, step, 1), length_at(d, step, 2)};
      state.geometry = box_geometry;
      break;
    case Op::primitive_disk:
      state.geometry = stored(
          d, "disk", [](std::uint32_t a, std::uint32_t b) { return disk_across(a, b); },
          sides_at(d, step, 0, 32), static_cast<std::uint32_t>(*normal));
      has_size = count == 2;
      if (has_size) state.size = flat_size(*normal, 2 * length_at(d, step, 1), 2 * length_at(d, step, 1));
      break;
    case Op::primitive_sphere: {
      const std::uint32_t rows = count > 1 ? sides_at(d, step, 1, 16) : 16;
      if (sides_at(d, step, 0, 32) * rows > most_sphere_faces)
        reject(d, step.offset, "found a sphere of more than 50,000 faces");
      state.geometry = stored(
          d, "sphere", [](std::uint32_t a, std::uint32_t b) { return sphere_of({.sides = a}, b); },
          sides_at(d, step, 0, 32), rows);
      has_size = count == 3;
      if (has_size) state.size = glm::dvec3(2 * length_at(d, step, 2));
      break;
    }
    default: {
      const bool is_cone = step.op == Op::primitive_cone;
      const std::uint32_t sides = sides_at(d, step, 0, 32);
      state.geometry =
          is_cone
              ? stored(
                    d, "cone", [](std::uint32_t a, std::uint32_t) { return cone_of(smooth_above_8(a)); },
                    sides, 0)
              : stored(
                    d, "cylinder",
                    [](std::uint32_t a, std::uint32_t) { return cylinder_of(smooth_above_8(a)); }, sides, 0);
      has_size = count == 3;
      if (count == 2) reject(d, step.offset, "found a radius without a height");
      if (has_size) radius_and_height(1);
    }
  }
  if (has_size) {
    center_on(d, state, scope, normal.value_or(1));
  } else {
    fill_scope(state, normal);
  }
}

/// insertAlongUV(set, name, height): a copy in every tile of the texture coordinates that lies inside the shape. x of the copy
/// runs along u, z against v, y along the normal.
void insert_along_uv(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  const int set = uv_set_at(d, step, 0);
  const double height = number_or(d, step, 2, 0);
  if (dimension(state.size) != 2 || state.has_asset()) {
    warn(d, step.offset, "insertAlongUV needs a face; this shape is left out");
    return;
  }
  const Projection projection = projection_of(d, state, set);
  const UvRange range = uv_range(d, state, set);
  const glm::dmat3& axes = d.out.axes[state.axes];
  const glm::dvec3 normal = axes[flat_axis(state.size)];
  const auto in_plane = [&](const glm::dvec3& v) { return v - normal * glm::dot(normal, v); };
  const glm::dvec3 u = in_plane(projection.u), v = in_plane(projection.v);
  const double determinant = glm::dot(glm::cross(u, v), normal);
  if (!(std::abs(determinant) > 1e-12)) reject(d, step.offset, "u and v have one direction on this shape");
  // The steps in the world for which u, and v, rise by 1.
  const glm::dvec3 along_u = glm::cross(v, normal) / determinant,
                   along_v = glm::cross(normal, u) / determinant;
  const glm::dvec3 origin = state.origin -
                            along_u * (glm::dot(projection.u, state.origin) + projection.u_at) -
                            along_v * (glm::dot(projection.v, state.origin) + projection.v_at);
  const double first_u = std::floor(range.low[0] + 1e-6), last_u = std::ceil(range.high[0] - 1e-6);
  const double first_v = std::floor(range.low[1] + 1e-6), last_v = std::ceil(range.high[1] - 1e-6);
  if (!((last_u - first_u) * (last_v - first_v) <= most_copies))
    reject(d, step.offset, "insertAlongUV would make more than 10,000 copies");
  ShapeState tile = state;
  const glm::dvec3 x = math::unit(along_u, axes[0]);
  const glm::dvec3 z = math::unit(-along_v - x * glm::dot(x, -along_v), axes[2]);
  const glm::dvec3 y = glm::cross(z, x);
  tile.axes = add_axes(d, {x, y, z});
  tile.size = {glm::length(along_u), std::abs(height), std::abs(glm::dot(along_v, z))};
  tile.geometry = box_geometry;
  std::uint64_t place = 0;
  for (double row = first_v; row < last_v; ++row) {
    for (double column = first_u; column < last_u; ++column) {
      // A tile that lies outside by more than a half is left out.
      if (std::min(column + 1, range.high[0]) - std::max(column, range.low[0]) < 0.5 ||
          std::min(row + 1, range.high[1]) - std::max(row, range.low[1]) < 0.5)
        continue;
      ShapeState copy = tile;
      copy.origin = origin + along_u * column + along_v * (row + 1);
      if (glm::dot(y, normal) * height < 0) copy.origin += y * -std::abs(height);
      insert_named_geometry(d, step, copy, text_of(d, argument_at(d, step, 1)));
      check_containment(d, site.frame.shape, copy, step.offset);
      add_leaf(d, copy, site.frame, key_at(site.key, place++), d.out.shapes[site.frame.shape].symbol);
    }
  }
}

}  // namespace seedmesh::building::operators
