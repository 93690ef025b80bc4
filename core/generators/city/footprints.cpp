#include "core/generators/city/footprints.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/generators/city/geojson.h"
#include "core/generators/city/rings.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double usual_height = 9, height_of_floor = 3, least_height = 1, most_height = 1000;  // m
constexpr double cell_size = 64;                                                               // m

double height_of(const GeoFeature& building, std::vector<Issue>& issues) {
  const auto height = number_property(building, "height", issues);
  auto floors = number_property(building, "floors", issues);
  if (!floors && !height) floors = number_property(building, "building:levels", issues);
  const double value = height ? *height : floors ? *floors * height_of_floor : usual_height;
  if (value >= least_height && value <= most_height) return value;
  issues.emplace_back(IssueKind::out_of_range,
                      building.pointer + "/properties/" + (height ? "height" : "floors"),
                      "found a height of " + number_text(value) + " m, expected " +
                          number_text(least_height) + " to " + number_text(most_height) + " m");
  return usual_height;
}

/// The middle of the box around a ring, in whole centimetres.
CmPoint middle_of(const CmRing& ring) {
  CmPoint low = ring[0], high = ring[0];
  for (const CmPoint& p : ring) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
}

double distance_to(const CmRing& ring, const dvec2& cm) {
  double least = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i)
    least = std::min(least, distance_to_segment(cm, in_cm(ring[i]), in_cm(ring[(i + 1) % ring.size()])));
  return least;
}

}  // namespace

std::vector<GivenFootprint> given_footprints(const CityParams& params, std::vector<Issue>& issues) {
  std::vector<GivenFootprint> all;
  if (!params.given.given_footprints) return all;
  for (GeoFeature& each :
       features_of(*params.given.given_footprints, GeoKind::polygons, "/given/footprints", {issues})) {
    const double height = height_of(each, issues);
    for (Rings& rings : each.polygons) {
      if (std::all_of(rings.begin(), rings.end(), [](const CmRing& ring) { return is_simple(ring); })) {
        all.push_back({each.pointer, std::move(rings), height});
      } else {
        issues.emplace_back(IssueKind::invalid_value, each.geometry,
                            "found a ring that meets itself, expected simple rings");
      }
    }
  }
  return all;
}

std::vector<Landmark> landmarks_of(const std::vector<GivenFootprint>& footprints) {
  std::vector<Landmark> landmarks;
  for (const GivenFootprint& each : footprints) {
    const CmPoint middle = middle_of(each.rings[0]);
    Json rings = Json::array();
    Landmark landmark;
    landmark.radius = 0;
    landmark.is_given = true;
    for (const CmRing& ring : each.rings) {
      Json points = Json::array();
      for (const CmPoint& p : ring) {
        // x is east and z is south.
        points.push_back({(p.x - middle.x) / 100.0, (middle.y - p.y) / 100.0});
        landmark.radius = std::max(landmark.radius, distance(p, middle) / 100);
      }
      rings.push_back(std::move(points));
    }
    const std::string rules =
        "Lot --> extrude(" + number_text(each.height) + ") comp(f) { top: Roof. | side: Wall. }";
    landmark.request = {"building", 0, canonical_text({{"footprint", std::move(rings)}, {"rules", rules}})};
    landmark.pointer = each.pointer;
    landmark.position = in_metres(middle);
    landmarks.push_back(std::move(landmark));
  }
  return landmarks;
}

FootprintIndex::Cell FootprintIndex::cell_of(const dvec2& metres) {
  return {math::to_int32(std::floor(metres.x / cell_size)), math::to_int32(std::floor(metres.y / cell_size))};
}

FootprintIndex::FootprintIndex(const std::vector<GivenFootprint>& footprints) {
  for (const GivenFootprint& each : footprints) {
    dvec2 low = in_metres(each.rings[0][0]), high = low;
    for (const CmPoint& p : each.rings[0]) {
      low = glm::min(low, in_metres(p));
      high = glm::max(high, in_metres(p));
    }
    const Cell first = cell_of(low - dvec2(most_reach)), last = cell_of(high + dvec2(most_reach));
    for (std::int32_t x = first[0]; x <= last[0]; ++x) {
      for (std::int32_t y = first[1]; y <= last[1]; ++y)
        cells_[{x, y}].push_back(static_cast<std::uint32_t>(rings_.size()));
    }
    rings_.push_back(each.rings);
  }
}

bool FootprintIndex::is_near(const dvec2& metres, double reach) const {
  const auto cell = cells_.find(cell_of(metres));
  if (cell == cells_.end()) return false;
  const dvec2 cm = metres * 100.0;
  return std::any_of(cell->second.begin(), cell->second.end(), [&](std::uint32_t n) {
    return is_in(rings_[n], cm) || distance_to(rings_[n][0], cm) < reach * 100;
  });
}

bool FootprintIndex::meets(const std::array<CmPoint, 4>& corners) const {
  const CmRing house(corners.begin(), corners.end());
  for (const CmPoint& corner : corners) {
    const auto cell = cells_.find(cell_of(in_metres(corner)));
    if (cell == cells_.end()) continue;
    for (const std::uint32_t n : cell->second) {
      const CmRing& ring = rings_[n][0];
      if (is_inside(ring, in_cm(corner)) || is_inside(house, in_cm(ring[0]))) return true;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
          if (segments_meet(ring[i], ring[(i + 1) % ring.size()], house[k], house[(k + 1) % 4])) return true;
        }
      }
    }
  }
  return false;
}

}  // namespace seedmesh::city
