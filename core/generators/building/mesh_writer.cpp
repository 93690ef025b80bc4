#include "core/generators/building/mesh_writer.h"

#include <cmath>
#include <vector>

#include "core/base/math.h"

namespace seedmesh::building {
namespace {

/// Faces at a steeper angle to the plane of a projection (as a cosine) do not use it: their coordinates would
/// almost lie on a line.
constexpr double least_facing = 0.05;

/// The directions of texture coordinates of a face: along the wall and down.
struct Directions {
  glm::dvec3 along{0}, down{0};
};

Directions directions_on(const glm::dvec3& n) {
  glm::dvec3 x = glm::cross(glm::dvec3(0, 1, 0), n);
  if (glm::dot(x, x) < 1e-9) x = glm::dvec3(1, 0, 0);
  x = math::unit(x, glm::dvec3(1, 0, 0));
  return {x, glm::cross(n, x)};
}

bool is_facing(const Projection& projection, const glm::dvec3& normal) {
  const glm::dvec3 out = math::unit(glm::cross(projection.u, projection.v), normal);
  return std::abs(glm::dot(out, normal)) > least_facing;
}

/// The normal of the triangle that begins at an index. Smooth vertex normals would distort the texture of a
/// round wall.
glm::dvec3 facing_at(const BodySurface& surface, std::size_t first) {
  const glm::dvec3& a = surface.position[surface.index[first]];
  const glm::dvec3 across = glm::cross(surface.position[surface.index[first + 1]] - a,
                                       surface.position[surface.index[first + 2]] - a);
  const glm::dvec3& normal = surface.normal[surface.index[first]];
  const glm::dvec3 facing = math::unit(across, normal);
  return glm::dot(facing, normal) > 1 - 1e-9 ? normal : facing;
}

/// The face normals of all vertices of a surface; each vertex belongs to one face.
std::vector<glm::dvec3> facings_of(const BodySurface& surface) {
  std::vector<glm::dvec3> facings = surface.normal;
  if (surface.has_face_normals) return facings;
  for (std::size_t t = 0; t < surface.index.size(); t += 3) {
    const glm::dvec3 facing = facing_at(surface, t);
    for (std::size_t k = 0; k < 3; ++k) facings[surface.index[t + k]] = facing;
  }
  return facings;
}

/// Appends the texture coordinates in tiles of the last vertices of a mesh: the horizontal distance along the wall and
/// the height, continuous over neighbours.
void append_coordinates(const BodySurface& surface, Mesh& mesh, const glm::dmat3& axes,
                        const glm::dvec3& origin, const TextureMapping& texturing) {
  const std::vector<glm::dvec3> facings = facings_of(surface);
  const Projection* const projection = texturing.projection;
  glm::vec2* out = mesh.uv[0].extend(facings.size());
  bool is_projected = false;
  Directions on_face;
  for (std::size_t i = 0; i < facings.size(); ++i) {
    // Most neighbours have one face in common.
    if (i == 0 || facings[i] != facings[i - 1] || surface.normal[i] != surface.normal[i - 1]) {
      is_projected = projection != nullptr && is_facing(*projection, axes * surface.normal[i]);
      on_face = directions_on(axes * facings[i]);
    }
    const glm::dvec3 at = origin + axes * surface.position[i];
    if (is_projected) {
      // v runs up here and down in glTF.
      *out++ = {static_cast<float>(glm::dot(projection->u, at) + projection->u_at),
                static_cast<float>(-glm::dot(projection->v, at) - projection->v_at)};
    } else {
      *out++ = {static_cast<float>(glm::dot(at, on_face.along) / texturing.tile->x),
                static_cast<float>(-glm::dot(at, on_face.down) / texturing.tile->y)};
    }
  }
}

}  // namespace

Mesh empty_mesh(bool has_uv, const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  if (has_uv) mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  return mesh;
}

void append(const BodySurface& surface, Mesh& mesh, const glm::dmat3& axes, const glm::dvec3& origin,
            const TextureMapping& texturing) {
  const auto base = static_cast<std::uint32_t>(mesh.position.size());
  const std::size_t count = surface.position.size();
  glm::vec3* position = mesh.position.extend(count);
  glm::vec3* normal = mesh.normal.extend(count);
  for (std::size_t i = 0; i < count; ++i) {
    position[i] = glm::vec3(origin + axes * surface.position[i]);
    normal[i] = glm::vec3(axes * surface.normal[i]);
  }
  if (texturing.tile != nullptr) append_coordinates(surface, mesh, axes, origin, texturing);
  std::uint32_t* index = mesh.index.wide.extend(surface.index.size());
  for (std::size_t i = 0; i < surface.index.size(); ++i) index[i] = base + surface.index[i];
}

void append_part(const Mesh& from, Mesh& to, const glm::dmat3& axes, const glm::dvec3& at,
                 const glm::dvec2* tile) {
  const auto base = static_cast<std::uint32_t>(to.position.size());
  for (std::size_t i = 0; i < from.position.size(); ++i) {
    to.position.push_back(glm::vec3(at + axes * glm::dvec3(from.position[i])));
    to.normal.push_back(glm::vec3(math::unit(axes * glm::dvec3(from.normal[i]), glm::dvec3(0, 1, 0))));
    if (tile == nullptr) continue;
    to.uv[0].push_back(from.uv[0].empty() ? glm::vec2(0) : from.uv[0][i] / glm::vec2(*tile));
  }
  for (std::size_t i = 0; i < from.index.size(); ++i) to.index.wide.push_back(base + from.index.at(i));
}

}  // namespace seedmesh::building
