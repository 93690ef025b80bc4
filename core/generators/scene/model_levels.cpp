#include "core/generators/scene/model_levels.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/geom/mesh/flatten.h"
#include "core/geom/mesh/weld.h"
#include "core/model/build.h"
#include "core/model/levels.h"

namespace seedmesh::scene {
namespace {

/// Returns true where no node has a transform.
bool is_plain(const Model& model) {
  return std::all_of(model.nodes.begin(), model.nodes.end(), [](const Node& node) {
    return is_identity(node.transform) && node.instances.transforms.empty() && node.skin < 0;
  });
}

/// Returns true where a coarser level uses a mesh of this level.
bool is_shown_again(const Model& model, std::size_t level, std::size_t levels) {
  std::set<int> here;
  for (const Node& node : model.nodes) here.insert(mesh_at(node, level));
  here.erase(-1);
  for (std::size_t later = level + 1; later < levels; ++later) {
    for (const Node& node : model.nodes) {
      if (here.contains(mesh_at(node, later))) return true;
    }
  }
  return false;
}

/// Takes the meshes of a level out of the model. A mesh that two nodes show at the same position is taken
/// once.
std::vector<Primitive> taken(Model& model, std::size_t level) {
  std::vector<Primitive> primitives;
  std::set<int> seen;
  for (const Node& node : model.nodes) {
    const int mesh = mesh_at(node, level);
    if (mesh < 0 || !seen.insert(mesh).second) continue;
    for (Primitive& each : model.meshes[static_cast<std::size_t>(mesh)].primitives)
      primitives.push_back(std::move(each));
  }
  return primitives;
}

/// The greatest step of the grids of gltf/compress/quantize.h for meshes of at most this extent.
float greatest_grid_step(float extent) {
  constexpr float most_steps = 65'534;
  int exponent = 0;
  std::frexp(extent / most_steps, &exponent);
  return std::ldexp(1.0F, exponent);
}

}  // namespace

bool is_same(const Material& a, const Material& b, Seeds seeds) {
  return (seeds == Seeds::may_differ || a.recipe.seed == b.recipe.seed) && are_alike(a, b);
}

void separate_bodies(Model& model, Vertices vertices) {
  float reach = 0;
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& each : group.primitives) {
      for (const glm::vec3& p : each.mesh.position) reach = std::max(reach, glm::dot(p, p));
    }
  }
  reach = std::sqrt(reach);
  float far = 0;
  const auto each_place = [&](auto&& change) {
    for (Node& node : model.nodes) {
      if (node.mesh < 0) continue;
      if (node.instances.transforms.empty()) change(node.transform);
      for (Transform& copy : node.instances.transforms) change(copy);
    }
  };
  each_place([&](const Transform& at) { far = std::max(far, glm::length(at.translation)); });
  const float step =
      vertices == Vertices::quantized ? 1.5F * greatest_grid_step(2 * (reach + far)) : 8e-6F * (reach + far);
  std::uint32_t place = 0;
  each_place([&](Transform& at) {
    at.translation += step * glm::vec3(place % 8, place / 8 % 8, place / 64 % 8);
    ++place;
  });
}

std::vector<std::vector<Primitive>> extract_levels(Model& model, Job& job) {
  const std::size_t levels = levels_of(model);
  const bool plain = is_plain(model);
  std::vector<int> finest;
  for (const Node& node : model.nodes) finest.push_back(node.mesh);
  std::vector<std::vector<Primitive>> made;
  for (std::size_t level = 0; level < levels; ++level) {
    if (plain && !is_shown_again(model, level, levels)) {
      made.push_back(taken(model, level));
      continue;
    }
    for (Node& node : model.nodes) node.mesh = mesh_at(node, level);
    made.push_back(flatten(model, job));
    for (Primitive& each : made.back()) weld(each.mesh, job);  // touching parts share vertices
    for (std::size_t i = 0; i < model.nodes.size(); ++i) model.nodes[i].mesh = finest[i];
  }
  return made;
}

}  // namespace seedmesh::scene
