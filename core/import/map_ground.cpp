// Areas, streets, waterways and trees of maps; see map_scene.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/import/map_rings.h"
#include "core/import/map_scene.h"
#include "core/import/map_values.h"

namespace seedmesh {
namespace {

using glm::dvec2;

/// Areas of one kind; kinds that come later lie on top.
struct AreaKind {
  const char* name;
  const char* color;
  double roughness;
};
constexpr std::array<AreaKind, 9> area_kinds{{{"farmland", "#b5ad72", 1},
                                              {"grass", "#7d9a5a", 1},
                                              {"forest", "#4f6b3c", 1},
                                              {"scrub", "#71844c", 1},
                                              {"sand", "#d8c796", 1},
                                              {"pitch", "#6f9a6d", 1},
                                              {"wetland", "#6d8577", 1},
                                              {"water", "#47718f", 0.15},
                                              {"paving", "#8f8d88", 0.95}}};

struct AreaRule {
  const char* key;
  const char* value;
  const char* kind;
};
constexpr std::array<AreaRule, 55> area_rules{{{"natural", "water", "water"},
                                               {"waterway", "riverbank", "water"},
                                               {"waterway", "dock", "water"},
                                               {"landuse", "reservoir", "water"},
                                               {"landuse", "basin", "water"},
                                               {"leisure", "swimming_pool", "water"},
                                               {"amenity", "fountain", "water"},
                                               {"natural", "wetland", "wetland"},
                                               {"natural", "sand", "sand"},
                                               {"natural", "beach", "sand"},
                                               {"natural", "shingle", "sand"},
                                               {"leisure", "pitch", "pitch"},
                                               {"leisure", "track", "pitch"},
                                               {"leisure", "stadium", "pitch"},
                                               {"natural", "wood", "forest"},
                                               {"landuse", "forest", "forest"},
                                               {"natural", "scrub", "scrub"},
                                               {"natural", "heath", "scrub"},
                                               {"landuse", "orchard", "scrub"},
                                               {"landuse", "vineyard", "scrub"},
                                               {"natural", "shrubbery", "scrub"},
                                               {"natural", "grassland", "grass"},
                                               {"natural", "grass", "grass"},
                                               {"natural", "meadow", "grass"},
                                               {"landuse", "grass", "grass"},
                                               {"landuse", "meadow", "grass"},
                                               {"landuse", "village_green", "grass"},
                                               {"landuse", "recreation_ground", "grass"},
                                               {"landuse", "cemetery", "grass"},
                                               {"amenity", "grave_yard", "grass"},
                                               {"landuse", "allotments", "grass"},
                                               {"landuse", "flowerbed", "grass"},
                                               {"landuse", "greenfield", "grass"},
                                               {"landuse", "greenery", "grass"},
                                               {"landuse", "plant_nursery", "grass"},
                                               {"leisure", "park", "grass"},
                                               {"leisure", "garden", "grass"},
                                               {"leisure", "golf_course", "grass"},
                                               {"leisure", "common", "grass"},
                                               {"leisure", "dog_park", "grass"},
                                               {"leisure", "playground", "grass"},
                                               {"leisure", "nature_reserve", "grass"},
                                               {"golf", "green", "grass"},
                                               {"golf", "fairway", "grass"},
                                               {"landuse", "farmland", "farmland"},
                                               {"landuse", "farm", "farmland"},
                                               {"landuse", "farmyard", "farmland"},
                                               {"place", "square", "paving"},
                                               {"amenity", "parking", "paving"},
                                               {"amenity", "bicycle_parking", "paving"},
                                               {"area:highway", "", "paving"},
                                               {"highway", "", "paving"},
                                               {"railway", "platform", "paving"},
                                               {"public_transport", "platform", "paving"},
                                               {"man_made", "pier", "paving"}}};

struct LineRule {
  const char* key;
  const char* value;
  double width;
  const char* color;
};
constexpr char road[] = "#6f6f72", minor_road[] = "#7f7e7c", footway[] = "#b3aa97", rail[] = "#5c564f",
               stream[] = "#47718f";
constexpr std::array<LineRule, 38> line_rules{
    {{"highway", "motorway", 11, road},      {"highway", "motorway_link", 6, road},
     {"highway", "trunk", 10, road},         {"highway", "trunk_link", 6, road},
     {"highway", "primary", 9, road},        {"highway", "primary_link", 6, road},
     {"highway", "secondary", 8, road},      {"highway", "secondary_link", 6, road},
     {"highway", "tertiary", 7, road},       {"highway", "tertiary_link", 5, road},
     {"highway", "unclassified", 6, road},   {"highway", "residential", 6, road},
     {"highway", "road", 6, road},           {"highway", "busway", 6, road},
     {"highway", "raceway", 8, road},        {"highway", "living_street", 5, minor_road},
     {"highway", "service", 4, minor_road},  {"highway", "pedestrian", 5, footway},
     {"highway", "track", 3, footway},       {"highway", "cycleway", 2, footway},
     {"highway", "bridleway", 2, footway},   {"highway", "footway", 2, footway},
     {"highway", "path", 1.5, footway},      {"highway", "steps", 2, footway},
     {"highway", "corridor", 2, footway},    {"railway", "rail", 3, rail},
     {"railway", "tram", 2.6, rail},         {"railway", "light_rail", 2.8, rail},
     {"railway", "narrow_gauge", 2.2, rail}, {"railway", "subway", 2.8, rail},
     {"railway", "funicular", 2.2, rail},    {"railway", "monorail", 1.5, rail},
     {"waterway", "river", 12, stream},      {"waterway", "canal", 10, stream},
     {"waterway", "stream", 2, stream},      {"waterway", "ditch", 1, stream},
     {"waterway", "drain", 1.5, stream},     {"waterway", "tidal_channel", 5, stream}}};
constexpr double lane_width = 3.25;

// Positions farther from the origin are cut off, metres.
constexpr double farthest = 150'000;
constexpr std::size_t most_points = 4096, most_items = 100'000;
// Metres: between trees of a row, and the heights that a tag may state.
constexpr double tree_distance = 8, least_tree = 0.5, tallest_tree = 120;

const AreaRule* area_rule(const MapTags& tags) {
  for (const AreaRule& rule : area_rules) {
    const std::string_view value = tags.get(rule.key);
    if (!value.empty() && (rule.value[0] == 0 || value == rule.value)) return &rule;
  }
  return nullptr;
}

const LineRule* line_rule(const MapTags& tags) {
  for (const LineRule& rule : line_rules) {
    if (tags.is(rule.key, rule.value)) return &rule;
  }
  return nullptr;
}

/// The key that gives the kind of a feature, for the list of those that are left out.
std::string kind_of(const MapTags& tags) {
  constexpr std::array<std::string_view, 23> keys{
      "building", "highway",          "railway",   "waterway", "natural",         "landuse",
      "leisure",  "amenity",          "barrier",   "power",    "man_made",        "shop",
      "tourism",  "historic",         "place",     "boundary", "aeroway",         "entrance",
      "office",   "public_transport", "emergency", "route",    "addr:housenumber"};
  for (const std::string_view key : keys) {
    const std::string_view value = tags.get(key);
    if (value.empty()) continue;
    const bool is_many = key == "shop" || key == "entrance" || key == "office" || key == "addr:housenumber";
    return is_many ? std::string(key) : std::string(key) + "=" + shortened(value, 30);
  }
  return "others";
}

class GroundWriter {
 public:
  explicit GroundWriter(MapConversion& map) : map_(map) {}

