#pragma once
/// The twist of cross-sections that are not circles: they follow the turtle's frame (Limbs::frame), in one
/// internode only as far as faces between its rings do not cross. tube_count.h and tube_writer.h use the same
/// numbers.
#include "core/base/math.h"
#include "core/geom/plant/limb_walk.h"

namespace seedmesh {

/// The largest twist of one internode, in radians. The twist is also at most the length divided by the radius.
constexpr float most_twist = static_cast<float>(math::pi) / 4;

/// The twist of a cross-section along one internode.
struct Twist {
  glm::vec3 side{0};  ///< direction to the corner at 0 degrees, at the internode's end
  float cosine = 1;
};

/// Returns the part of `axis`, in the frame of the joint, that is across the internode; 0 where there is none.
inline glm::vec3 across(const Limbs& limbs, const Internode& internode, const glm::vec3& axis) {
  glm::vec3 left = limbs.frame[internode.joint] * axis;
  left -= internode.along * glm::dot(left, internode.along);
  const float length = std::sqrt(glm::dot(left, left));
  return length > 1e-3F ? left * (1 / length) : glm::vec3{0};
}

/// Returns the direction of angle 0 in a tube's first ring: the turtle's left.
inline glm::vec3 first_side(const Limbs& limbs, const Internode& first) {
  const glm::vec3 left = across(limbs, first, {-1, 0, 0});
  return left == glm::vec3{0} ? across(limbs, first, {0, 0, 1}) : left;
}

/// Moves a direction from one internode to the next by the least rotation, in two halves. A step of Newton's
/// method toward unit length prevents drift in long limbs.
inline glm::vec3 carried(const glm::vec3& side, const glm::vec3& along, const Turn& turn,
                         const glm::vec3& next) {
  const glm::vec3& tangent = turn.tangent;
  const float half = 1 / (1 + turn.cosine);
  const glm::vec3 middle = side - (along + tangent) * (glm::dot(side, tangent) * half);
  glm::vec3 out = middle - (tangent + next) * (glm::dot(middle, next) * half);
  out -= next * glm::dot(out, next);
  out *= 1.5F - 0.5F * glm::dot(out, out);
  return out;
}

/// Turns `side`, the direction at the start of an internode, to the turtle's left. One internode turns it at most by
/// the greatest twist.
inline Twist twist_of(const Limbs& limbs, const Scale& scale, const Internode& internode,
                      const glm::vec3& side) {
  const glm::vec3 left = across(limbs, internode, {-1, 0, 0});
  if (left == glm::vec3{0}) return {side, 1};
  const float limit = std::min(most_twist, internode.length / std::max(internode.base, scale.thinnest));
  const math::SinCos most = math::sincos(limit);
  const float cosine = glm::dot(side, left);
  if (cosine >= static_cast<float>(most.cos)) return {left, cosine};
  const glm::vec3 v = glm::cross(internode.along, side);
  const float sense = glm::dot(v, left) < 0 ? -1.0F : 1.0F;
  return {side * static_cast<float>(most.cos) + v * (sense * static_cast<float>(most.sin)),
          static_cast<float>(most.cos)};
}

/// Whether the cross-section is a circle at both ends, so that no twist is visible.
inline bool is_round(const Limbs& limbs, std::uint32_t joint) {
  if (limbs.contour.empty()) return true;
  const std::uint32_t first = limbs.starts_limb[joint] ? joint : limbs.parent[joint];
  return limbs.contour[joint] == 0 && limbs.contour[first] == 0;
}

/// A twist of less than 2 degrees counts as none.
constexpr bool is_twisted(float cosine) { return cosine < 0.9994F; }

/// Returns the twist for each metre, radians, anticlockwise about the internode from the side where it begins.
inline float spin_of(const Internode& internode, const glm::vec3& side, const Twist& twist) {
  const glm::vec3 step = twist.side - side;
  const float chord2 = glm::dot(step, step);
  const float angle = std::sqrt(chord2) * (1 + chord2 / 24);  // 2 asin(chord / 2) to a thousandth
  const float sense = glm::dot(glm::cross(side, twist.side), internode.along) < 0 ? -1.0F : 1.0F;
  return sense * angle / internode.length;
}

/// Returns the number of inner rings that a twist needs: one for each 15 degrees, so that the faces of a hollow
/// outline keep their outside.
inline int rings_of_twist(float cosine) {
  constexpr float cosine_15 = 0.9659258F, cosine_30 = 0.8660254F;
  return cosine < cosine_30 ? 2 : cosine < cosine_15 ? 1 : 0;
}

}  // namespace seedmesh
