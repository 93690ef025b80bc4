#pragma once
/// A map as a request of the generator scene: buildings, areas, paths and trees in metres about an origin.
#include <map>
#include <optional>

#include "core/base/job.h"
#include "core/geom/polygon/plan.h"
#include "core/import/import.h"
#include "core/import/map_data.h"
#include "core/import/map_projection.h"

namespace seedmesh {

/// Converts the features to a scene. `text`: the file, for the lines of warnings; empty for JSON. Returns an
/// error if no feature has a counterpart or the map is too large. Works within the limits, stop and deadline of
/// `options.job`.
Result<Imported> scene_of_map(MapData data, std::string_view text, const ImportOptions& options = {});

/// The data that the parts of the conversion share.
struct MapConversion {
  MapConversion(MapWarnings& warnings_of_file, const Job& job_of_file, MapUnit unit_of_file)
      : warnings(warnings_of_file), job(job_of_file), unit(unit_of_file) {}

  MapWarnings& warnings;
  const Job& job;
  MapUnit unit = MapUnit::degrees;
  std::optional<TransverseMercator> projection;  ///< null for metres
  glm::dvec2 origin{0};                          ///< origin of the coordinates in metres

  Json buildings = Json::array(), areas = Json::array(), paths = Json::array();
  Json broadleaved = Json::array(), needleleaved = Json::array();  ///< positions of trees
  std::map<std::string, std::size_t> left_out;  ///< features without a counterpart, by their key
  double outline_work = 0;                      ///< the sum of the squared numbers of points of all outlines
  double reach = 0;  ///< the greatest distance of buildings and areas from the origin, along an axis

  /// Returns the rings of a polygon in metres. Empty, with a warning, if it has more than 5,000 points, or if
  /// `outline_work` exceeds its limit. `what`: "a footprint".
  std::vector<PlanRing> outline(const std::vector<MapRing>& polygon, const char* what,
                                const MapPosition& position);

  glm::dvec2 local(const glm::dvec2& position) const;
  PlanRing local(const MapRing& ring) const;
  /// Returns a position of a scene: metres east and south, rounded to whole millimetres.
  static Json point(const glm::dvec2& p);
  Json rings(const Plan& plan);
};

/// Returns the height in metres of the models of trees at scale 1.
constexpr double map_tree_height(bool is_needle) { return is_needle ? 12 : 10; }

/// Whether the tags are those of an area or a line of the ground.
bool has_ground_tag(const MapTags& tags);
/// Returns the key to which a value without a key belongs, such as "leisure" for "park". The result is empty
/// if no kind of line or area has the value, or if the value can also be a kind of building.
std::string_view map_key_of(std::string_view value, bool is_line);

/// Adds buildings and parts of buildings (map_buildings.cpp). Returns for each feature whether it is one.
std::vector<bool> add_buildings(MapConversion& map, const MapData& data);

/// Adds areas, streets, waterways and trees (map_ground.cpp); areas in the order in which they cover each other.
void add_ground(MapConversion& map, const MapData& data, const std::vector<bool>& is_building);

}  // namespace seedmesh
