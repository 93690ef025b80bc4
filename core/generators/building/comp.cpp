/// The component split: faces, edges and corners as shapes.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/deriver.h"

namespace seedmesh::building {
namespace {

/// A face of a box in its scope: where its own scope begins (share of the size), its axes, and which sizes it
/// has.
struct Side {
  glm::dvec3 at;
  glm::dmat3 axes;
  int u, v;
};
// Front, right, back, left, top, bottom; x runs counter-clockwise around the box, y up, z out of the face.
const std::array<Side, 6> sides = {{
    {{0, 0, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, 1},
    {{1, 0, 1}, {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, 2, 1},
    {{1, 0, 0}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, 0, 1},
    {{0, 0, 0}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}, 2, 1},
    {{0, 1, 1}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 0, 2},
    {{0, 0, 0}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 0, 2},
}};

constexpr std::size_t most_masses = 2'000;

// Sines of 11.25 and 78.75 degrees, the borders of the classes by slope.
constexpr double sine_low = 0.19509032201612825, sine_high = 0.98078528040323043;

/// The frame of a face with this normal: x level where the face is not, else along its first edge.
glm::dmat3 frame_of(const glm::dvec3& normal, const glm::dvec3& first_edge) {
  glm::dvec3 x = glm::cross(glm::dvec3(0, 1, 0), normal);
  if (glm::dot(x, x) < 1e-12) x = first_edge - normal * glm::dot(normal, first_edge);
  x = math::unit(x, glm::dvec3(1, 0, 0));
  return {x, glm::cross(normal, x), normal};
}

}  // namespace

/// Classes of a face by its z axis, seen from the scope that is taken apart (face.axes are in it already).
std::uint32_t Deriver::classes_of(const State& face) const {
  const glm::dmat3& axes = out_.axes[seen_->axes];
  glm::dvec3 n = glm::transpose(axes) * out_.axes[face.axes][2];
  if (seen_->roof_up != no_roof) {
    // A roof over a face that lies is told by the world's upright, whichever axis of its scope that is.
    const int up = seen_->roof_up, u = (up + 1) % 3, v = (up + 2) % 3;
    const double height = out_.axes[face.axes][2].y;
    n = up == 1 ? glm::dvec3(n.x, height, n.z) : glm::dvec3(n[u], height, -n[v]);
  }
  std::uint32_t classes = face_all;
  if (face.tag == face_is_inside) classes |= face_inside;
  if (face.tag == face_is_border) classes |= face_border;
  const glm::dvec3 a = glm::abs(n);
  if (a.y >= a.x && a.y >= a.z) {
    classes |= n.y > 0 ? face_top : face_bottom;
  } else {
    classes |= face_side;
    if (a.z >= a.x)
      classes |= n.z > 0 ? face_front : face_back;
    else
      classes |= n.x > 0 ? face_right : face_left;
  }
  if (a.y > sine_high)
    classes |= face_horizontal;
  else if (n.y > sine_low)
    classes |= face_aslant;
  else if (n.y < -sine_low)
    classes |= face_nutant;
  else
    classes |= face_vertical;
  return classes;
}

void Deriver::box_faces(const State& state, std::vector<State>& out) {
  const int flat = dimension(state.size) == 2 ? flat_axis(state.size) : -1;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    const int normal = 3 - side.u - side.v;
    const double outward = side.axes[2][normal];
    if (flat >= 0 && (normal != flat || outward < 0)) continue;
    const std::uint64_t key = static_cast<std::uint64_t>(state.axes) << 3U | i;
    const auto [found, is_new] = turned_.try_emplace(key, 0);
    if (is_new) found->second = add_axes(out_.axes[state.axes] * side.axes);
    State face = state;
    face.axes = found->second;
    face.origin = state.origin + out_.axes[state.axes] * (side.at * state.size);
    face.size = {state.size[side.u], state.size[side.v], 0};
    out.push_back(face);
  }
}

void Deriver::solid_faces(const State& state, std::vector<State>& out) {
  const Solid& solid = out_.solid_of(state.geometry);
  for (const Face& each : solid.faces) {
    const glm::dvec3 normal = math::unit(area_vector(solid, each, state.size), glm::dvec3(0, 1, 0));
    const Loop& outer = solid.loops[each.first_loop];
    const glm::dvec3 base = solid.points[solid.corners[outer.first]] * state.size;
    const glm::dvec3 edge = solid.points[solid.corners[outer.first + 1]] * state.size - base;
    const glm::dmat3 frame = frame_of(normal, edge);
    Solid face;
    for (std::uint32_t l = each.first_loop; l < each.first_loop + each.loop_count; ++l) {
      const Loop& loop = solid.loops[l];
      face.loops.push_back({static_cast<std::uint32_t>(face.corners.size()), loop.count});
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        face.corners.push_back(static_cast<std::uint32_t>(face.points.size()));
        glm::dvec3 p =
            glm::transpose(frame) * (solid.points[solid.corners[loop.first + i]] * state.size - base);
        p.z = 0;
        face.points.push_back(p);
      }
    }
    face.faces.push_back({0, each.loop_count, false});
    glm::dvec3 low, extent;
    fit(face, low, extent);
    if (extent.x == 0 || extent.y == 0) continue;
    State made = state;
    made.roof_up = no_roof;
    made.origin = state.origin + out_.axes[state.axes] * (base + frame * low);
    made.axes = add_axes(out_.axes[state.axes] * frame);
    made.size = {extent.x, extent.y, 0};
    const bool is_rectangle =
        face.points.size() == 4 && std::ranges::all_of(face.points, [](const glm::dvec3& p) {
          return (p.x < 1e-9 || p.x > 1 - 1e-9) && (p.y < 1e-9 || p.y > 1 - 1e-9);
        });
    made.geometry = is_rectangle ? box_geometry : add_solid(std::move(face));
    made.tag = each.tag;
    out.push_back(made);
  }
}

