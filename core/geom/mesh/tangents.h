#pragma once
/// Tangents for normal maps.
#include "core/model/model.h"

namespace seedmesh {

/// Returns a unit vector at right angles to a unit vector.
glm::vec3 any_perpendicular(const glm::vec3& normal);

/// Adds tangents to every triangle mesh that has normals, a material with a normal map, and the texture
/// coordinates of that map. A tangent is a unit vector at right angles to the normal: the mean direction in
/// which u grows over the triangles of a vertex, weighted by area. Its w is the sign of the bitangent, as in
/// glTF.
///
/// Where triangles at a vertex have opposite signs (a mirror seam whose vertices are not duplicated), those with
/// the larger total area decide. Where u grows nowhere, any direction in the surface is taken. Cost: about 15 ns
/// a triangle, and 16 bytes a vertex.
void add_tangents(Model& model, const Job& job);

}  // namespace seedmesh
