#include "core/geom/plant/grow.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace seedmesh {
namespace {

constexpr std::size_t check_interval = 4096;
// The last pieces need time to grow, and a trunk should not be bare for long.
constexpr double last_birth = 0.6;
// The scale of a bone that is not born yet. Not 0: viewers invert matrices.
constexpr float seed_size = 0.001F;
// Keys of a scale between birth and end. Between keys the error is below one percent.
constexpr int keys_a_bone = 9;

/// Values of each joint from which bones are chosen.
struct Measures {
  explicit Measures(const Limbs& limbs, Job& job)
      : path(job, limbs.size(), 0.0F), carried(job, limbs.size(), 0.0F), born(job, limbs.size()) {}
  Array<float> path;         ///< length along the limbs from the root to the joint
  Array<float> carried;      ///< length of the internode and of all that grows from it
  Array<std::uint8_t> born;  ///< class of birth of the internode
};

std::uint32_t carrier_of(const Limbs& limbs, std::size_t joint) {
  if (limbs.parent[joint] != Limbs::none) return limbs.parent[joint];
  return limbs.anchor.empty() ? Limbs::none : limbs.anchor[joint];
}

float length_of(const Limbs& limbs, std::size_t joint) {
  if (limbs.parent[joint] == Limbs::none) return 0;
  const glm::vec3 step = limbs.position[joint] - limbs.position[limbs.parent[joint]];
  return std::sqrt(glm::dot(step, step));
}

void measure_births(const Limbs& limbs, Measures& measures) {
  const bool given = !limbs.birth.empty();
  float first = 0, last = 0;
  const auto birth = [&](std::size_t i) {
    if (given) return limbs.birth[i];
    const std::uint32_t carrier = carrier_of(limbs, i);
    return carrier == Limbs::none ? 0.0F : measures.path[carrier];
  };
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i == 0) first = last = birth(0);
    first = std::min(first, birth(i));
    last = std::max(last, birth(i));
  }
  const float span = last - first;
  constexpr auto most = static_cast<float>(GrowthPlan::birth_classes - 1);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const float share = span > 0 ? (birth(i) - first) / span : 0;
    measures.born[i] = static_cast<std::uint8_t>(std::clamp(share * most, 0.0F, most));
  }
}

Measures measure(const Limbs& limbs, Job& job) {
  Measures measures(limbs, job);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const std::uint32_t carrier = carrier_of(limbs, i);
    if (carrier != Limbs::none) measures.path[i] = measures.path[carrier] + length_of(limbs, i);
  }
  for (std::size_t i = limbs.size(); i-- > 0;) {
    if (i % check_interval == 0) job.check();
    measures.carried[i] += length_of(limbs, i);
    const std::uint32_t carrier = carrier_of(limbs, i);
    if (carrier != Limbs::none) measures.carried[carrier] += measures.carried[i];
  }
  measure_births(limbs, measures);
  return measures;
}

/// True where a bone may begin with the internode of `joint`: at roots and side branches, and where a limb
/// continues in a later class of birth.
bool may_begin(const Limbs& limbs, const Measures& measures, std::uint32_t joint) {
  const std::uint32_t parent = limbs.parent[joint];
  if (parent == Limbs::none) return true;
  if (limbs.parent[parent] == Limbs::none)
    return false;  // the first internode of a root belongs to the root's bone
  return limbs.starts_limb[joint] || measures.born[joint] != measures.born[parent];
}

/// The joints where bones begin, rising: those that carry most.
std::vector<std::uint32_t> chosen_joints(const Limbs& limbs, const Measures& measures, std::size_t most,
                                         Job& job) {
  std::vector<std::uint32_t> joints;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const auto joint = static_cast<std::uint32_t>(i);
    if (may_begin(limbs, measures, joint)) joints.push_back(joint);
  }
  const auto carries_more = [&](std::uint32_t a, std::uint32_t b) {
    if (measures.carried[a] != measures.carried[b]) return measures.carried[a] > measures.carried[b];
    return a < b;
  };
  if (joints.size() > most) {
    const auto end = joints.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(joints.begin(), end, joints.end(), carries_more);
    joints.erase(end, joints.end());
    std::sort(joints.begin(), joints.end());
  }
  return joints;
}

double size_at(std::uint32_t born, double time) {
  const double birth = last_birth * born / (GrowthPlan::birth_classes - 1);
  if (time <= birth) return 0;
  const double rest = 1 - (time - birth) / (1 - birth);
  return 1 - rest * rest;
}

/// The scale track of a bone: key times in seconds, three floats a key.
struct Track {
  std::vector<float> times, values;
};

