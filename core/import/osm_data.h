#pragma once
/// The elements of OpenStreetMap files, and their assembly to features.
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/import/import.h"
#include "core/import/map_data.h"
#include "core/import/osm_points.h"

namespace seedmesh {

/// The role of a member of a relation. `outline` occurs in relations of the type `building`. `unknown` is a
/// missing role, as in old files, or any other; then the geometry decides.
enum class OsmRole { outer, inner, outline, unknown };

/// Returns the role of a member by its name.
OsmRole osm_role(std::string_view name);

/// Extends `bounds` by a further box. A file that joins several downloads states one box for each.
void add_bounds(std::optional<MapBounds>& bounds, const MapBounds& more);

struct OsmNode {
  std::int64_t id = 0;
  glm::dvec2 position{0};  ///< longitude and latitude in degrees
  MapTags tags;
  MapPosition location;
};

struct OsmWay {
  std::int64_t id = 0;
  std::vector<std::int64_t> nodes;
  std::vector<glm::dvec2>
      inline_points;                 ///< of `out geom`: by node, or unknown; empty: the nodes are elements
  std::optional<glm::dvec2> center;  ///< of `out center`
  MapTags tags;
  MapPosition location;
};

struct OsmMember {
  std::int64_t way = 0;
  OsmRole role = OsmRole::unknown;
  std::vector<glm::dvec2> inline_points;  ///< of `out geom`
};

struct OsmRelation {
  std::int64_t id = 0;
  std::vector<OsmMember> members;    ///< its ways
  std::optional<glm::dvec2> center;  ///< of `out center`
  MapTags tags;
  MapPosition location;
};

struct OsmFile {
  std::vector<OsmNode> nodes;
  std::vector<OsmWay> ways;
  std::vector<OsmRelation> relations;
  std::optional<MapBounds> bounds;
  MapWarnings warnings;
};

/// The text `remark` of Overpass at `place`: its server stopped the query. Returns an error if `file` has no
/// elements; otherwise adds a warning, because the map is incomplete, and returns nullopt. `text`: the file; empty for
/// JSON.
std::optional<Error> stopped_query(OsmFile& file, std::string_view remark, const MapPosition& place,
                                   std::string_view text);

/// Joins ways and multipolygons to features. Elements that occur twice count once, with the tags and nodes of
/// both. If the only outer way of a multipolygon describes the same object, the multipolygon also gets the tags
/// of that way. Elements that refer to nodes or ways that the file lacks are left out or shortened, with a
/// warning. Checks stop and deadline of the job of `options`. Cost: about n log n.
MapData map_of(OsmFile file, const ImportOptions& options = {});

}  // namespace seedmesh