/// Each edge once, in the order of the faces: x along it, z the mean of its faces' normals. Each corner once.
void Deriver::edges_and_corners(const State& state, int kind, std::vector<State>& out) {
  const Solid box =
      state.geometry == box_geometry
          ? (dimension(state.size) == 3 ? unit_box()
                                        : squares_[static_cast<std::size_t>(flat_axis(state.size))])
          : Solid{};
  const Solid& solid = state.geometry == box_geometry ? box : out_.solid_of(state.geometry);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> places;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
  std::vector<glm::dvec3> normals;
  for (const Face& face : solid.faces) {
    const glm::dvec3 normal = math::unit(area_vector(solid, face, state.size), glm::dvec3(0, 1, 0));
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const Loop& loop = solid.loops[l];
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const std::uint32_t a = solid.corners[loop.first + i];
        const std::uint32_t b = kind == 1 ? solid.corners[loop.first + (i + 1) % loop.count] : a;
        const auto [found, is_new] = places.try_emplace({std::min(a, b), std::max(a, b)}, order.size());
        if (is_new) {
          order.emplace_back(a, b);
          normals.emplace_back(0);
        }
        normals[found->second] += normal;
      }
    }
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    const glm::dvec3 a = solid.points[order[i].first] * state.size,
                     b = solid.points[order[i].second] * state.size;
    const glm::dvec3 z = math::unit(normals[i], glm::dvec3(0, 1, 0));
    glm::dmat3 frame = frame_of(z, glm::dvec3(1, 0, 0));
    if (kind == 1) {
      const glm::dvec3 x = math::unit(b - a, glm::dvec3(1, 0, 0));
      const glm::dvec3 up = math::unit(z - x * glm::dot(x, z), frame[1]);
      frame = {x, glm::cross(up, x), up};
    }
    State made = state;
    made.geometry = box_geometry;
    made.roof_up = no_roof;
    made.origin = state.origin + out_.axes[state.axes] * a;
    made.axes = add_axes(out_.axes[state.axes] * frame);
    made.size = {kind == 1 ? glm::length(b - a) : 0.0, 0, 0};
    out.push_back(made);
  }
}