/// `parent_born` below 0: the parent has its final size from the start.
Track track_of(std::uint32_t born, int parent_born, double seconds) {
  Track track;
  const double birth = last_birth * born / (GrowthPlan::birth_classes - 1);
  for (int i = 0; i < keys_a_bone; ++i) {
    const double share = static_cast<double>(i) / (keys_a_bone - 1);
    const double time = i + 1 == keys_a_bone ? 1 : birth + (1 - birth) * share * share;  // more keys at first
    const double parent = parent_born < 0 ? 1 : size_at(static_cast<std::uint32_t>(parent_born), time);
    double size = i == 0 || parent == 0 ? 0 : size_at(born, time) / parent;
    if (i + 1 == keys_a_bone) size = 1;
    track.times.push_back(static_cast<float>(seconds * time));
    for (int axis = 0; axis < 3; ++axis)
      track.values.push_back(std::max(seed_size, static_cast<float>(size)));
  }
  return track;
}

}  // namespace

GrowthPlan plan_growth(const Limbs& limbs, const GrowthOptions& options, Job& job) {
  GrowthPlan plan;
  plan.seconds = options.seconds;
  plan.bone = Array<std::uint16_t>(job, limbs.size(), std::uint16_t{0});
  plan.bones.push_back({});
  const Measures measures = measure(limbs, job);
  std::size_t plants = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) plants += carrier_of(limbs, i) == Limbs::none ? 1 : 0;
  plan.ground_grows = plants == 0 || plants + 1 > options.most_bones;
  if (plan.ground_grows) return plan;

  const std::vector<std::uint32_t> begins = chosen_joints(limbs, measures, options.most_bones - 1, job);
  auto next = begins.begin();
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const std::uint32_t carrier = carrier_of(limbs, i);
    const std::uint16_t under = plan.bone_of(carrier);
    plan.bone[i] = under;
    const bool begins_here = next != begins.end() && *next == i;
    if (begins_here) ++next;
    // A plant without a bone of its own would be visible from the start.
    if (!begins_here && !(carrier == Limbs::none)) continue;
    const glm::vec3 at = limbs.position[limbs.parent[i] == Limbs::none ? i : limbs.parent[i]];
    plan.bone[i] = static_cast<std::uint16_t>(plan.bones.size());
    plan.bones.push_back({at, under, measures.born[i]});
  }
  return plan;
}

void add_growth(Model& model, const GrowthPlan& plan) {
  const auto first = static_cast<int>(model.nodes.size());
  for (Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const MeshGroup& group = model.meshes[static_cast<std::size_t>(node.mesh)];
    if (std::none_of(group.primitives.begin(), group.primitives.end(),
                     [](const Primitive& each) { return !each.mesh.bone.empty(); })) {
      continue;
    }
    node.parent = -1;
    node.skin = static_cast<int>(model.skins.size());
  }
  Skin skin;
  skin.name = "growth";
  skin.skeleton = first;
  Animation animation;
  animation.name = "growth";
  std::map<std::uint32_t, int> times;  // the key times of each class of birth
  for (std::size_t i = 0; i < plan.bones.size(); ++i) {
    const Bone& bone = plan.bones[i];
    const bool is_ground = bone.parent < 0;
    Node node;
    node.name = is_ground ? "ground" : "limb_" + std::to_string(i);
    node.parent = is_ground ? 0 : first + bone.parent;
    if (!is_ground)
      node.transform.translation = bone.position - plan.bones[static_cast<std::size_t>(bone.parent)].position;
    model.nodes.push_back(std::move(node));
    skin.joints.push_back(first + static_cast<int>(i));
    glm::mat4 bind(1);
    bind[3] = glm::vec4(-bone.position + 0.0F, 1);
    skin.inverse_bind.push_back(bind);
    if (is_ground && !plan.ground_grows) continue;
    const bool parent_stands = is_ground || (bone.parent == 0 && !plan.ground_grows);
    const int parent_born =
        parent_stands ? -1 : static_cast<int>(plan.bones[static_cast<std::size_t>(bone.parent)].born);
    if (parent_born == static_cast<int>(bone.born)) continue;  // of the size of its parent at all times
    Track track = track_of(bone.born, parent_born, plan.seconds);
    const auto [known, is_new] = times.try_emplace(bone.born, static_cast<int>(animation.times.size()));
    if (is_new) animation.times.push_back(std::move(track.times));
    animation.channels.push_back({first + static_cast<int>(i), Path::scale, Interpolation::linear,
                                  known->second, std::move(track.values)});
  }
  model.skins.push_back(std::move(skin));
  model.animations.push_back(std::move(animation));
}

}  // namespace seedmesh
