#include "core/generators/building/lifted_faces.h"

#include <algorithm>

namespace seedmesh::building {
namespace {

// Key of lifted faces among Derivation::raised_solids, behind prisms and pyramids.
constexpr int lifted_key = 6;

/// The axis along which all points have one coordinate; -1: there is none.
int axis_of_plane(const Solid& solid) {
  for (int axis = 2; axis >= 0; --axis) {
    const double at = solid.points[0][axis];
    if (std::ranges::all_of(solid.points, [&](const glm::dvec3& p) { return p[axis] == at; })) return axis;
  }
  return -1;
}

}  // namespace

void lift_face(Derivation& d, ShapeState& state, int axis) {
  const auto [found, is_new] = d.raised_solids.try_emplace({state.geometry, lifted_key + axis}, none);
  if (is_new) {
    Solid face = flat_solid(d, state);
    for (glm::dvec3& p : face.points) p[axis] = 0;
    face.is_closed = false;
    found->second = add_solid(d, std::move(face));
  }
  state.geometry = found->second;
}

void lower_face(Derivation& d, ShapeState& state) {
  if (!state.has_solid() || dimension(state.size) != 3) return;
  const Solid& solid = d.out.solid_of(state.geometry);
  if (solid.is_closed || solid.faces.empty()) return;
  const int axis = axis_of_plane(solid);
  if (axis < 0) return;
  const double at = solid.points[0][axis];
  state.origin += d.out.axes[state.axes][axis] * (at * state.size[axis]);
  state.size[axis] = 0;
  const Solid& square = d.squares[static_cast<std::size_t>(axis)];
  if (solid.points == square.points && solid.corners == square.corners) {
    state.geometry = box_geometry;
  } else if (at != 0) {
    Solid face = solid;
    for (glm::dvec3& p : face.points) p[axis] = 0;
    state.geometry = add_solid(d, std::move(face));
  }
}

}  // namespace seedmesh::building
