#include "core/generators/tree/ez_tree_turns.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::tree {
namespace {

// Quaternions whose product is greater are mixed linearly.
constexpr double nearly_equal = 0.9995;
// Where +X is turned so close to Z, the angle about Z is 0.
constexpr double nearly_upright = 0.9999999;
constexpr double opposite = 1e-8;

double dot(const EzTurn& a, const EzTurn& b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }

EzTurn normalised(const EzTurn& turn) {
  const double length = std::sqrt(dot(turn, turn));
  if (!(length > 0)) return {};
  return {turn.x / length, turn.y / length, turn.z / length, turn.w / length};
}

EzTurn mixed(const EzTurn& a, double of_a, const EzTurn& b, double of_b) {
  return {a.x * of_a + b.x * of_b, a.y * of_a + b.y * of_b, a.z * of_a + b.z * of_b, a.w * of_a + b.w * of_b};
}

}  // namespace

EzTurn turn_of_angles(const glm::dvec3& angles) {
  const math::SinCos x = math::sincos(angles.x / 2), y = math::sincos(angles.y / 2),
                     z = math::sincos(angles.z / 2);
  return {x.sin * y.cos * z.cos + x.cos * y.sin * z.sin, x.cos * y.sin * z.cos - x.sin * y.cos * z.sin,
          x.cos * y.cos * z.sin + x.sin * y.sin * z.cos, x.cos * y.cos * z.cos - x.sin * y.sin * z.sin};
}

EzTurn turn_about(const glm::dvec3& axis, double angle) {
  const math::SinCos half = math::sincos(angle / 2);
  return {axis.x * half.sin, axis.y * half.sin, axis.z * half.sin, half.cos};
}

EzTurn turn_from_up(const glm::dvec3& to) {
  const double w = to.y + 1;
  if (w < opposite) return normalised({0, 0, 1, 0});
  return normalised({to.z, 0, -to.x, w});
}

EzTurn product(const EzTurn& a, const EzTurn& b) {
  return {a.x * b.w + a.w * b.x + a.y * b.z - a.z * b.y, a.y * b.w + a.w * b.y + a.z * b.x - a.x * b.z,
          a.z * b.w + a.w * b.z + a.x * b.y - a.y * b.x, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

EzTurn between(const EzTurn& a, const EzTurn& b, double t) {
  const double sign = dot(a, b) < 0 ? -1 : 1;
  const double cosine = sign * dot(a, b);
  if (cosine >= nearly_equal) return normalised(mixed(a, 1 - t, b, sign * t));
  const double angle = math::acos(cosine), sine = math::sin(angle);
  return mixed(a, math::sin((1 - t) * angle) / sine, b, sign * math::sin(t * angle) / sine);
}

EzTurn toward(const EzTurn& a, const EzTurn& b, double step) {
  const double angle = 2 * math::acos(std::abs(std::clamp(dot(a, b), -1.0, 1.0)));
  if (angle == 0) return a;
  return between(a, b, std::min(1.0, step / angle));
}

glm::dvec3 angles_of(const EzTurn& q) {
  const double m13 = 2 * (q.x * q.z + q.w * q.y);
  const double y = math::asin(std::clamp(m13, -1.0, 1.0));
  if (std::abs(m13) < nearly_upright) {
    const double m23 = 2 * (q.y * q.z - q.w * q.x), m33 = 1 - 2 * (q.x * q.x + q.y * q.y);
    const double m12 = 2 * (q.x * q.y - q.w * q.z), m11 = 1 - 2 * (q.y * q.y + q.z * q.z);
    return {math::atan2(-m23, m33), y, math::atan2(-m12, m11)};
  }
  const double m32 = 2 * (q.y * q.z + q.w * q.x), m22 = 1 - 2 * (q.x * q.x + q.z * q.z);
  return {math::atan2(m32, m22), y, 0};
}

Frame frame_of(const EzTurn& q) {
  const auto turned = [&](const glm::dvec3& v) {
    const glm::dvec3 axis{q.x, q.y, q.z};
    const glm::dvec3 twice = 2.0 * glm::cross(axis, v);
    return v + q.w * twice + glm::cross(axis, twice);
  };
  return {turned({0, 1, 0}), turned({-1, 0, 0}), turned({0, 0, 1})};
}

}  // namespace seedmesh::tree
