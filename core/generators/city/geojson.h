#pragma once
/// Reads GeoJSON (RFC 7946) of a request: lines or polygons, in whole centimetres. Includes the whole of
/// nlohmann/json: for .cpp files only.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/generators/city/geometry.h"
#include "core/schema/geojson.h"
#include "core/schema/json.h"

namespace seedmesh::city {

/// A feature with its geometry, or a geometry that stands alone.
struct GeoFeature {
  std::string pointer;   ///< of the feature
  std::string geometry;  ///< pointer of its geometry
  Json properties;       ///< an object
  std::vector<CmRing> lines;
  std::vector<Rings> polygons;
};

enum class GeoKind { lines, polygons };

/// Where reading reports what it finds.
struct GeoReport {
  std::vector<Issue>& issues;
  std::vector<Warning>* warnings = nullptr;  ///< may be null
};

/// Returns the features with lines or with polygons. Features without a geometry and geometries without coordinates
/// are left out, as RFC 7946 allows them. Lines do not repeat a corner, and rings not their first point.
/// Issues: what RFC 7946 forbids; coordinates beyond 1,000 km; lines with fewer than two different corners;
/// rings with fewer than three; positions that look like degrees; geometries of other kinds alone.
/// Warnings: geometries of another kind beside those of the wanted kind.
std::vector<GeoFeature> features_of(const GeoJson& value, GeoKind kind, const std::string& pointer,
                                    const GeoReport& report);

/// Returns the polygons of all features.
std::vector<Rings> polygons_of(const GeoJson& value, const std::string& pointer, const GeoReport& report);

/// Returns a property; of a list its first value, since merged streets of OpenStreetMap have lists. Null without it
/// and for null.
const Json* first_property(const GeoFeature& feature, const char* name);

/// Returns a property that is a number, or a text with a number, as OpenStreetMap has them: "2", "6.5 m", "20 ft",
/// "20'". Lengths are converted to metres, and the first of "3;4" counts. Nothing without it or for null. Issue:
/// another value.
std::optional<double> number_property(const GeoFeature& feature, const char* name,
                                      std::vector<Issue>& issues);

}  // namespace seedmesh::city
