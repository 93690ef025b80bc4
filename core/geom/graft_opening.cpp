#include "core/geom/graft_opening.h"

#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"

namespace seedmesh {
namespace {

// A collar is wider than its limb by this share, less where the limb is thick.
constexpr float collar_flare = 0.3F;
// The widest collar, as a share of the parent's radius: beyond, the tubes meet too flat.
constexpr float widest_collar = 0.86F;
// Limbs that leave at a smaller angle would open their parent over too long a way; sine.
constexpr float flattest_sine = 0.3F;
// How far the crotch of a fork may stand above its joint, in radii, and as a share of the way to the next
// ring.
constexpr float highest_crotch = 5, crotch_share = 0.7F, least_parting = 0.75F;
constexpr float pi = static_cast<float>(math::pi);

/// The inverse sine up to 0.9, to half a degree: angles along a loop need to be in order, not exact.
float inverse_sine(float x) {
  const float s = x * x;
  return x * (1 + s * (1.0F / 6 + s * (3.0F / 40 + s * (15.0F / 336 + s * (105.0F / 3456)))));
}

struct Cross {
  glm::vec3 top{0};    ///< at right angles to the child, toward the parent's tip
  glm::vec3 aside{0};  ///< at right angles to both
  glm::vec3 out{0};    ///< at right angles to the parent, toward the child
  float cosine = 0, sine = 0;
};

Cross cross_of(const glm::vec3& parent, const glm::vec3& child) {
  Cross c;
  c.cosine = glm::dot(parent, child);
  c.sine = std::sqrt(std::max(0.0F, 1 - c.cosine * c.cosine));
  if (c.sine < 1e-3F) return c;
  const float by = 1 / c.sine;
  c.out = unit_again((child - parent * c.cosine) * by, [&] { return any_aside(parent); });
  c.top = unit_again((parent - child * c.cosine) * by, [&] { return any_aside(child); });
  c.aside = glm::cross(parent, c.out);
  return c;
}

/// By rising angle; for a few.
void sort_by_angle(LoopPoint* begin, const LoopPoint* end) {
  for (LoopPoint* each = begin; each != end; ++each) {
    const LoopPoint point = *each;
    LoopPoint* at = each;
    for (; at != begin && point.angle < at[-1].angle; --at) *at = at[-1];
    *at = point;
  }
}

/// Sorts the corners of the loop, the last in the list from `opening.points` on: two ends on the ring, which
/// leave the list, those below and those above it.
void place(Opening& opening, std::vector<LoopPoint>& list) {
  const std::size_t count = list.size() - opening.points;
  list.resize(list.size() + count);  // the second half is for the sorted ones
  LoopPoint *const points = list.data() + opening.points, *const sorted = points + count;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (points[i].angle < points[first].angle) first = i;
    if (points[i].angle > points[last].angle) last = i;
  }
  opening.first = points[first];
  opening.last = points[last];
  const float ends = std::abs(points[first].phase);
  LoopPoint* out = sorted;
  for (const bool above : {false, true}) {
    LoopPoint* const begin = out;
    for (std::size_t i = 0; i < count; ++i) {
      if (i != first && i != last && (std::abs(points[i].phase) < ends) == above) *out++ = points[i];
    }
    sort_by_angle(begin, out);
    (above ? opening.upper : opening.lower) = static_cast<std::size_t>(out - begin);
  }
  opening.at = 0.5F * (opening.first.height + opening.last.height);
  opening.half = std::max(-opening.first.angle, opening.last.angle);
  opening.low = std::min(opening.first.height, opening.last.height);
  opening.high = std::max(opening.first.height, opening.last.height);
  opening.child_reach = 0;
  for (std::size_t i = 0; i < count; ++i) {
    opening.low = std::min(opening.low, points[i].height);
    opening.high = std::max(opening.high, points[i].height);
    opening.child_reach = std::max(opening.child_reach, points[i].reach);
  }
  std::copy(sorted, out, points);
  list.resize(opening.points + opening.lower + opening.upper);
}

float angle_about(const GraftAxis& parent, std::size_t piece, const glm::vec3& out) {
  return static_cast<float>(math::quick_atan2(static_cast<double>(glm::dot(out, parent.aside(piece))),
                                              static_cast<double>(glm::dot(out, parent.u[piece]))));
}

}  // namespace

const std::vector<Phase>& Phases::of(int sides) {
  const auto number = static_cast<std::size_t>(sides);
  if (number >= by_sides_.size()) by_sides_.resize(number + 1);
  std::vector<Phase>& phases = by_sides_[number];
  if (!phases.empty()) return phases;
  phases.reserve(number);
  const float step = 2 * pi / static_cast<float>(sides);
  const float first = sides % 4 == 2 ? 0.5F * step : 0;
  for (int corner = 0; corner < sides; ++corner) {
    float angle = first + step * static_cast<float>(corner);
    if (angle > pi + 1e-4F) angle -= 2 * pi;
    const math::SinCos at = math::quick_sincos(static_cast<double>(angle));
    phases.push_back({angle, static_cast<float>(at.cos), static_cast<float>(at.sin)});
  }
  return phases;
}