  void add(const MapFeature& feature) {
    const MapTags& tags = feature.tags;
    bool is_used = false;
    if (tags.is("natural", "tree_row")) {
      for (const MapRing& line : feature.lines) add_row(feature, line);
      is_used = !feature.lines.empty();
    } else if (tags.is("natural", "tree")) {
      for (const dvec2& p : feature.points) add_tree(feature, map_.local(p));
      is_used = !feature.points.empty();
    }
    if (!feature.lines.empty() && !is_used) is_used = add_lines(feature);
    if (!feature.polygons.empty() && !is_used) is_used = add_area(feature);
    // Bare nodes carry no information of their own.
    if (!is_used && !tags.all().empty()) ++map_.left_out[kind_of(tags)];
  }

  void finish() {
    for (auto& kind : by_kind_) {
      for (Json& area : kind) {
        if (map_.areas.size() < most_items) map_.areas.push_back(std::move(area));
      }
    }
  }

 private:
  bool is_below_ground(const MapFeature& feature) {
    const MapTags& tags = feature.tags;
    if (!tags.has("tunnel") && !tags.is("location", "underground")) return false;
    map_.warnings.add("a line or area below the ground is left out", feature.position);
    return true;
  }

  bool add_lines(const MapFeature& feature) {
    const MapTags& tags = feature.tags;
    const LineRule* rule = line_rule(tags);
    if (!rule) return false;
    if (is_below_ground(feature)) return true;
    if (tags.has("bridge")) map_.warnings.add("a bridge lies on the ground", feature.position);
    double width = rule->width;
    const auto stated = map_length(tags.get("width")), lanes = map_number(tags.get("lanes"));
    for (const std::string_view name : {"width", "lanes"}) {
      const bool is_read = name == "width" ? stated.has_value() : lanes.has_value();
      if (tags.get(name).empty() || is_read) continue;
      map_.warnings.add("\"" + shortened(tags.get(name), 40) + "\" is no value of " + std::string(name) +
                            "; it is left out",
                        feature.position);
    }
    if (stated && *stated >= 0.1 && *stated <= 500) {
      width = *stated;
    } else if (lanes && *lanes >= 1 && *lanes <= 20 && std::string_view(rule->key) == "highway") {
      width = *lanes * lane_width;
    }
    for (const MapRing& line : feature.lines) add_line(line, width, rule->color);
    return true;
  }

