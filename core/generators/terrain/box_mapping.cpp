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
      place_(job, mapped_side_count * from.position.size(), unplaced),
      source_(job),
      index_(job),
      job_(job) {}

void BoxMappedMesh::reserve(std::size_t triangles) {
  index_.reserve(3 * triangles);
  // A vertex of a regular mesh has six triangles; borders have more vertices.
  source_.reserve(triangles / 2 + triangles / 8);
}

void BoxMappedMesh::add(const std::array<std::uint32_t, 3>& corners) {
  const glm::vec3& a = from_.position[corners[0]];
  const MappedSide side = side_of(glm::cross(from_.position[corners[1]] - a, from_.position[corners[2]] - a));
  for (const std::uint32_t corner : corners) {
    std::uint32_t& place = place_[mapped_side_count * corner + side];
    if (place == unplaced) {
      place = static_cast<std::uint32_t>(source_.size());
      source_.push_back({corner, side});
    }
    index_.push_back(place);
  }
}

Mesh BoxMappedMesh::take() {
  place_ = Array<std::uint32_t>(job_);
  const std::size_t count = source_.size();
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job_, count);
  mesh.normal = Array<glm::vec3>(job_, count);
  mesh.tangent = Array<glm::vec4>(job_, count);
  const std::size_t set = from_.uv[0].empty() ? 0 : 1;
  for (std::size_t i = 0; i <= set; ++i) mesh.uv[i] = Array<glm::vec2>(job_, count);
  mesh.color = Array<glm::u8vec4>(job_, from_.color.empty() ? 0 : count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [v, side] = source_[i];
    mesh.position[i] = from_.position[v];
    mesh.normal[i] = overrides_.normals.empty() ? from_.normal[v] : overrides_.normals[v];
    mesh.tangent[i] = tangent_of(mesh.normal[i], side);
    if (set > 0) mesh.uv[0][i] = from_.uv[0][v];
    mesh.uv[set][i] = mapped(from_.position[v], side) + 0.0F;
    if (!from_.color.empty()) mesh.color[i] = color_of(v);
  }
  mesh.index.wide = std::move(index_);
  return mesh;
}

glm::u8vec4 BoxMappedMesh::color_of(std::uint32_t v) const {
  glm::u8vec4 color = from_.color[v];
  for (int i = 0; i < 3; ++i) {
    const float factor = overrides_.factors.empty() ? 1 : overrides_.factors[v][i];
    const float lit = static_cast<float>(color[i]) * factor * lighter_ + 0.5F;
    color[i] = static_cast<std::uint8_t>(std::min(lit, 255.0F));
  }
  return color;
}

}  // namespace seedmesh::terrain
