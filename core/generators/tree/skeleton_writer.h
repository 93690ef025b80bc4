#pragma once
/// What all models of a tree share: random numbers, frames, and the writer of a skeleton of limbs and leaves.
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "core/base/attempt.h"
#include "core/base/job.h"
#include "core/base/quick_math.h"
#include "core/geom/plant/frame.h"
#include "core/geom/plant/limbs.h"
#include "core/model/mesh.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {

/// Random numbers of the three parts of a tree, which may have seeds of their own.
struct RandomStreams {
  RandomStreams(const TreeSeeds& seeds, std::uint64_t seed)
      : trunk(Rng::of_seed(seeds.trunk.value_or(seed)).at("trunk")),
        branches(Rng::of_seed(seeds.branches.value_or(seed)).at("branches")),
        leaves(Rng::of_seed(seeds.leaves.value_or(seed)).at("leaves")) {}
  Rng trunk, branches, leaves;
};

/// The hash of a name at compile time: rng.at(name_key("x")) equals rng.at("x").
constexpr std::uint64_t name_key(std::string_view name) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return hash;
}
static_assert(Rng(7).at(name_key("down")).key() == Rng(7).at("down").key());

/// Uniform in [-range, range).
inline double spread(Rng rng, double range) { return range == 0 ? 0 : rng.uniform(-range, range); }

/// Returns the frame turned about a unit axis.
inline Frame rotated(const Frame& frame, const glm::dvec3& axis, const math::SinCos& angle) {
  const auto turn = [&](const glm::dvec3& v) {
    return v * angle.cos + glm::cross(axis, v) * angle.sin + axis * (glm::dot(axis, v) * (1 - angle.cos));
  };
  return {turn(frame.heading), turn(frame.left), turn(frame.up)};
}

/// Returns the frame with this unit heading that differs from `frame` by the smallest rotation.
Frame headed(const Frame& frame, const glm::dvec3& heading);

/// Returns a random number of 53 bits that decides whether the leaf or limb with this key is drawn.
inline std::uint64_t draw_number(std::uint64_t key) { return key_at(key, 0xDE45) >> 11U; }

/// True for the share `density` of all keys.
inline bool is_drawn(std::uint64_t key, double density) {
  return density >= 1 || static_cast<double>(draw_number(key)) * 0x1p-53 < density;
}

/// Calls use(array) for every array that the joints of a tree have.
template <class L, class Use>
void each_array(L& limbs, const Use& use) {
  use(limbs.position);
  use(limbs.radius);
  use(limbs.base_radius);
  use(limbs.parent);
  use(limbs.starts_limb);
  use(limbs.color);
  use(limbs.order);
  use(limbs.key);
}

/// Appends joints and leaves to a skeleton. Every joint is spent as a module and every leaf as a shape.
/// Throws Stop as soon as the bark or the leaves must exceed the limit of triangles.
class SkeletonWriter {
 public:
  /// Only the share `density` of the leaves is written; the others are counted.
  SkeletonWriter(Skeleton& skeleton, Job& job, double density = 1);

  /// Makes the attempt (core/base/attempt.h) end by abandon_attempt() as soon as it adds more joints or
  /// leaves than these.
  void end_after(std::size_t joints, std::size_t leaves) {
    end_joints_ = joints;
    end_leaves_ = leaves;
  }

  /// Whether end_after() was called, so that the attempt may be abandoned.
  bool may_abandon() const { return end_joints_ != ~std::size_t{0}; }

  /// No part of the output needs limbs whose radius at the base is below `radius`, or anything that grows
  /// from them. They need not be written. The caller calls pass_over() for their joints, and finish() at the
  /// end.
  void leave_out_below(double radius) { least_radius_ = static_cast<float>(radius); }
  /// Requires a joint wherever a limb begins, even where the bark needs none, so that limbs can be measured.
  void mark_every_foot() { marks_every_foot_ = true; }
  bool marks_every_foot() const { return marks_every_foot_; }
  bool leaves_out(double radius) const { return static_cast<float>(radius) < least_radius_; }
  /// Counts a joint that is not written, and extends the bounds of the skeleton by it.
  void pass_over(const glm::dvec3& position) {
    count_joint();
    const glm::vec3 at(position);
    passed_box_ = {glm::min(passed_box_.min, at), glm::max(passed_box_.max, at)};
    ++passed_;
  }
  /// Writes two joints without limbs at the corners of the bounds of what was passed over.
  void finish();

