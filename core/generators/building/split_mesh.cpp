#include "core/generators/building/split_mesh.h"

#include <algorithm>

namespace seedmesh::building {
namespace {

/// The triangles from `first` to `last` as a mesh with only their vertices.
Mesh part_of(const Mesh& mesh, std::size_t first, std::size_t last, const Job& job) {
  Mesh out;
  out.cache_ordered = mesh.cache_ordered;
  out.position = Array<glm::vec3>(job);
  out.normal = Array<glm::vec3>(job);
  if (!mesh.uv[0].empty()) out.uv[0] = Array<glm::vec2>(job);
  out.index.wide = Array<std::uint32_t>(job);
  constexpr std::uint32_t unplaced = 0xFFFFFFFFU;
  std::vector<std::uint32_t> place(mesh.position.size(), unplaced);
  for (std::size_t i = 3 * first; i < 3 * last; ++i) {
    const std::uint32_t vertex = mesh.index.at(i);
    if (place[vertex] == unplaced) {
      place[vertex] = static_cast<std::uint32_t>(out.position.size());
      out.position.push_back(mesh.position[vertex]);
      out.normal.push_back(mesh.normal[vertex]);
      if (!mesh.uv[0].empty()) out.uv[0].push_back(mesh.uv[0][vertex]);
    }
    out.index.wide.push_back(place[vertex]);
  }
  return out;
}

}  // namespace

std::optional<MeshGroup> split_in_half(MeshGroup& group, const Job& job) {
  const auto largest = std::ranges::max_element(group.primitives, {},
                                                [](const Primitive& each) { return each.mesh.elements(); });
  if (largest == group.primitives.end() || largest->mesh.elements() < 4) return std::nullopt;
  const std::size_t count = largest->mesh.elements(), half = count / 4 * 2;
  MeshGroup out{group.name, {}};
  out.primitives.push_back({part_of(largest->mesh, half, count, job), largest->material, {}});
  largest->mesh = part_of(largest->mesh, 0, half, job);
  return out;
}

}  // namespace seedmesh::building
