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

void Turtle::begin_recording(const Turtle& like, Recording& recording) {
  places_ = &recording.places_;
  most_segments_ = like.most_segments_;
  state_ = like.state_;
  state_.position = glm::dvec3(0);
  state_.frame = Frame{};
  state_.rotations = 0;
  state_.order = 0;
  state_.joint = state_.last = Limbs::none;
  recording.start_ = like.state_;
  if (like.state_.joint == Limbs::none) return;
  state_.joint = state_.last = add_joint(state_.position, Limbs::none, 0);
  recording.shared_joints_ = 1;
  if (draws_wires_) return;
  recording.radius_ = like.skeleton_->limbs.radius[like.state_.joint];
  skeleton_->limbs.radius[0] = recording.radius_;
}

void Turtle::end_recording(Recording& recording) {
  places_ = nullptr;
  recording.end_ = state_;
  recording.report_ = report_;
  for (const glm::dvec3& p : recording.places_)
    recording.reach_ = std::max(recording.reach_, std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
}

bool Turtle::matches(const Recording& recording) const {
  const State& other = recording.start_;
  return !state_.is_sweeping && state_.width == other.width && state_.scale == other.scale &&
         state_.turn_scale == other.turn_scale && state_.side == other.side && state_.color == other.color &&
         state_.begins_branch == other.begins_branch &&
         (state_.joint != Limbs::none) == (recording.shared_joints_ == 1) &&
         (draws_wires_ || recording.shared_joints_ == 0 ||
          skeleton_->limbs.radius[state_.joint] == recording.radius_);
}

void Turtle::append_copy(const Recording& recording) {
  job_.check();
  const std::size_t before = skeleton_->limbs.size();
  const std::size_t count = recording.places_.size() - recording.shared_joints_;
  if (recording.report_.segments > most_segments_ - report_.segments) refuse_segments();
  if (before + count >= Limbs::none) refuse_joints();
  report_.segments += recording.report_.segments;
  report_.total_length += recording.report_.total_length;
  copy_links(recording);
  copy_positions(recording);
  if (!draws_wires_) copy_bark(recording);
  copy_colors(recording, before);
  go_to_end(recording, static_cast<std::uint32_t>(before) - recording.shared_joints_);
}

void Turtle::skip_copy(const Recording& recording, bool is_measured) {
  job_.check();
  refuse_far(recording);
  if (is_measured) {
    const Setting setting(state_.position, state_.frame);
    for (const glm::dvec3& each : recording.places_) {
      const glm::dvec3 place = setting.place(each);
      const bool is_first = report_.segments == 0 && &each == recording.places_.data();
      report_.min = is_first ? place : glm::min(report_.min, place);
      report_.max = is_first ? place : glm::max(report_.max, place);
    }
  }
  report_.segments += recording.report_.segments;
  report_.total_length += recording.report_.total_length;
  const State before = state_;
  go_to_end(recording, 0);
  state_.last = before.last;
  if (state_.joint == Limbs::none) return;
  // Joints of the recording are not in this skeleton.
  const bool is_at_start = recording.end_.joint < recording.shared_joints_;
  state_.joint = is_at_start ? before.joint : Limbs::none;
}

/// In any rotation, no coordinate of a joint exceeds the sum of its absolute coordinates.
void Turtle::refuse_far(const Recording& recording) const {
  const glm::dvec3& p = state_.position;
  if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) + recording.reach_ < largest_coordinate))
    job_.refuse({IssueKind::evaluation, "", too_far});
}

void Turtle::copy_positions(const Recording& recording) {
  const Setting setting(state_.position, state_.frame);
  refuse_far(recording);
  const std::size_t count = recording.places_.size() - recording.shared_joints_;
  const glm::dvec3* from = recording.places_.data() + recording.shared_joints_;
  glm::vec3* to = skeleton_->limbs.position.extend(count);
  for (std::size_t i = 0; i < count; ++i) to[i] = glm::vec3(setting.place(from[i])) + 0.0F;
}

void Turtle::copy_links(const Recording& recording) {
  Limbs& limbs = skeleton_->limbs;
  const std::uint32_t first = static_cast<std::uint32_t>(limbs.size()) - recording.shared_joints_;
  const std::uint32_t joint = state_.joint, shared = recording.shared_joints_;
  const Array<std::uint32_t>& parent = recording.skeleton.limbs.parent;
  std::uint32_t* to = limbs.parent.extend(parent.size() - shared);
  for (std::size_t i = shared; i < parent.size(); ++i) {
    // A joint without a parent begins another root; the first one may be where the recording begins.
    const std::uint32_t own = parent[i];
    *to++ = own < shared ? joint : own == Limbs::none ? own : own + first;
  }
}

void Turtle::copy_bark(const Recording& recording) {
  Limbs& limbs = skeleton_->limbs;
  const Limbs& from = recording.skeleton.limbs;
  append_rest(limbs.radius, from.radius, recording.shared_joints_);
  append_rest(limbs.base_radius, from.base_radius, recording.shared_joints_);
  append_rest(limbs.starts_limb, from.starts_limb, recording.shared_joints_);
  for (std::size_t i = recording.shared_joints_; i < from.size(); ++i) {
    const unsigned order = unsigned{from.order[i]} + state_.order;
    limbs.order.push_back(static_cast<std::uint16_t>(std::min(order, 0xFFFFU)));
  }
  for (std::size_t i = recording.shared_joints_; !limbs.key.empty() && i < from.size(); ++i)
    limbs.key.push_back(0);
}

/// Wires have no colours as long as all are 0.
void Turtle::copy_colors(const Recording& recording, std::size_t before) {
  Limbs& limbs = skeleton_->limbs;
  const Array<std::int16_t>& color = recording.skeleton.limbs.color;
  const std::size_t count = recording.places_.size() - recording.shared_joints_;
  if (!color.empty()) {
    while (limbs.color.size() < before) limbs.color.push_back(0);
    append_rest(limbs.color, color, recording.shared_joints_);
  } else if (!limbs.color.empty()) {
    std::fill_n(limbs.color.extend(count), count, std::int16_t{0});
  }
}

void Turtle::go_to_end(const Recording& recording, std::uint32_t first) {
  const Setting setting(state_.position, state_.frame);
  const State before = state_;
  const auto joint_of = [&](std::uint32_t joint, std::uint32_t existing) {
    return joint == Limbs::none ? Limbs::none : joint < recording.shared_joints_ ? existing : joint + first;
  };
  state_ = recording.end_;
  state_.position = setting.place(recording.end_.position);
  state_.frame = {setting.direction(recording.end_.frame.heading),
                  setting.direction(recording.end_.frame.left), setting.direction(recording.end_.frame.up)};
  state_.order = static_cast<std::uint16_t>(std::min(unsigned{recording.end_.order} + before.order, 0xFFFFU));
  state_.joint = joint_of(recording.end_.joint, before.joint);
  state_.last = joint_of(recording.end_.last, before.last);
  if (recording.end_.last == Limbs::none) state_.last = before.last;
  const unsigned rotations = unsigned{before.rotations} + recording.end_.rotations;
  state_.rotations = static_cast<std::uint16_t>(rotations);
  if (rotations / rotations_until_drift != before.rotations / rotations_until_drift)
    state_.frame = reorthonormalise(state_.frame);
}

}  // namespace seedmesh
