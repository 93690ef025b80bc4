#include "core/geom/plant/graft/junction.h"

#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"

namespace seedmesh {
namespace {

// A collar is wider than its limb by this share, less where the limb is thick.
constexpr float collar_flare = 0.3F;
// The widest collar, as a share of the parent's radius. Beyond it the tubes meet at too flat an angle.
constexpr float widest_collar = 0.86F;
// The least sine of the angle between child and parent: flatter limbs would open their parent over too long a
// distance.
constexpr float flattest_sine = 0.3F;
// The highest crotch of a fork above its joint: in radii, and as a share of the distance to the next ring.
// The lowest crotch, as a share of the height at which the tubes part.
constexpr float highest_crotch = 5, crotch_share = 0.7F, least_parting = 0.75F;
constexpr float pi = static_cast<float>(math::pi);

/// The inverse sine up to 0.9, within half a degree: the order of angles along a loop matters, not their
/// value.
float inverse_sine(float x) {
  const float s = x * x;
  return x * (1 + s * (1.0F / 6 + s * (3.0F / 40 + s * (15.0F / 336 + s * (105.0F / 3456)))));
}

/// Directions at a junction.
struct Directions {
  glm::vec3 top{0};    ///< at right angles to the child, toward the parent's tip
  glm::vec3 aside{0};  ///< at right angles to both
  glm::vec3 out{0};    ///< at right angles to the parent, toward the child
  float cosine = 0, sine = 0;
};

Directions directions_of(const glm::vec3& parent, const glm::vec3& child) {
  Directions c;
  c.cosine = glm::dot(parent, child);
  c.sine = std::sqrt(std::max(0.0F, 1 - c.cosine * c.cosine));
  if (c.sine < 1e-3F) return c;
  const float by = 1 / c.sine;
  c.out = unit_again((child - parent * c.cosine) * by, [&] { return unit_perpendicular(parent); });
  c.top = unit_again((parent - child * c.cosine) * by, [&] { return unit_perpendicular(child); });
  c.aside = glm::cross(parent, c.out);
  return c;
}

/// By rising angle. Insertion sort: loops have few points.
void sort_by_angle(LoopPoint* begin, const LoopPoint* end) {
  for (LoopPoint* each = begin; each != end; ++each) {
    const LoopPoint point = *each;
    LoopPoint* at = each;
    for (; at != begin && point.angle < at[-1].angle; --at) *at = at[-1];
    *at = point;
  }
}

/// Sorts the points of the loop, which are the elements of the list from `junction.points` on: those below
/// the ring, then those above it. The two ends on the ring move from the list to the junction.
void sort_points(Junction& junction, std::vector<LoopPoint>& list) {
  const std::size_t count = list.size() - junction.points;
  list.resize(list.size() + count);  // the second half holds the sorted points
  LoopPoint *const points = list.data() + junction.points, *const sorted = points + count;
  std::size_t first = 0, last = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (points[i].angle < points[first].angle) first = i;
    if (points[i].angle > points[last].angle) last = i;
  }
  junction.first = points[first];
  junction.last = points[last];
  const float ends = std::abs(points[first].phase);
  LoopPoint* out = sorted;
  for (const bool above : {false, true}) {
    LoopPoint* const begin = out;
    for (std::size_t i = 0; i < count; ++i) {
      if (i != first && i != last && (std::abs(points[i].phase) < ends) == above) *out++ = points[i];
    }
    sort_by_angle(begin, out);
    (above ? junction.upper : junction.lower) = static_cast<std::size_t>(out - begin);
  }
  junction.at = 0.5F * (junction.first.height + junction.last.height);
  junction.half_width = std::max(-junction.first.angle, junction.last.angle);
  junction.low = std::min(junction.first.height, junction.last.height);
  junction.high = std::max(junction.first.height, junction.last.height);
  junction.child_reach = 0;
  for (std::size_t i = 0; i < count; ++i) {
    junction.low = std::min(junction.low, points[i].height);
    junction.high = std::max(junction.high, points[i].height);
    junction.child_reach = std::max(junction.child_reach, points[i].reach);
  }
  std::copy(sorted, out, points);
  list.resize(junction.points + junction.lower + junction.upper);
}

float angle_about(const LimbAxis& parent, std::size_t piece, const glm::vec3& out) {
  return static_cast<float>(math::quick_atan2(static_cast<double>(glm::dot(out, parent.aside(piece))),
                                              static_cast<double>(glm::dot(out, parent.u[piece]))));
}

}  // namespace

const std::vector<LoopAngle>& LoopAngles::of(int sides) {
  const auto number = static_cast<std::size_t>(sides);
  if (number >= by_sides_.size()) by_sides_.resize(number + 1);
  std::vector<LoopAngle>& angles = by_sides_[number];
  if (!angles.empty()) return angles;
  angles.reserve(number);
  const float step = 2 * pi / static_cast<float>(sides);
  const float first = sides % 4 == 2 ? 0.5F * step : 0;
  for (int corner = 0; corner < sides; ++corner) {
    float angle = first + step * static_cast<float>(corner);
    if (angle > pi + 1e-4F) angle -= 2 * pi;
    const math::SinCos at = math::quick_sincos(static_cast<double>(angle));
    angles.push_back({angle, static_cast<float>(at.cos), static_cast<float>(at.sin)});
  }
  return angles;
}

