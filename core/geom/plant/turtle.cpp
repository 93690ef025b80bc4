#include "core/geom/plant/turtle.h"

#include <cmath>

namespace seedmesh {
namespace {

glm::vec3 stored(const glm::dvec3& p) { return glm::vec3(p) + 0.0F; }  // -0 becomes 0

// The default and the largest number of internodes in a piece of a generalised cylinder.
constexpr std::int64_t default_strips = 8, most_strips = 1000;

}  // namespace

Turtle::Turtle(Skeleton* skeleton, double width, Job& job) : skeleton_(skeleton), job_(job) {
  set_width(width);
}

void Turtle::advance(double length) {
  const glm::dvec3 p = state_.position + length * state_.frame.heading;
  if (std::abs(p.x) < largest_coordinate && std::abs(p.y) < largest_coordinate &&
      std::abs(p.z) < largest_coordinate) {
    state_.position = p;
  } else {
    is_out_of_range_ = true;
  }
}

void Turtle::refuse_segments() const {
  job_.refuse(limit_issue({Resource::segments, most_segments_, most_segments_ + 1},
                          "draws more than " + std::to_string(most_segments_) +
                              " segments, which exceed the limit of " +
                              std::to_string(job_.limits().triangles) + " triangles"));
}

void Turtle::refuse_joints() const {
  job_.refuse(limit_issue({Resource::segments, Limbs::none, std::uint64_t{Limbs::none} + 1},
                          "draws more segments than can be counted in 32 bits"));
}

void Turtle::check_depth(std::size_t depth, const char* what) const {
  const std::uint32_t deepest = job_.limits().bracket_depth;
  if (depth < deepest) return;
  job_.refuse(limit_issue({Resource::depth, deepest, depth + 1},
                          std::string(what) + " nest deeper than " + std::to_string(deepest)));
}

void Turtle::draw(double length, std::uint64_t key) {
  if (!polygons_.empty()) return walk(length);
  draw_plain(length, key);
}

void Turtle::walk(double length) {
  walk_plain(length);
  if (!polygons_.empty()) set_vertex();
}

void Turtle::draw_plain(double length, std::uint64_t key) {
  if (!polygons_.empty()) return walk_plain(length);
  const glm::dvec3 from = state_.position;
  advance(length);
  if (state_.is_sweeping) return set_control(default_strips, key);
  add_segment(from, length, key);
  if (tropisms_) state_.frame = tropisms_->turned(state_.frame, tropism_share_);
}

void Turtle::walk_plain(double length) {
  advance(length);
  if (!state_.is_sweeping) state_.joint = Limbs::none;
}

void Turtle::move_to(const glm::dvec3& position) {
  state_.position = position;
  walk_plain(0);  // checks the position
}

void Turtle::set_heading(const glm::dvec3& direction) {
  Frame frame = state_.frame;
  frame.heading = math::unit(direction, frame.heading);
  state_.frame = seedmesh::upright(reorthonormalise(frame));
}

void Turtle::set_frame(const Frame& frame) {
  state_.frame = reorthonormalise(frame);
  state_.rotations = 0;
}

void Turtle::reset_frame() {
  state_.frame = Frame{};
  state_.rotations = 0;
}

void Turtle::add_segment(const glm::dvec3& from, double length, std::uint64_t key) {
  const glm::dvec3& to = state_.position;
  if (report_.segments == most_segments_) refuse_segments();
  if (report_.segments++ == 0) report_.min = report_.max = from;
  report_.total_length += std::abs(length);
  report_.min = glm::min(report_.min, glm::min(from, to));
  report_.max = glm::max(report_.max, glm::max(from, to));
  if (!skeleton_) return;
  std::uint32_t parent = state_.joint;
  if (parent == Limbs::none) {
    parent = add_joint(from, Limbs::none, key);
    state_.begins_branch = false;
  }
  state_.joint = add_joint(to, parent, key);
  state_.last = state_.joint;
  state_.begins_branch = false;
}

std::uint32_t Turtle::add_joint(const glm::dvec3& at, std::uint32_t parent, std::uint64_t key) {
  Limbs& limbs = skeleton_->limbs;
  if (limbs.size() >= Limbs::none) refuse_joints();
  const auto own = static_cast<std::uint32_t>(limbs.size());
  limbs.position.push_back(stored(at));
  limbs.parent.push_back(parent);
  if (places_) places_->push_back(at);
  if (draws_wires_) {
    if (state_.color != 0 && limbs.color.empty()) {  // the first colour that is not 0
      for (std::uint32_t joint = 0; joint < own; ++joint) limbs.color.push_back(0);
    }
    if (state_.color != 0 || !limbs.color.empty()) limbs.color.push_back(state_.color);
    return own;
  }
  limbs.color.push_back(state_.color);
  const double width = state_.width - width_reduction_;
  auto radius = static_cast<float>(width > 0 ? width / 2 : 0);
  const bool goes_on = parent != Limbs::none && !state_.begins_branch;
  // An internode with a small share tapers less, and leaves the rest of the taper to the next one.
  if (share_ != 1 && goes_on) radius = limbs.radius[parent] + (radius - limbs.radius[parent]) * share_;
  limbs.radius.push_back(radius);
  limbs.base_radius.push_back(goes_on ? limbs.radius[parent] : radius);
  limbs.starts_limb.push_back(parent != Limbs::none && state_.begins_branch ? 1 : 0);
  limbs.order.push_back(state_.order);
  if (draws_contours_) {
    limbs.contour.push_back(state_.contour);
    limbs.frame.push_back(quaternion(reorthonormalise(state_.frame)));
  }
  if (tracks_anchors_) limbs.anchor.push_back(parent == Limbs::none ? state_.last : Limbs::none);
  if (key != 0 && limbs.key.empty()) {  // the first key: earlier joints have none
    for (std::uint32_t joint = 0; joint < own; ++joint) limbs.key.push_back(0);
  }
  if (key != 0 || !limbs.key.empty()) limbs.key.push_back(key);
  if (share_ != 1 && limbs.share.empty()) limbs.share = Array<float>(job_, own, 1.0F);
  if (share_ != 1 || !limbs.share.empty()) limbs.share.push_back(share_);
  return own;
}

void Turtle::set_color(std::int64_t color) {
  constexpr std::int64_t most = 255;
  state_.color = static_cast<std::int16_t>(color < 0 ? 0 : color > most ? most : color);
}

void Turtle::set_elasticity(std::int64_t tropism, double elasticity) {
  if (tropisms_ && tropism >= 0) tropisms_->set(static_cast<std::size_t>(tropism), elasticity);
}

void Turtle::change_elasticity(std::int64_t tropism, double steps) {
  if (tropisms_ && tropism >= 0) tropisms_->change(static_cast<std::size_t>(tropism), steps);
}

Turtle::Pose Turtle::pose() const {
  Pose pose{state_.position, state_.frame, state_.width, state_.scale, state_.turn_scale, state_.side, {}};
  if (tropisms_) pose.elasticity = tropisms_->elasticities();
  return pose;
}

void Turtle::interpolate_from(const Pose& earlier, double share, double turned) {
  const auto part = [share](const auto& from, const auto& to) { return from + (to - from) * share; };
  const auto differs = [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x || a.y != b.y || a.z != b.z;
  };
  state_.position = part(earlier.position, state_.position);
  state_.width = part(earlier.width, state_.width);
  state_.scale = part(earlier.scale, state_.scale);
  state_.turn_scale = part(earlier.turn_scale, state_.turn_scale);
  state_.side = part(earlier.side, state_.side);
  const Frame &from = earlier.frame, &to = state_.frame;
  if (turned != 1 && (differs(from.heading, to.heading) || differs(from.left, to.left)))
    state_.frame = between(from, to, turned);
  for (std::size_t i = 0; i < earlier.elasticity.size(); ++i)
    tropisms_->set(i, part(earlier.elasticity[i], tropisms_->elasticities()[i]));
}

void Turtle::rejoin() {
  if (!skeleton_ || state_.joint != Limbs::none || state_.last == Limbs::none) return;
  const glm::vec3 here = stored(state_.position), gap = here - skeleton_->limbs.position[state_.last];
  constexpr float near = 1e-6F;
  if (glm::dot(gap, gap) <= near * near * (1 + glm::dot(here, here))) state_.joint = state_.last;
}

void Turtle::push() {
  check_depth(stack_.size(), "brackets");
  stack_.push_back(state_);
  if (state_.is_sweeping) controls_.push_back(control_);
  if (tropisms_) tropisms_->push();
  state_.is_sweeping = false;
  state_.begins_branch = state_.joint != Limbs::none;
  if (state_.order < 0xFFFF) ++state_.order;
}

void Turtle::pop() {
  if (stack_.empty()) return;
  state_ = stack_.back();
  stack_.pop_back();
  if (state_.is_sweeping) {
    control_ = controls_.back();
    controls_.pop_back();
  }
  if (tropisms_) tropisms_->pop();
}

void Turtle::place_organ(std::uint32_t surface, const glm::dvec3& scale, std::int32_t color,
                         std::uint64_t key) {
  if (!skeleton_) return;
  if (skeleton_->organs.organ.size() % 4096 == 0) job_.check();
  skeleton_->organs.organ.push_back({surface, quaternion(reorthonormalise(state_.frame)),
                                     stored(state_.position), glm::vec3(scale), state_.last,
                                     color < 0 ? state_.color : static_cast<std::int16_t>(color), key});
}

void Turtle::begin_sweep() {
  state_.is_sweeping = true;
  control_.position = state_.position;
  control_.heading = state_.frame.heading;
  control_.left = state_.frame.left;
  control_.width = state_.width;
}

void Turtle::set_control(std::int64_t strips, std::uint64_t key) {
  if (!state_.is_sweeping) return;
  const State here = state_;
  const glm::dvec3 span = here.position - control_.position;
  const double reach = std::sqrt(glm::dot(span, span));
  if (reach > 0) {
    const glm::dvec3 leave = control_.heading * reach, arrive = here.frame.heading * reach;
    const auto count = std::clamp<std::int64_t>(strips, 1, most_strips);
    glm::dvec3 from = control_.position;
    for (std::int64_t i = 1; i <= count; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(count), t2 = t * t, t3 = t2 * t;
      const double rise = 3 * t2 - 2 * t3;
      state_.position = control_.position * (1 - rise) + here.position * rise + leave * (t3 - 2 * t2 + t) +
                        arrive * (t3 - t2);
      if (i == count) state_.position = here.position;
      state_.width = control_.width + (here.width - control_.width) * rise;
      const glm::dvec3 step = state_.position - from;
      if (draws_contours_) {
        const glm::dvec3 left = control_.left + (here.frame.left - control_.left) * rise;
        state_.frame = reorthonormalise({math::unit(step, here.frame.heading), left, here.frame.up});
      }
      add_segment(from, std::sqrt(glm::dot(step, step)),
                  key == 0 ? 0 : key_at(key, static_cast<std::uint64_t>(i)));
      from = state_.position;
    }
    state_.position = here.position;
    state_.width = here.width;
    state_.frame = here.frame;
  }
  control_.position = here.position;
  control_.heading = here.frame.heading;
  control_.left = here.frame.left;
  control_.width = here.width;
}

void Turtle::end_sweep(std::uint64_t key) {
  set_control(default_strips, key);
  state_.is_sweeping = false;
}

void Turtle::open_polygon() {
  check_depth(polygons_.size(), "polygons");
  polygons_.push_back({Array<glm::dvec3>(job_), state_.last});
}

void Turtle::set_vertex() {
  if (polygons_.empty()) return;
  ++report_.vertices;
  polygons_.back().vertices.push_back(state_.position);
}

void Turtle::close_polygon(std::uint64_t key) {
  if (polygons_.empty()) return;
  const Array<glm::dvec3> vertices = std::move(polygons_.back().vertices);
  const std::uint32_t joint = polygons_.back().joint;
  polygons_.pop_back();
  if (!skeleton_ || vertices.size() < 3) return;
  Outlines& outlines = skeleton_->outlines;
  outlines.outline.push_back({static_cast<std::uint32_t>(outlines.vertex.size()),
                              static_cast<std::uint32_t>(vertices.size()), state_.color, key, joint});
  for (const glm::dvec3& vertex : vertices) outlines.vertex.push_back(stored(vertex));
}

}  // namespace seedmesh
