// What the schema cannot say about a city.

#include "core/generators/city/city.h"
#include "core/generators/city/density.h"
#include "core/generators/city/footprints.h"
#include "core/generators/city/given.h"
#include "core/generators/city/house_placement.h"
#include "core/generators/city/house_requests.h"
#include "core/generators/city/landform.h"
#include "core/generators/city/productions.h"
#include "core/generators/city/tensor.h"
#include "core/geom/polygon/plan.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

constexpr std::size_t most_points = 5000;

void check_range(const std::array<double, 2>& range, const std::string& pointer, std::vector<Issue>& issues) {
  if (range[0] <= range[1]) return;
  issues.emplace_back(
      conflict_with({}), pointer,
      "found " + number_text(range[0]) + " to " + number_text(range[1]) + ", expected the least value first");
}

void check_area(const CityParams& params, const Job& job, std::vector<Issue>& issues) {
  if (params.area.polygon.empty()) return;
  std::vector<PlanRing> rings;
  std::size_t points = 0;
  for (const auto& ring : params.area.polygon) {
    PlanRing plan;
    for (const auto& p : ring) plan.emplace_back(p[0], p[1]);
    points += plan.size();
    rings.push_back(std::move(plan));
  }
  if (points > most_points) {
    issues.emplace_back(
        IssueKind::out_of_range, "/area/polygon",
        "found " + std::to_string(points) + " points, expected at most " + std::to_string(most_points));
    return;
  }
  for (const PlanDefect& each : defects_of(read_plan(std::move(rings)), &job)) {
    issues.emplace_back(IssueKind::invalid_value,
                        "/area/polygon/" + std::to_string(each.ring) + "/" + std::to_string(each.vertex),
                        each.message);
  }
}

void check_lots(const CityLots& lots, std::vector<Issue>& issues) {
  check_range(lots.area, "/lots/area", issues);
  // A lot is at most six times as long as it is wide, so that it has at least this area.
  if (lots.width * lots.width > lots.area[1]) {
    issues.emplace_back(conflict_with({"area"}), "/lots/width",
                        "found a least width of " + number_text(lots.width) +
                            " m; a square of this width has more than the greatest area of " +
                            number_text(lots.area[1]) + " m²");
  }
}

void check_surfaces(const CityParams& params, std::vector<Issue>& issues) {
  for (std::size_t i = 0; i < params.surfaces.size(); ++i) {
    for (std::size_t before = 0; before < i; ++before) {
      if (params.surfaces[i].material != params.surfaces[before].material) continue;
      issues.emplace_back(IssueKind::duplicate_key, "/surfaces/" + std::to_string(i) + "/name",
                          "found \"" + std::string(text_of(params.surfaces[i].material)) +
                              "\", which /surfaces/" + std::to_string(before) + " has already");
      break;
    }
  }
}

void check_rules(const CityParams& params, std::vector<Issue>& issues) {
  for (std::size_t i = 0; i < rules_of(params).size(); ++i) {
    const CityBuildingRule& rule = rules_of(params)[i];
    const std::string pointer = "/buildings/rules/" + std::to_string(i);
    check_range(rule.density, pointer + "/density", issues);
    check_range(rule.distance, pointer + "/distance", issues);
    check_range(rule.lot, pointer + "/lot", issues);
    check_range(rule.frontage, pointer + "/frontage", issues);
    check_range(rule.depth, pointer + "/depth", issues);
    check_range(rule.width, pointer + "/width", issues);
    const std::array<int, 2> floors = {rule.floors[0], rule.floors[1]};
    check_range({static_cast<double>(floors[0]), static_cast<double>(floors[1])}, pointer + "/floors",
                issues);
    const std::array<int, 2> taken = floors_of(text_of(rule.blueprint));
    if (rule.building) continue;
    if (taken[1] > 0 && (floors[0] < taken[0] || floors[1] > taken[1])) {
      issues.emplace_back(conflict_with({"blueprint"}), pointer + "/floors",
                          "found " + std::to_string(floors[0]) + " to " + std::to_string(floors[1]) +
                              " floors; the blueprint " + std::string(text_of(rule.blueprint)) + " has " +
                              std::to_string(taken[0]) + " to " + std::to_string(taken[1]));
    }
  }
}

void check_patterns(const CityParams& params, const Job& job, std::vector<Issue>& issues) {
  if (!params.maps.pattern) return;
  FieldMap::read(*params.maps.pattern, "/maps/pattern", {-1, -1}, {1, 1}, job, issues);
  const CityStreets& streets = params.streets;
  if (streets.method != CityMethod::growth) {
    issues.emplace_back(conflict_with({"streets/method"}), "/maps/pattern",
                        "found the method " + std::string(text_of(streets.method)) +
                            ", which has no patterns; expected the method growth");
  }
  if (second_pattern_of(streets) == streets.pattern) {
    issues.emplace_back(
        conflict_with({"pattern"}), "/streets/second_pattern",
        "found " + std::string(text_of(streets.pattern)) + ", which is the pattern; expected another one");
  }
}

}  // namespace

std::vector<Issue> check(const CityParams& params, const CheckContext& context) {
  std::vector<Issue> issues;
  check_surfaces(params, issues);
  check_area(params, context.job, issues);
  check_lots(params.lots, issues);
  check_rules(params, issues);
  check_house_requests(params, context, issues);
  const auto check_map = [&](const MapValue& value, const std::string& pointer) {
    FieldMap::read(value, pointer, {-1, -1}, {1, 1}, context.job, issues);
  };
  for (std::size_t i = 0; i < params.maps.zones.size(); ++i)
    check_map(params.maps.zones[i].area, "/maps/zones/" + std::to_string(i) + "/area");
  const StreetGrammar grammar(params.streets.productions, "/streets/productions", issues);
  check_map(params.maps.density, "/maps/density");
  if (params.maps.water) check_map(*params.maps.water, "/maps/water");
  if (params.maps.obstacles) check_map(*params.maps.obstacles, "/maps/obstacles");
  check_patterns(params, context.job, issues);
  check_landform(params, context.job, issues);
  given_water(params, issues);
  given_footprints(params, issues);
  std::vector<CrossSection> sections = classes_of(params);
  std::vector<Issue> of_streets;
  given_lines(params, sections, of_streets);
  issues.insert(issues.end(), of_streets.begin(), of_streets.end());
  if (params.streets.method == CityMethod::given && !params.given.given_streets)
    issues.emplace_back(missing_for({"streets/method"}), "/given/streets", "the method given needs streets");
  if (params.streets.method == CityMethod::wards && params.given.given_streets) {
    issues.emplace_back(conflict_with({"streets/method"}), "/given/streets",
                        "found given streets; the method wards lays out all streets");
  }
  return issues;
}

}  // namespace seedmesh::city
