#include "core/generators/scene/grow.h"

#include <algorithm>

#include "core/generators/registry.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t least_bones = 2;  ///< the ground, and the plant on it
constexpr std::uint64_t draw_start = 8;

}  // namespace

Taken taken_to_grow(Model& model) {
  Taken taken;
  if (model.skins.empty() || model.animations.empty()) return taken;
  const Skin& skin = model.skins.front();
  std::vector<int> place(model.nodes.size(), -1);
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    place[static_cast<std::size_t>(skin.joints[i])] = static_cast<int>(i);
  for (const int joint : skin.joints) {
    Node node = model.nodes[static_cast<std::size_t>(joint)];
    node.parent = node.parent < 0 ? -1 : place[static_cast<std::size_t>(node.parent)];
    taken.grower.joints.push_back(std::move(node));
  }
  taken.grower.inverse_bind = skin.inverse_bind;
  taken.grower.animation = std::move(model.animations.front());
  for (Channel& channel : taken.grower.animation.channels)
    channel.node = place[static_cast<std::size_t>(channel.node)];
  for (Node& node : model.nodes) {
    if (node.skin < 0 || node.mesh < 0) continue;
    for (Primitive& each : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      taken.primitives.push_back(std::move(each));
    model.meshes[static_cast<std::size_t>(node.mesh)].primitives.clear();
    node.mesh = -1;
    node.lods.clear();
  }
  return taken;
}

Start start_of(const SceneLayer& layer, const Stand& stand) {
  if (!layer.start) return {};
  if (const double* one = std::get_if<double>(&*layer.start)) return {0, static_cast<float>(*one)};
  const auto& [from, to] = std::get<1>(*layer.start);
  Rng rng(key_at(stand.key, draw_start));
  const std::uint32_t number = rng.below(starts_of_a_layer);
  return {number, static_cast<float>(from + (to - from) * number / (starts_of_a_layer - 1))};
}

void add_grower(Model& scene, Grower& grower, const Plot& plot) {
  const std::string& name = plot.name;
  if (scene.animations.empty()) {
    scene.animations.emplace_back();
    scene.animations.back().name = grower.animation.name;
  }
  Animation& animation = scene.animations.front();
  int& times = grower.times[plot.start.number];
  if (times < 0) {
    times = static_cast<int>(animation.times.size());
    for (std::vector<float> keys : grower.animation.times) {
      for (float& each : keys) each += plot.start.seconds;
      animation.times.push_back(std::move(keys));
    }
  }
  const auto stand = static_cast<int>(scene.nodes.size()), first = stand + 1;
  Node node;
  node.name = name;
  node.parent = plot.parent;
  node.transform = plot.at;
  scene.nodes.push_back(std::move(node));
  Skin skin;
  skin.name = name;
  skin.skeleton = first;
  skin.inverse_bind = grower.inverse_bind;
  for (std::size_t i = 0; i < grower.joints.size(); ++i) {
    Node joint = grower.joints[i];
    joint.name = name + "_" + joint.name;
    joint.parent = joint.parent < 0 ? stand : first + joint.parent;
    scene.nodes.push_back(std::move(joint));
    skin.joints.push_back(first + static_cast<int>(i));
  }
  for (Channel channel : grower.animation.channels) {
    channel.node += first;
    channel.times += times;
    animation.channels.push_back(std::move(channel));
  }
  // A skinned mesh is placed by its bones alone, so it stands at the root.
  Node shown;
  shown.name = name + "_mesh";
  shown.mesh = grower.mesh;
  shown.skin = static_cast<int>(scene.skins.size());
  scene.skins.push_back(std::move(skin));
  scene.nodes.push_back(std::move(shown));
}

Result<std::uint32_t> bones_for(const Plan& plan) {
  std::size_t growing = 0;
  for (std::size_t layer = 0; layer < plan.planting.layers.size(); ++layer) {
    for (const Stand& stand : plan.planting.layers[layer]) {
      const Cast& cast = plan.casting.casts[plan.casting.cast_of(layer, stand)];
      const Generator* generator = find_generator(cast.request.generator);
      growing += generator && generator->grows ? 1 : 0;
    }
  }
  if (growing * least_bones > most_joints) {
    return Error{Code::invalid,
                 {{"/output/animation", "found " + std::to_string(growing) +
                                            " plants, and each that grows has bones of its own; expected at "
                                            "most " +
                                            std::to_string(most_joints / least_bones)}}};
  }
  const std::size_t each = growing == 0 ? most_joints : most_joints / growing;
  return static_cast<std::uint32_t>(std::min<std::size_t>(Demand{}.most_bones, each));
}

}  // namespace seedmesh::scene
