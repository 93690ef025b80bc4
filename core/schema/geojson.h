#pragma once
/// GeoJSON (RFC 7946) inside a request. Generated readers accept any object wherever a schema has the x-widget
/// "geojson"; the generator that uses it checks the rest.
#include <string>

namespace seedmesh {

/// A FeatureCollection, a Feature or a geometry.
struct GeoJson {
  std::string text = "{}";  ///< canonical JSON; of the members outside RFC 7946, it has only `crs`

  friend bool operator==(const GeoJson&, const GeoJson&) = default;
};

}  // namespace seedmesh
