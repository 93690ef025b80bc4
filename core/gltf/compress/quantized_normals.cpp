#include "core/gltf/compress/quantized_normals.h"

#include <algorithm>
#include <cmath>

#include "core/gltf/compress/vertex_data.h"

namespace seedmesh::gltf {
namespace {

// Decoders round differently: below this cosine a normal may face away in some reader.
constexpr double least_cosine = 1e-3;

const Column* column_of(const Part& part, std::string_view semantic) {
  for (const Attribute& attribute : part.attributes) {
    if (attribute.semantic == semantic) return &part.columns[attribute.column];
  }
  return nullptr;
}

bool has_faces(const Part& part, const Column* position, const Column* normal) {
  return part.topology == Topology::triangles && part.index && position != nullptr && normal != nullptr;
}

glm::dvec3 position_at(const Column& position, std::size_t i) {
  return position.component == Component::u16 ? glm::dvec3(load<glm::u16vec4>(position.slice, i))
                                              : glm::dvec3(load<glm::vec3>(position.slice, i));
}

glm::dvec3 decoded(const OctahedralNormal& packed) {
  const double one = packed[2];
  glm::dvec3 n(packed[0] / one, packed[1] / one, 0);
  n.z = 1 - std::abs(n.x) - std::abs(n.y);
  const double fold = std::max(-n.z, 0.0);
  n.x += n.x >= 0 ? -fold : fold;
  n.y += n.y >= 0 ? -fold : fold;
  return n / std::sqrt(glm::dot(n, n));
}

}  // namespace

std::vector<std::size_t> inward_corners(const Part& part, Job& job) {
  std::vector<std::size_t> inward;
  const Column *position = column_of(part, "POSITION"), *normal = column_of(part, "NORMAL");
  if (!has_faces(part, position, normal) || position->component != Component::f32) return inward;
  for (std::size_t i = 0; i + 2 < part.index->count; i += 3) {
    if (i % check_interval == 0) job.check();
    std::uint32_t corner[3];
    glm::vec3 at[3];
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = corner_at(*part.index, i + k);
      at[k] = load<glm::vec3>(position->slice, corner[k]);
    }
    const glm::vec3 face = glm::cross(at[1] - at[0], at[2] - at[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (glm::dot(face, load<glm::vec3>(normal->slice, corner[k])) < 0) inward.push_back(i + k);
    }
  }
  return inward;
}

void repair_quantized_normals(Part& part, const std::vector<std::size_t>& inward, Job& job) {
  const Column *position = column_of(part, "POSITION"), *normal = column_of(part, "NORMAL");
  if (!has_faces(part, position, normal) || normal->filter != Filter::octahedral) return;
  struct Repaired {
    std::size_t corner;
    OctahedralNormal normal;
  };
  std::vector<Repaired> repaired;
  auto known = inward.begin();
  for (std::size_t i = 0; i + 2 < part.index->count; i += 3) {
    if (i % check_interval == 0) job.check();
    std::uint32_t corner[3];
    glm::dvec3 at[3];
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = corner_at(*part.index, i + k);
      at[k] = position_at(*position, corner[k]);
    }
    const glm::dvec3 across = glm::cross(at[1] - at[0], at[2] - at[0]);
    const double area = std::sqrt(glm::dot(across, across));
    for (std::size_t k = 0; k < 3; ++k) {
      const bool was_inward = known != inward.end() && *known == i + k;
      if (was_inward) ++known;
      if (area == 0 || was_inward) continue;
      const glm::dvec3 own = decoded(load<OctahedralNormal>(normal->slice, corner[k]));
      if (glm::dot(across, own) < least_cosine * area) repaired.push_back({i + k, octahedral(across)});
    }
  }
  if (repaired.empty()) return;
  const std::size_t count = position->count, all = count + repaired.size();
  Array<std::uint32_t> vertices(job, all), corners(job, part.index->count);
  for (std::size_t i = 0; i < count; ++i) vertices[i] = static_cast<std::uint32_t>(i);
  job.check();
  for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = corner_at(*part.index, i);
  job.check();
  for (std::size_t i = 0; i < repaired.size(); ++i) {
    vertices[count + i] = corners[repaired[i].corner];
    corners[repaired[i].corner] = static_cast<std::uint32_t>(count + i);
  }
  Array<OctahedralNormal> normals(job, all);
  for (std::size_t i = 0; i < all; ++i)
    normals[i] = i < count ? load<OctahedralNormal>(normal->slice, i) : repaired[i - count].normal;
  const auto repaired_slice = keep(std::move(normals));
  for (Column& column : part.columns) {
    job.check();
    column.slice = &column == normal ? repaired_slice : selected(column, vertices, job);
    column.count = all;
  }
  set_index(part, std::move(corners), all, job);
}

}  // namespace seedmesh::gltf
