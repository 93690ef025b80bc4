#include "core/generators/city/rings.h"

#include <algorithm>

namespace seedmesh::city {

bool is_in(const Rings& rings, const glm::dvec2& cm) {
  bool inside = false;
  for (const CmRing& ring : rings) inside ^= is_inside(ring, cm);
  return inside;
}

bool is_in_any(const std::vector<Rings>& polygons, const glm::dvec2& cm) {
  return std::any_of(polygons.begin(), polygons.end(), [&](const Rings& rings) { return is_in(rings, cm); });
}

}  // namespace seedmesh::city
