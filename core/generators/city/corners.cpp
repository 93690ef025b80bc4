#include "core/generators/city/corners.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double straight = 0.05;        // sine of a turn that counts as none
constexpr double sharpest_mitre = -1.6;  // radians; outer corners that turn further are cut off
constexpr int arc_pieces = 4;
constexpr double step_slant = 30;        // cm
constexpr double least_overlap = 2;      // of ends of streets, by rounding, cm
constexpr double least_fillet = 50;      // cm
constexpr double greatest_fillet = 500;  // cm

dvec2 left_of(const dvec2& d) { return {-d.y, d.x}; }

std::vector<CmPoint> arc(const CornerInput& corner, const dvec2& tip, double turn) {
  const double along = corner.fillet * math::tan(turn / 2);
  const dvec2 normal = left_of(corner.before);
  const dvec2 centre = tip - corner.before * along + normal * corner.fillet;
  std::vector<CmPoint> points;
  for (int k = 0; k <= arc_pieces; ++k) {
    const math::SinCos part = math::sincos(turn * k / arc_pieces);
    const dvec2 p = centre - (normal * part.cos - corner.before * part.sin) * corner.fillet;
    points.push_back(rounded_cm(p));
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] == points[i - 1]) return {rounded_cm(tip)};
  }
  return points;
}

/// The corner between two widths along a nearly straight line, with the sine of its turn. The wider street ends behind
/// the end of the narrower one, which is perpendicular to a slightly other direction. So they do not overlap.
std::vector<CmPoint> step_at_node(const CornerInput& corner, double sine) {
  const bool narrows = corner.distance_before > corner.distance_after;
  const double narrow = std::min(corner.distance_before, corner.distance_after);
  // Shores and the border of the area have no width.
  const double back = corner.walk > 0 || narrow <= 0 ? 0 : std::abs(sine) * narrow + least_overlap;
  const dvec2 a = corner.at + left_of(corner.before) * corner.distance_before +
                  corner.before * (narrows ? corner.walk - back : -corner.walk);
  const dvec2 b = corner.at + left_of(corner.after) * corner.distance_after +
                  corner.after * (narrows ? corner.walk : back - corner.walk);
  return {rounded_cm(a), rounded_cm(b)};
}

}  // namespace

double fillet_of(const CornerInput& corner, double walk) {
  const double c = corner.before.x * corner.after.x + corner.before.y * corner.after.y;
  const double sine = std::sqrt(std::max(0.0, (1 + c) / 2));  // of half the inner angle
  return std::min(greatest_fillet, sine < 0.999 ? 0.7 * walk / (1 - sine) : greatest_fillet);
}

std::vector<CmPoint> corner_points(const CornerInput& corner) {
  const dvec2 &d1 = corner.before, &d2 = corner.after;
  const double s = d1.x * d2.y - d1.y * d2.x, c = d1.x * d2.x + d1.y * d2.y;
  const double h1 = corner.distance_before, h2 = corner.distance_after;
  const auto pair = [&](double first, double second) {
    const CmPoint a = rounded_cm(corner.at + left_of(d1) * h1 + d1 * first);
    const CmPoint b = rounded_cm(corner.at + left_of(d2) * h2 - d2 * second);
    return a == b ? std::vector<CmPoint>{a} : std::vector<CmPoint>{a, b};
  };
  if (corner.is_dead_end) return pair(corner.cap, corner.cap);
  // The wider outline ends first, so that no step lies on the line across the end of the wider street.
  const double reach = corner.step + corner.walk;
  if (corner.step > 0 && h1 * c > h2) return pair(reach - s * h2, -(reach + step_slant) / c);
  if (corner.step > 0 && h2 * c > h1) return pair(-(reach + step_slant) / c, reach - s * h1);
  if (c > 0 && std::abs(s) < straight) {
    if (std::abs(h1 - h2) > 1) return step_at_node(corner, s);
    const dvec2 normal = left_of(d1) + left_of(d2);
    return {
        rounded_cm(corner.at + normal * ((h1 + h2) / 2 / (normal.x * normal.x + normal.y * normal.y) * 2))};
  }
  const double turn = math::atan2(s, c);
  if (turn < sharpest_mitre) {
    const double past = math::tan(-turn / 4);
    return pair(h1 * past, h2 * past);
  }
  const dvec2 tip = corner.at + left_of(d1) * h1 + d1 * ((h1 * c - h2) / s);
  if (turn > 0 && corner.fillet >= least_fillet) return arc(corner, tip, turn);
  if (turn > 0 && corner.chamfer > 0) {
    const double along = corner.chamfer / 2 / math::cos(turn / 2);
    const CmPoint a = rounded_cm(tip - d1 * along), b = rounded_cm(tip + d2 * along);
    if (a != b) return {a, b};
  }
  return {rounded_cm(tip)};
}

}  // namespace seedmesh::city
