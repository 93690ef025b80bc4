/// What the tube writer does where limbs have cross-sections of their own (contour.h).
#include <cmath>

#include "core/base/math.h"
#include "core/geom/tube_writer.h"

namespace seedmesh {
namespace {

// How far a cross-section turns along an internode at most, also for each radius of its length: faces between
// rings turned further would cross.
constexpr float most_twist = static_cast<float>(math::pi) / 4;

}  // namespace

/// The cross-section of the ring where an internode begins.
std::uint8_t TubeWriter::first_contour(std::uint32_t joint) const {
  const Limbs& limbs = context_.limbs;
  if (limbs.contour.empty()) return 0;
  return limbs.contour[limbs.starts_limb[joint] ? joint : limbs.parent[joint]];
}

std::uint8_t TubeWriter::last_contour(std::uint32_t joint) const {
  return context_.limbs.contour.empty() ? std::uint8_t{0} : context_.limbs.contour[joint];
}

/// Turns u to the turtle's left, or as far that way as one internode may.
void TubeWriter::turn_to_left(bool at_once) {
  if (!has_contours() || context_.limbs.frame.empty()) return;
  const glm::vec3& along = internode_.along;
  glm::vec3 left = context_.limbs.frame[internode_.joint] * glm::vec3{-1, 0, 0};
  left -= along * glm::dot(left, along);
  const float length = std::sqrt(glm::dot(left, left));
  if (!(length > 1e-3F)) return;
  left *= 1 / length;
  const float twist = std::min(most_twist, internode_.length / std::max(radius_, context_.scale.thinnest));
  const math::SinCos most = math::sincos(twist);
  if (at_once || glm::dot(u_, left) >= static_cast<float>(most.cos)) {
    u_ = left;
    return;
  }
  const glm::vec3 v = glm::cross(along, u_);
  const float sense = glm::dot(v, left) < 0 ? -1.0F : 1.0F;
  u_ = u_ * static_cast<float>(most.cos) + v * (sense * static_cast<float>(most.sin));
}

/// The corner `k` of a ring, between two cross-sections.
ContourCorner TubeWriter::corner(const Ring& ring, std::uint32_t k) const {
  const ContourCorner& a = tables().contours[ring.contour][k];
  if (ring.blend == 0) return a;
  const ContourCorner& b = tables().contours[ring.next_contour][k];
  const auto mix = [&](const auto& x, const auto& y) { return x + (y - x) * ring.blend; };
  const glm::vec2 normal = mix(a.normal, b.normal);
  const float length = std::sqrt(glm::dot(normal, normal));
  return {mix(a.at, b.at), length > 1e-3F ? normal * (1 / length) : a.normal, mix(a.round, b.round)};
}

void TubeWriter::write_contour(const Ring& ring, Slope slope) {
  const std::size_t first = here_->vertex;
  const float whole = corner(ring, section_.sides).round;
  const float by_round = context_.options.wrap ? turns_ / whole : ring.radius;
  for (std::uint32_t k = 0; k < section_.corners; ++k) {
    const ContourCorner c = corner(ring, k);
    here_->position[first + k] = (ring.centre + 0.0F) + ring.side_u * c.at.x + ring.side_v * c.at.y;
    // A cone over this outline leans by how far its edge is from the middle.
    const float lean = slope.y * glm::dot(c.normal, c.at);
    const float by_length = 1 / std::sqrt(slope.x * slope.x + lean * lean);
    here_->normal[first + k] =
        ((ring.normal_u * c.normal.x + ring.normal_v * c.normal.y) * slope.x + ring.tangent * lean) *
            by_length +
        0.0F;
    if (here_->uv) here_->uv[first + k] = glm::vec2{c.round * by_round, ring.v} + 0.0F;
  }
}

}  // namespace seedmesh
