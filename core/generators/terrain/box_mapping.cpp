#include "core/generators/terrain/box_mapping.h"

#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"
#include "core/texture/ground.h"

namespace seedmesh::terrain {
namespace {

constexpr std::uint32_t unplaced = 0xFFFFFFFFU;
constexpr auto by_tile = static_cast<float>(1 / texture::ground_tile);
// The vertical part of a normal at 50 degrees.
constexpr float least_upright = 0.64278761F;

MappedSide side_of(const glm::vec3& across) {
  const float length = std::sqrt(glm::dot(across, across));
  if (across.y >= least_upright * length) return above;
  if (across.y <= -least_upright * length) return below;
  return std::abs(across.x) >= std::abs(across.z) ? along_x : along_z;
}

glm::vec2 mapped(const glm::vec3& p, MappedSide side) {
  if (side == above || side == below) return {p.x * by_tile, p.z * by_tile};
  return {(side == along_x ? p.z : p.x) * by_tile, -p.y * by_tile};
}

/// Whether u, v and the normal are right-handed: negative where they are not.
float hand_of(const glm::vec3& normal, MappedSide side) {
  switch (side) {
    case along_x:
      return -normal.x;
    case along_z:
      return normal.z;
    case below:
      return -1;
    default:
      return 1;
  }
}

/// The direction in which u grows, at right angles to the normal.
glm::vec4 tangent_of(const glm::vec3& normal, MappedSide side) {
  const glm::vec3 u = side == along_x ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  return {math::quick_unit(u - normal * glm::dot(u, normal), glm::vec3(1, 0, 0)),
          hand_of(normal, side) < 0 ? -1.0F : 1.0F};
}

}  // namespace

BoxMappedMesh::BoxMappedMesh(const Mesh& from, const VertexOverrides& overrides, float lighter,
                             const Job& job)
    : from_(from),
      overrides_(overrides),
      lighter_(lighter),
      set_(from.uv[0].empty() ? 0 : 1),
      index_(job, mapped_side_count * from.position.size(), unplaced) {
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.tangent = Array<glm::vec4>(job);
  for (std::size_t set = 0; set <= set_; ++set) mesh.uv[set] = Array<glm::vec2>(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
}

void BoxMappedMesh::add(const std::array<std::uint32_t, 3>& corners) {
  const glm::vec3& a = from_.position[corners[0]];
  const MappedSide side = side_of(glm::cross(from_.position[corners[1]] - a, from_.position[corners[2]] - a));
  for (const std::uint32_t corner : corners) {
    std::uint32_t& place = index_[mapped_side_count * corner + side];
    if (place == unplaced) {
      place = static_cast<std::uint32_t>(mesh.position.size());
      add_vertex(corner, side);
    }
    mesh.index.wide.push_back(place);
  }
}

void BoxMappedMesh::add_vertex(std::uint32_t v, MappedSide side) {
  mesh.position.push_back(from_.position[v]);
  const glm::vec3 normal = overrides_.normals.empty() ? from_.normal[v] : overrides_.normals[v];
  mesh.normal.push_back(normal);
  mesh.tangent.push_back(tangent_of(normal, side));
  if (set_ > 0) mesh.uv[0].push_back(from_.uv[0][v]);
  mesh.uv[set_].push_back(mapped(from_.position[v], side) + 0.0F);
  if (from_.color.empty()) return;
  glm::u8vec4 color = from_.color[v];
  for (int i = 0; i < 3; ++i) {
    const float factor = overrides_.factors.empty() ? 1 : overrides_.factors[v][i];
    const float lit = static_cast<float>(color[i]) * factor * lighter_ + 0.5F;
    color[i] = static_cast<std::uint8_t>(std::min(lit, 255.0F));
  }
  mesh.color.push_back(color);
}

}  // namespace seedmesh::terrain
