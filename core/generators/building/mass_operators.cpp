/// Masses over an outline: extrusion in a direction, envelopes, ridges, and footprints. Definitions as in the CGA reference.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/face_plans.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/raised_solids.h"
#include "core/generators/building/solid_faces.h"
#include "core/generators/building/solid_tools.h"
#include "core/generators/building/value_functions.h"
#include "core/geom/polygon/roof.h"

namespace seedmesh::building {
namespace {

/// The vector for each corner that moves all faces at it outwards by `height`: the mean of their normals, lengthened so that
/// each face moves by `height` if possible.
std::vector<glm::dvec3> along_vertices(const Solid& solid, double height) {
  std::vector<std::vector<glm::dvec3>> normals(solid.points.size());
  for (const Face& face : solid.faces) {
    const glm::dvec3 n = unit_normal(solid, face);
    for (const Loop& loop : loops_of(solid, face)) {
      for (const std::uint32_t point : points_of(solid, loop)) {
        auto& own = normals[point];
        if (std::ranges::none_of(own, [&](const glm::dvec3& other) { return glm::dot(other, n) > 1 - 1e-9; }))
          own.push_back(n);
      }
    }
  }
  std::vector<glm::dvec3> out;
  for (const auto& own : normals) {
    glm::dvec3 mean(0);
    for (const glm::dvec3& n : own) mean += n;
    mean = math::unit(mean, glm::dvec3(0, 1, 0));
    double least = 1;
    for (const glm::dvec3& n : own) least = std::min(least, glm::dot(mean, n));
    out.push_back(mean * (height / std::max(least, 0.2)));
  }
  return out;
}

/// Every face as an extrusion of its own.
Solid extruded_alone(const Solid& solid, double height) {
  Solid out;
  out.is_closed = true;
  for (const Face& face : solid.faces) {
    Solid own;
    own.faces.push_back({0, face.loop_count});
    own.faces[0].tags = face.tags;
    for (const Loop& loop : loops_of(solid, face)) {
      std::vector<std::uint32_t> corners;
      for (const std::uint32_t point : points_of(solid, loop)) {
        corners.push_back(static_cast<std::uint32_t>(own.points.size()));
        own.points.push_back(solid.points[point]);
      }
      add_loop(own, corners);
    }
    const std::vector<glm::dvec3> by(own.points.size(), unit_normal(solid, face) * height);
    append(out, extruded_by(own, by));
  }
  return out;
}

/// The part of a solid where height - rise.(p - at) <= 0, for a plane that rises from `at`: the coordinate `up` is sheared so
/// that the plane is level, cut, and sheared back.
Solid cut_by_slope(Solid solid, int up, const glm::dvec3& at, const glm::dvec3& rise) {
  const auto slope = [&](const glm::dvec3& p) { return at[up] + glm::dot(rise, p - at); };
  for (glm::dvec3& p : solid.points) p[up] -= slope(p);
  solid = clipped(solid, up, 0, 1);
  for (glm::dvec3& p : solid.points) p[up] += slope(p);  // which does not depend on p[up]
  return solid;
}

double cut_angle(Derivation& d, const Step& step, double degrees) {
  if (!(degrees > 0 && degrees <= 90)) {
    reject(d, step.offset,
           "found a slope of " + text_of_number(degrees) + " degrees, expected one above 0 and up to 90");
  }
  return degrees;
}

}  // namespace

void extrude_in(Derivation& d, const Step& step, ShapeState& state, const std::string& direction,
                double height) {
  constexpr std::string_view world_axes[] = {"world.x",  "world.y",  "world.z",
                                             "object.x", "object.y", "object.z"};
  const auto axis = std::ranges::find(world_axes, direction);
  Solid solid = welded(solid_in_metres(d, state), 0);
  if (solid.faces.empty()) return;
  const glm::dvec3 up = glm::transpose(d.out.axes[state.axes]) * glm::dvec3(0, 1, 0);
  std::vector<glm::dvec3> by(solid.points.size(), up * height);
  if (direction == "world.up.flatTop") {
    double low = 1e300, high = -1e300;
    for (const glm::dvec3& p : solid.points) {
      low = std::min(low, glm::dot(p, up));
      high = std::max(high, glm::dot(p, up));
    }
    const double top = low + std::max(height, high - low);
    for (std::size_t i = 0; i < by.size(); ++i)
      by[i] = up * std::max(0.0, top - glm::dot(solid.points[i], up));
  } else if (direction == "vertex.normal") {
    by = along_vertices(solid, height);
  } else if (direction.size() == 1 && direction[0] >= 'x' && direction[0] <= 'z') {
    glm::dvec3 along(0);
    along[direction[0] - 'x'] = height;
    by.assign(by.size(), along);
  } else if (axis != std::end(world_axes)) {
    glm::dvec3 along(0);
    along[direction.back() - 'x'] = height;
    by.assign(by.size(), glm::transpose(d.out.axes[state.axes]) * along);
  } else if (direction != "world.up" && direction != "face.normal") {
    reject(d, step.offset,
           "found the direction " + lang::in_quotes(direction) +
               ", expected world.up, world.up.flatTop, world.x, vertex.normal, face.normal, x, y or z");
  }
  // A closed solid, and faces along their own normals, become one body for each face.
  const bool alone = direction == "face.normal" || is_watertight(solid);
  if (alone) {
    take_solid(d, state, extruded_alone(solid, height));
    return;
  }
  Solid made = extruded_by(solid, by);
  // Faces that face away from the direction are turned over, so that the outside stays outside.
  Solid measured = made;
  measured.is_closed = true;
  if (volume_of(measured, glm::dvec3(1)) < 0) {
    for (const Loop& loop : made.loops)
      std::reverse(made.corners.begin() + loop.first, made.corners.begin() + loop.first + loop.count);
  }
  take_solid(d, state, std::move(made));
}

Solid outline_along(const Solid& solid, int axis, double side) {
  Solid out;
  for (const Face& face : solid.faces) {
    if (!(unit_normal(solid, face)[axis] * side > 1e-6)) continue;
    Face copy = face;
    copy.first_loop = static_cast<std::uint32_t>(out.loops.size());
    for (const Loop& loop : loops_of(solid, face)) {
      const auto first = static_cast<std::uint32_t>(out.corners.size());
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const std::uint32_t corner = side < 0 ? loop.count - 1 - i : i;
        glm::dvec3 p = solid.points[solid.corners[loop.first + corner]];
        p[axis] = 0;
        out.corners.push_back(static_cast<std::uint32_t>(out.points.size()));
        out.points.push_back(p);
      }
      out.loops.push_back({first, loop.count});
    }
    out.faces.push_back(copy);
  }
  return out.faces.empty() ? out : without_straight_corners(with_joined_faces(welded(out, 0), 0), 0);
}

