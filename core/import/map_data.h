#pragma once
/// Maps as the readers of GeoJSON and OpenStreetMap return them, before they are converted to a scene. A map has
/// features with tags and geographic geometry, and the warnings that many features share.
#include <cstddef>
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// Names and values of OpenStreetMap, such as "roof:shape" and "gabled". Features have few of them, so they
/// are a list in the order of the file, which is searched linearly.
class MapTags {
 public:
  void add(std::string name, std::string value) { tags_.emplace_back(std::move(name), std::move(value)); }
  /// Returns the value of a name; empty if there is none.
  std::string_view get(std::string_view name) const;
  /// Returns the first value of several names that is not empty.
  std::string_view get(std::initializer_list<std::string_view> names) const;
  bool is(std::string_view name, std::string_view value) const { return get(name) == value; }
  /// Whether the name has a value other than "no".
  bool has(std::string_view name) const;
  const std::vector<std::pair<std::string, std::string>>& all() const { return tags_; }

 private:
  std::vector<std::pair<std::string, std::string>> tags_;
};

using MapRing = std::vector<glm::dvec2>;  ///< x is the longitude in degrees, or the easting in metres

/// The position of a feature in the file: a byte of XML, or a pointer into JSON.
struct MapPosition {
  std::size_t offset = 0;
  std::string pointer;
};

struct MapFeature {
  std::string name;  ///< such as "way/123"; may be empty
  MapPosition position;
  MapTags tags;
  std::vector<glm::dvec2> points;
  std::vector<MapRing> lines;
  std::vector<std::vector<MapRing>>
      polygons;  ///< each an outer ring and its holes, without repeated first points
};

enum class MapUnit { degrees, web_mercator, metres };

/// Warnings, each with its number of occurrences and the position of the first one.
class MapWarnings {
 public:
  void add(std::string message, const MapPosition& position);
  /// Returns the warnings in the order of their first occurrences. `text` is the file, for lines and
  /// columns; it is empty for JSON.
  std::vector<Warning> list(std::string_view text) const;

 private:
  struct Entry {
    std::string message;
    MapPosition position;
    std::size_t count = 0;
  };
  std::vector<Entry> entries_;
  std::map<std::string, std::size_t, std::less<>> known_;
};

struct MapBounds {
  glm::dvec2 min{0}, max{0};
};

struct MapData {
  std::vector<MapFeature> features;
  MapUnit unit = MapUnit::degrees;
  /// Bounds of the part of the world that the file covers, if the file states them.
  std::optional<MapBounds> bounds;
  /// Polygons that no tag describes are buildings, as in files of footprints.
  bool plain_polygons_are_buildings = false;
  MapWarnings warnings;
};

}  // namespace seedmesh
