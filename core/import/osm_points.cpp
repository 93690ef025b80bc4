#include "core/import/osm_points.h"

#include <cmath>

namespace seedmesh {

bool is_osm_position(double longitude, double latitude) {
  return std::abs(longitude) <= 180 && std::abs(latitude) <= 90;
}

MapRing WayPoints::joined() const {
  MapRing points;
  for (const MapRing& run : runs) points.insert(points.end(), run.begin(), run.end());
  return points;
}

WayPoints runs_of(const std::vector<glm::dvec2>& points) {
  WayPoints made;
  bool is_gap = true;
  for (const glm::dvec2& p : points) {
    const bool is_known = is_osm_position(p.x, p.y);
    if (!is_known) ++made.missing;
    if (is_known && is_gap) made.runs.emplace_back();
    if (is_known) made.runs.back().push_back(p);
    is_gap = !is_known;
  }
  return made;
}

}  // namespace seedmesh