bool raises_faces(Op op) {
  constexpr Op raising[] = {Op::extrude,      Op::taper,       Op::envelope,     Op::roof_ridge,
                            Op::roof_hip,     Op::roof_gable,  Op::roof_pyramid, Op::roof_shed,
                            Op::roof_mansard, Op::roof_gambrel};
  return std::ranges::find(raising, op) != std::end(raising);
}

bool is_level_face(const Derivation& d, const ShapeState& state) {
  return dimension(state.size) == 2 && d.out.axes[state.axes][flat_axis(state.size)].y > 1 - 1e-9;
}

void face_forward(Derivation& d, const Step& step, ShapeState& state) {
  if (!raises_faces(step.op) || dimension(state.size) != 2 || !state.has_solid()) return;
  const Solid& solid = d.out.solid_of(state.geometry);
  const int flat = flat_axis(state.size);
  if (solid.faces.empty() || unit_normal(solid, solid.faces[0])[flat] >= 0) return;
  glm::dmat3 axes = d.out.axes[state.axes];
  axes[flat] = -axes[flat];
  const int other = flat == 2 ? 1 : 2;  // x stays if it can
  axes[other] = -axes[other];
  reframe(d, state, axes);
}

void stand_up(Derivation& d, const Step& step, const ShapeState& before, ShapeState& state) {
  if (!raises_faces(step.op) || dimension(before.size) != 2 || dimension(state.size) != 3 ||
      state.has_asset())
    return;
  const glm::dmat3& axes = d.out.axes[state.axes];
  glm::dvec3 up = d.out.axes[before.axes][flat_axis(before.size)];
  if ((step.op == Op::extrude || step.op == Op::envelope) && is_word(d, step, 0)) {
    const std::string direction = word_at(d, step, 0);
    if (direction.starts_with("world.up") || direction == "world.y") up = glm::dvec3(0, 1, 0);
  }
  if (glm::dot(axes[1], up) > 1 - 1e-12) return;
  glm::dvec3 along = axes[0] - up * glm::dot(axes[0], up);
  if (glm::length(along) < 1e-6) along = axes[2] - up * glm::dot(axes[2], up);
  along = math::unit(along, axes[0]);
  const bool is_roof = state.roof_up != no_roof;
  reframe(d, state, glm::dmat3(along, up, glm::cross(along, up)));
  if (is_roof) state.roof_up = 1;
}

namespace {

bool is_convex(const PlanRing& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[(i + 1) % ring.size()] - ring[i],
                     b = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
    if (a.x * b.y - a.y * b.x <= -1e-9 * glm::length(a) * glm::length(b)) return false;
  }
  return true;
}

/// 0 front, 1 back, 2 right (or side), 3 left: where an edge of a face across axis `w` faces.
std::uint32_t side_of(const glm::dvec3& outward, int w) {
  const double forward = w == 2 ? -outward.y : outward.z;
  if (std::abs(forward) >= std::abs(outward.x)) return forward > 0 ? 0 : 1;
  return outward.x > 0 ? 2 : 3;
}

}  // namespace

