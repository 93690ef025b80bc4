// Reads GeoJSON (RFC 7946) with buildings, streets, water, green areas and trees. Properties have the names of
// OpenStreetMap, as osmtogeojson and Overpass turbo write them, or those of files of footprints (Overture Maps, OSM
// Buildings, vector tiles), which are translated.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/import/city_plan.h"
#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/import/listed_objects.h"
#include "core/import/map_names.h"
#include "core/import/map_scene.h"

namespace seedmesh {
namespace {

constexpr std::size_t most_errors = 100;
constexpr std::string_view blanks = " \t\r\n";
constexpr char record_separator = '\x1e';
// Greatest depth of geometry collections.
constexpr int deepest = 8;

/// The text of a property; empty for null and for lists and objects.
std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.is_number() ? number_text(value.get<double>()) : std::string();
}

class GeoJsonReader {
 public:
  explicit GeoJsonReader(const ImportOptions& options) : options_(options) {}

  /// Reads a file whose features are still texts.
  Result<Imported> read_in_parts(std::string_view text, const ListedObjects& features) {
    Result<Json> file = parse_json(features.shell, {.job = options_.job});
    if (!file) return std::move(file).error();
    Json& list = (*file)["features"];
    if (!features.texts.empty()) {
      Result<Json> first = parse_listed(text, features, 0, options_.job);
      if (!first) return std::move(first).error();
      list.push_back(*std::move(first));
    }
    begin(*file);
    if (type_of(*file) != "FeatureCollection") return read(*file);
    for (std::size_t i = 0; i < features.texts.size() && issues_.size() < most_errors; ++i) {
      if (i > 0) {
        Result<Json> one = parse_listed(text, features, i, options_.job);
        if (!one) return std::move(one).error();
        list[0] = *std::move(one);
      }
      read_feature(list[0], "/features/" + std::to_string(i));
    }
    return made();
  }

  Result<Imported> read(const Json& file) {
    begin(file);
    const std::string type = type_of(file);
    if (type == "FeatureCollection") {
      const Json* features = member(file, "features", "");
      if (features && !features->is_array()) {
        report(IssueKind::wrong_type, "/features", "expected an array of features");
      } else if (features) {
        for (std::size_t i = 0; i < features->size(); ++i)
          read_feature((*features)[i], "/features/" + std::to_string(i));
      }
    } else if (type == "Feature") {
      read_feature(file, "");
    } else {
      MapFeature feature;
      read_geometry(file, "", feature, 0);
      data_.features.push_back(std::move(feature));
    }
    return made();
  }

 private:
  void begin(const Json& file) {
    data_.plain_polygons_are_buildings = true;
    read_crs(file);
    is_plan_ = is_city_plan(file);
    if (is_plan_) {
      data_.unit = MapUnit::metres;
      is_stated_ = true;
    }
  }

  Result<Imported> made() {
    if (!issues_.empty()) return Error{Code::invalid, std::move(issues_)};
    if (!is_stated_ && is_beyond_degrees_) {
      data_.unit = MapUnit::metres;
      data_.warnings.add("positions beyond 180 degrees are read as metres east and north", {});
    }
    return scene_of_map(std::move(data_), "", options_);
  }

  void report(IssueCause cause, std::string pointer, std::string message) {
    if (issues_.size() < most_errors)
      issues_.emplace_back(std::move(cause), std::move(pointer), std::move(message));
  }

  const Json* member(const Json& object, const char* name, const std::string& pointer) {
    const auto found = object.find(name);
    if (found != object.end()) return &*found;
    report(missing_for({name, "type"}), pointer, std::string("expected a member \"") + name + "\"");
    return nullptr;
  }

  static std::string type_of(const Json& object) {
    const auto found = object.find("type");
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
  }

  /// The old member `crs` names the coordinate system of the file.
  void read_crs(const Json& file) {
    const auto crs = file.find("crs");
    if (crs == file.end() || !crs->is_object()) return;
    const Json name = crs->value("properties", Json::object()).value("name", Json());
    if (!name.is_string()) return;
    const std::string text = lower(name.get<std::string>());
    is_stated_ = true;
    const auto ends = [&](std::string_view end) { return text.ends_with(end); };
    if (ends("crs84") || ends(":4326") || ends(":4979") || ends(":4258")) return;
    if (ends(":3857") || ends(":900913")) {
      data_.unit = MapUnit::web_mercator;
      return;
    }
    data_.unit = MapUnit::metres;
    data_.warnings.add("the coordinate system " + shortened(text, 60) + " is read as metres east and north",
                       {0, "/crs"});
  }

