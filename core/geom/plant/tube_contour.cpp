/// The parts of the tube writer for limbs with contours (contour.h).
#include <cmath>

#include "core/geom/plant/tube_writer.h"

namespace seedmesh {
/// The contour of the ring where an internode begins.
std::uint8_t TubeWriter::first_contour(std::uint32_t joint) const {
  const Limbs& limbs = context_.limbs;
  if (limbs.contour.empty()) return 0;
  return limbs.contour[limbs.starts_limb[joint] ? joint : limbs.parent[joint]];
}

std::uint8_t TubeWriter::last_contour(std::uint32_t joint) const {
  return context_.limbs.contour.empty() ? std::uint8_t{0} : context_.limbs.contour[joint];
}

/// Turns the cross-section along the current internode, from the side where it begins.
void TubeWriter::twist(const glm::vec3& side) {
  first_u_ = side;
  twist_ = 1;
  spin_ = 0;
  const Limbs& limbs = context_.limbs;
  if (!has_contours() || limbs.frame.empty()) return;
  const Twist twist = twist_of(limbs, context_.scale, internode_, side);
  u_ = twist.side;
  if (is_round(limbs, internode_.joint)) return;
  twist_ = twist.cosine;
  if (is_twisted(twist_)) spin_ = spin_of(internode_, side, twist);
}

/// Corner `k` of a ring, between two contours.
ContourCorner TubeWriter::corner(const Ring& ring, std::uint32_t k) const {
  const ContourCorner& a = tables().contours[ring.contour][k];
  if (ring.blend == 0) return a;
  const ContourCorner& b = tables().contours[ring.next_contour][k];
  const auto mix = [&](const auto& x, const auto& y) { return x + (y - x) * ring.blend; };
  const glm::vec2 normal = mix(a.normal, b.normal);
  const float length = std::sqrt(glm::dot(normal, normal));
  return {mix(a.at, b.at), length > 1e-3F ? normal * (1 / length) : a.normal, mix(a.round, b.round)};
}

/// Splits quads along the other diagonal where wants_other(low, low_next, high, high_next) is true. Their
/// triangles are (low, low_next, high) and (low_next, high_next, high) before.
template <class WantsOther>
void TubeWriter::split_otherwise(std::size_t first_corner, const WantsOther& wants_other) {
  for (std::uint32_t* quad = here_->index + first_corner; quad + 6 <= here_->index + here_->corner;) {
    const std::uint32_t low = quad[0], low_next = quad[1], high = quad[2], high_next = quad[4];
    if (quad[3] != low_next || quad[5] != high || high == piece_.end_apex) {  // of a cone
      quad += 3;
      continue;
    }
    if (wants_other(low, low_next, high, high_next)) {
      quad[2] = high_next;
      quad[3] = low;
    }
    quad += 6;
  }
}

/// Splits the quads of a twisted piece by the shorter diagonal: with the other one, the flanks of a ridge or
/// a furrow would face inward.
void TubeWriter::split_by_shorter(std::size_t first_corner) {
  const auto length2 = [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3 step = here_->position[b] - here_->position[a];
    return glm::dot(step, step);
  };
  constexpr float clearly = 0.999F;
  split_otherwise(first_corner, [&](std::uint32_t low, std::uint32_t low_next, std::uint32_t high,
                                    std::uint32_t high_next) {
    return length2(low, high_next) < clearly * length2(low_next, high);
  });
}

/// Splits the quads from a turned ring to a ring that is not turned along the other diagonal: their upper
/// corners are half a side back.
void TubeWriter::split_by_turns(std::size_t first_corner) {
  split_otherwise(first_corner, [&](std::uint32_t low, std::uint32_t, std::uint32_t, std::uint32_t) {
    const std::size_t ring = (low - piece_.first_ring) / section_.corners;
    return is_ring_turned_[ring] && !is_ring_turned_[ring + 1];
  });
}

void TubeWriter::write_contour(const Ring& ring, Slope slope) {
  const std::size_t first = here_->vertex;
  const float whole = corner(ring, section_.sides).round;
  const float spin = 0.5F * (ring.spin + spin_);
  const float by_round = context_.options.wrap ? turns_ / whole : ring.radius;
  for (std::uint32_t k = 0; k < section_.corners; ++k) {
    const ContourCorner c = corner(ring, k);
    here_->position[first + k] = (ring.centre + 0.0F) + ring.side_u * c.at.x + ring.side_v * c.at.y;
    // A cone over this outline leans by the distance of its edge from the middle. A twisted flank leans by
    // the speed with which its edge moves past its normal.
    const float sweep = spin * ring.radius * (c.at.x * c.normal.y - c.at.y * c.normal.x);
    const float lean = slope.y * glm::dot(c.normal, c.at) - sweep * slope.x;
    const float by_length = 1 / std::sqrt(slope.x * slope.x + lean * lean);
    here_->normal[first + k] =
        ((ring.normal_u * c.normal.x + ring.normal_v * c.normal.y) * slope.x + ring.tangent * lean) *
            by_length +
        0.0F;
    if (here_->uv) here_->uv[first + k] = glm::vec2{c.round * by_round, ring.v} + 0.0F;
  }
}

}  // namespace seedmesh
