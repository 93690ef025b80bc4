#include "core/import/map_scene.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/api.h"

namespace seedmesh {
namespace {

// Metres.
constexpr double largest_map = 100'000, margin = 10, least_ground = 40;
// Digits of the origin: a hundred-thousandth of a degree is about a metre.
constexpr double origin_digits = 1e5;
constexpr std::size_t most_points = 5000;
constexpr double most_work = 5e8;  ///< see MapConversion::outline_work
constexpr char ground_color[] = "#a3a08f";
constexpr int tree_variants = 3;

/// A light tree of Weber and Penn, with a height of about map_tree_height.
Json tree_model(bool is_needle) {
  Json leaf = {{"shape", is_needle ? "needles" : "cordate"}, {"color", is_needle ? "#2f5a3a" : "#5f8a3e"}};
  Json parameters = {{"model", "weber_penn"},
                     {"Shape", is_needle ? 0 : 1},
                     {"Levels", 2},
                     {"Scale", map_tree_height(is_needle)},
                     {"ScaleV", 1}};
  if (is_needle) {
    leaf.update({{"build", "cross"}, {"evergreen", true}});
    parameters.update({{"Leaves", 14}, {"sides", 4}});
  } else {
    parameters["range"] = 300;
  }
  parameters["leaf"] = std::move(leaf);
  return {{"generator", "tree"}, {"parameters", std::move(parameters)}};
}

void widen(std::optional<MapBounds>& bounds, const glm::dvec2& p) {
  if (!bounds) bounds = MapBounds{p, p};
  bounds->min = {std::min(bounds->min.x, p.x), std::min(bounds->min.y, p.y)};
  bounds->max = {std::max(bounds->max.x, p.x), std::max(bounds->max.y, p.y)};
}

/// Longitudes beyond the 180th meridian continue those before it, seen from the first position.
double unwrapped(double longitude, double first) {
  return first + (longitude - first) - 360 * std::floor((longitude - first + 180) / 360);
}

std::optional<MapBounds> bounds_of(const MapData& data) {
  std::optional<MapBounds> bounds;
  const auto add = [&](const glm::dvec2& p) {
    glm::dvec2 position = data.unit == MapUnit::web_mercator ? of_web_mercator(p) : p;
    if (bounds && data.unit != MapUnit::metres) position.x = unwrapped(position.x, bounds->min.x);
    widen(bounds, position);
  };
  for (const MapFeature& feature : data.features) {
    for (const glm::dvec2& p : feature.points) add(p);
    for (const MapRing& line : feature.lines) {
      for (const glm::dvec2& p : line) add(p);
    }
    for (const auto& polygon : feature.polygons) {
      for (const glm::dvec2& p : polygon[0]) add(p);
    }
  }
  return bounds;
}

Issue issue_of(IssueKind kind, std::string message) { return {kind, "", std::move(message)}; }

std::string list_of(const std::map<std::string, std::size_t>& counts) {
  std::vector<std::pair<std::string, std::size_t>> rows(counts.begin(), counts.end());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string list;
  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(rows.size(), most); ++i)
    list += (i == 0 ? "" : ", ") + rows[i].first + " (" + std::to_string(rows[i].second) + ")";
  if (rows.size() > most) list += ", and " + std::to_string(rows.size() - most) + " other kinds";
  return list;
}

/// A layer of trees at explicit positions.
void add_trees(Json& layers, bool is_needle, Json positions) {
  if (positions.empty()) return;
  layers.push_back({{"name", is_needle ? "needleleaved" : "broadleaved"},
                    {"model", tree_model(is_needle)},
                    {"variants", tree_variants},
                    {"scale", {0.7, 1.1}},
                    {"place", {{"method", "positions"}, {"positions", std::move(positions)}}}});
}

Json parameters_of(MapConversion& map) {
  const double size = std::max(2 * (map.reach + margin), least_ground);
  Json parameters = {{"ground", {{"size", std::ceil(size)}, {"color", ground_color}}}};
  const auto put = [&](const char* name, Json value) {
    if (!value.empty()) parameters[name] = std::move(value);
  };
  put("paths", std::move(map.paths));
  put("areas", std::move(map.areas));
  put("buildings", std::move(map.buildings));
  Json layers = Json::array();
  add_trees(layers, false, std::move(map.broadleaved));
  add_trees(layers, true, std::move(map.needleleaved));
  put("layers", std::move(layers));
  return parameters;
}

/// Chooses the origin: the middle of the map, on round figures.
Json set_origin(MapConversion& map, const glm::dvec2& middle) {
  const auto rounded = [](double value, double digits) { return std::floor(value * digits + 0.5) / digits; };
  if (map.unit == MapUnit::metres) {
    map.origin = {rounded(middle.x, 1), rounded(middle.y, 1)};
    if (map.origin != glm::dvec2(0)) {
      map.warnings.add("positions are metres from (" + number_text(map.origin.x) + ", " +
                           number_text(map.origin.y) + ") of the file's coordinates",
                       {});
    }
    return nullptr;
  }
  const double longitude = rounded(unwrapped(middle.x, 0), origin_digits);
  const double latitude = rounded(std::clamp(middle.y, -89.9, 89.9), origin_digits);
  map.projection.emplace(longitude, latitude);
  return {{"latitude", latitude}, {"longitude", longitude}, {"projection", map.projection->text()}};
}

}  // namespace