  void read_feature(const Json& json, const std::string& pointer) {
    if (!json.is_object() || type_of(json) != "Feature") {
      report(IssueKind::invalid_value, pointer, "expected an object with \"type\": \"Feature\"");
      return;
    }
    if (++features_ % 256 == 0) options_.check();
    MapFeature feature;
    feature.position.pointer = pointer;
    const auto properties = json.find("properties");
    if (properties != json.end() && properties->is_object()) read_properties(*properties, feature);
    const auto id = json.find("id");
    if (id != json.end()) feature.name = text_of(*id);
    if (feature.name.empty()) feature.name = std::string(feature.tags.get({"@id", "osm_id", "id"}));
    feature.name = shortened(feature.name, 100);
    const Json* geometry = member(json, "geometry", pointer);
    if (!geometry || geometry->is_null()) return;
    read_geometry(*geometry, pointer + "/geometry", feature, 0);
    if (is_plan_) {
      if (properties == json.end() || !describe_plan_feature(*properties, feature)) return;
    } else {
      close_lines(feature);
      read_kind(feature);
    }
    data_.features.push_back(std::move(feature));
  }

  static void read_properties(const Json& properties, MapFeature& feature) {
    std::vector<std::pair<std::string, std::string>> translated;
    const auto take = [&](const std::string& name, const Json& value) {
      std::string text = text_of(value);
      if (text.empty()) return;
      for (const FootprintName& known : footprint_names(name)) {
        if (known.key != name) translated.emplace_back(known.key, text + std::string(known.unit));
      }
      feature.tags.add(name, std::move(text));
    };
    for (const auto& [name, value] : properties.items()) {
      if (name == "tags" && value.is_object()) {
        for (const auto& [key, tag] : value.items()) take(key, tag);
      } else {
        take(name, value);
      }
    }
    for (auto& [key, text] : translated) {
      if (feature.tags.get(key).empty()) feature.tags.add(std::move(key), std::move(text));
    }
  }

  /// Files of other map services say in one property what a feature is: {"class": "park"}.
  static void read_kind(MapFeature& feature) {
    for (const std::string_view name :
         {"building", "building:part", "height", "building:levels", "roof:shape"}) {
      if (feature.tags.has(name)) return;
    }
    if (has_ground_tag(feature.tags) || (feature.lines.empty() && feature.polygons.empty())) return;
    for (const std::string_view name : {"fclass", "subclass", "class", "subtype", "kind", "type"}) {
      const std::string value = lower(feature.tags.get(name));
      const std::string_view key = map_key_of(value, feature.polygons.empty());
      if (value.empty() || key.empty()) continue;
      feature.tags.add(std::string(key), value);
      return;
    }
  }

  /// Closed lines of buildings are polygons: some programs write all ways as lines.
  static void close_lines(MapFeature& feature) {
    if (!feature.tags.has("building") && !feature.tags.has("building:part")) return;
    for (MapRing& line : feature.lines) {
      if (line.size() < 4 || line.front() != line.back()) continue;
      line.pop_back();
      feature.polygons.push_back({std::move(line)});
    }
    std::erase_if(feature.lines, [](const MapRing& line) { return line.empty(); });
  }

  bool read_position(const Json& json, const std::string& pointer, glm::dvec2& p) {
    const bool is_position =
        json.is_array() && json.size() >= 2 && json[0].is_number() && json[1].is_number();
    if (!is_position) {
      report(IssueKind::wrong_type, pointer, "expected a position: an array of two or three numbers");
      return false;
    }
    if (++positions_ % 1024 == 0) options_.check();
    p = {json[0].get<double>(), json[1].get<double>()};
    if (!has_altitudes_ && json.size() > 2 && json[2].is_number() && json[2].get<double>() != 0) {
      has_altitudes_ = true;
      data_.warnings.add("altitudes of positions are left out; the map is flat", {0, pointer});
    }
    constexpr double most = 1e8;
    if (!(std::abs(p.x) <= most && std::abs(p.y) <= most)) {
      report(IssueKind::out_of_range, pointer, "found a position beyond 100,000 km");
      return false;
    }
    if (std::abs(p.x) > 540 || std::abs(p.y) > 90) is_beyond_degrees_ = true;
    return true;
  }

  MapRing read_line(const Json& json, const std::string& pointer) {
    MapRing line;
    if (!json.is_array()) {
      report(IssueKind::wrong_type, pointer, "expected an array of positions");
      return line;
    }
    line.reserve(json.size());
    for (std::size_t i = 0; i < json.size() && issues_.size() < most_errors; ++i) {
      glm::dvec2 p{0};
      if (read_position(json[i], pointer + "/" + std::to_string(i), p)) line.push_back(p);
    }
    return line;
  }

  void read_polygon(const Json& json, const std::string& pointer, MapFeature& feature) {
    if (!json.is_array() || json.empty()) {
      report(IssueKind::wrong_type, pointer, "expected an array of rings");
      return;
    }
    std::vector<MapRing> rings;
    for (std::size_t i = 0; i < json.size(); ++i) {
      const std::string at = pointer + "/" + std::to_string(i);
      MapRing ring = read_line(json[i], at);
      if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
      if (ring.size() < 3) {
        if (i == 0) {
          data_.warnings.add("a ring of fewer than three points is left out", feature.position);
          return;
        }
        continue;
      }
      rings.push_back(std::move(ring));
    }
    feature.polygons.push_back(std::move(rings));
  }

