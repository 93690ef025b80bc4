#include "core/generators/tree/age.h"

#include <algorithm>
#include <cmath>

#include "core/geom/plant/tube_formulas.h"

namespace seedmesh::tree {
namespace {

// In the animation, a limb sprouts after this share of the time that its parent has left: the first at the
// foot of the parent, the last at its tip, with a random difference of up to `spread_share`.
constexpr float first_share = 0.03F, last_share = 0.5F, spread_share = 0.06F;
constexpr float latest = 0.8F;
// With an age, limbs sprout within this share of the time that their parent has left. Limbs near the foot and
// thick limbs, which are older, sprout earlier. More than a quarter of those on the trunk sprout in the first
// tenth.
constexpr float young_share = 0.5F, by_position = 0.1F, by_thickness = 0.75F;
// Limbs below this share of their size do not exist yet.
constexpr float smallest = 2e-3F;
// A leaf is unfolded when its twig has this share of its size.
constexpr float unfolded = 0.35F;
// Leaves of younger trees are smaller.
constexpr float of_full_leaves = 0.4F;
// A seedling has this share of the height.
constexpr float seedling = 0.01F;
// First leaves are unfolded when their stem has grown by the first share. They shrink from the second share
// of the age of the tree to the third.
constexpr float first_unfolded = 0.05F, first_until = 0.05F, first_gone = 0.1F;

float length_of(const Limbs& limbs, std::size_t joint) {
  const glm::vec3 step = limbs.position[joint] - limbs.position[limbs.parent[joint]];
  return std::sqrt(glm::dot(step, step));
}

/// The relative position of each joint along its limb, 0 .. 1.
Array<float> positions_along(const Limbs& limbs, Job& job) {
  Array<float> position(job, limbs.size(), 0.0F), rest(job, limbs.size(), 0.0F);
  for (std::size_t i = limbs.size(); i-- > 0;) {
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none || limbs.starts_limb[i]) continue;
    rest[parent] = rest[i] + length_of(limbs, i);
  }
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    const float before = limbs.starts_limb[i] ? 0 : position[parent];
    const float length = length_of(limbs, i), left = length + rest[i];
    position[i] = left > 0 ? before + (1 - before) * (length / left) : 1;
  }
  return position;
}

/// The relative size of the trunk.
float trunk_size(float share) { return std::max(seedling, 1 - (1 - share) * (1 - share)); }

/// The relative size of an unfolded leaf: the 3/4th power of the relative height of the tree.
float leaf_size(float share) {
  const float height = std::min(1.0F, trunk_size(share) / trunk_size(of_full_leaves));
  return std::sqrt(height) * std::sqrt(std::sqrt(height));
}

/// The relative size of a limb compared with its parent.
float limb_size(float birth, float share) {
  if (share <= birth) return 0;
  const float left = 1 - (share - birth) / (share * (1 - birth));
  return 1 - left * left;
}

/// The time at which the internode of each joint sprouts, 0 .. 1: that of the joint before it, or where a
/// limb begins the result of sprout(joint, birth of its parent, position along its parent).
template <class Sprout>
Array<float> births(const Limbs& limbs, Job& job, const Sprout& sprout) {
  Array<float> birth(job, limbs.size(), 0.0F);
  const Array<float> position = positions_along(limbs, job);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    birth[i] = limbs.starts_limb[i] ? sprout(i, birth[parent], position[parent]) : birth[parent];
  }
  return birth;
}

/// For a tree with an age.
Array<float> sprouting_of(const Limbs& limbs, Job& job) {
  return births(limbs, job, [&](std::size_t i, float parent_birth, float position) {
    const float around = std::max(limbs.radius[limbs.parent[i]], limbs.base_radius[i]);
    const float thickness = around > 0 ? limbs.base_radius[i] / around : 1.0F;
    float drawn = fraction_of(key_at(limbs.key[i], 0xA6E));
    if (limbs.order[i] <= 1) drawn *= drawn;
    const float moment = by_position * position + (1 - by_position) * drawn;
    const float soon = 1 - by_thickness * thickness * thickness;
    return parent_birth + (1 - parent_birth) * young_share * moment * soon;
  });
}

/// The first leaves of a seedling: where a limb will sprout from an existing stem, one of its leaves exists
/// already.
class FirstLeaves {
 public:
  FirstLeaves(const Skeleton& skeleton, float share, Job& job) : limbs_(skeleton.limbs), first_(job) {
    size_ = std::clamp((first_gone - share) / (first_gone - first_until), 0.0F, 1.0F);
    if (size_ == 0) return;
    const Array<Organ>& organs = skeleton.organs.organ;
    first_ = Array<std::uint32_t>(job, limbs_.size(), Limbs::none);
    const auto hash = [&](std::uint32_t organ) { return key_at(organs[organ].key, 0xF125); };
    const auto offer = [&](std::uint32_t joint, std::uint32_t organ) {
      std::uint32_t& best = first_[joint];
      if (best == Limbs::none || hash(organ) < hash(best)) best = organ;
    };
    for (std::uint32_t i = 0; i < organs.size(); ++i) {
      if (organs[i].limb_joint != Limbs::none) offer(organs[i].limb_joint, i);
    }
    for (std::size_t i = limbs_.size(); i-- > 0;) {
      if (first_[i] != Limbs::none && limbs_.parent[i] != Limbs::none) offer(limbs_.parent[i], first_[i]);
    }
  }