  /// How many joints and leaves each of `parts` parts may have so that all together exceed no limit of the
  /// request; 0 where there is no such number.
  std::size_t most_of_parts(std::size_t parts) const;
  /// Writes a part of a skeleton to `part`; several parts may be written at the same time. Joints are
  /// numbered as if they followed those of `whole`, which may itself be a part and must outlive this one.
  /// Abandons the attempt beyond `most` joints or leaves. Nothing is spent before take().
  SkeletonWriter(Skeleton& part, const SkeletonWriter& whole, std::size_t most);
  /// Appends what `parts` have written, on all threads. Each may refer to joints of the parts before it.
  void take(std::span<SkeletonWriter* const> parts);

  struct Joint {
    std::uint32_t parent = Limbs::none;
    glm::dvec3 position{0};
    double base_radius = 0, radius = 0;
    bool starts_limb = false;
    int order = 0;
    std::uint64_t key = 0;
  };
  std::uint32_t add(const Joint& joint);
  /// Reserves memory for about this many joints and leaves; more may follow.
  void expect(double joints, double leaves);

  struct Leaf {
    Frame frame;  ///< heading along the leaf, up out of its upper side
    glm::dvec3 position{0};
    double length = 0, width = 0;
    std::uint32_t joint = Limbs::none;
    std::uint64_t key = 0;
  };
  /// Counts leaves. Throws Stop where there are too many.
  void count_leaves(std::uint64_t count) {
    if (!is_part_) shapes_.spend(count);
    leaves_ += count;
    if (leaves_ > end_leaves_) abandon_attempt();
    if (leaves_ > most_leaves_) refuse_leaves();
  }
  /// The leaves with a draw_number() below this are drawn.
  std::uint64_t drawn_below() const { return drawn_below_; }
  /// Whether the leaf with this key belongs to those that are drawn.
  bool draws(std::uint64_t key) const { return draw_number(key) < drawn_below_; }
  /// Counts a leaf. False: it is not drawn, and must not be added.
  bool wants_leaf(std::uint64_t key) {
    count_leaves(1);
    return draws(key);
  }
  void add(const Leaf& leaf);
  void add(const Organ& leaf) { *extend(1) = leaf; }
  /// Appends this many leaves, which the caller fills in.
  Organ* extend(std::size_t leaves) { return organs_.organ.extend(leaves); }

  /// Returns the radius at a joint, where its internode ends.
  double radius(std::uint32_t joint) const { return static_cast<double>(limbs_.radius[joint - first_]); }
  glm::dvec3 position(std::uint32_t joint) const { return glm::dvec3(limbs_.position[joint - first_]); }
  /// Calls each(joint) for the joints that follow `root` on its limb, until a call returns false.
  template <class Each>
  void each_of_limb(std::uint32_t root, const Each& each) const {
    for (std::uint32_t joint = root + 1; joint - first_ < limbs_.size(); ++joint) {
      const std::size_t i = joint - first_;
      if (limbs_.parent[i] != joint - 1 || limbs_.starts_limb[i] || !each(joint)) return;
    }
  }
  Job& job() const { return job_; }

 private:
  void count_joint() {
    if (!is_part_) {
      modules_.spend();
    } else if (joints() % 1024 == 0) {
      job_.check();
    }
    if (joints() >= end_joints_) abandon_attempt();
    if (joints() >= most_joints_) refuse_joints();
  }
  [[noreturn]] void refuse_joints() const;
  [[noreturn]] void refuse_leaves() const;
  /// Returns the number of joints, including those that were passed over.
  std::size_t joints() const { return limbs_.size() + passed_; }
  void write(const Joint& joint);
  void copy(const SkeletonWriter& part, std::size_t leaf);
  std::uint32_t number_after_take(std::uint32_t joint) const;

  Limbs& limbs_;
  Organs& organs_;
  Job& job_;
  Meter modules_, shapes_;
  std::uint64_t most_joints_, most_leaves_, leaves_ = 0;
  std::size_t end_joints_ = ~std::size_t{0}, end_leaves_ = ~std::size_t{0};
  double density_;
  std::uint64_t drawn_below_;  ///< is_drawn() for `density_`, as a bound of draw_number()
  float least_radius_ = 0;
  bool marks_every_foot_ = false;
  std::size_t passed_ = 0;
  Box passed_box_{glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
  bool is_part_ = false;
  std::uint32_t first_ = 0;     ///< number of a part's first joint
  std::uint32_t taken_at_ = 0;  ///< number of its first joint in the skeleton that took the part
  const SkeletonWriter* whole_ = nullptr;
};

}  // namespace seedmesh::tree
