#include "core/geom/mesh/copies.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/base/math.h"
#include "core/model/build.h"
#include "core/model/levels.h"

namespace seedmesh {
namespace {

constexpr std::size_t check_interval = 4096;

std::vector<std::uint64_t> uses_of(const Model& model) {
  std::vector<std::uint64_t> uses(model.meshes.size(), 0);
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    uses[static_cast<std::size_t>(node.mesh)] += std::max<std::size_t>(1, node.instances.transforms.size());
  }
  return uses;
}

/// Marks nodes that an animation moves.
std::vector<bool> moving(const Model& model) {
  std::vector<bool> moves(model.nodes.size(), false);
  for (const Animation& animation : model.animations) {
    for (const Channel& channel : animation.channels) moves[static_cast<std::size_t>(channel.node)] = true;
  }
  for (const Skin& skin : model.skins) {
    for (const int joint : skin.joints) moves[static_cast<std::size_t>(joint)] = true;
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const int parent = model.nodes[i].parent;
    if (model.nodes[i].skin >= 0 || (parent >= 0 && moves[static_cast<std::size_t>(parent)])) moves[i] = true;
  }
  return moves;
}

/// A primitive of the model at one position.
struct Placed {
  const Primitive* primitive;
  const glm::dmat4* matrix;
};

/// The properties that primitives must share to be merged: material, topology and attributes.
using Kind = std::tuple<int, std::vector<int>, Topology, unsigned>;

unsigned attributes_of(const Mesh& mesh) {
  unsigned mask = 0;
  const auto add = [&mask](bool has) { mask = mask << 1U | (has ? 1U : 0U); };
  add(!mesh.normal.empty());
  for (const auto& uv : mesh.uv) add(!uv.empty());
  add(!mesh.color.empty());
  add(!mesh.tangent.empty());
  add(mesh.index.size() > 0);
  return mask;
}

class Joining {
 public:
  Joining(const std::vector<Placed>& parts, Job& job) : job_(job) {
    const Mesh& first = parts.front().primitive->mesh;
    mesh_.topology = first.topology;
    mesh_.cache_ordered = true;
    std::size_t vertices = 0, corners = 0;
    for (const Placed& part : parts) {
      vertices += part.primitive->mesh.position.size();
      corners += part.primitive->mesh.index.size();
      mesh_.cache_ordered = mesh_.cache_ordered && part.primitive->mesh.cache_ordered;
    }
    const auto open = [&](auto& array, const auto& like) {
      array = std::decay_t<decltype(array)>(job);
      if (!like.empty()) array.reserve(vertices);
    };
    open(mesh_.position, first.position);
    open(mesh_.normal, first.normal);
    for (std::size_t set = 0; set < mesh_.uv.size(); ++set) open(mesh_.uv[set], first.uv[set]);
    open(mesh_.color, first.color);
    open(mesh_.tangent, first.tangent);
    mesh_.index.wide = Array<std::uint32_t>(job);
    mesh_.index.wide.reserve(corners);
    for (const Placed& part : parts) add(part.primitive->mesh, *part.matrix);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void add(const Mesh& from, const glm::dmat4& matrix) {
    job_.check();
    const auto first = static_cast<std::uint32_t>(mesh_.position.size());
    const glm::dmat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    const glm::dmat3 upright = determinant != 0 ? glm::transpose(glm::inverse(linear)) : linear;
    for (const glm::vec3& p : from.position) {
      mesh_.position.push_back(glm::vec3(matrix * glm::dvec4(glm::dvec3(p), 1)));
    }
    for (const glm::vec3& n : from.normal) {
      mesh_.normal.push_back(glm::vec3(math::unit(upright * glm::dvec3(n), {0, 1, 0})));
    }
    for (const glm::vec4& t : from.tangent) {
      const glm::dvec3 along = math::unit(linear * glm::dvec3(t), {1, 0, 0});
      mesh_.tangent.push_back(glm::vec4(glm::vec3(along), determinant < 0 ? -t.w : t.w));
    }
    for (std::size_t set = 0; set < mesh_.uv.size(); ++set) mesh_.uv[set].append(from.uv[set].span());
    mesh_.color.append(from.color.span());
    const bool mirrored = determinant < 0 && from.topology == Topology::triangles;
    for (std::size_t i = 0; i < from.index.size(); ++i) {
      if (i % check_interval == 0) job_.check();
      mesh_.index.wide.push_back(first + from.index.at(mirrored ? i / 3 * 3 + 2 - i % 3 : i));
    }
  }

  Job& job_;
  Mesh mesh_;
};

/// The nodes to merge, each with the transforms of its mesh.
struct Copies {
  std::vector<std::size_t> nodes;
  std::vector<std::vector<glm::dmat4>> places;
  std::size_t levels = 1;
};

Copies copies_of(const Model& model) {
  Copies copies;
  const std::vector<std::uint64_t> uses = uses_of(model);
  const std::vector<bool> moves = moving(model);
  const std::vector<glm::dmat4> world = world_matrices(model);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const bool wanted = node.mesh >= 0 && uses[static_cast<std::size_t>(node.mesh)] > 1 && !moves[i] &&
                        node.collision == CollisionShape::none;
    if (!wanted) continue;
    copies.nodes.push_back(i);
    std::vector<glm::dmat4>& places = copies.places.emplace_back();
    for (const Transform& copy : node.instances.transforms) places.push_back(world[i] * matrix_of(copy));
    if (places.empty()) places.push_back(world[i]);
    copies.levels = std::max(copies.levels, 1 + node.lods.size());
  }
  return copies;
}

MeshGroup joined(const Model& model, const Copies& copies, std::size_t level, Job& job) {
  std::map<Kind, std::size_t> numbers;
  std::vector<std::vector<Placed>> groups;
  for (std::size_t i = 0; i < copies.nodes.size(); ++i) {
    const Node& node = model.nodes[copies.nodes[i]];
    const int shown =
        level == 0 || node.lods.empty() ? node.mesh : node.lods[std::min(level, node.lods.size()) - 1];
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(shown)].primitives) {
      const Mesh& mesh = primitive.mesh;
      if (mesh.elements() == 0) continue;
      job.spend(Resource::triangles, (copies.places[i].size() - 1) * mesh.elements());
      const auto [found, is_new] = numbers.try_emplace(
          {primitive.material, primitive.variant_materials, mesh.topology, attributes_of(mesh)},
          groups.size());
      if (is_new) groups.emplace_back();
      for (const glm::dmat4& place : copies.places[i]) groups[found->second].push_back({&primitive, &place});
    }
  }
  MeshGroup group{level_name("copies", level), {}};
  for (const std::vector<Placed>& parts : groups) {
    const Primitive& first = *parts.front().primitive;
    group.primitives.push_back({Joining(parts, job).take(), first.material, first.variant_materials});
  }
  return group;
}

