#include "core/geom/limb_walk.h"

#include "core/base/math.h"

namespace seedmesh {
namespace {

// Beyond 120 degrees a mitred ring is more than twice as long as it is wide.
constexpr float sharpest = -0.5F;
// What mitred rings must leave of an internode on its shorter side.
constexpr float least_free = 0.02F;
// A face whose normal is within this of a right angle to a corner's is given up: room for rounding and for
// faces that taper and bend at once, which are not quite flat.
constexpr float least_cosine = 0.05F;

/// Sine of the angle between the flank of a cone and its axis.
float slope_of(float taper, float length) {
  return taper == 0 ? 0 : taper / std::sqrt(taper * taper + length * length);
}

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

  const float sine = turn.reach / radius * turn.cosine;
  const float free_a = std::max(a.length - turn.reach - reach_, least_free * a.length);
  const float free_b = std::max(b.length - turn.reach, least_free * b.length);
  const float slope_a = slope_of(std::abs(radius_before - radius), free_a);
  if (!keeps_faces_outside(sine_, slope_before_, slope_a)) return false;
  if (!keeps_faces_outside(sine, slope_a, slope_of(std::abs(radius - b.end), free_b))) return false;

  lean_ = (turn.tangent - b.along * glm::dot(b.along, turn.tangent)) * (radius / turn.cosine);
  reach_ = turn.reach;
  sine_ = sine;
  slope_before_ = slope_a;
  return true;
}

/// Bounds from below the cosine between the normal of any face at a ring and the normal of any corner of the
/// ring. With h half the turn and d half the angle of a side, a face's own direction is at least (cos d (1 +
/// cos h) - (1 - cos h)) / 2 along that of its corner; the slopes tilt both, in the worst case away from each
/// other.
bool TurnJudge::keeps_faces_outside(float sine, float slope_before, float slope_after) const {
  // Straight: a ring's normal lies between those of its two cones, whatever their slopes.
  if (sine < 1e-3F) return true;
  const float cosine = std::sqrt(1 - std::min(sine * sine, 1.0F));
  const float face = 0.5F * (side_cosine_ * (1 + cosine) - (1 - cosine));
  const float slope = std::max(slope_before, slope_after);
  const float flat = std::sqrt(1 - slope * slope);
  return flat * (flat * face - slope * sine) - slope * flat * sine - slope * slope > least_cosine;
}

}  // namespace seedmesh