  /// How far an organ is unfolded as a first leaf, 0 .. 1. own[joint] is the relative size of a joint;
  /// new_index is Limbs::none for joints that do not exist yet.
  float open(std::uint32_t organ, std::uint32_t joint, const Array<float>& own,
             const Array<std::uint32_t>& new_index) const {
    float most = 0;
    for (; size_ > 0 && joint != Limbs::none && first_[joint] == organ; joint = limbs_.parent[joint]) {
      const std::uint32_t bearer = limbs_.parent[joint];
      if (!limbs_.starts_limb[joint] || new_index[bearer] == Limbs::none) continue;
      most = std::max(most, std::min(1.0F, (own[bearer] - seedling) / first_unfolded));
    }
    return size_ * most;
  }

 private:
  const Limbs& limbs_;
  Array<std::uint32_t> first_;  ///< the first organ on each joint and beyond it
  float size_ = 0;
};

template <class T>
void compact(Array<T>& values, const Array<std::uint32_t>& new_index, std::size_t count) {
  if (values.empty()) return;
  for (std::size_t i = 0; i < new_index.size(); ++i) {
    if (new_index[i] != Limbs::none) values[new_index[i]] = values[i];
  }
  values.resize(count);
}

}  // namespace

Array<float> births_of(const Limbs& limbs, Job& job) {
  return births(limbs, job, [&](std::size_t i, float parent_birth, float position) {
    const float difference = 2 * fraction_of(key_at(limbs.key[i], 0xA6E)) - 1;
    const float wait = first_share + (last_share - first_share) * position + spread_share * difference;
    return std::min(latest, parent_birth + (1 - parent_birth) * std::max(0.0F, wait));
  });
}

void make_young(Skeleton& skeleton, double share, Job& job) {
  if (share >= 1) return;
  Limbs& limbs = skeleton.limbs;
  const std::size_t size = limbs.size();
  const Array<float> birth = sprouting_of(limbs, job);
  const auto time = static_cast<float>(share);
  Array<float> own(job, size, 1.0F), scale(job, size, 1.0F);
  Array<glm::vec3> position(job, size);
  Array<std::uint32_t> new_index(job, size);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (i % 4096 == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    own[i] = birth[i] == 0 ? trunk_size(time) : limb_size(birth[i], time);
    scale[i] = parent == Limbs::none       ? own[i]
               : birth[i] == birth[parent] ? scale[parent]
                                           : std::min(own[i], 1.0F) * scale[parent];
    const bool is_there = parent == Limbs::none || (new_index[parent] != Limbs::none && scale[i] > smallest);
    new_index[i] = is_there ? count++ : Limbs::none;
    position[i] = parent == Limbs::none
                      ? limbs.position[i]
                      : position[parent] + (limbs.position[i] - limbs.position[parent]) * scale[i];
  }
  const float largest = leaf_size(time);
  Array<Organ>& organs = skeleton.organs.organ;
  const FirstLeaves first(skeleton, time, job);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < organs.size(); ++i) {
    const Organ& organ = organs[i];
    std::uint32_t joint = organ.limb_joint;
    if (joint == Limbs::none) continue;
    const bool is_there = new_index[joint] != Limbs::none;
    const float by_twig = is_there ? std::min(1.0F, (own[joint] - seedling) / unfolded) : 0.0F;
    const float open = std::max(by_twig, first.open(static_cast<std::uint32_t>(i), joint, own, new_index));
    if (!(open > 0)) continue;
    Organ young = organ;
    young.position = position[joint] + (organ.position - limbs.position[joint]) * scale[joint];
    young.scale *= open * largest;
    while (new_index[joint] == Limbs::none) joint = limbs.parent[joint];
    young.limb_joint = new_index[joint];
    organs[kept++] = young;
  }
  organs.resize(kept);
  for (std::size_t i = 0; i < size; ++i) {
    const float thickness = scale[i] * std::sqrt(scale[i]);
    limbs.radius[i] *= thickness;
    limbs.base_radius[i] *= thickness;
    if (limbs.parent[i] != Limbs::none) limbs.parent[i] = new_index[limbs.parent[i]];
  }
  limbs.position = std::move(position);
  each_array(limbs, [&](auto& values) { compact(values, new_index, count); });
}

}  // namespace seedmesh::tree