  void add_line(const MapRing& line, double width, const char* color) {
    Json points = Json::array();
    Json last;
    const auto flush = [&] {
      if (points.size() > 1 && map_.paths.size() < most_items)
        map_.paths.push_back({{"points", points}, {"width", width}, {"color", color}});
      points = Json::array();
    };
    for (const dvec2& p : line) {
      const dvec2 q = map_.local(p);
      if (std::abs(q.x) > farthest || std::abs(q.y) > farthest) {
        flush();
        last = nullptr;
        continue;
      }
      Json point = MapConversion::point(q);
      if (point == last) continue;
      if (points.size() == most_points) {
        flush();
        points.push_back(last);
      }
      points.push_back(point);
      last = std::move(point);
    }
    flush();
  }

  bool add_area(const MapFeature& feature) {
    const AreaRule* rule = area_rule(feature.tags);
    if (!rule) return false;
    if (is_below_ground(feature)) return true;
    std::size_t kind = 0;
    while (std::string_view(area_kinds[kind].name) != rule->kind) ++kind;
    for (const std::vector<MapRing>& polygon : feature.polygons) {
      const std::vector<PlanRing> rings = map_.outline(polygon, "an area", feature.position);
      if (rings.empty()) continue;
      const ValidPlans sound = valid_plans(rings, &map_.job);
      if (sound.has_crossing) {
        map_.warnings.add("an area crosses itself; it is left out in part or whole", feature.position);
      } else if (sound.is_divided) {
        map_.warnings.add("an area crosses itself; it is divided at the crossings", feature.position);
      }
      if (sound.lost_holes > 0)
        map_.warnings.add("a hole of an area crosses its edges; it is left out", feature.position);
      for (const Plan& plan : sound.plans) {
        Json area = {{"name", area_kinds[kind].name},
                     {"outline", map_.rings(plan)},
                     {"color", area_kinds[kind].color}};
        if (area_kinds[kind].roughness < 1) area["roughness"] = area_kinds[kind].roughness;
        by_kind_[kind].push_back(std::move(area));
      }
    }
    return true;
  }

  void add_row(const MapFeature& feature, const MapRing& line) {
    double left = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const dvec2 a = map_.local(line[i - 1]), b = map_.local(line[i]);
      const double length = glm::length(b - a);
      if (!(length > 0) || length > farthest) continue;
      for (; left <= length && trees_ < most_items; left += tree_distance)
        add_tree(feature, a + (b - a) * (left / length));
      left -= length;
    }
  }

  void add_tree(const MapFeature& feature, const dvec2& p) {
    if (std::abs(p.x) > farthest || std::abs(p.y) > farthest || ++trees_ > most_items) return;
    const bool is_needle = feature.tags.is("leaf_type", "needleleaved");
    Json tree = {{"at", MapConversion::point(p)}};
    const auto height = map_length(feature.tags.get("height"));
    if (height && *height >= least_tree && *height <= tallest_tree) {
      const double scale = *height / map_tree_height(is_needle);
      tree["scale"] = std::floor(scale * 1000 + 0.5) / 1000;
    }
    (is_needle ? map_.needleleaved : map_.broadleaved).push_back(std::move(tree));
    map_.reach = std::max({map_.reach, std::abs(p.x), std::abs(p.y)});
  }

  MapConversion& map_;
  std::array<std::vector<Json>, area_kinds.size()> by_kind_;
  std::size_t trees_ = 0;
};

}  // namespace

bool has_ground_tag(const MapTags& tags) {
  constexpr std::array<std::string_view, 14> keys{
      "natural", "landuse", "leisure",      "waterway", "highway", "amenity", "boundary",
      "place",   "railway", "area:highway", "golf",     "aeroway", "barrier", "admin_level"};
  // A building of a file of footprints may have an amenity, too; its other tags state that it is one.
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return tags.has(key); });
}

std::string_view map_key_of(std::string_view value, bool is_line) {
  if (is_line) {
    for (const LineRule& rule : line_rules) {
      if (value == rule.value) return rule.key;
    }
    return {};
  }
  // These are kinds of buildings, too.
  constexpr std::array<std::string_view, 3> doubtful{"farm", "farmyard", "stadium"};
  if (value.empty() || std::find(doubtful.begin(), doubtful.end(), value) != doubtful.end()) return {};
  for (const AreaRule& rule : area_rules) {
    const std::string_view key = rule.key;
    const bool is_land = key == "natural" || key == "landuse" || key == "leisure" || key == "waterway";
    if (is_land && value == rule.value) return key;
  }
  return {};
}

void add_ground(MapConversion& map, const MapData& data, const std::vector<bool>& is_building) {
  GroundWriter writer(map);
  for (std::size_t i = 0; i < data.features.size(); ++i) {
    if (i % 64 == 0) map.job.check();
    if (!is_building[i]) writer.add(data.features[i]);
  }
  writer.finish();
}

}  // namespace seedmesh
