#include "core/model/append.h"

#include <algorithm>
#include <iterator>

#include "core/model/build.h"

namespace seedmesh {
namespace {

template <class T>
void move_behind(std::vector<T>& all, std::vector<T>& others) {
  all.insert(all.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
}

void shift(int& index, std::size_t by) {
  if (index >= 0) index += static_cast<int>(by);
}

void append_animation(Model& model, Animation other, std::size_t nodes) {
  for (Channel& channel : other.channels) shift(channel.node, nodes);
  const auto same = std::find_if(model.animations.begin(), model.animations.end(),
                                 [&](const Animation& each) { return each.name == other.name; });
  if (same == model.animations.end()) {
    model.animations.push_back(std::move(other));
    return;
  }
  for (Channel& channel : other.channels) shift(channel.times, same->times.size());
  move_behind(same->times, other.times);
  move_behind(same->channels, other.channels);
}

}  // namespace

void append(Model& model, Model other, int parent, const Transform& at) {
  const std::size_t nodes = model.nodes.size() + 1, meshes = model.meshes.size(),
                    materials = model.materials.size(), skins = model.skins.size();
  const auto stand = static_cast<int>(model.nodes.size());
  add_node(model, other.name, parent).transform = at;
  for (Node& node : other.nodes) {
    shift(node.parent, nodes);
    // A skinned mesh is placed by its bones and stays a root.
    if (node.parent < 0 && node.skin < 0) node.parent = stand;
    shift(node.mesh, meshes);
    for (int& lod : node.lods) shift(lod, meshes);
    shift(node.skin, skins);
  }
  for (MeshGroup& group : other.meshes) {
    for (Primitive& primitive : group.primitives) {
      shift(primitive.material, materials);
      for (int& material : primitive.variant_materials) shift(material, materials);
    }
  }
  for (Material& material : other.materials) {
    for (ImpostorRecipe::Part& part : material.impostor.parts) shift(part.mesh, meshes);
  }
  for (Skin& skin : other.skins) {
    for (int& joint : skin.joints) shift(joint, nodes);
    shift(skin.skeleton, nodes);
  }
  move_behind(model.nodes, other.nodes);
  move_behind(model.meshes, other.meshes);
  move_behind(model.skins, other.skins);
  for (Animation& each : other.animations) append_animation(model, std::move(each), nodes);
  move_materials(model, other);
}

}  // namespace seedmesh
