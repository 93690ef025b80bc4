#pragma once
/// What every model of a tree writes with: limbs and leaves of one Skeleton, counted before they are made.
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include "core/base/job.h"
#include "core/base/quick_math.h"
#include "core/geom/frame.h"
#include "core/geom/limbs.h"
#include "core/model/mesh.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {

/// Streams of chance of the three parts, which may have seeds of their own.
struct Chances {
  Chances(const TreeSeeds& seeds, std::uint64_t seed)
      : trunk(Rng::of_seed(seeds.trunk.value_or(seed)).at("trunk")),
        branches(Rng::of_seed(seeds.branches.value_or(seed)).at("branches")),
        leaves(Rng::of_seed(seeds.leaves.value_or(seed)).at("leaves")) {}
  Rng trunk, branches, leaves;
};

/// The place of a name, reckoned when this is compiled: rng.at(place_of("x")) is rng.at("x").
constexpr std::uint64_t place_of(std::string_view name) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
  return hash;
}
static_assert(Rng(7).at(place_of("down")).key() == Rng(7).at("down").key());

/// Uniform in [-spread, spread).
inline double spread(Rng rng, double range) { return range == 0 ? 0 : rng.uniform(-range, range); }

/// The frame turned about a unit axis.
inline Frame rotated(const Frame& frame, const glm::dvec3& axis, const math::SinCos& angle) {
  const auto turn = [&](const glm::dvec3& v) {
    return v * angle.cos + glm::cross(axis, v) * angle.sin + axis * (glm::dot(axis, v) * (1 - angle.cos));
  };
  return {turn(frame.heading), turn(frame.left), turn(frame.up)};
}

/// A frame whose heading is `heading`, turned the least from `frame`.
Frame headed(const Frame& frame, const glm::dvec3& heading);

/// Where a leaf's key tells whether it is drawn.
constexpr std::uint64_t drawn_place = 0xDE45;

/// Is a leaf among the share `density` that is drawn?
inline bool is_drawn(std::uint64_t key, double density) {
  return density >= 1 || static_cast<double>(key_at(key, drawn_place) >> 11U) * 0x1p-53 < density;
}

/// Appends to a skeleton. Every joint is spent as a module, and refused where its bark would pass the limit
/// of triangles, so that a hostile request ends early and small.
class SkeletonWriter {
 public:
  /// Leaves beyond the share `density` are counted, but not made.
  SkeletonWriter(Skeleton& skeleton, Job& job, double density = 1);

  /// Thrown where more joints or leaves are added than end_after() allows: caught where that was asked for.
  struct Enough {};
  void end_after(std::size_t joints, std::size_t leaves) {
    end_joints_ = joints;
    end_leaves_ = leaves;
  }

  /// Limbs that begin thinner, and all that grows from them, need not be written, for nobody looks at them.
  /// Whoever grows them calls pass_over(), and finish() when all is grown.
  void leave_out_below(double radius) { least_radius_ = static_cast<float>(radius); }
  /// A joint wherever a limb stands, for whoever measures limbs, also where the bark needs none.
  void mark_every_foot() { marks_every_foot_ = true; }
  bool marks_every_foot() const { return marks_every_foot_; }
  bool leaves_out(double radius) const { return static_cast<float>(radius) < least_radius_; }
  /// Counts a joint as if it were written; the extent of the skeleton will be what it would be then.
  void pass_over(const glm::dvec3& position) {
    count_joint();
    const glm::vec3 at(position);
    passed_box_ = {glm::min(passed_box_.min, at), glm::max(passed_box_.max, at)};
    ++passed_;
  }
  /// Two joints without limbs at the corners of all that was passed over.
  void finish();

