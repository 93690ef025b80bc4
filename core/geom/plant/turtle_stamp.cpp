#include <algorithm>
#include <cmath>

#include "core/geom/plant/turtle.h"

namespace seedmesh {
namespace {

/// Transforms what was drawn from the origin, upward, to the position and frame of a turtle.
struct Setting {
  glm::dvec3 origin, x, y, z;
  Setting(const glm::dvec3& position, const Frame& frame)
      : origin(position), x(-frame.left), y(frame.heading), z(frame.up) {}
  glm::dvec3 direction(const glm::dvec3& v) const { return x * v.x + y * v.y + z * v.z; }
  glm::dvec3 place(const glm::dvec3& p) const { return direction(p) + origin; }
};

template <class T>
void append_rest(Array<T>& to, const Array<T>& from, std::uint32_t first) {
  to.append(from.span().subspan(first));
}

}  // namespace

void Turtle::begin_stamp(const Turtle& like, Stamp& stamp) {
  places_ = &stamp.places_;
  most_segments_ = like.most_segments_;
  state_ = like.state_;
  state_.position = glm::dvec3(0);
  state_.frame = Frame{};
  state_.rotations = 0;
  state_.order = 0;
  state_.joint = state_.last = Limbs::none;
  stamp.start_ = like.state_;
  if (like.state_.joint == Limbs::none) return;
  state_.joint = state_.last = add_joint(state_.position, Limbs::none, 0);
  stamp.seeds_ = 1;
  if (draws_wires_) return;
  stamp.radius_ = like.skeleton_->limbs.radius[like.state_.joint];
  skeleton_->limbs.radius[0] = stamp.radius_;
}

void Turtle::end_stamp(Stamp& stamp) {
  places_ = nullptr;
  stamp.end_ = state_;
  stamp.report_ = report_;
  for (const glm::dvec3& p : stamp.places_)
    stamp.reach_ = std::max(stamp.reach_, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
}

bool Turtle::matches(const Stamp& stamp) const {
  const State& other = stamp.start_;
  return !state_.is_sweeping && state_.width == other.width && state_.scale == other.scale &&
         state_.turn_scale == other.turn_scale && state_.side == other.side && state_.color == other.color &&
         state_.begins_branch == other.begins_branch &&
         (state_.joint != Limbs::none) == (stamp.seeds_ == 1) &&
         (draws_wires_ || stamp.seeds_ == 0 || skeleton_->limbs.radius[state_.joint] == stamp.radius_);
}

void Turtle::press(const Stamp& stamp) {
  job_.check();
  const std::size_t before = skeleton_->limbs.size();
  const std::size_t count = stamp.places_.size() - stamp.seeds_;
  if (stamp.report_.segments > most_segments_ - report_.segments) refuse_segments();
  if (before + count >= Limbs::none) refuse_joints();
  report_.segments += stamp.report_.segments;
  report_.total_length += stamp.report_.total_length;
  press_links(stamp);
  press_places(stamp);
  if (!draws_wires_) press_bark(stamp);
  press_colors(stamp, before);
  go_to_end(stamp, static_cast<std::uint32_t>(before) - stamp.seeds_);
}

void Turtle::press_places(const Stamp& stamp) {
  const Setting setting(state_.position, state_.frame);
  const glm::dvec3& p = state_.position;
  // In any rotation, no coordinate of a joint exceeds the sum of its absolute coordinates.
  if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + stamp.reach_ < world))
    job_.refuse({IssueKind::evaluation, "", too_far});
  const std::size_t count = stamp.places_.size() - stamp.seeds_;
  const glm::dvec3* from = stamp.places_.data() + stamp.seeds_;
  glm::vec3* to = skeleton_->limbs.position.extend(count);
  for (std::size_t i = 0; i < count; ++i) to[i] = glm::vec3(setting.place(from[i])) + 0.0F;
}

void Turtle::press_links(const Stamp& stamp) {
  Limbs& limbs = skeleton_->limbs;
  const std::uint32_t first = static_cast<std::uint32_t>(limbs.size()) - stamp.seeds_;
  const std::uint32_t joint = state_.joint, seeds = stamp.seeds_;
  const Array<std::uint32_t>& parent = stamp.skeleton.limbs.parent;
  std::uint32_t* to = limbs.parent.extend(parent.size() - seeds);
  for (std::size_t i = seeds; i < parent.size(); ++i) {
    // A joint without a parent begins another root; the first one may be where the stamp begins.
    const std::uint32_t own = parent[i];
    *to++ = own < seeds ? joint : own == Limbs::none ? own : own + first;
  }
}

void Turtle::press_bark(const Stamp& stamp) {
  Limbs& limbs = skeleton_->limbs;
  const Limbs& from = stamp.skeleton.limbs;
  append_rest(limbs.radius, from.radius, stamp.seeds_);
  append_rest(limbs.base_radius, from.base_radius, stamp.seeds_);
  append_rest(limbs.starts_limb, from.starts_limb, stamp.seeds_);
  for (std::size_t i = stamp.seeds_; i < from.size(); ++i) {
    const unsigned order = unsigned{from.order[i]} + state_.order;
    limbs.order.push_back(static_cast<std::uint16_t>(std::min(order, 0xFFFFU)));
  }
  for (std::size_t i = stamp.seeds_; !limbs.key.empty() && i < from.size(); ++i) limbs.key.push_back(0);
}

/// Wires have no colours as long as all are 0.
void Turtle::press_colors(const Stamp& stamp, std::size_t before) {
  Limbs& limbs = skeleton_->limbs;
  const Array<std::int16_t>& color = stamp.skeleton.limbs.color;
  const std::size_t count = stamp.places_.size() - stamp.seeds_;
  if (!color.empty()) {
    while (limbs.color.size() < before) limbs.color.push_back(0);
    append_rest(limbs.color, color, stamp.seeds_);
  } else if (!limbs.color.empty()) {
    std::fill_n(limbs.color.extend(count), count, std::int16_t{0});
  }
}

void Turtle::go_to_end(const Stamp& stamp, std::uint32_t first) {
  const Setting setting(state_.position, state_.frame);
  const State before = state_;
  const auto joint_of = [&](std::uint32_t joint, std::uint32_t seed) {
    return joint == Limbs::none ? Limbs::none : joint < stamp.seeds_ ? seed : joint + first;
  };
  state_ = stamp.end_;
  state_.position = setting.place(stamp.end_.position);
  state_.frame = {setting.direction(stamp.end_.frame.heading), setting.direction(stamp.end_.frame.left),
                  setting.direction(stamp.end_.frame.up)};
  state_.order = static_cast<std::uint16_t>(std::min(unsigned{stamp.end_.order} + before.order, 0xFFFFU));
  state_.joint = joint_of(stamp.end_.joint, before.joint);
  state_.last = joint_of(stamp.end_.last, before.last);
  if (stamp.end_.last == Limbs::none) state_.last = before.last;
  const unsigned rotations = unsigned{before.rotations} + stamp.end_.rotations;
  state_.rotations = static_cast<std::uint16_t>(rotations);
  if (rotations / rotations_until_drift != before.rotations / rotations_until_drift)
    state_.frame = reorthonormalise(state_.frame);
}

}  // namespace seedmesh