std::optional<Opening> collar(const GraftAxis& parent, std::size_t at_point, const Bud& bud,
                              std::vector<LoopPoint>& points) {
  const std::size_t inside = std::min(at_point, parent.pieces() - 1);
  Cross cross = cross_of(parent.along[inside], bud.along);
  std::size_t piece = inside;
  if (cross.cosine < 0 && at_point > 0) {
    piece = at_point - 1;
    cross = cross_of(parent.along[piece], bud.along);
  }
  if (cross.sine < flattest_sine) return std::nullopt;
  const float around = parent.radius[at_point];
  const float share = bud.radius / around;
  const float wide = bud.radius * (1 + collar_flare * std::max(0.0F, 1 - share));
  if (!(wide < widest_collar * around)) return std::nullopt;

  Opening opening;
  opening.limb = bud.limb;
  opening.piece = piece;
  opening.radius = wide;
  const glm::vec3 joint = parent.point[at_point];
  const glm::vec3 axis = parent.along[piece];
  const float taper =
      (parent.radius[piece + 1] - parent.radius[piece]) / (parent.at[piece + 1] - parent.at[piece]);
  const float out_of_top = glm::dot(cross.top, cross.out);
  opening.points = points.size();
  for (const Phase& phase : bud.phases->of(bud.sides)) {
    LoopPoint point;
    point.phase = phase.angle;
    const float cosine = phase.cosine, sine = phase.sine;
    const float beside = wide * sine, before = wide * cosine * out_of_top;
    float radius = around;
    for (int step = 0; step < 3; ++step) {
      const float distance = std::sqrt(std::max(0.0F, radius * radius - beside * beside));
      point.reach = (distance - before) / cross.sine;
      point.position = joint + cross.top * (wide * cosine) + cross.aside * beside + bud.along * point.reach;
      point.height = glm::dot(point.position - joint, axis);
      radius = std::max(0.5F * around, around + taper * point.height);
    }
    point.angle = inverse_sine(std::clamp(beside / radius, -0.95F, 0.95F));
    point.height += parent.at[at_point];
    points.push_back(point);
  }
  place(opening, points);
  if (opening.child_reach + 0.5F * bud.radius > 0.85F * bud.length) return std::nullopt;
  opening.middle = angle_about(parent, piece, cross.out);
  opening.child_u = cross.top;
  return opening;
}

std::optional<Opening> fork_at(const GraftAxis& parent, std::size_t at_point, const Bud& bud,
                               std::vector<LoopPoint>& points) {
  if (at_point == 0 || at_point >= parent.pieces()) return std::nullopt;
  const glm::vec3 &before = parent.along[at_point - 1], &after = parent.along[at_point];
  const Cross cross = cross_of(after, bud.along);
  if (cross.sine < 0.12F || cross.cosine < -0.4F) return std::nullopt;
  const float radius = parent.radius[at_point];
  if (bud.radius > 1.15F * radius || bud.radius < 0.4F * radius) return std::nullopt;

  Opening opening;
  opening.limb = bud.limb;
  opening.piece = at_point;
  opening.radius = radius;
  opening.is_fork = true;
  const glm::vec3 joint = parent.point[at_point];
  const glm::vec3 middle = math::quick_unit(before + bud.along, before);
  const glm::vec3 outer = math::quick_unit(cross.out - middle * glm::dot(middle, cross.out), cross.out);
  const glm::vec3 outward = math::quick_unit(cross.out - before * glm::dot(before, cross.out), cross.out);
  const float mitre = 1 / std::max(0.7F, glm::dot(outer, outward));
  const glm::vec3 crotch = math::quick_unit(after + bud.along, after);
  const float cosine_half = glm::dot(crotch, after);
  const float sine_half = std::sqrt(std::max(1e-4F, 1 - cosine_half * cosine_half));
  const float next = parent.at[at_point + 1] - parent.at[at_point];
  // Where the two tubes part; a lower crotch would lie inside both.
  const float parting = 0.9F * std::min(bud.radius, radius) / sine_half;
  const float rise = std::min({parting, highest_crotch * radius, crotch_share * next / cosine_half,
                               crotch_share * bud.length / cosine_half});
  if (rise < least_parting * parting) return std::nullopt;
  opening.points = points.size();
  for (const Phase& phase : bud.phases->of(bud.sides)) {
    LoopPoint point;
    point.phase = phase.angle;
    const float cosine = phase.cosine, sine = phase.sine;
    const glm::vec3 lean = cosine > 0 ? crotch * (rise * cosine) : outer * (-radius * mitre * cosine);
    const glm::vec3 off = cross.aside * (radius * sine) + lean;
    point.position = joint + off;
    point.height = parent.at[at_point] + glm::dot(off, cosine > 0 ? after : before);
    point.reach = glm::dot(off, bud.along);
    point.angle = cosine > 0 || std::abs(cosine) < 1e-4F ? point.phase
                                                         : std::copysign(pi - std::abs(point.phase), sine);
    if (std::abs(std::abs(point.phase) - pi) < 1e-3F) point.angle = 0;
    points.push_back(point);
  }
  place(opening, points);
  opening.at = parent.at[at_point];
  opening.middle = angle_about(parent, at_point, cross.out);
  opening.child_u = cross.top;
  return opening;
}

}  // namespace seedmesh
