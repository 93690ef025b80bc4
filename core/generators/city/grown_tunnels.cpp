// Tunnels of streets that grow.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/landform.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double piece_length = 3000;       // in which the ground is sampled, cm
constexpr double shortest_tunnel = 3000;    // cm
constexpr double shortest_approach = 1500;  // of the street before and behind a tunnel, cm
constexpr double least_depth = 6.5;   // of the floor in the middle third: the tube and earth above it, m
constexpr double least_cover = -0.5;  // of the floor elsewhere, m
constexpr double least_cosine = 0.9;  // between a tunnel and the street at its mouths

double length_of(const StreetPiece& piece) { return distance(piece.a, piece.b); }

dvec2 direction_of(const CmPoint& a, const CmPoint& b) { return (in_cm(b) - in_cm(a)) / distance(a, b); }

/// The same street in pieces that are short enough to be sampled.
std::vector<StreetPiece> short_pieces(const std::vector<StreetPiece>& pieces) {
  std::vector<StreetPiece> all;
  for (const StreetPiece& piece : pieces) {
    const int count = std::max(1, math::to_int32(length_of(piece) / piece_length + 0.5));
    const dvec2 from = in_cm(piece.a), along = in_cm(piece.b) - from;
    CmPoint last = piece.a;
    for (int n = 1; n <= count; ++n) {
      const CmPoint next = n == count ? piece.b : rounded_cm(from + along * (static_cast<double>(n) / count));
      all.push_back({last, next, piece.kind});
      last = next;
    }
  }
  return all;
}

/// Whether the ground between two positions is a ridge that a straight tunnel passes at most as steep as its limit.
bool is_ridge(const Landform& ground, const CmPoint& a, const CmPoint& b, double grade_limit) {
  const dvec2 from = in_metres(a), along = in_metres(b) - from;
  const double length = glm::length(along), low = ground.at(from), rise = ground.at(in_metres(b)) - low;
  if (std::abs(rise) > grade_limit * length) return false;
  const int count = std::max(6, math::to_int32(length / 5));
  for (int n = 1; n < count; ++n) {
    const double share = static_cast<double>(n) / count;
    const double depth = ground.at(from + along * share) - low - rise * share;
    const bool is_middle = share >= 1 / 3.0 && share <= 2 / 3.0;
    if (depth < (is_middle ? least_depth : least_cover)) return false;
  }
  return true;
}

}  // namespace

std::optional<Route> GrowthInput::tunnelled(const Route& route) const {
  const bool follows_slope = streets.method == CityMethod::growth && streets.pattern == CityPattern::slope;
  if (!landform || streets.tunnel_length <= 0 || follows_slope) return std::nullopt;
  const std::vector<StreetPiece> pieces = short_pieces(route.pieces);
  std::vector<std::uint8_t> is_steep;
  for (const StreetPiece& each : pieces) {
    if (!keeps_off_given(each)) return std::nullopt;
    is_steep.push_back(is_too_steep(in_cm(each.a), in_cm(each.b), limit_of(each.kind)) ? 1 : 0);
  }
  Route built;
  built.separated = route.separated;
  built.reaches_end = route.reaches_end;
  for (std::size_t i = 0; i < pieces.size();) {
    const StreetPiece& first = pieces[i];
    if (is_steep[i] == 0) {
      if (is_obstructed(in_cm(first.a), in_cm(first.b))) return std::nullopt;
      built.pieces.push_back(first);
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (end < pieces.size() && is_steep[end] != 0 && pieces[end].a == pieces[end - 1].b) ++end;
    if (i == 0 || end == pieces.size()) return std::nullopt;
    const StreetPiece &before = pieces[i - 1], &last = pieces[end - 1], &after = pieces[end];
    const double length = distance(first.a, last.b);
    if (before.b != first.a || after.a != last.b || length < shortest_tunnel ||
        length > streets.tunnel_length * 100 || length_of(before) < shortest_approach ||
        length_of(after) < shortest_approach)
      return std::nullopt;
    const dvec2 along = direction_of(first.a, last.b);
    if (glm::dot(along, direction_of(before.a, before.b)) < least_cosine ||
        glm::dot(along, direction_of(after.a, after.b)) < least_cosine ||
        !is_ridge(*landform, first.a, last.b, limit_of(first.kind)))
      return std::nullopt;
    built.separated.push_back({{first.a, last.b}, first.kind, -1});
    i = end;
  }
  return built;
}

}  // namespace seedmesh::city
