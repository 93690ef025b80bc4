#pragma once
/// The turtle's orientation and its rotations. They are exact for right angles (SinCos{1, 0}, as from
/// math::sincos_degrees): components only change signs and positions. Signs are those measured in cpfg; the
/// matrices printed in "The Algorithmic Beauty of Plants" do not give all of them.
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/base/math.h"

namespace seedmesh {

/// Three unit vectors at right angles with up = heading x left. At the start, the turtle heads up.
struct Frame {
  glm::dvec3 heading{0, 1, 0};
  glm::dvec3 left{-1, 0, 0};
  glm::dvec3 up{0, 0, 1};
};

/// `+` : to the left about up. A negative angle (negative sine) is `-`, to the right.
inline Frame turn(const Frame& f, const math::SinCos& angle) {
  return {f.heading * angle.cos + f.left * angle.sin, f.left * angle.cos - f.heading * angle.sin, f.up};
}

/// `&` : down about left. A negative angle is `^`, up.
inline Frame pitch(const Frame& f, const math::SinCos& angle) {
  return {f.heading * angle.cos - f.up * angle.sin, f.left, f.up * angle.cos + f.heading * angle.sin};
}

/// `\` : roll to the left about heading. A negative angle is `/`, to the right.
inline Frame roll(const Frame& f, const math::SinCos& angle) {
  return {f.heading, f.left * angle.cos + f.up * angle.sin, f.up * angle.cos - f.left * angle.sin};
}

/// `|` : half a turn about up.
inline Frame turn_around(const Frame& f) { return {-f.heading, -f.left, f.up}; }

/// The same orientation without the rounding errors of many rotations. Heading keeps its direction, and left
/// keeps the plane that it spans with heading.
inline Frame reorthonormalise(const Frame& f) {
  const glm::dvec3 heading = math::unit(f.heading, {0, 1, 0});
  const glm::dvec3 flat = f.left - heading * glm::dot(heading, f.left);
  const glm::dvec3 left = math::unit(flat, glm::cross(f.up, heading));
  return {heading, left, glm::cross(heading, left)};
}

/// `$` : rolls about heading until left is horizontal and up points upward. With a vertical heading, it
/// changes nothing.
inline Frame upright(const Frame& f) {
  const glm::dvec3 level = glm::cross(glm::dvec3{0, 1, 0}, f.heading);
  // Below this the direction of `level` is rounding noise, and the turtle would spin at random.
  if (glm::dot(level, level) < 1e-20) return f;
  const glm::dvec3 left = math::unit(level, f.left);
  return {f.heading, left, glm::cross(f.heading, left)};
}

/// Returns the rotation that takes +Y to heading, -X to left and +Z to up, w >= 0. Square roots only; after Shepperd,
/// "Quaternion from Rotation Matrix", 1978: the largest of the four components is found first, so none is a
/// small difference.
inline glm::dquat fine_quaternion(const Frame& f) {
  const glm::dvec3 x = -f.left;
  const glm::dvec3& y = f.heading;
  const glm::dvec3& z = f.up;
  const double squares[4] = {1 + x.x + y.y + z.z, 1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z,
                             1 - x.x - y.y + z.z};
  // Selects instead of branching, so that loops over this function can be vectorised.
  const bool is_x = squares[1] > squares[0];
  const double most_of_two = is_x ? squares[1] : squares[0];
  const bool is_y = squares[2] > most_of_two;
  const double most_of_three = is_y ? squares[2] : most_of_two;
  const bool is_z = squares[3] > most_of_three;
  const double four = 2 * std::sqrt(is_z ? squares[3] : most_of_three);  // four times the largest component
  const auto chosen = [&](double of_w, double of_x, double of_y, double of_z) {
    return is_z ? of_z : is_y ? of_y : is_x ? of_x : of_w;
  };
  const glm::dvec3 skew{y.z - z.y, z.x - x.z, x.y - y.x};
  const double xy = y.x + x.y, xz = z.x + x.z, yz = z.y + y.z;
  const double w = chosen(squares[0], skew.x, skew.y, skew.z);
  const double by = w < 0 ? -four : four;
  // + 0.0 makes -0 a 0
  return {w / by + 0.0, chosen(skew.x, squares[1], xy, xz) / by + 0.0,
          chosen(skew.y, xy, squares[2], yz) / by + 0.0, chosen(skew.z, xz, yz, squares[3]) / by + 0.0};
}

/// The same in the precision of Limbs::frame.
inline glm::quat quaternion(const Frame& f) {
  const glm::dquat q = fine_quaternion(f);
  return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
}

/// Returns the orientation at a share of the shorter rotation from one orientation to another. It follows the chord of
/// the quaternions, without trigonometry, so the rate is not quite constant.
inline Frame between(const Frame& from, const Frame& to, double share) {
  const glm::dquat a = fine_quaternion(from), b = fine_quaternion(to);
  const double near = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0 ? -share : share;
  glm::dvec4 q = glm::dvec4{a.x, a.y, a.z, a.w} * (1 - share) + glm::dvec4{b.x, b.y, b.z, b.w} * near;
  q /= std::sqrt(glm::dot(q, q));
  const auto turned = [&q](const glm::dvec3& v) {
    const glm::dvec3 axis{q};
    const glm::dvec3 twice = 2.0 * glm::cross(axis, v);
    return v + q.w * twice + glm::cross(axis, twice);
  };
  const Frame start;
  return reorthonormalise({turned(start.heading), turned(start.left), turned(start.up)});
}

}  // namespace seedmesh
