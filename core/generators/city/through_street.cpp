// The street of an area in which no pattern finds one, and the places where growth can start.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/growth.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double piece_length = 3000;       // of a bent street, cm
constexpr double least_border_sine = 0.72;  // of the angle between a street and the border
constexpr double least_density = 0.1;

/// The ends on the border of the line through a point; nothing if it is shorter than the least length or meets the
/// border at an angle with a lower sine.
std::optional<std::array<CmPoint, 2>> line_through(const Region& region, const dvec2& p,
                                                   const dvec2& direction, double least_sine) {
  constexpr double far = 1e7;
  constexpr double shortest = 3000;
  std::array<CmPoint, 2> ends;
  for (const int side : {0, 1}) {
    const dvec2 along = direction * (side == 0 ? far : 0 - far);
    const std::vector<OutlineHit> hits = hits_of(region, p, p + along);
    if (hits.empty() || hits[0].sine < least_sine) return std::nullopt;
    ends[static_cast<std::size_t>(side)] = rounded_cm(p + along * hits[0].share);
  }
  if (distance(ends[0], ends[1]) < shortest) return std::nullopt;
  return ends;
}

}  // namespace

std::vector<dvec2> lattice_of(const Region& region) {
  if (region.rings.empty()) return {};
  dvec2 low = in_cm(region.rings[0][0]), high = low;
  for (const CmRing& ring : region.rings) {
    for (const CmPoint& p : ring) {
      low = glm::min(low, in_cm(p));
      high = glm::max(high, in_cm(p));
    }
  }
  constexpr int points = 15;
  std::vector<dvec2> inside;
  for (int i = 0; i < points; ++i) {
    for (int k = 0; k < points; ++k) {
      const dvec2 p = low + (high - low) * dvec2((i + 0.5) / points, (k + 0.5) / points);
      if (is_on_land(region, p)) inside.push_back(p);
    }
  }
  return inside;
}

namespace {

std::vector<StreetPiece> pieces_between(const std::array<CmPoint, 2>& ends) {
  const dvec2 start = in_cm(ends[0]), along = in_cm(ends[1]) - start;
  const int count = std::max(1, math::to_int32(distance(ends[0], ends[1]) / piece_length));
  std::vector<StreetPiece> pieces;
  CmPoint last = ends[0];
  for (int n = 1; n <= count; ++n) {
    const CmPoint next = rounded_cm(start + along * (static_cast<double>(n) / count));
    pieces.push_back({last, next, static_cast<std::uint32_t>(EdgeClass::major)});
    last = next;
  }
  return pieces;
}

bool is_too_steep(const GrowthInput& input, const std::vector<StreetPiece>& pieces) {
  return std::any_of(pieces.begin(), pieces.end(), [&](const StreetPiece& piece) {
    return input.is_too_steep(in_cm(piece.a), in_cm(piece.b), input.streets.classes.major.grade);
  });
}

bool is_blocked(const GrowthInput& input, const std::vector<StreetPiece>& pieces) {
  return std::any_of(pieces.begin(), pieces.end(), [&](const StreetPiece& piece) {
    return input.is_blocked(in_cm(piece.a), in_cm(piece.b), input.streets.classes.major.grade);
  });
}

/// Returns the longest line at one of the densest points that is not too steep. A line that meets no obstacle and no given
/// building comes first; if there is none, the pieces that meet a building are left out.
std::vector<StreetPiece> longest_line(const GrowthInput& input) {
  std::vector<std::pair<double, dvec2>> from;
  for (const dvec2& p : lattice_of(input.region)) {
    const double density = input.density.at(p / 100.0);
    if (density >= least_density) from.emplace_back(0 - density, p);
  }
  std::stable_sort(from.begin(), from.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  // Where several parts of the area are about as dense, the one with the longest street has the most space.
  constexpr double as_dense = 0.6;
  for (const double least_sine : {least_border_sine, 0.4}) {
    std::optional<std::array<CmPoint, 2>> best, best_free;
    double longest = 0, longest_free = 0;
    for (const auto& [density, p] : from) {
      if (best && density > from.front().first * as_dense) break;
      constexpr int directions = 12;
      for (int k = 0; k < directions; ++k) {
        const math::SinCos turn = math::sincos_degrees(input.streets.angle + 180.0 * k / directions);
        const auto ends = line_through(input.region, p, {turn.cos, turn.sin}, least_sine);
        const double length = ends ? distance((*ends)[0], (*ends)[1]) : 0;
        if (length <= longest_free) continue;
        const std::vector<StreetPiece> pieces = pieces_between(*ends);
        if (is_too_steep(input, pieces)) continue;
        if (!is_blocked(input, pieces)) {
          longest_free = length;
          best_free = ends;
        }
        if (length <= longest) continue;
        longest = length;
        best = ends;
      }
    }
    if (best_free) return pieces_between(*best_free);
    if (!best) continue;
    std::vector<StreetPiece> pieces = pieces_between(*best);
    std::erase_if(pieces, [&](const StreetPiece& piece) { return input.is_on_footprint(piece); });
    return pieces;
  }
  return {};
}

/// One road, which the productions may build.
class OneRoad final : public RoadRules {
 public:
  explicit OneRoad(const GrowthInput& input) : input_(input) {}
  GlobalGoals global_goals(double, double, Rng) override { return {}; }
  RoadState local_constraints(double road) override {
    if (road == 0 && pieces.empty()) pieces = longest_line(input_);
    return RoadState::failed;  // it ends at the border
  }
  std::array<double, 2> measure(double) const override { return {0, 0}; }

  std::vector<StreetPiece> pieces;

 private:
  const GrowthInput& input_;
};

}  // namespace

std::vector<StreetPiece> through_street(const GrowthInput& input, const Job& job) {
  OneRoad road(input);
  input.grammar.grow({{0, 0, 0, 1}}, road, 1000, job);
  return std::move(road.pieces);
}

}  // namespace seedmesh::city
