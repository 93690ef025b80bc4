#pragma once
/// The turtle's orientation and its rotations, exact in the sense that a right angle (SinCos{1, 0}, as
/// math::sincos_degrees gives it) changes no bit but signs and places. Signs are those of cpfg, measured; the
/// matrices printed in "The Algorithmic Beauty of Plants" do not give all of them.
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/base/math.h"

namespace seedmesh {

/// Three unit vectors at right angles with up = heading x left. As it starts the turtle looks up the trunk.
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

/// The same orientation with the rounding errors of many rotations taken out: heading keeps its direction,
/// left the plane it spans with heading.
inline Frame reorthonormalise(const Frame& f) {
  const glm::dvec3 heading = math::unit(f.heading, {0, 1, 0});
  const glm::dvec3 flat = f.left - heading * glm::dot(heading, f.left);
  const glm::dvec3 left = math::unit(flat, glm::cross(f.up, heading));
  return {heading, left, glm::cross(heading, left)};
}

/// `$` : rolls about heading until left is horizontal and up looks upward. A vertical heading has no such
/// roll: unchanged.
inline Frame upright(const Frame& f) {
  const glm::dvec3 level = glm::cross(glm::dvec3{0, 1, 0}, f.heading);
  // Below this the direction of `level` is rounding noise, and the turtle would spin at random.
  if (glm::dot(level, level) < 1e-20) return f;
  const glm::dvec3 left = math::unit(level, f.left);
  return {f.heading, left, glm::cross(f.heading, left)};
}

/// The rotation that takes +Y to heading, -X to left and +Z to up (Limbs::frame), w >= 0. Square roots only;
/// after Shepperd, "Quaternion from Rotation Matrix", 1978: the largest of the four components is found
/// first, so none is a small difference.
inline glm::quat quaternion(const Frame& f) {
  const glm::dvec3 x = -f.left;
  const glm::dvec3& y = f.heading;
  const glm::dvec3& z = f.up;
  const double squares[4] = {1 + x.x + y.y + z.z, 1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z,
                             1 - x.x - y.y + z.z};
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    if (squares[i] > squares[largest]) largest = i;
  }
  const double four = 2 * std::sqrt(squares[largest]);  // four times the largest component
  const glm::dvec3 skew{y.z - z.y, z.x - x.z, x.y - y.x};
  const double xy = y.x + x.y, xz = z.x + x.z, yz = z.y + y.z;
  glm::dvec4 q{0, 0, 0, 0};  // x y z w
  switch (largest) {
    case 0:
      q = {skew.x, skew.y, skew.z, squares[0]};
      break;
    case 1:
      q = {squares[1], xy, xz, skew.x};
      break;
    case 2:
      q = {xy, squares[2], yz, skew.y};
      break;
    default:
      q = {xz, yz, squares[3], skew.z};
      break;
  }
  q = q / (q.w < 0 ? -four : four) + 0.0;  // + 0.0 makes -0 a 0
  return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
}

}  // namespace seedmesh
