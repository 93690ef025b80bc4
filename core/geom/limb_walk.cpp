#include "core/geom/limb_walk.h"

#include "core/base/math.h"

namespace seedmesh {
namespace {

// Beyond 120 degrees a mitred ring is more than twice as long as it is wide.
constexpr float sharpest = -0.5F;
// What mitred rings must leave of an internode on its shorter side.
constexpr float least_free = 0.02F;
// Below these no corner of a tube of three sides can look inward; spares the full test for nearly all
// internodes.
constexpr float gentle_reach = 0.2F, gentle_taper = 0.1F;

}  // namespace

TurnJudge::TurnJudge(const Scale& scale, int sides)
    : scale_(scale), side_cosine_(static_cast<float>(math::cos(math::pi / sides))) {}

bool TurnJudge::allows(const Internode& a, const Internode& b, float radius_before, Turn& turn) {
  const float radius = b.base;
  if (radius < scale_.thinnest) return false;
  const float cosine = glm::dot(a.along, b.along);
  if (cosine < sharpest) return false;
  const glm::vec3 sum = a.along + b.along;
  const glm::vec3 difference = b.along - a.along;
  const float twice_cosine = std::sqrt(glm::dot(sum, sum));
  turn.tangent = sum / twice_cosine;
  turn.cosine = 0.5F * twice_cosine;
  turn.reach = radius * (std::sqrt(glm::dot(difference, difference)) / twice_cosine);

  const float most_of_a = a.length - std::max(least_free * a.length, scale_.apart);
  const float most_of_b = b.length - std::max(least_free * b.length, scale_.apart);
  if (turn.reach > most_of_b) return false;
  const glm::vec3 across = turn.tangent - a.along * glm::dot(a.along, turn.tangent);
  const glm::vec3 lean = across * (radius / turn.cosine);
  if (turn.reach + reach_ > most_of_a) {
    const glm::vec3 both = lean - lean_;
    if (glm::dot(both, both) > most_of_a * most_of_a) return false;
  }
  if (!keeps_faces_outside(a, b, radius_before, turn)) return false;

  const glm::vec3 across_b = turn.tangent - b.along * glm::dot(b.along, turn.tangent);
  lean_ = across_b * (radius / turn.cosine);
  reach_ = turn.reach;
  return true;
}

/// A bound from below on the cosine between the normal of any face at the ring and the normal of any of its
/// corners, times positive lengths: with half the turn h and the slopes of the tapering sides, see
/// docs/skin.md.
bool TurnJudge::keeps_faces_outside(const Internode& a, const Internode& b, float radius_before,
                                    const Turn& turn) const {
  const float radius = b.base;
  const float free_a = std::max(a.length - turn.reach - reach_, least_free * a.length);
  const float free_b = std::max(b.length - turn.reach, least_free * b.length);
  const float taper_a = std::abs(radius_before - radius);
  const float taper_b = std::max(std::abs(radius - b.end), std::abs(b.base - b.end));
  if (turn.reach < gentle_reach * radius && taper_a < gentle_taper * free_a &&
      taper_b < gentle_taper * free_b)
    return true;

  const float sine = turn.reach / radius * turn.cosine;
  if (sine < 1e-3F)
    return true;  // straight: a ring's normal lies between those of its two cones, whatever their slopes
  const float face = 0.5F * (side_cosine_ * (1 + turn.cosine) - (1 - turn.cosine));
  const float slope_a = taper_a / std::sqrt(taper_a * taper_a + free_a * free_a);
  const float slope_b = taper_b / std::sqrt(taper_b * taper_b + free_b * free_b);
  const float slope = std::max(slope_a, slope_b);
  const float flat = std::sqrt(1 - slope * slope);
  return flat * (flat * face - slope * sine) - slope * flat * sine - slope * slope > 0.02F;
}

}  // namespace seedmesh
