#include "core/model/model.h"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "core/base/math.h"
#include "core/model/build.h"

namespace seedmesh {
namespace {

void grow(Box& box, const glm::mat4& matrix, const Box& part) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 local{(corner & 1) ? part.max.x : part.min.x, (corner & 2) ? part.max.y : part.min.y,
                          (corner & 4) ? part.max.z : part.min.z};
    const glm::vec3 p = glm::vec3(matrix * glm::vec4(local, 1));
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
  }
}

}  // namespace

ModelCounts count(const Model& model) {
  ModelCounts counts;
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) {
      counts.vertices += primitive.mesh.vertices();
      counts.bytes += primitive.mesh.bytes();
    }
  }
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const std::uint64_t times = std::max<std::size_t>(1, node.instances.transforms.size());
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const std::uint64_t elements = primitive.mesh.elements() * times;
      switch (primitive.mesh.topology) {
        case Topology::triangles:
          counts.triangles += elements;
          break;
        case Topology::lines:
          counts.lines += elements;
          break;
        case Topology::points:
          counts.points += elements;
          break;
      }
    }
  }
  return counts;
}

Box bounds_of(const Model& model) {
  constexpr float huge = std::numeric_limits<float>::max();
  Box box{glm::vec3(huge), glm::vec3(-huge)};
  const std::vector<glm::mat4> world = world_matrices<float>(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.mesh < 0) continue;
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (primitive.mesh.vertices() == 0) continue;
      const Box part = bounds_of(primitive.mesh);
      if (node.instances.transforms.empty()) grow(box, world[i], part);
      for (const Transform& t : node.instances.transforms) grow(box, world[i] * matrix_of<float>(t), part);
    }
  }
  return box.min.x > box.max.x ? Box{} : box;
}

float linear_of_srgb(std::uint8_t value) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (int i = 0; i < 256; ++i) {
      const double c = i / 255.0;
      made[static_cast<std::size_t>(i)] =
          static_cast<float>(c <= 0.04045 ? c / 12.92 : math::pow((c + 0.055) / 1.055, 2.4));
    }
    return made;
  }();
  return table[value];
}

}  // namespace seedmesh
