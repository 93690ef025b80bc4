#include "core/generators/scene/grow.h"

#include <algorithm>

#include "core/generators/api.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::size_t least_bones = 2;  ///< one for the ground, one for the plant
constexpr std::uint64_t draw_start = 8;

}  // namespace

ExtractedPlant extract_growing_plant(Model& model) {
  ExtractedPlant taken;
  if (model.skins.empty() || model.animations.empty()) return taken;
  const Skin& skin = model.skins.front();
  std::vector<int> place(model.nodes.size(), -1);
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    place[static_cast<std::size_t>(skin.joints[i])] = static_cast<int>(i);
  for (const int joint : skin.joints) {
    Node node = model.nodes[static_cast<std::size_t>(joint)];
    node.parent = node.parent < 0 ? -1 : place[static_cast<std::size_t>(node.parent)];
    taken.growing_plant.joints.push_back(std::move(node));
  }
  taken.growing_plant.inverse_bind = skin.inverse_bind;
  taken.growing_plant.animation = std::move(model.animations.front());
  for (Channel& channel : taken.growing_plant.animation.channels)
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

Start start_of(const SceneLayer& layer, const Placement& placement) {
  if (!layer.start) return {};
  if (const double* one = std::get_if<double>(&*layer.start)) return {0, static_cast<float>(*one)};
  const auto& [from, to] = std::get<1>(*layer.start);
  Rng rng(key_at(placement.key, draw_start));
  const std::uint32_t number = rng.below(starts_of_a_layer);
  return {number, static_cast<float>(from + (to - from) * number / (starts_of_a_layer - 1))};
}

void add_growing_plant(Model& scene, GrowingPlant& growing_plant, const PlantInstance& plot) {
  const std::string& name = plot.name;
  if (scene.animations.empty()) {
    scene.animations.emplace_back();
    scene.animations.back().name = growing_plant.animation.name;
  }
  Animation& animation = scene.animations.front();
  int& times = growing_plant.times[plot.start.number];
  if (times < 0) {
    times = static_cast<int>(animation.times.size());
    for (std::vector<float> keys : growing_plant.animation.times) {
      for (float& each : keys) each += plot.start.seconds;
      animation.times.push_back(std::move(keys));
    }
  }
  const auto placement = static_cast<int>(scene.nodes.size()), first = placement + 1;
  Node node;
  node.name = name;
  node.parent = plot.parent;
  node.transform = plot.at;
  scene.nodes.push_back(std::move(node));
  Skin skin;
  skin.name = name;
  skin.skeleton = first;
  skin.inverse_bind = growing_plant.inverse_bind;
  for (std::size_t i = 0; i < growing_plant.joints.size(); ++i) {
    Node joint = growing_plant.joints[i];
    joint.name = name + "_" + joint.name;
    joint.parent = joint.parent < 0 ? placement : first + joint.parent;
    scene.nodes.push_back(std::move(joint));
    skin.joints.push_back(first + static_cast<int>(i));
  }
  for (Channel channel : growing_plant.animation.channels) {
    channel.node += first;
    channel.times += times;
    animation.channels.push_back(std::move(channel));
  }
  // Only its bones place a skinned mesh, so its node is a root.
  Node shown;
  shown.name = name + "_mesh";
  shown.mesh = growing_plant.mesh;
  shown.skin = static_cast<int>(scene.skins.size());
  scene.skins.push_back(std::move(skin));
  scene.nodes.push_back(std::move(shown));
}

Result<std::uint32_t> bones_for(const Plan& plan, GeneratorList generators) {
  std::size_t growing = 0;
  for (std::size_t layer = 0; layer < plan.all_placements.layers.size(); ++layer) {
    for (const Placement& placement : plan.all_placements.layers[layer]) {
      const ModelVariant& variant =
          plan.variant_table.variants[plan.variant_table.variant_at(layer, placement)];
      const Generator* generator = find_generator(generators, variant.request.generator);
      growing += generator && generator->grows ? 1 : 0;
    }
  }
  if (growing * least_bones > most_joints) {
    return Error{
        Code::invalid,
        {{IssueKind::out_of_range, "/output/animation",
          "found " + std::to_string(growing) + " growing plants with bones of their own; expected at most " +
              std::to_string(most_joints / least_bones)}}};
  }
  const std::size_t each = growing == 0 ? most_joints : most_joints / growing;
  return static_cast<std::uint32_t>(std::min<std::size_t>(Demand{}.most_bones, each));
}

}  // namespace seedmesh::scene
