#include "core/geom/plant/limb_walk.h"

#include "core/base/math.h"

namespace seedmesh {
namespace {

// Beyond 120 degrees a mitred ring is more than twice as long as it is wide.
constexpr float sharpest = -0.5F;
// The share of an internode that mitred rings must leave on its shorter side.
constexpr float least_free = 0.02F;
// The least cosine between a face and the normal of a corner: leaves room for rounding, and for faces that
// taper and bend, which are not flat.
constexpr float least_cosine = 0.15F;

// The largest taper for which gentle turns are precomputed: the radius seldom changes by more than a tenth of
// the length.
constexpr float gentle_taper = 0.1F;

/// A lower bound of the cosine between any face at a ring and the normal of any of its corners. With half the
/// turn h and half the angle of a side d, the face's direction has a cosine of at least (cos d (1 + cos h) -
/// (1 - cos h)) / 2 to that of its corner. The slopes tilt both, in the worst case away from each other.
float least_face_cosine(float side_cosine, float turn_tangent, float taper) {
  const float cosine = 1 / std::sqrt(1 + turn_tangent * turn_tangent);
  const float sine = turn_tangent * cosine;
  const float flat = 1 / std::sqrt(1 + taper * taper);
  const float slope = taper * flat;
  const float face = 0.5F * (side_cosine * (1 + cosine) - (1 - cosine));
  return flat * (flat * face - slope * sine) - slope * flat * sine - slope * slope;
}

/// The largest tangent of half a turn that is sound with any gentle taper.
float gentle_reach_for(float side_cosine) {
  float reach = 0;
  while (reach < 1.7F && least_face_cosine(side_cosine, reach + 0.01F, gentle_taper) > least_cosine)
    reach += 0.01F;
  return reach;
}

/// The lean of a ring along an internode: its offset there toward `side` is dot(lean, side).
glm::vec3 lean_along(const glm::vec3& along, const Turn& turn, float radius) {
  return (turn.tangent - along * glm::dot(along, turn.tangent)) * (radius / turn.cosine);
}

}  // namespace

MitreCheck::MitreCheck(const Scale& scale, int sides)
    : scale_(&scale),
      side_cosine_(static_cast<float>(math::cos(math::pi / sides))),
      gentle_reach_(gentle_reach_for(side_cosine_)) {}

bool MitreCheck::allows(const Internode& a, const Internode& b, float radius_before, Turn& turn) {
  const float radius = b.base;
  if (radius < scale_->thinnest) return false;
  const glm::vec3 sum = a.along + b.along;
  const glm::vec3 difference = b.along - a.along;
  const float sum_squared = glm::dot(sum, sum);
  if (sum_squared < 2 + 2 * sharpest) return false;
  const float twice_cosine = std::sqrt(sum_squared);
  const float inverse = 1 / twice_cosine;
  const float turn_tangent = std::sqrt(glm::dot(difference, difference)) * inverse;
  turn.tangent = sum * inverse;
  turn.cosine = 0.5F * twice_cosine;
  turn.reach = radius * turn_tangent;

  const float most_of_a = a.length - std::max(least_free * a.length, scale_->apart);
  const float most_of_b = b.length - std::max(least_free * b.length, scale_->apart);
  Ring ring{turn, radius, gentle_taper, false};
  if (turn.reach > most_of_b || !has_length_for_rings(a, most_of_a, ring)) return false;

  const float free_a = std::max(a.length - turn.reach - last_.turn.reach, least_free * a.length);
  const float free_b = std::max(b.length - turn.reach, least_free * b.length);
  const float fall_a = std::abs(radius_before - radius), fall_b = std::abs(radius - b.end);
  const bool a_is_gentle = fall_a <= gentle_taper * free_a, b_is_gentle = fall_b <= gentle_taper * free_b;
  ring.is_gentle = a_is_gentle && turn_tangent <= gentle_reach_;
  if (!(ring.is_gentle && b_is_gentle && last_.is_gentle)) {
    const float taper_a = fall_a / free_a;
    ring.taper = taper_a;
    if (!keeps_faces_outside(last_, taper_a) || !keeps_faces_outside(ring, fall_b / free_b)) return false;
  }
  last_ = ring;
  return true;
}

/// True where the rings at both ends of `a` do not cross: together they use at most the length `most` of it.
bool MitreCheck::has_length_for_rings(const Internode& a, float most, const Ring& ring) const {
  if (ring.turn.reach + last_.turn.reach <= most) return true;
  glm::vec3 both = lean_along(a.along, ring.turn, ring.radius);
  if (last_.radius > 0) both -= lean_along(a.along, last_.turn, last_.radius);
  return glm::dot(both, both) <= most * most;
}

bool MitreCheck::keeps_faces_outside(const Ring& ring, float taper_after) const {
  if (ring.radius == 0) return true;
  const float turn_tangent = ring.turn.reach / ring.radius;
  // Straight: a ring's normal lies between those of its two cones, whatever their slopes.
  if (turn_tangent < 1e-3F) return true;
  return least_face_cosine(side_cosine_, turn_tangent, std::max(ring.taper, taper_after)) > least_cosine;
}

}  // namespace seedmesh
