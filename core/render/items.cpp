#include "core/render/items.h"

#include <limits>

namespace seedmesh::render {
namespace {

constexpr float far = std::numeric_limits<float>::max();

glm::mat4 matrix_of(const Transform& t) {
  glm::mat4 matrix = glm::mat4_cast(t.rotation);
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= t.scale[axis];
  matrix[3] = glm::vec4(t.translation, 1);
  return matrix;
}

void widen(Box& box, const glm::vec3& p) { box = {glm::min(box.min, p), glm::max(box.max, p)}; }

}  // namespace

Box box_of(const MeshGroup& group) {
  Box box{glm::vec3(far), glm::vec3(-far)};
  for (const Primitive& primitive : group.primitives) {
    for (const glm::vec3& p : primitive.mesh.position) widen(box, p);
  }
  return box.min.x > box.max.x ? Box{} : box;
}

Items items_of(const Model& model, const Job& job) {
  Items items{Array<Item>(job), {glm::vec3(far), glm::vec3(-far)}, {}};
  std::vector<Box>& boxes = items.boxes;
  for (const MeshGroup& group : model.meshes) boxes.push_back(box_of(group));
  std::vector<glm::mat4> at;
  for (const Node& node : model.nodes) {
    job.check();
    const glm::mat4 own = matrix_of(node.transform);
    // A skin ignores the transform of its node.
    at.push_back(node.parent < 0 ? own : at[static_cast<std::size_t>(node.parent)] * own);
    if (node.mesh < 0 || node.collision != CollisionShape::none) continue;
    const auto group = static_cast<std::uint32_t>(node.mesh);
    const auto add = [&](const glm::mat4& where) {
      items.list.push_back({group, where});
      for (int corner = 0; corner < 8; ++corner)
        widen(items.box, glm::vec3(where * glm::vec4(corner_of(boxes[group], corner), 1)));
    };
    if (node.instances.transforms.empty()) add(node.skin >= 0 ? glm::mat4(1) : at.back());
    for (const Transform& copy : node.instances.transforms) add(at.back() * matrix_of(copy));
  }
  if (items.list.empty()) items.box = {};
  return items;
}

}  // namespace seedmesh::render
