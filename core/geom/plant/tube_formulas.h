#pragma once
/// Formulas that all bark has in common: the tubes of skin(), the welded limbs of graft(), and the levels of
/// detail.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/base/math.h"

namespace seedmesh {

/// The cone that closes a tube inside its parent or at a bend, as a share of the radius.
constexpr float cap_share = 0.5F;

/// Returns the length of the cone at a free tip, where `free` is the length of the last straight piece: the limb
/// stays as long as it was drawn.
inline float tip_length(float radius, float free) { return std::min(radius, 0.3F * free); }

/// Returns a number in [0, 1) from a hash.
inline float fraction_of(std::uint64_t hash) { return static_cast<float>(hash >> 40U) * 0x1p-24F; }

/// A texture whose strips repeat has this number of repetitions for each metre around a limb, others have one. Ridges of
/// oaks are then 51 mm apart, and plates of pines 74 mm, as on real trunks.
constexpr float strips_a_metre = 1.5F;

/// Returns the number of repetitions of a wrapped texture around a limb. For a texture with strips, whose `least` is
/// below 1, the result may be a power of two below 1, the nearest by ratio. Thin limbs then show a strip of the
/// texture at its own scale.
inline float texture_repeats(float radius, float least) {
  constexpr float root_of_half = 0.70710678F;
  const float around = static_cast<float>(2 * math::pi) * radius * (least < 1 ? strips_a_metre : 1);
  float repeats = std::max(1.0F, std::floor(around + 0.5F));
  while (repeats > least && around < root_of_half * repeats && repeats <= 1) repeats *= 0.5F;
  return std::max(repeats, least);
}

/// Returns the radius that determines how fast v grows along a limb. A texture that repeats as a whole keeps its
/// proportions. One with strips, of which `least` is below 1, becomes narrower than long: it is half way between
/// keeping its proportions and keeping its scale.
inline float texture_radius(float radius, float first, float least) {
  return least < 1 ? std::sqrt(radius * first) : radius;
}

/// Returns a unit vector at right angles to the unit vector `along` (Duff et al., "Building an Orthonormal Basis,
/// Revisited", 2017).
inline glm::vec3 unit_perpendicular(const glm::vec3& along) {
  const float sign = along.z < 0 ? -1.0F : 1.0F;
  const float a = -1 / (sign + along.z);
  return {1 + sign * along.x * along.x * a, sign * along.x * along.y * a, -sign * along.x};
}

/// The number of corners of welded limbs is proportional to this power of the radius: a limb with a tenth of
/// the largest radius has half as many corners.
constexpr double corner_power = 0.3;
/// The least number of corners of a welded limb that has side limbs.
constexpr int least_opened_corners = 6;

/// Rounds `wanted` to 3 or to an even number, so that the rings of different limbs meet corner to corner. The
/// largest number, `most`, stays as it is.
inline int paired_corners(int wanted, int most) {
  return wanted <= 3 ? 3 : wanted != most ? wanted + wanted % 2 : wanted;
}

/// Returns the corners of a welded limb by its radius, from 3 up to `most` for the radius `thickest`.
inline int corners_by_radius(float radius, float thickest, int most, double exponent = corner_power) {
  const double share = thickest > 0 ? static_cast<double>(std::min(1.0F, radius / thickest)) : 1;
  return paired_corners(math::to_int32(most * math::pow(std::max(share, 1e-6), exponent) + 0.5), most);
}

}  // namespace seedmesh