std::optional<Junction> collar_at(const LimbAxis& parent, std::size_t at_point, const ChildLimb& child,
                                  std::vector<LoopPoint>& points) {
  const std::size_t inside = std::min(at_point, parent.pieces() - 1);
  Directions cross = directions_of(parent.along[inside], child.along);
  std::size_t piece = inside;
  if (cross.cosine < 0 && at_point > 0) {
    piece = at_point - 1;
    cross = directions_of(parent.along[piece], child.along);
  }
  if (cross.sine < flattest_sine) return std::nullopt;
  const float around = parent.radius[at_point];
  const float share = child.radius / around;
  const float wide = child.radius * (1 + collar_flare * std::max(0.0F, 1 - share));
  if (!(wide < widest_collar * around)) return std::nullopt;

  Junction junction;
  junction.limb = child.limb;
  junction.piece = piece;
  junction.radius = wide;
  const glm::vec3 joint = parent.point[at_point];
  const glm::vec3 axis = parent.along[piece];
  const float taper =
      (parent.radius[piece + 1] - parent.radius[piece]) / (parent.at[piece + 1] - parent.at[piece]);
  const float out_of_top = glm::dot(cross.top, cross.out);
  junction.points = points.size();
  for (const LoopAngle& corner : child.angles->of(child.sides)) {
    LoopPoint point;
    point.phase = corner.angle;
    const float cosine = corner.cosine, sine = corner.sine;
    const float beside = wide * sine, before = wide * cosine * out_of_top;
    float radius = around;
    for (int step = 0; step < 3; ++step) {
      const float distance = std::sqrt(std::max(0.0F, radius * radius - beside * beside));
      point.reach = (distance - before) / cross.sine;
      point.position = joint + cross.top * (wide * cosine) + cross.aside * beside + child.along * point.reach;
      point.height = glm::dot(point.position - joint, axis);
      radius = std::max(0.5F * around, around + taper * point.height);
    }
    point.angle = inverse_sine(std::clamp(beside / radius, -0.95F, 0.95F));
    point.height += parent.at[at_point];
    points.push_back(point);
  }
  sort_points(junction, points);
  if (junction.child_reach + 0.5F * child.radius > 0.85F * child.length) return std::nullopt;
  junction.middle = angle_about(parent, piece, cross.out);
  junction.child_u = cross.top;
  return junction;
}

std::optional<Junction> fork_at(const LimbAxis& parent, std::size_t at_point, const ChildLimb& child,
                                std::vector<LoopPoint>& points) {
  if (at_point == 0 || at_point >= parent.pieces()) return std::nullopt;
  const glm::vec3 &before = parent.along[at_point - 1], &after = parent.along[at_point];
  const Directions cross = directions_of(after, child.along);
  if (cross.sine < 0.12F || cross.cosine < -0.4F) return std::nullopt;
  const float radius = parent.radius[at_point];
  if (child.radius > 1.15F * radius || child.radius < 0.4F * radius) return std::nullopt;

  Junction junction;
  junction.limb = child.limb;
  junction.piece = at_point;
  junction.radius = radius;
  junction.is_fork = true;
  const glm::vec3 joint = parent.point[at_point];
  const glm::vec3 middle = math::quick_unit(before + child.along, before);
  const glm::vec3 outer = math::quick_unit(cross.out - middle * glm::dot(middle, cross.out), cross.out);
  const glm::vec3 outward = math::quick_unit(cross.out - before * glm::dot(before, cross.out), cross.out);
  const float mitre = 1 / std::max(0.7F, glm::dot(outer, outward));
  const glm::vec3 crotch = math::quick_unit(after + child.along, after);
  const float cosine_half = glm::dot(crotch, after);
  const float sine_half = std::sqrt(std::max(1e-4F, 1 - cosine_half * cosine_half));
  const float next = parent.at[at_point + 1] - parent.at[at_point];
  // The height at which the two tubes part. A lower crotch would lie inside both.
  const float parting = 0.9F * std::min(child.radius, radius) / sine_half;
  const float rise = std::min({parting, highest_crotch * radius, crotch_share * next / cosine_half,
                               crotch_share * child.length / cosine_half});
  if (rise < least_parting * parting) return std::nullopt;
  junction.points = points.size();
  for (const LoopAngle& corner : child.angles->of(child.sides)) {
    LoopPoint point;
    point.phase = corner.angle;
    const float cosine = corner.cosine, sine = corner.sine;
    const glm::vec3 lean = cosine > 0 ? crotch * (rise * cosine) : outer * (-radius * mitre * cosine);
    const glm::vec3 off = cross.aside * (radius * sine) + lean;
    point.position = joint + off;
    point.height = parent.at[at_point] + glm::dot(off, cosine > 0 ? after : before);
    point.reach = glm::dot(off, child.along);
    point.angle = cosine > 0 || std::abs(cosine) < 1e-4F ? point.phase
                                                         : std::copysign(pi - std::abs(point.phase), sine);
    if (std::abs(std::abs(point.phase) - pi) < 1e-3F) point.angle = 0;
    points.push_back(point);
  }
  sort_points(junction, points);
  junction.at = parent.at[at_point];
  junction.middle = angle_about(parent, at_point, cross.out);
  junction.child_u = cross.top;
  return junction;
}

}  // namespace seedmesh
