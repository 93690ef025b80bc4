#pragma once
/// Points of ways of OpenStreetMap, some of which a file can lack.
#include <cstddef>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "core/import/map_data.h"

namespace seedmesh {

/// A point whose position the file lacks: with `out geom`, one outside of the queried box.
constexpr glm::dvec2 osm_unknown_point{std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::quiet_NaN()};

/// Whether degrees are on Earth; false for the unknown point.
bool is_osm_position(double longitude, double latitude);

/// The known points of a way. They are in several runs if points between them are unknown.
struct WayPoints {
  std::vector<MapRing> runs;
  std::size_t missing = 0;  ///< unknown points

  /// Returns all known points in turn.
  MapRing joined() const;
};

/// Divides points at those that are unknown.
WayPoints runs_of(const std::vector<glm::dvec2>& points);

}  // namespace seedmesh
