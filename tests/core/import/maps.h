#pragma once
/// Maps written for tests. All lie around 11.5 degrees east, 48.1 degrees north.
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/core/import/support.h"

namespace seedmesh {

constexpr double map_longitude = 11.5, map_latitude = 48.1;

/// Degrees for metres east and north of the middle, by the radii of curvature of WGS 84 at its latitude.
inline nlohmann::json degrees_at(double east, double north) {
  constexpr double a = 6378137, e2 = 0.00669437999014;
  const double phi = map_latitude * 3.14159265358979323846 / 180, s = 1 - e2 * std::sin(phi) * std::sin(phi);
  const double across = a / std::sqrt(s) * std::cos(phi), along = a * (1 - e2) / (s * std::sqrt(s));
  constexpr double radian = 180 / 3.14159265358979323846;
  return {map_longitude + east / across * radian, map_latitude + north / along * radian};
}

inline nlohmann::json ring_of(const std::vector<std::pair<double, double>>& points) {
  nlohmann::json ring = nlohmann::json::array();
  for (const auto& [east, north] : points) ring.push_back(degrees_at(east, north));
  ring.push_back(ring[0]);
  return ring;
}

inline nlohmann::json box_of(double east, double north, double width, double depth) {
  return ring_of(
      {{east, north}, {east + width, north}, {east + width, north + depth}, {east, north + depth}});
}

inline nlohmann::json feature_of(nlohmann::json properties, nlohmann::json rings) {
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "Polygon"}, {"coordinates", std::move(rings)}}}};
}

inline nlohmann::json collection_of(std::vector<nlohmann::json> features) {
  return {{"type", "FeatureCollection"}, {"features", std::move(features)}};
}

inline Result<ImportedRequest> imported_map(const nlohmann::json& map) {
  return imported("geojson", map.dump());
}

/// The only building of a map of one rectangle of 20 by 10 metres with these properties.
inline nlohmann::json building_of(nlohmann::json properties) {
  const auto result =
      imported_map(collection_of({feature_of(std::move(properties), {box_of(-10, -5, 20, 10)})}));
  const nlohmann::json parameters = parameters_of(result);
  return parameters.is_null() ? nlohmann::json(reports(result)) : parameters.at("buildings").at(0);
}

/// XML of OpenStreetMap.
class OsmText {
 public:
  int node(double east, double north, const std::string& tags = "") {
    const nlohmann::json at = degrees_at(east, north);
    text_ += "<node id='" + std::to_string(++last_) + "' lon='" + at[0].dump() + "' lat='" + at[1].dump() +
             "'>" + tags + "</node>\n";
    return last_;
  }
  std::vector<int> box(double east, double north, double width, double depth) {
    std::vector<int> nodes{node(east, north), node(east + width, north), node(east + width, north + depth),
                           node(east, north + depth)};
    nodes.push_back(nodes[0]);
    return nodes;
  }
  int way(const std::vector<int>& nodes, const std::string& tags) {
    text_ += "<way id='" + std::to_string(++last_) + "'>";
    for (const int id : nodes) text_ += "<nd ref='" + std::to_string(id) + "'/>";
    text_ += tags + "</way>\n";
    return last_;
  }
  int multipolygon(const std::vector<int>& outer, const std::vector<int>& inner, const std::string& tags) {
    text_ += "<relation id='" + std::to_string(++last_) + "'>";
    for (const int id : outer) text_ += "<member type='way' role='outer' ref='" + std::to_string(id) + "'/>";
    for (const int id : inner) text_ += "<member type='way' role='inner' ref='" + std::to_string(id) + "'/>";
    text_ += "<tag k='type' v='multipolygon'/>" + tags + "</relation>\n";
    return last_;
  }
  std::string text() const {
    return "<?xml version='1.0' encoding='UTF-8'?>\n<osm version='0.6'>\n" + text_ + "</osm>\n";
  }

 private:
  std::string text_;
  int last_ = 0;
};

inline std::string tag(const std::string& name, const std::string& value) {
  return "<tag k='" + name + "' v='" + value + "'/>";
}

}  // namespace seedmesh
