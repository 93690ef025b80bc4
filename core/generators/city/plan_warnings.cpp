#include "core/generators/city/plan_warnings.h"

#include <algorithm>
#include <glm/common.hpp>
#include <set>
#include <string>
#include <type_traits>

#include "core/generators/city/crowded_streets.h"
#include "core/generators/city/geojson.h"
#include "core/generators/city/house_placement.h"
#include "core/generators/city/landmarks.h"
#include "core/generators/city/missing_streets.h"
#include "core/generators/unused.h"
#include "generated/params/city.h"
#include "generated/params/city_unused.h"

namespace seedmesh::city {
namespace {

/// Whether the ground of the plan covers the box around its area.
bool is_covered(const CityPlan& plan) {
  glm::dvec2 low = in_metres(plan.area[0][0]), high = low;
  for (const CmPoint& p : plan.area[0]) {
    low = glm::min(low, in_metres(p));
    high = glm::max(high, in_metres(p));
  }
  return plan.landform->covers(low, high);
}

/// The centre of the streets is where growth starts. Tensor fields, slopes and given streets use it for radial minor
/// streets and for distances of rules alone.
bool uses_centre(const CityParams& params) {
  const CityStreets& streets = params.streets;
  const bool follows_slope =
      streets.method == CityMethod::growth && streets.pattern == CityPattern::slope && !params.maps.pattern;
  const bool grows = streets.method == CityMethod::growth || streets.method == CityMethod::wards;
  if (grows && !follows_slope) return true;
  const bool is_radial = streets.method != CityMethod::given && streets.minor_pattern &&
                         *streets.minor_pattern == CityMinorPattern::radial;
  const std::vector<CityBuildingRule>& rules = rules_of(params);
  return is_radial || std::any_of(rules.begin(), rules.end(), [](const CityBuildingRule& rule) {
           return rule.distance != CityBuildingRule{}.distance;
         });
}

/// Parameters without an effect for reasons that a condition of the schema cannot express.
void add_unused(const CityParams& params, const CityPlan& plan, std::vector<Warning>& warnings) {
  if (params.maps.height && plan.landform->has_expression() &&
      params.maps.height_range != CityMaps{}.height_range) {
    warnings.push_back(
        {"/maps/height_range", "`height_range` has no effect, since the height is an expression in metres"});
  }
  if (params.streets.centre != CityStreets{}.centre && !uses_centre(params)) {
    warnings.push_back({"/streets/centre",
                        "`centre` has no effect: streets are given or follow a tensor field, and no rule of "
                        "buildings has a distance"});
  }
  if (params.streets.method == CityMethod::wards && !plan.graph.has_branches) {
    const auto warn = [&](const char* name) {
      warnings.push_back(
          {std::string("/streets/") + name,
           "`" + std::string(name) +
               "` has no effect: no street within a ward is long enough for branches; expected a "
               "smaller `length` and `clearance`, or larger wards"});
    };
    if (params.streets.branch_probability != CityStreets{}.branch_probability) warn("branch_probability");
    if (params.streets.noise != CityStreets{}.noise) warn("noise");
  }
  const std::vector<CityBuildingRule>& rules = rules_of(params);
  if (rules.empty() && params.buildings.variants != CityBuildings{}.variants)
    warnings.push_back({"/buildings/variants", "`variants` has no effect: there are no rules of buildings"});
  const bool has_blueprint =
      std::any_of(rules.begin(), rules.end(), [](const auto& rule) { return !rule.building; });
  if (!has_blueprint && params.buildings.detail != CityBuildings{}.detail)
    warnings.push_back({"/buildings/detail", "`detail` has no effect: no rule of buildings has a blueprint"});
}

/// Whether the width of a class has an effect without a street of the class: the space that growth keeps free depends
/// on the widest one.
bool keeps_space_for(EdgeClass kind, const CityParams& params) {
  const CityStreets& streets = params.streets;
  if (streets.method == CityMethod::given) return false;
  if (kind == EdgeClass::major || kind == EdgeClass::minor || params.given.given_footprints) return true;
  return kind == EdgeClass::highway && streets.highway_spacing > 0 && streets.method != CityMethod::wards;
}

/// Warns of classes that no street has, and of limits of grades on level ground.
void add_unused_classes(const CityParams& params, const CityPlan& plan, std::vector<Warning>& warnings) {
  std::set<std::string> names;  // of classes with streets
  bool has_ramps = false;
  for (const PlanarEdge& each : plan.graph.edges) names.insert(plan.classes[each.tag].name);
  for (const SeparatedStreet& each : plan.graph.separated) {
    names.insert(plan.classes[each.tag].name);
    has_ramps |= each.level != 0;
  }
  const auto check = [&](const char* name, EdgeClass kind, const auto& section) {
    const std::remove_cvref_t<decltype(section)> plain;
    const std::string pointer = std::string("/streets/classes/") + name;
    if (section == plain) return;
    if (!names.contains(name) && !keeps_space_for(kind, params)) {
      const auto is_known = [&](const Warning& each) { return each.pointer.starts_with(pointer); };
      if (std::none_of(warnings.begin(), warnings.end(), is_known))
        warnings.push_back({pointer, std::string("`") + name + "` has no effect: no street has this class"});
    } else if (section.grade != plain.grade && plan.heights.is_level() && !has_ramps) {
      warnings.push_back(
          {pointer + "/grade",
           "`grade` has no effect on level ground without bridges; expected a terrain or maps.height"});
    }
  };
  const CityClasses& classes = params.streets.classes;
  check("highway", EdgeClass::highway, classes.highway);
  check("major", EdgeClass::major, classes.major);
  check("minor", EdgeClass::minor, classes.minor);
  check("lane", EdgeClass::lane, classes.lane);
}

/// Whether all lines and rings are beside the box around the area.
bool is_beside_area(const std::vector<GeoFeature>& features, const std::vector<CmRing>& area) {
  glm::dvec2 low = in_cm(area[0][0]), high = low;
  for (const CmPoint& p : area[0]) {
    low = glm::min(low, in_cm(p));
    high = glm::max(high, in_cm(p));
  }
  const auto is_beside = [&](const CmRing& line) {
    glm::dvec2 least = in_cm(line[0]), most = least;
    for (const CmPoint& p : line) {
      least = glm::min(least, in_cm(p));
      most = glm::max(most, in_cm(p));
    }
    return least.x > high.x || least.y > high.y || most.x < low.x || most.y < low.y;
  };
  return std::all_of(features.begin(), features.end(), [&](const GeoFeature& each) {
    return std::all_of(each.lines.begin(), each.lines.end(), is_beside) &&
           std::all_of(each.polygons.begin(), each.polygons.end(),
                       [&](const Rings& rings) { return is_beside(rings[0]); });
  });
}

/// Warns of geometries without an effect.
void add_unused_geometries(const CityParams& params, const CityPlan& plan, std::vector<Warning>& warnings) {
  const auto add = [&](const GeoJson& value, GeoKind kind, const std::string& pointer) {
    std::vector<Issue> unused;  // the plan was made, so that there are none
    const std::vector<GeoFeature> features = features_of(value, kind, pointer, {unused, &warnings});
    if (!features.empty() && is_beside_area(features, plan.area)) {
      warnings.push_back(
          {pointer, "all of it is outside of the area; expected metres from the origin of the area"});
    }
  };
  const auto add_map = [&](const MapValue& value, const std::string& pointer) {
    if (const auto* polygons = std::get_if<GeoJson>(&value)) add(*polygons, GeoKind::polygons, pointer);
  };
  if (params.given.given_streets) add(*params.given.given_streets, GeoKind::lines, "/given/streets");
  if (params.given.given_water) add(*params.given.given_water, GeoKind::polygons, "/given/water");
  if (params.given.given_footprints)
    add(*params.given.given_footprints, GeoKind::polygons, "/given/footprints");
  add_map(params.maps.density, "/maps/density");
  if (params.maps.water) add_map(*params.maps.water, "/maps/water");
  if (params.maps.obstacles) add_map(*params.maps.obstacles, "/maps/obstacles");
  if (params.maps.pattern) add_map(*params.maps.pattern, "/maps/pattern");
  if (params.maps.height) add_map(*params.maps.height, "/maps/height");
  for (std::size_t i = 0; i < params.maps.zones.size(); ++i)
    add_map(params.maps.zones[i].area, "/maps/zones/" + std::to_string(i) + "/area");
}

}  // namespace

std::vector<Warning> plan_warnings(const CityParams& params, const CityPlan& plan, const Job& job) {
  std::vector<Warning> warnings = warnings_of(unused_parameters(params));
  add_unused(params, plan, warnings);
  add_unused_classes(params, plan, warnings);
  add_unused_geometries(params, plan, warnings);
  std::vector<CrossSection> sections = classes_of(params);
  std::vector<Issue> issues;  // the plan was made, so that there are none
  const std::vector<GivenLine> lines = given_lines(params, sections, issues);
  for (Warning& each : missing_streets(lines, plan)) warnings.push_back(std::move(each));
  for (Warning& each : crowded_streets(lines, plan, job)) warnings.push_back(std::move(each));
  if (!is_covered(plan)) {
    warnings.push_back(
        {"/terrain",
         "the terrain is smaller than the area; beyond its border the ground has the height of the border"});
  }
  for (Warning& each : landmark_warnings(plan)) warnings.push_back(std::move(each));
  const std::vector<SeparatedStreet>& separated = plan.graph.separated;
  const bool has_tunnel = std::any_of(separated.begin(), separated.end(),
                                      [](const SeparatedStreet& each) { return each.level < 0; });
  if (has_tunnel && plan.heights.is_level()) {
    warnings.push_back(
        {"/given/streets", "tunnels below level ground have no mesh; expected a terrain or maps.height"});
  }
  return warnings;
}

void warn_of_unused_surfaces(const CityParams& params, Model& model) {
  for (std::size_t i = 0; i < params.surfaces.size(); ++i) {
    const std::string_view name = text_of(params.surfaces[i].material);
    const auto has_name = [&](const Material& material) { return material.name == name; };
    if (std::any_of(model.materials.begin(), model.materials.end(), has_name)) continue;
    model.warnings.push_back(
        {"/surfaces/" + std::to_string(i), "this city has no surface \"" + std::string(name) + "\""});
  }
}

}  // namespace seedmesh::city
