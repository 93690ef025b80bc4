#pragma once
/// Polygons with holes, in whole centimetres.
#include <vector>

#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

/// The rings of one polygon; the even-odd rule defines what is inside. Rings do not repeat their first point.
using Rings = std::vector<CmRing>;

/// Whether a position in centimetres is inside the polygon.
bool is_in(const Rings& rings, const glm::dvec2& cm);

/// Whether a position in centimetres is inside one of the polygons.
bool is_in_any(const std::vector<Rings>& polygons, const glm::dvec2& cm);

}  // namespace seedmesh::city