glm::dvec2 MapConversion::local(const glm::dvec2& position) const {
  if (!projection) return position - origin;
  return projection->forward(unit == MapUnit::web_mercator ? of_web_mercator(position) : position);
}

PlanRing MapConversion::local(const MapRing& ring) const {
  PlanRing made;
  made.reserve(ring.size());
  for (const glm::dvec2& p : ring) made.push_back(local(p));
  return made;
}

std::vector<PlanRing> MapConversion::outline(const std::vector<MapRing>& polygon, const char* what,
                                             const MapPosition& position) {
  std::size_t points = 0;
  for (const MapRing& ring : polygon) points += ring.size();
  if (points > most_points) {
    warnings.add(std::string(what) + " has more than 5000 points; it is left out", position);
    return {};
  }
  outline_work += static_cast<double>(points) * static_cast<double>(points);
  if (outline_work > most_work) {
    warnings.add(std::string(what) + " is left out, because the outlines before it have too many points",
                 position);
    return {};
  }
  std::vector<PlanRing> rings;
  for (const MapRing& ring : polygon) rings.push_back(local(ring));
  return rings;
}

Json MapConversion::point(const glm::dvec2& p) {
  const auto metres = [](double value) { return std::floor(value * 1000 + 0.5) / 1000 + 0.0; };
  return Json::array({metres(p.x), metres(-p.y)});
}

Json MapConversion::rings(const Plan& plan) {
  Json made = Json::array();
  for (const PlanRing& ring : plan.rings) {
    Json points = Json::array();
    for (const glm::dvec2& p : ring) {
      points.push_back(point(p));
      reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
    }
    made.push_back(std::move(points));
  }
  return made;
}

Result<Imported> scene_of_map(MapData data, std::string_view text, const ImportOptions& options) {
  const std::optional<MapBounds> bounds = data.bounds ? data.bounds : bounds_of(data);
  if (!bounds) return Error{Code::invalid, {issue_of(IssueKind::missing, "the map has no positions")}};
  const Job job = options.job ? options.job->for_estimate() : Job(0, Job::Options{});
  MapConversion map(data.warnings, job, data.unit);
  const Json georeference = set_origin(map, (bounds->min + bounds->max) / 2.0);
  const std::vector<bool> is_building = add_buildings(map, data);
  add_ground(map, data, is_building);
  if (map.reach > largest_map / 2) {
    return Error{Code::invalid,
                 {issue_of(IssueKind::out_of_range,
                           "the map reaches " + std::to_string(math::to_int64(map.reach / 1000)) +
                               " km from its middle; expected at most " +
                               std::to_string(math::to_int64(largest_map / 2000)) + " km")}};
  }
  const bool has_nothing = map.buildings.empty() && map.areas.empty() && map.paths.empty() &&
                           map.broadleaved.empty() && map.needleleaved.empty();
  if (has_nothing) {
    return Error{Code::invalid,
                 {issue_of(IssueKind::missing,
                           "found no building, street, water, green area or tree" +
                               (map.left_out.empty() ? std::string() : "; found " + list_of(map.left_out)))}};
  }
  if (!map.left_out.empty())
    map.warnings.add("features without a counterpart are left out: " + list_of(map.left_out), {});
  Imported imported;
  Json parameters = parameters_of(map);
  if (!georeference.is_null()) parameters["georeference"] = georeference;
  imported.request = {{"generator", "scene"}, {"parameters", std::move(parameters)}};
  imported.warnings = data.warnings.list(text);
  return imported;
}

}  // namespace seedmesh
