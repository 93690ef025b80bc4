#pragma once
/// Tangents of organs for normal maps: what add_tangents() (tangents.h) would sum over the triangles of a
/// placed organ is linear in its positions. So it is summed once, over the surface, and placed as they are.
#include <cmath>
#include <vector>

#include "core/model/mesh.h"

namespace seedmesh {

/// At a vertex of a surface: the mean directions in which u and v of uv[0] grow, weighted by area. `u` has
/// length 1, or 0 where u grows nowhere.
struct PictureSides {
  glm::vec3 u{0}, v{0};
  bool operator==(const PictureSides&) const = default;
};

/// Of each vertex. Positions, uv[0] and wide indices must be there.
std::vector<PictureSides> picture_sides(const Mesh& surface);

/// v / |v| by one quotient; sets the flag where the length is none or not of ordinary size.
inline glm::vec3 organ_unit(const glm::vec3& v, std::uint32_t& fault) {
  const float square = v.x * v.x + v.y * v.y + v.z * v.z;
  fault |= square > 1e-30F && square < 1e30F ? 0U : 1U;
  const float by = 1.0F / std::sqrt(square);
  return {v.x * by, v.y * by, v.z * by};
}

/// The tangent at a unit normal where u grows along `u`; `across` is the cross product of the directions of u
/// and v. Sets the flag where u grows along the normal.
inline glm::vec4 organ_tangent(const glm::vec3& normal, const glm::vec3& u, const glm::vec3& across,
                               std::uint32_t& fault) {
  const float along = normal.x * u.x + normal.y * u.y + normal.z * u.z;
  const glm::vec3 flat{u.x - normal.x * along, u.y - normal.y * along, u.z - normal.z * along};
  const float whole = u.x * u.x + u.y * u.y + u.z * u.z;
  const float square = flat.x * flat.x + flat.y * flat.y + flat.z * flat.z;
  fault |= ((square > 1e-6F * whole) & (square > 1e-30F) & (square < 1e30F)) ? 0U : 1U;
  const float by = 1.0F / std::sqrt(square);
  // v grows down the picture, and the bitangent points up it.
  const float side = normal.x * across.x + normal.y * across.y + normal.z * across.z > 0.0F ? -1.0F : 1.0F;
  return {flat.x * by, flat.y * by, flat.z * by, side};
}

}  // namespace seedmesh
