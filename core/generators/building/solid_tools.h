#pragma once
/// Operations on the faces of a solid: joining corners and faces, convex parts, extrusion in a direction.
#include "core/base/job.h"
#include "core/generators/building/solid.h"

namespace seedmesh::building {

/// Joins corners nearer than `distance` (0: equal ones), and drops edges without a length and faces without an area.
Solid welded(const Solid& solid, double distance);
/// Joins neighbouring faces of one plane, within `distance`. Faces of different tags stay apart.
Solid with_joined_faces(const Solid& solid, double distance);
/// Removes corners on straight edges that no face needs, within `distance`.
Solid without_straight_corners(const Solid& solid, double distance);
/// Puts corners that lie on an edge of another face into that edge, so that faces meet edge to edge.
Solid with_shared_corners(const Solid& solid, double distance, const Job& job);
/// Returns each face as convex faces: triangles that are joined while they stay convex (Hertel and Mehlhorn,
/// 1983). Checks stop and deadline.
Solid convex_faces(const Solid& solid, const Job& job);
/// Returns the triangles of one face, as indices of points. Checks stop and deadline.
std::vector<std::uint32_t> triangles_of(const Solid& solid, const Face& face, const Job& job);

/// Moves copies of all faces by a vector for each point. The original faces turn over, and walls join both at
/// edges with one face. The result is closed if each edge had at most two faces.
Solid extruded_by(const Solid& faces, std::span<const glm::dvec3> by);

/// Whether every edge has two faces that run along it in opposite directions.
bool is_watertight(const Solid& solid);

}  // namespace seedmesh::building