/// Removes nodes without a mesh and without children, and renumbers all references to nodes.
void drop_bare(Model& model, const std::vector<bool>& emptied) {
  std::vector<bool> bears(model.nodes.size(), false);
  std::vector<int> place(model.nodes.size(), -1);
  for (std::size_t i = model.nodes.size(); i-- > 0;) {
    const Node& node = model.nodes[i];
    const bool goes = emptied[i] && !bears[i] && node.extras.empty();
    place[i] = goes ? -1 : 0;
    if (!goes && node.parent >= 0) bears[static_cast<std::size_t>(node.parent)] = true;
  }
  std::vector<Node> kept;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (place[i] < 0) continue;
    place[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(model.nodes[i]));
  }
  const auto move = [&place](int& node) {
    if (node >= 0) node = place[static_cast<std::size_t>(node)];
  };
  for (Node& node : kept) move(node.parent);
  for (Skin& skin : model.skins) {
    for (int& joint : skin.joints) move(joint);
    move(skin.skeleton);
  }
  for (Animation& animation : model.animations) {
    for (Channel& channel : animation.channels) move(channel.node);
  }
  model.nodes = std::move(kept);
}

}  // namespace

std::uint64_t count_copies(const Model& model) {
  std::uint64_t copies = 0;
  for (const std::uint64_t uses : uses_of(model)) copies += uses > 1 ? uses : 0;
  return copies;
}

void merge_copies(Model& model, Job& job) {
  const Copies copies = copies_of(model);
  if (copies.nodes.empty()) return;
  Node all;
  all.name = "copies";
  std::vector<MeshGroup> levels;
  for (std::size_t level = 0; level < copies.levels; ++level)
    levels.push_back(joined(model, copies, level, job));
  std::vector<bool> merged(model.meshes.size(), false), emptied(model.nodes.size(), false);
  for (const std::size_t number : copies.nodes) {
    Node& node = model.nodes[number];
    merged[static_cast<std::size_t>(node.mesh)] = true;
    for (const int lod : node.lods) merged[static_cast<std::size_t>(lod)] = true;
    emptied[number] = true;
    node.mesh = -1;
    node.lods.clear();
    node.instances.transforms.clear();
  }
  const bool has_root = !model.nodes.empty() && model.nodes[0].parent < 0 && !emptied[0] &&
                        !moving(model)[0] && matrix_of(model.nodes[0].transform) == glm::dmat4(1);
  if (has_root) all.parent = 0;
  drop_bare(model, emptied);
  for (const Node& node : model.nodes) {  // meshes that are still shown
    if (node.mesh >= 0) merged[static_cast<std::size_t>(node.mesh)] = false;
    for (const int lod : node.lods) merged[static_cast<std::size_t>(lod)] = false;
  }
  for (std::size_t i = 0; i < merged.size(); ++i) {
    if (merged[i]) model.meshes[i].primitives.clear();
  }
  for (MeshGroup& group : levels) {
    const auto number = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(group));
    if (all.mesh < 0) {
      all.mesh = number;
    } else {
      all.lods.push_back(number);
    }
  }
  model.nodes.push_back(std::move(all));
}

}  // namespace seedmesh
