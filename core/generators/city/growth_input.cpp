// What the ground, obstacles and given streets allow.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/city/footprints.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/landform.h"
#include "generated/params/city.h"

namespace seedmesh::city {

using glm::dvec2;

ConstraintLimits limits_of(const CityStreets& streets) {
  ConstraintLimits limits;
  limits.snap = streets.snap * 100;
  limits.clearance = streets.clearance * 100;
  limits.cos_minimal_angle = math::cos(math::radians(streets.minimal_angle + 0.2));
  limits.cos_border_angle = math::cos(math::radians(45));
  const auto space_of = [](const auto& section) { return (section.width + 2 * section.sidewalk) * 100; };
  const CityClasses& classes = streets.classes;
  double widest = std::max(space_of(classes.major), space_of(classes.minor));
  if (streets.highway_spacing > 0 && streets.method != CityMethod::wards)
    widest = std::max(widest, space_of(classes.highway));
  limits.least_length = std::max(900.0, widest * 0.75);
  limits.beside = std::max(700.0, widest * 0.6);
  return limits;
}

double GrowthInput::limit_of(std::uint32_t kind) const {
  const CityClasses& classes = streets.classes;
  switch (static_cast<EdgeClass>(kind)) {
    case EdgeClass::highway:
      return classes.highway.grade;
    case EdgeClass::minor:
      return classes.minor.grade;
    case EdgeClass::lane:
      return classes.lane.grade;
    default:
      return classes.major.grade;
  }
}

bool GrowthInput::is_blocked(const dvec2& metres) const {
  if (obstacles && obstacles->at(metres) >= 0.5) return true;
  if (!footprints) return false;
  constexpr double margin = 1;
  double widest = 0;
  for (std::size_t kind = static_cast<std::size_t>(EdgeClass::highway); kind < first_given; ++kind)
    widest = std::max(widest, sections[kind].width / 2 + sections[kind].sidewalk[0]);
  return footprints->is_near(metres, std::min(widest + margin, FootprintIndex::most_reach));
}

bool GrowthInput::is_on_footprint(const StreetPiece& piece) const {
  if (!footprints) return false;
  const CrossSection& section = sections[piece.kind];
  const double reach = std::min(section.width / 2 + section.sidewalk[0], FootprintIndex::most_reach);
  const dvec2 a = in_metres(piece.a), along = in_metres(piece.b) - a;
  const std::int32_t count = math::to_int32(std::sqrt(along.x * along.x + along.y * along.y)) + 1;
  for (std::int32_t n = 0; n <= count; ++n) {
    if (footprints->is_near(a + along * (static_cast<double>(n) / count), reach)) return true;
  }
  return false;
}

bool GrowthInput::is_too_steep(const dvec2& a, const dvec2& b, double grade_limit) const {
  return landform && city::is_too_steep(*landform, a, b, grade_limit);
}

bool GrowthInput::is_blocked(const dvec2& a, const dvec2& b, double grade_limit) const {
  return is_too_steep(a, b, grade_limit) || is_obstructed(a, b);
}

bool GrowthInput::is_obstructed(const dvec2& a, const dvec2& b) const {
  if (!obstacles && !footprints) return false;
  const dvec2 along = b - a;
  const std::int32_t count = math::to_int32(std::sqrt(along.x * along.x + along.y * along.y) / 400) + 1;
  for (std::int32_t n = 0; n <= count; ++n) {
    if (is_blocked((a + along * (static_cast<double>(n) / count)) / 100.0)) return true;
  }
  return false;
}

bool GrowthInput::is_free(const Route& route) const {
  return std::all_of(route.pieces.begin(), route.pieces.end(), [&](const StreetPiece& piece) {
    return !is_blocked(in_cm(piece.a), in_cm(piece.b), limit_of(piece.kind)) && keeps_off_given(piece);
  });
}

bool GrowthInput::keeps_off_given(const StreetPiece& piece) const {
  constexpr double near = 1400, least_cross_sine = 0.77;
  if (!given) return true;
  const dvec2 p = in_cm(piece.a), q = in_cm(piece.b), along = q - p;
  for (const StreetPiece& other : given->pieces) {
    const dvec2 a = in_cm(other.a), b = in_cm(other.b), across = b - a;
    const double apart = std::min({distance_to_segment(p, a, b), distance_to_segment(q, a, b),
                                   distance_to_segment(a, p, q), distance_to_segment(b, p, q)});
    if (!segments_meet(piece.a, piece.b, other.a, other.b)) {
      if (apart < near) return false;
      continue;
    }
    const double sine = std::abs(along.x * across.y - along.y * across.x) /
                        (distance(piece.a, piece.b) * distance(other.a, other.b));
    if (sine < least_cross_sine || apart < near) return false;
  }
  return true;
}

}  // namespace seedmesh::city
