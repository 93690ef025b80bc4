#pragma once
/// Reads GeoJSON (RFC 7946) of a request: lines or polygons, in whole centimetres. Includes the whole of
/// nlohmann/json: for .cpp files only.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/generators/city/rings.h"
#include "core/schema/geojson.h"
#include "core/schema/json.h"

namespace seedmesh::city {

/// A feature with its geometry, or a geometry without a feature.
struct GeoFeature {
  std::string pointer;   ///< pointer of the feature
  std::string geometry;  ///< pointer of its geometry
  Json properties;       ///< an object
  std::vector<CmRing> lines;
  std::vector<Rings> polygons;
};

enum class GeoKind { lines, polygons };

/// The lists that receive issues and warnings.
struct GeoReport {
  std::vector<Issue>& issues;
  std::vector<Warning>* warnings = nullptr;  ///< may be null
};

/// Returns the features with lines or with polygons. RFC 7946 allows features without a geometry and geometries
/// without coordinates; both are left out. Consecutive corners of a line differ, and rings do not repeat their first
/// point. Issues: what RFC 7946 forbids; coordinates beyond 1,000 km; lines with fewer than two different corners;
/// rings with fewer than three; positions that are probably degrees; a value whose geometries are all of other kinds.
/// Warnings: geometries of another kind beside those of the expected kind.
std::vector<GeoFeature> features_of(const GeoJson& value, GeoKind kind, const std::string& pointer,
                                    const GeoReport& report);

/// Returns the polygons of all features.
std::vector<Rings> polygons_of(const GeoJson& value, const std::string& pointer, const GeoReport& report);

/// Returns a property. If it is a list, returns its first value, since merged streets of OpenStreetMap have lists.
/// Returns null if the property is missing or null.
const Json* first_property(const GeoFeature& feature, const char* name);

/// Returns a property that is a number, or a text with a number, as OpenStreetMap has them: "2", "6.5 m", "20 ft",
/// "20'". Lengths are converted to metres, and the first of "3;4" counts. Returns nullopt if the property is missing
/// or null. Adds an issue for any other value.
std::optional<double> number_property(const GeoFeature& feature, const char* name,
                                      std::vector<Issue>& issues);

}  // namespace seedmesh::city
