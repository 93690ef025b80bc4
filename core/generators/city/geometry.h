#pragma once
/// Polygons and lines of GeoJSON geometries, in whole centimetres.
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geom/polygon/cm_point.h"

namespace seedmesh {
struct CityLines;
struct CityPolygons;
}  // namespace seedmesh

namespace seedmesh::city {

/// The rings of one polygon; the even-odd rule says what is inside. Rings do not repeat their first point.
using Rings = std::vector<CmRing>;

/// Reads the polygons of a geometry. Issues: lists of another depth than the type of the geometry has, rings with
/// fewer than three corners, and more than 100,000 positions.
std::vector<Rings> polygons_of(const CityPolygons& geometry, const std::string& pointer,
                               std::vector<Issue>& issues);

/// Reads the lines of a geometry, without corners that repeat the one before. Issues: the same for lines, which
/// have at least two corners.
std::vector<CmRing> lines_of(const CityLines& geometry, const std::string& pointer,
                             std::vector<Issue>& issues);

/// Whether a position in centimetres is inside one of the polygons.
bool is_in_any(const std::vector<Rings>& polygons, const glm::dvec2& cm);

}  // namespace seedmesh::city