void Deriver::components(const State& state, int kind, std::vector<State>& out) {
  if (kind != 0) return edges_and_corners(state, kind, out);
  if (state.geometry == box_geometry) return box_faces(state, out);
  solid_faces(state, out);
}

/// Faces put together again: one shape in the scope around them.
void Deriver::merge(const State& state, std::span<const State> faces, State& out) {
  Solid all;
  const glm::dmat3 back = glm::transpose(out_.axes[state.axes]);
  std::map<std::array<std::int64_t, 3>, std::uint32_t> places;  // corners that faces share are one point
  for (const State& face : faces) {
    const Solid& solid = flat_solid(face);
    for (const Face& each : solid.faces) {
      Face copy{static_cast<std::uint32_t>(all.loops.size()), each.loop_count, false};
      for (std::uint32_t l = each.first_loop; l < each.first_loop + each.loop_count; ++l) {
        const Loop& loop = solid.loops[l];
        all.loops.push_back({static_cast<std::uint32_t>(all.corners.size()), loop.count});
        for (std::uint32_t i = 0; i < loop.count; ++i) {
          const glm::dvec3 p =
              back * (face.origin +
                      out_.axes[face.axes] * (solid.points[solid.corners[loop.first + i]] * face.size) -
                      state.origin);
          const std::array<std::int64_t, 3> key = {math::to_int64(p.x * 1e7 + 0.5),
                                                   math::to_int64(p.y * 1e7 + 0.5),
                                                   math::to_int64(p.z * 1e7 + 0.5)};
          const auto [found, is_new] = places.try_emplace(key, static_cast<std::uint32_t>(all.points.size()));
          if (is_new) all.points.push_back(p);
          all.corners.push_back(found->second);
        }
      }
      all.faces.push_back(copy);
    }
  }
  glm::dvec3 low, extent;
  fit(all, low, extent);
  out = state;
  out.origin = state.origin + out_.axes[state.axes] * low;
  out.size = extent;
  out.geometry = add_solid(std::move(all));
}

void Deriver::comp(const Step& step, const State& state, const Frame& frame, std::uint64_t key) {
  if ((state.geometry & asset_bit) != 0) reject(step.offset, "an inserted asset cannot be taken apart");
  std::vector<State> all;
  if (dimension(state.size) >= 2) components(state, step.axis, all);
  std::vector<std::uint32_t> classes(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    look_at(state, frame.shape);
    classes[i] = classes_of(all[i]);
  }
  std::vector<std::uint8_t> is_taken(all.size(), 0);
  Frame own = frame;
  const bool is_body = dimension(state.size) == 3 &&
                       (state.geometry == box_geometry || out_.solid_of(state.geometry).is_closed);
  if (is_body && plan_.keeps_masses && !frame.is_carried && out_.masses.size() < most_masses)
    out_.masses.push_back({state.origin, state.size, state.axes, state.geometry});
  own.is_carried |= is_body;
  std::uint32_t place = 0;
  for (std::uint32_t p = 0; p < step.part_count; ++p) {
    const Part& part = grammar_.parts[step.first_part + p];
    std::vector<State> taken;
    std::int32_t number = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((classes[i] & part.classes) == 0) continue;
      const std::int32_t own_number = number++;
      if (is_taken[i] != 0 || (part.index >= 0 && own_number != part.index)) continue;
      is_taken[i] = 1;
      taken.push_back(all[i]);
    }
    if (taken.empty()) continue;
    if (part.is_merged && step.axis == 0) {
      State merged;
      merge(state, taken, merged);
      taken.assign(1, merged);
    }
    for (std::uint32_t i = 0; i < taken.size(); ++i) {
      taken[i].comp_index = i;
      taken[i].comp_total = static_cast<std::uint32_t>(taken.size());
      own.key = key_at(key, place++);
      run_body(part.body, taken[i], own);
    }
  }
}

}  // namespace seedmesh::building