  /// The members of a list, each with its pointer.
  template <class Read>
  void each(const Json& json, const std::string& pointer, const Read& read) {
    if (!json.is_array()) {
      report(IssueKind::wrong_type, pointer, "expected an array");
      return;
    }
    for (std::size_t i = 0; i < json.size() && issues_.size() < most_errors; ++i)
      read(json[i], pointer + "/" + std::to_string(i));
  }

  void read_geometry(const Json& json, const std::string& pointer, MapFeature& feature, int depth) {
    const std::string type = json.is_object() ? type_of(json) : std::string();
    if (type == "GeometryCollection") {
      if (depth >= deepest) {
        report(IssueKind::out_of_range, pointer, "found geometry collections more than 8 deep");
      } else if (const Json* members = member(json, "geometries", pointer)) {
        each(*members, pointer + "/geometries",
             [&](const Json& one, const std::string& at) { read_geometry(one, at, feature, depth + 1); });
      }
      return;
    }
    constexpr std::array<std::string_view, 6> types{"Point",           "MultiPoint", "LineString",
                                                    "MultiLineString", "Polygon",    "MultiPolygon"};
    if (std::find(types.begin(), types.end(), type) == types.end()) {
      report(IssueKind::invalid_value, pointer,
             "found " + (type.empty() ? std::string("no type") : "the type \"" + shortened(type, 40) + "\"") +
                 "; expected a feature collection, a feature or a geometry of GeoJSON");
      return;
    }
    const Json* found = member(json, "coordinates", pointer);
    if (!found) return;
    const Json& coordinates = *found;
    if (coordinates.is_array() && coordinates.empty()) return;  // as a geometry that is null
    const std::string at = pointer + "/coordinates";
    const auto add_point = [&](const Json& one, const std::string& where) {
      glm::dvec2 p{0};
      if (read_position(one, where, p)) feature.points.push_back(p);
    };
    const auto add_line = [&](const Json& one, const std::string& where) {
      feature.lines.push_back(read_line(one, where));
    };
    const auto add_polygon = [&](const Json& one, const std::string& where) {
      read_polygon(one, where, feature);
    };
    if (type == "Point") add_point(coordinates, at);
    if (type == "MultiPoint") each(coordinates, at, add_point);
    if (type == "LineString") add_line(coordinates, at);
    if (type == "MultiLineString") each(coordinates, at, add_line);
    if (type == "Polygon") add_polygon(coordinates, at);
    if (type == "MultiPolygon") each(coordinates, at, add_polygon);
  }

  const ImportOptions& options_;
  std::size_t positions_ = 0, features_ = 0;
  MapData data_;
  std::vector<Issue> issues_;
  bool is_stated_ = false, is_beyond_degrees_ = false, has_altitudes_ = false, is_plan_ = false;
};

/// Whether the lines of a text are features of their own, as GeoJSON text sequences (RFC 8142) and newline-delimited
/// GeoJSON have them.
bool has_features_as_lines(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return false;
  if (text[first] == record_separator) return true;
  const std::size_t end = text.find('\n', first), next = text.find_first_not_of(blanks, end);
  if (end == std::string_view::npos || next == std::string_view::npos) return false;
  const std::size_t last = text.find_last_not_of(blanks, end);
  return text[last] == '}' && text[next] == '{';
}

/// The features of such a text as one collection.
Result<Json> collection_of_lines(std::string_view text, const Job* job) {
  Json features = Json::array();
  int line = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view one = text.substr(at, end - at);
    at = end + 1;
    ++line;
    if (one.starts_with(record_separator)) one.remove_prefix(1);
    if (one.find_first_not_of(blanks) == std::string_view::npos) continue;
    Result<Json> feature = parse_json(one, {.job = job});
    if (!feature) {
      Error error = std::move(feature).error();
      for (Issue& issue : error.issues) {
        if (issue.line > 0) issue.line += line - 1;
      }
      return error;
    }
    features.push_back(std::move(*feature));
  }
  return Json{{"type", "FeatureCollection"}, {"features", std::move(features)}};
}

}  // namespace

int marks_of_geojson(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos || (text[first] != '{' && text[first] != record_separator)) return 0;
  if (text.find("\"FeatureCollection\"") != std::string_view::npos) return 100;
  const bool has_coordinates = text.find("\"coordinates\"") != std::string_view::npos;
  return has_coordinates && text.find("\"type\"") != std::string_view::npos ? 50 : 0;
}

Result<Imported> import_geojson(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of GeoJSON contains one map"))
    return *std::move(error);
  if (text.size() > largest_whole_file && !has_features_as_lines(text)) {
    const std::optional<ListedObjects> features = listed_objects(text, "features");
    // Errors outside of the features are found in the whole text, for their position.
    if (features && parse_json(features->shell, {.job = options.job}))
      return GeoJsonReader(options).read_in_parts(text, *features);
  }
  Result<Json> file = has_features_as_lines(text) ? collection_of_lines(text, options.job)
                                                  : parse_json(text, {.job = options.job});
  if (!file) return std::move(file).error();
  if (!file->is_object())
    return Error{Code::invalid, {{IssueKind::wrong_type, "", "expected an object of GeoJSON"}}};
  return GeoJsonReader(options).read(*file);
}

}  // namespace seedmesh
