#pragma once
/// Tangents of organs for normal maps. The sums that add_tangents() (tangents.h) makes over the triangles of
/// a placed organ are linear in its positions. They are computed once for the surface and transformed with
/// it.
#include <cmath>
#include <vector>

#include "core/model/mesh.h"

namespace seedmesh {

/// The mean directions in which u and v of uv[0] grow at a vertex, weighted by area: unit vectors, or 0 where
/// the texture coordinates do not change.
struct TextureAxes {
  glm::vec3 u{0}, v{0};
  bool operator==(const TextureAxes&) const = default;
};

/// Returns the axes of each vertex of a surface with positions, uv[0] and wide indices.
std::vector<TextureAxes> texture_axes(const Mesh& surface);

/// Returns the unit vector of `v`, by one division. Sets the flag where the length is 0 or not of ordinary size.
inline glm::vec3 organ_unit(const glm::vec3& v, std::uint32_t& failure) {
  const float square = v.x * v.x + v.y * v.y + v.z * v.z;
  failure |= square > 1e-30F && square < 1e30F ? 0U : 1U;
  const float by = 1.0F / std::sqrt(square);
  return {v.x * by, v.y * by, v.z * by};
}

/// Returns the tangent at a unit normal, where u grows along `u` and `across` is the cross product of the directions
/// of u and v. Sets the flag where u grows along the normal.
inline glm::vec4 organ_tangent(const glm::vec3& normal, const glm::vec3& u, const glm::vec3& across,
                               std::uint32_t& failure) {
  const float along = normal.x * u.x + normal.y * u.y + normal.z * u.z;
  const glm::vec3 flat{u.x - normal.x * along, u.y - normal.y * along, u.z - normal.z * along};
  const float whole = u.x * u.x + u.y * u.y + u.z * u.z;
  const float square = flat.x * flat.x + flat.y * flat.y + flat.z * flat.z;
  failure |= ((square > 1e-6F * whole) & (square > 1e-30F) & (square < 1e30F)) ? 0U : 1U;
  const float by = 1.0F / std::sqrt(square);
  // v grows down the texture, and the bitangent points up.
  const float side = normal.x * across.x + normal.y * across.y + normal.z * across.z > 0.0F ? -1.0F : 1.0F;
  return {flat.x * by, flat.y * by, flat.z * by, side};
}

}  // namespace seedmesh
