// Triangles of roofs; see roof.h.
#include <glm/geometric.hpp>

#include "core/geom/mesh/weld.h"
#include "core/geom/polygon/roof.h"
#include "core/model/empty_mesh.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using glm::dvec3;

dvec2 in_face(const RoofFace& face, const dvec3& p) {
  return {glm::dot(p, face.along), glm::dot(p, glm::cross(face.normal, face.along))};
}

void add_face(Mesh& mesh, const Roof& roof, const RoofFace& face, const Job& job) {
  const std::vector<std::uint32_t> triangles = triangulate(roof, face, &job);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> number;
  const auto place = [&](std::uint32_t point) {
    for (const auto& [known, at] : number) {
      if (known == point) return at;
    }
    const auto at = static_cast<std::uint32_t>(mesh.position.size());
    mesh.position.push_back(glm::vec3(roof.point[point]) + 0.0F);
    mesh.normal.push_back(glm::vec3(face.normal) + 0.0F);
    mesh.uv[0].push_back(glm::vec2(in_face(face, roof.point[point])) + 0.0F);
    number.emplace_back(point, at);
    return at;
  };
  for (const std::uint32_t point : triangles) mesh.index.wide.push_back(place(point));
}

}  // namespace

std::vector<std::uint32_t> triangulate(const Roof& roof, const RoofFace& face, const Job* job) {
  Plan flat;
  std::vector<std::uint32_t> point;
  const auto add = [&](const std::vector<std::uint32_t>& loop) {
    flat.rings.emplace_back();
    for (const std::uint32_t i : loop) {
      flat.rings.back().push_back(in_face(face, roof.point[i]));
      point.push_back(i);
    }
  };
  add(face.outline);
  for (const auto& hole : face.holes) add(hole);
  std::vector<std::uint32_t> triangles = triangulate(flat, ThinTriangles::drop, job);
  for (std::uint32_t& i : triangles) i = point[i];
  return triangles;
}

std::vector<RoofMesh> meshes_of(const Roof& roof, Job& job) {
  std::vector<RoofMesh> meshes;
  std::uint64_t corners = 0;
  for (const RoofFace& face : roof.faces) {
    corners += face.outline.size();
    for (const auto& hole : face.holes) corners += hole.size() + 2;
  }
  job.spend(Resource::triangles, corners);
  for (std::size_t r = 0; r < roof_role_names.size(); ++r) {
    const auto role = static_cast<RoofRole>(r);
    Mesh mesh = empty_mesh(job);
    mesh.uv[0] = Array<glm::vec2>(job);
    for (const RoofFace& face : roof.faces) {
      if (face.role == role) add_face(mesh, roof, face, job);
    }
    if (mesh.position.empty()) continue;
    weld(mesh, job);
    meshes.push_back({role, std::move(mesh)});
  }
  return meshes;
}

}  // namespace seedmesh
