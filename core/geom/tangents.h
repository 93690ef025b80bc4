#pragma once
/// Tangents for normal maps.
#include "core/model/model.h"

namespace seedmesh {

/// Some direction at right angles to a unit vector.
glm::vec3 any_across(const glm::vec3& normal);

/// Gives every triangle mesh whose material has a normal map, and that has normals and the map's texture
/// coordinates, unit tangents at right angles to its normals: the mean direction of growing u over the
/// triangles of a vertex, weighted by area, with the sign of the bitangent in w as glTF wants it. A vertex
/// between triangles that disagree (a mirrored seam that is not doubled) follows the larger ones; where u
/// grows nowhere, any direction in the surface is taken. About 15 ns a triangle; 16 bytes a vertex.
void add_tangents(Model& model, const Job& job);

}  // namespace seedmesh
