#pragma once
/// The orientations of leaves on their stems, after Weber and Penn, SIGGRAPH 1995. A leaf is rotated about
/// the stem, then down from it, then to the light (their section 4.5). Its upper side is then turned up.
/// A batch of leaves is computed at once in single precision, so that the compiler can use vectors. Cost: about 3 ns
/// for each leaf.
#include <cstddef>

#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Returns the frame of a leaf at `position` after two turns: about +Y until its upper side faces away from
/// the trunk, then up. Each turn is multiplied by `bend`. Computed in double precision, for single leaves.
Frame turned_to_light(const Frame& leaf, const glm::dvec3& position, double bend);

/// Returns a leaf whose upper side faces down, turned over about its heading.
inline Frame upper_side_up(const Frame& leaf) {
  const double side = leaf.up.y < 0 ? -1 : 1;
  return {leaf.heading, leaf.left * side, leaf.up * side};
}

/// A batch of leaves whose orientations are not yet computed.
class LeafFrames {
 public:
  static constexpr std::size_t capacity = 128;

  /// For all leaves of a batch.
  struct Options {
    double bend = 0;                  ///< share of the turn to the light, 0 .. 1: the paper's LeafBend
    double rotate_v = 0, down_v = 0;  ///< degrees; each angle varies by up to this to either side
  };
  /// For one leaf.
  struct Angles {
    double rotate = 0, down = 0;  ///< degrees about the stem and down from it, without variation
    std::uint64_t key = 0;        ///< key of its random numbers
  };

  bool is_full() const { return count_ == capacity; }
  std::size_t size() const { return count_; }
  void clear() { count_ = 0; }

  /// Adds a leaf at `position` that moves with `joint`. `stem`: quaternion() of the frame of the stem there.
  void add(const glm::quat& stem, const glm::dvec3& position, std::uint32_t joint, const Angles& angles) {
    stem_[0][count_] = stem.w;
    stem_[1][count_] = stem.x;
    stem_[2][count_] = stem.y;
    stem_[3][count_] = stem.z;
    for (int axis = 0; axis < 3; ++axis) position_[axis][count_] = static_cast<float>(position[axis]);
    rotate_[count_] = angles.rotate;
    down_[count_] = angles.down;
    key_[count_] = angles.key;
    joint_[count_] = joint;
    ++count_;
  }

  /// Computes the batch and writes it to `out`, which has a capacity of at least size() organs.
  void write(const Options& options, const glm::vec3& scale, Organ* out);

 private:
  std::size_t count_ = 0;
  float stem_[4][capacity] = {}, position_[3][capacity] = {};
  double rotate_[capacity] = {}, down_[capacity] = {};
  std::uint64_t key_[capacity] = {};
  std::uint32_t joint_[capacity];
};

}  // namespace seedmesh::tree
