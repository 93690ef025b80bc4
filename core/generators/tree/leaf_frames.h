#pragma once
/// How leaves stand on their stems, many reckoned at once: down and about as Weber and Penn 1995 put any
/// child on a stem, then toward the light (their section on leaf orientation). In single precision, as they
/// are stored. About 3 ns a leaf.
#include <cstddef>

#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// A leaf's frame with its upper side turned outward and up by the share `bend` > 0, at a place about the
/// trunk.
inline Frame to_light(const Frame& leaf, const glm::dvec3& position, double bend) {
  const double off = math::quick_atan2(position.z, position.x) - math::quick_atan2(leaf.up.z, leaf.up.x);
  const double less = off > math::pi ? off - 2 * math::pi : off;
  const double outward = less < -math::pi ? less + 2 * math::pi : less;
  const math::SinCos about = math::quick_sincos(-bend * outward);
  const auto about_sky = [&](const glm::dvec3& v) {
    return glm::dvec3{v.x * about.cos + v.z * about.sin, v.y * about.cos + v.y * (1 - about.cos),
                      v.z * about.cos - v.x * about.sin};
  };
  const Frame turned{about_sky(leaf.heading), about_sky(leaf.left), about_sky(leaf.up)};
  const double aside = std::sqrt(turned.up.x * turned.up.x + turned.up.z * turned.up.z);
  const bool is_level = aside < 1e-9;
  const double by = is_level ? 1 : aside;
  const glm::dvec3 level_axis{-turned.up.z / by, 0, turned.up.x / by};
  const Frame lit =
      rotated(turned, level_axis, math::quick_sincos(bend * math::quick_atan2(aside, turned.up.y)));
  const auto chosen = [&](const glm::dvec3& yes, const glm::dvec3& no) {
    return glm::dvec3{is_level ? yes.x : no.x, is_level ? yes.y : no.y, is_level ? yes.z : no.z};
  };
  return {chosen(turned.heading, lit.heading), chosen(turned.left, lit.left), chosen(turned.up, lit.up)};
}

/// A leaf whose upper side looks down is turned over.
inline Frame upper_side_up(const Frame& leaf) {
  const double side = leaf.up.y < 0 ? -1 : 1;
  return {leaf.heading, leaf.left * side, leaf.up * side};
}

/// Leaves that wait for their frames, by numbers.
class LeafFrames {
 public:
  static constexpr std::size_t most = 128;

  /// The same of all leaves: the share by which they turn to the light, and by how many degrees their angles
  /// about and from the stem differ by chance.
  struct Habit {
    double bend = 0, about_v = 0, down_v = 0;
  };
  /// Of one: in degrees about and from the stem, by chance apart; `key`: of its chance.
  struct Stance {
    double about = 0, down = 0;
    std::uint64_t key = 0;
  };

  bool is_full() const { return count_ == most; }
  std::size_t size() const { return count_; }
  void clear() { count_ = 0; }

  /// A leaf at `position` of a stem whose frame there is `stem`, as quaternion() has it, moved with `joint`.
  void add(const glm::quat& stem, const glm::dvec3& position, std::uint32_t joint, const Stance& stance) {
    stem_[0][count_] = stem.w;
    stem_[1][count_] = stem.x;
    stem_[2][count_] = stem.y;
    stem_[3][count_] = stem.z;
    for (int axis = 0; axis < 3; ++axis) position_[axis][count_] = static_cast<float>(position[axis]);
    about_[count_] = stance.about;
    down_[count_] = stance.down;
    key_[count_] = stance.key;
    joint_[count_] = joint;
    ++count_;
  }

  /// Writes all, `scale` in size, to as many organs.
  void reckon(const Habit& habit, const glm::vec3& scale, Organ* out);

 private:
  std::size_t count_ = 0;
  float stem_[4][most] = {}, position_[3][most] = {};
  double about_[most] = {}, down_[most] = {};
  std::uint64_t key_[most] = {};
  std::uint32_t joint_[most];
};

}  // namespace seedmesh::tree