  /// Several write at once, each a part that begins behind what is written here. `most`: joints and leaves of
  /// one, so many that `parts` of them meet no limit of the request; 0: there is no room for that.
  std::size_t most_of_parts(std::size_t parts) const;
  /// Writes to `part`, numbering joints as if they came next after those of `whole`, which may be a part
  /// itself and lives as long; throws Enough beyond `most` joints or leaves. Nothing is spent before the part
  /// is taken.
  SkeletonWriter(Skeleton& part, const SkeletonWriter& whole, std::size_t most);
  /// Appends what `parts` have written, on all threads; none hangs on one behind it.
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
  /// Room for about so many of both in all; more come in all the same.
  void expect(double joints, double leaves);

  struct Leaf {
    Frame frame;  ///< heading along the leaf, up out of its upper side
    glm::dvec3 position{0};
    double length = 0, width = 0;
    std::uint32_t joint = Limbs::none;
    std::uint64_t key = 0;
  };
  /// Counts leaves; throws where that is too many.
  void count_leaves(std::uint64_t count) {
    if (!is_part_) shapes_.spend(count);
    leaves_ += count;
    if (leaves_ > end_leaves_) throw Enough{};
    if (leaves_ > most_leaves_) refuse_leaves();
  }
  /// Hashes of a leaf's key at drawn_place, shifted by 11, are below this where it is drawn.
  std::int64_t drawn_below() const { return drawn_below_; }
  bool draws_all() const { return drawn_below_ == std::int64_t{1} << 53U; }
  /// Counts a leaf. False: it is none of those that are drawn, and need not be made.
  bool wants_leaf(std::uint64_t key) {
    count_leaves(1);
    return static_cast<std::int64_t>(key_at(key, drawn_place) >> 11U) < drawn_below_;
  }
  void add(const Leaf& leaf);
  void add(const Organ& leaf) { *extend(1) = leaf; }
  /// Room for so many leaves more, to be filled.
  Organ* extend(std::size_t leaves) { return organs_.organ.extend(leaves); }

  /// The radius at the far end of a joint's internode.
  double radius(std::uint32_t joint) const { return static_cast<double>(limbs_.radius[joint - first_]); }
  glm::dvec3 position(std::uint32_t joint) const { return glm::dvec3(limbs_.position[joint - first_]); }
  /// Calls each(joint) for those that stand behind `root` on its own limb, which are written one after the
  /// other, until one of them returns false.
  template <class Each>
  void each_of_limb(std::uint32_t root, const Each& each) const {
    for (std::uint32_t joint = root + 1; joint - first_ < limbs_.size(); ++joint) {
      const std::size_t i = joint - first_;
      if (limbs_.parent[i] != joint - 1 || limbs_.starts_limb[i] || !each(joint)) return;
    }
  }
  Job& job() { return job_; }

 private:
  void count_joint() {
    if (!is_part_) {
      modules_.spend();
    } else if (joints() % 1024 == 0) {
      job_.check();
    }
    if (joints() >= end_joints_) throw Enough{};
    if (joints() >= most_joints_) refuse_joints();
  }
  [[noreturn]] void refuse_joints() const;
  [[noreturn]] void refuse_leaves() const;
  /// Of all, those that were passed over too.
  std::size_t joints() const { return limbs_.size() + passed_; }
  void write(const Joint& joint);
  void copy(const SkeletonWriter& part, std::size_t leaf);
  std::uint32_t taken(std::uint32_t joint) const;

  Limbs& limbs_;
  Organs& organs_;
  Job& job_;
  Meter modules_, shapes_;
  std::uint64_t most_joints_, most_leaves_, leaves_ = 0;
  std::size_t end_joints_ = ~std::size_t{0}, end_leaves_ = ~std::size_t{0};
  double density_;
  std::int64_t drawn_below_;
  float least_radius_ = 0;
  bool marks_every_foot_ = false;
  std::size_t passed_ = 0;
  Box passed_box_{glm::vec3(std::numeric_limits<float>::max()),
                  glm::vec3(std::numeric_limits<float>::lowest())};
  bool is_part_ = false;
  std::uint32_t first_ = 0;  ///< number of a part's first joint
  std::uint32_t place_ = 0;  ///< its number where the part was taken
  const SkeletonWriter* whole_ = nullptr;
};

}  // namespace seedmesh::tree
