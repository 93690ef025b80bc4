/// The choice of the quantization grids, and their transforms in the model.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/disjoint_sets.h"
#include "core/gltf/compress/quantize.h"

namespace seedmesh::gltf {
namespace {

constexpr float most_steps = 65'534;  ///< one less than 65,535, because the origin is rounded down

std::vector<int> shown_by(const Node& node) {
  std::vector<int> meshes = node.lods;
  std::erase(meshes, -1);
  if (node.mesh >= 0) meshes.push_back(node.mesh);
  return meshes;
}

/// Sets of meshes that share a grid.
DisjointSets shared(const Model& model) {
  DisjointSets sets(model.meshes.size());
  std::vector<int> first_of_skin(model.skins.size(), -1);
  for (const Node& node : model.nodes) {
    const std::vector<int> meshes = shown_by(node);
    for (const int mesh : meshes)
      sets.join(static_cast<std::uint32_t>(meshes.front()), static_cast<std::uint32_t>(mesh));
    if (node.skin < 0 || meshes.empty()) continue;
    int& first = first_of_skin[static_cast<std::size_t>(node.skin)];
    if (first < 0) first = meshes.front();
    sets.join(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(meshes.front()));
  }
  return sets;
}

Grid grid_of(const Box& box, float least_extent) {
  if (box.min.x > box.max.x) return {};
  const glm::vec3 extent = box.max - box.min;
  const float longest = std::max({extent.x, extent.y, extent.z, least_extent});
  int exponent = -20;
  if (longest > 0) {
    std::frexp(longest / most_steps, &exponent);  // longest / most_steps < 2^exponent
    exponent = std::max(exponent, -60);
  }
  Grid grid;
  grid.step = std::ldexp(1.0F, exponent);
  for (int axis = 0; axis < 3; ++axis)
    grid.origin[axis] = std::floor(box.min[axis] / grid.step) * grid.step + 0.0F;
  return grid;
}

/// The transform that applies the grid `inner` first.
Transform after(const Transform& outer, const Grid& inner) {
  Transform both = outer;
  both.translation = outer.translation + outer.rotation * (outer.scale * inner.origin) + 0.0F;
  both.scale = outer.scale * inner.step;
  return both;
}

/// Nodes whose transform affects more than their mesh: parents, joints and animated nodes.
std::vector<bool> shared_transforms(const Model& model) {
  std::vector<bool> is_shared(model.nodes.size(), false);
  for (const Node& node : model.nodes) {
    if (node.parent >= 0) is_shared[static_cast<std::size_t>(node.parent)] = true;
  }
  for (const Animation& animation : model.animations) {
    for (const Channel& channel : animation.channels)
      is_shared[static_cast<std::size_t>(channel.node)] = true;
  }
  for (const Skin& skin : model.skins) {
    for (const int joint : skin.joints) is_shared[static_cast<std::size_t>(joint)] = true;
  }
  return is_shared;
}

void move_into(Skin& skin, const Grid& grid) {
  glm::mat4 placed(grid.step);
  placed[3] = glm::vec4(grid.origin, 1);
  for (glm::mat4& bind : skin.inverse_bind) bind = bind * placed;
}

/// Moves the mesh of a node to a new child.
void add_child(Model& model, std::size_t number, const Grid& grid, std::set<std::string>& names) {
  Node child;
  child.name = model.nodes[number].name + "_mesh";
  while (!names.insert(child.name).second) child.name += '_';
  child.parent = static_cast<int>(number);
  child.transform = after({}, grid);
  child.mesh = std::exchange(model.nodes[number].mesh, -1);
  child.lods = std::exchange(model.nodes[number].lods, {});
  model.nodes.push_back(std::move(child));
}

}  // namespace

std::vector<Grid> grids_of(const Model& model, const GridOptions& options) {
  constexpr float far = std::numeric_limits<float>::max();
  DisjointSets sets = shared(model);
  std::vector<Box> boxes(model.meshes.size(), Box{glm::vec3(far), glm::vec3(-far)});
  for (std::uint32_t i = 0; i < sets.size(); ++i) {
    Box& box = boxes[sets.of(i)];
    for (const Primitive& primitive : model.meshes[i].primitives) {
      if (primitive.mesh.vertices() == 0) continue;
      const Box own = bounds_of(primitive.mesh);
      box = {glm::min(box.min, own.min), glm::max(box.max, own.max)};
    }
  }
  std::vector<Grid> grids;
  for (std::uint32_t i = 0; i < sets.size(); ++i)
    grids.push_back(grid_of(boxes[sets.of(i)], options.least_extent));
  if (!options.keeps_copies) return grids;
  std::vector<bool> is_copied(model.meshes.size(), false);
  for (const Node& node : model.nodes) {
    const std::vector<int> meshes = shown_by(node);
    if (!meshes.empty() && !node.instances.transforms.empty())
      is_copied[sets.of(static_cast<std::uint32_t>(meshes.front()))] = true;
  }
  for (std::uint32_t i = 0; i < grids.size(); ++i) {
    if (is_copied[sets.of(i)]) grids[i] = {.is_exact = true};
  }
  return grids;
}

std::vector<Grid> apply_grids(Model& model, const GridOptions& options) {
  const std::vector<Grid> grids = grids_of(model, options);
  std::vector<bool> skin_done(model.skins.size(), false);
  const std::vector<bool> is_shared = shared_transforms(model);
  std::set<std::string> names;
  for (const Node& node : model.nodes) names.insert(node.name);
  const std::size_t nodes = model.nodes.size();
  for (std::size_t i = 0; i < nodes; ++i) {
    Node& node = model.nodes[i];
    const std::vector<int> meshes = shown_by(node);
    if (meshes.empty()) continue;
    const Grid& grid = grids[static_cast<std::size_t>(meshes.front())];
    if (grid.is_exact) continue;
    if (node.skin >= 0) {
      const auto skin = static_cast<std::size_t>(node.skin);
      if (!skin_done[skin]) move_into(model.skins[skin], grid);
      skin_done[skin] = true;
    } else if (!node.instances.transforms.empty()) {
      for (Transform& copy : node.instances.transforms) copy = after(copy, grid);
    } else if (is_shared[i]) {
      add_child(model, i, grid, names);
    } else {
      node.transform = after(node.transform, grid);
    }
  }
  return grids;
}

}  // namespace seedmesh::gltf
