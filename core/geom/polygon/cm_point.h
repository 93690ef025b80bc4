#pragma once
/// Points of the plane on whole centimetres, with exact predicates. Coordinates are at most 2^27 in magnitude
/// (1,342 km), so that all products of differences fit into 64 bits.
#include <cmath>
#include <compare>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace seedmesh {

/// x is east and y is north. One unit is a centimetre.
struct CmPoint {
  std::int32_t x = 0, y = 0;
  friend auto operator<=>(const CmPoint&, const CmPoint&) = default;
};

constexpr std::int32_t greatest_cm = 1 << 27;

/// Rings do not repeat their first point.
using CmRing = std::vector<CmPoint>;

/// Returns twice the signed area of the triangle o, a, b in square centimetres; positive for counter-clockwise order.
/// Exact.
constexpr std::int64_t cross(const CmPoint& o, const CmPoint& a, const CmPoint& b) {
  return (std::int64_t{a.x} - o.x) * (std::int64_t{b.y} - o.y) -
         (std::int64_t{a.y} - o.y) * (std::int64_t{b.x} - o.x);
}

/// Returns the coordinates of a point as doubles, in centimetres or in metres.
inline glm::dvec2 in_cm(const CmPoint& p) { return {p.x, p.y}; }
inline glm::dvec2 in_metres(const CmPoint& p) { return {p.x / 100.0, p.y / 100.0}; }

/// Returns the nearest whole centimetres of a position in centimetres; halves go up. Coordinates have to be in range.
CmPoint rounded_cm(const glm::dvec2& cm);

/// Returns the distance of two points in centimetres.
inline double distance(const CmPoint& a, const CmPoint& b) {
  const glm::dvec2 d = in_cm(b) - in_cm(a);
  return std::sqrt(d.x * d.x + d.y * d.y);
}

/// Returns the distance from `p` to the segment a b, in centimetres.
double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b);

/// Whether the open segments a b and c d cross at one inner point of both. Exact.
bool cross_properly(const CmPoint& a, const CmPoint& b, const CmPoint& c, const CmPoint& d);

/// Whether the closed segments a b and c d have a common point. Exact.
bool segments_meet(const CmPoint& a, const CmPoint& b, const CmPoint& c, const CmPoint& d);

/// Returns twice the signed area of a ring, in square centimetres. Exact while it is below 2^62.
std::int64_t doubled_area(std::span<const CmPoint> ring);

/// Whether no two edges of a ring meet except neighbours at their common end, and neighbours do not overlap.
/// Exact. Cost: quadratic in the worst case; edges far apart along x are not compared.
bool is_simple(std::span<const CmPoint> ring);

/// Returns whether `p` is inside a ring by the even-odd rule. For points on the ring the result is unspecified.
bool is_inside(std::span<const CmPoint> ring, const glm::dvec2& p);

/// Compares the directions from `origin` to `a` and to `b` by their counter-clockwise angle from east. Returns -1, 0 or
/// 1. Exact; computes no angle.
int compare_angles(const CmPoint& origin, const CmPoint& a, const CmPoint& b);

}  // namespace seedmesh