namespace operators {

/// envelope(direction, height, base and angle of the front, back, right and left edges), or arrays of them by edge.
void envelope(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const std::string direction = word_at(d, step, 0);
  if (direction != "normal" && direction != "world.up")
    reject(d, step.offset, "found " + lang::in_quotes(direction) + ", expected normal or world.up");
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for envelope");
  const double height = number_or(d, step, 1, 0);
  if (!(height > 0))
    reject(d, step.offset, "found a height of " + text_of_number(height) + " m, expected more than 0");
  const FacePlane plane(state.size);
  Evaluation at{d, step.offset};
  const lang::TaggedValue first = evaluate(d, argument_at(d, step, 2).value);
  ValueArray bases, angles;
  if (is_array(first)) {
    bases = array_in(at, first);
    angles = array_in(at, evaluate(d, argument_at(d, step, 3).value));
  }
  Solid all;
  all.is_closed = true;
  std::uint32_t edge_number = 0;
  for (const Plan& plan : plans_of(flat_solid(d, state), state.size, plane)) {
    Solid flat;
    add_plan(flat, plan, plane, 0);
    glm::dvec3 up(0);
    up[plane.w] = height;
    Solid mass = extruded_by(welded(flat, 0), std::vector<glm::dvec3>(welded(flat, 0).points.size(), up));
    if (plan.rings.size() != 1 || !is_convex(plan.rings[0])) {
      warn(d, step.offset,
           "the outline is not convex: slopes from its edges cut all of the volume that lies inside of them");
    }
    for (std::uint32_t e = 0; e < edge_count(plan); ++e, ++edge_number) {
      const auto [from, to] = edge_of(plan, e);
      const glm::dvec2 along = (to - from) / glm::length(to - from), inwards(-along.y, along.x);
      const std::uint32_t side = side_of(plane.raised(-inwards, 0), plane.w);
      double base = height, angle = 90;
      if (is_array(first)) {
        if (edge_number < bases.values.size()) base = number_in(at, bases.values[edge_number]);
        if (edge_number < angles.values.size()) angle = number_in(at, angles.values[edge_number]);
      } else {
        std::uint32_t place = 2 + 2 * side;
        if (place >= step.argument_count && side == 3) place = 6;
        if (place >= step.argument_count) place = 2;
        base = number_or(d, step, place, height);
        angle = number_or(d, step, place + 1, 90);
      }
      angle = cut_angle(d, step, angle);
      if (angle >= 90 || base >= height) continue;
      const double tangent = math::tan(math::radians(angle));
      mass = cut_by_slope(std::move(mass), plane.w, plane.raised(from, std::max(0.0, base)),
                          plane.raised(inwards * tangent, 0));
      if (mass.faces.empty()) break;
      d.job.check();
    }
    append(all, mass);
  }
  if (all.faces.empty()) return;
  take_solid(d, state, std::move(all));
}

/// roofRidge(angle) or roofRidge(byHeight, 3): two planes that rise from the front and the back of the scope to a ridge along x.
void roof_ridge(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for roofRidge");
  for (std::uint32_t i = 1; i < step.argument_count && i < 3; ++i) {
    if (number_or(d, step, i, 0) != 0) warn(d, step.offset, "roofRidge has no overhang");
  }
  const FacePlane plane(state.size);
  // The axis across the ridge: that of the plane that is not x.
  const int across = plane.u == 0 ? plane.v : plane.u;
  const double half = 0.5 * state.size[across];
  const Argument& argument = argument_at(d, step, 0);
  const double given = number_of(d, argument.value);
  const double height = argument.measure == Measure::height ? given : half * math::tan(math::radians(given));
  if (!(height > 0 && height < 1e6))
    reject(d, step.offset, "found a roof height of " + text_of_number(height) + " m, expected more than 0");
  const Solid flat = welded(solid_in_metres(d, state), 0);
  glm::dvec3 up(0);
  up[plane.w] = 2 * height;
  Solid mass = extruded_by(flat, std::vector<glm::dvec3>(flat.points.size(), up));
  for (const double side : {1.0, -1.0}) {
    glm::dvec3 rise(0), at(0);
    rise[across] = side * height / half;
    if (side < 0) at[across] = state.size[across];
    mass = cut_by_slope(std::move(mass), plane.w, at, rise);
  }
  take_solid(d, state, std::move(mass));
  state.roof_up = static_cast<std::uint8_t>(plane.w);
}

/// footprint(): the faces that look down, moved to the lowest level and turned over. Flat shapes, and those that are open
/// below, use the faces that face up.
void footprint(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  if (state.has_asset() || dimension(state.size) < 2) {
    if (state.has_asset() && dimension(state.size) == 3) {
      state.geometry = box_geometry;
      state.size.y = 0;
      return;
    }
    return warn(d, step.offset, "footprint needs a shape with faces; this one does not change");
  }
  if (state.geometry == box_geometry && state.size.x > 0 && state.size.z > 0) {
    state.size.y = 0;
    return;
  }
  const Solid solid = solid_in_metres(d, state);
  Solid out = outline_along(solid, 1, -1);
  if (out.faces.empty()) out = outline_along(solid, 1, 1);
  if (out.faces.empty()) return;
  state.roof_up = no_roof;
  take_solid(d, state, std::move(out));
}

}  // namespace operators
}  // namespace seedmesh::building
