#include "core/render/items.h"

#include <limits>

#include "core/model/build.h"

namespace seedmesh::render {
namespace {

constexpr float far = std::numeric_limits<float>::max();

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
  const std::vector<glm::mat4> world = world_matrices<float>(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    job.check();
    if (node.mesh < 0 || node.collision != CollisionShape::none) continue;
    const auto group = static_cast<std::uint32_t>(node.mesh);
    const auto add = [&](const glm::mat4& where) {
      items.list.push_back({group, where});
      for (int corner = 0; corner < 8; ++corner)
        widen(items.box, glm::vec3(where * glm::vec4(corner_of(boxes[group], corner), 1)));
    };
    if (node.instances.transforms.empty())
      add(node.skin >= 0 ? glm::mat4(1) : world[i]);  // a skin ignores the node
    for (const Transform& copy : node.instances.transforms) add(world[i] * matrix_of<float>(copy));
  }
  if (items.list.empty()) items.box = {};
  return items;
}

}  // namespace seedmesh::render
