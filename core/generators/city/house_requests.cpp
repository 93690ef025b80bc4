#include "core/generators/city/house_requests.h"

#include <map>
#include <tuple>

#include "core/generators/child.h"
#include "core/generators/city/house_placement.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

/// The part of a pointer after `prefix`; empty if it does not begin with it.
std::string_view after(std::string_view pointer, std::string_view prefix) {
  return pointer.substr(0, prefix.size()) == prefix ? pointer.substr(prefix.size()) : std::string_view{};
}

Json base_of(const CityBuildingRule& rule, int detail) {
  Json base = Json::object();
  if (rule.building) {
    base = Json::parse(rule.building->parameters);
    base.erase("footprint");
  } else {
    base["blueprint"] = text_of(rule.blueprint);
    base["attributes"]["lod"] = detail;
  }
  for (const auto& [name, value] : rule.attributes)
    std::visit([&, &key = name](const auto& each) { base["attributes"][key] = each; }, value);
  return base;
}

}  // namespace

HouseRequests::HouseRequests(const CityParams& params) : params_(params) {
  for (const CityBuildingRule& rule : rules_of(params))
    bases_.push_back(base_of(rule, params.buildings.detail));
}

Child HouseRequests::of(const House& house) const {
  const CityBuildingRule& rule = rules_of(params_)[house.rule];
  Json body = bases_[house.rule];
  const double height = rule.building && body.contains("size") ? body["size"][1].get<double>() : 0;
  body["size"] = {house.width, height, house.depth};
  if (rule.building) {
    if (rule.floors_as) body["attributes"][*rule.floors_as] = house.floors;
    return {"building", rule.building->seed.value_or(0) + house.seed, canonical_text(body)};
  }
  const std::string_view blueprint = text_of(rule.blueprint);
  if (blueprint == "skyscraper") {
    body["attributes"]["height"] = house.floors * 3.8;
  } else if (floors_of(blueprint)[1] > 0) {
    body["attributes"]["floors"] = house.floors;
  }
  return {"building", house.seed, canonical_text(body)};
}

std::vector<SharedHouse> shared_houses(const CityPlan& plan, const CityParams& params) {
  const HouseRequests requests(params);
  std::vector<SharedHouse> houses;
  std::map<std::tuple<std::uint32_t, int, double, double, std::uint64_t>, std::size_t> by_house;
  std::map<std::pair<std::uint64_t, std::string>, std::size_t> by_request;
  for (std::uint32_t i = 0; i < plan.lots.size(); ++i) {
    if (!plan.lots[i].house) continue;
    const House& house = *plan.lots[i].house;
    const auto [at, is_new] =
        by_house.try_emplace({house.rule, house.floors, house.width, house.depth, house.seed}, houses.size());
    if (is_new) {
      Child request = requests.of(house);
      const auto [same, is_other] =
          by_request.try_emplace({*request.seed, request.parameters}, houses.size());
      if (is_other) houses.push_back({std::move(request), house.rule, {}});
      at->second = same->second;
    }
    houses[at->second].lots.push_back(i);
  }
  return houses;
}

void check_house_requests(const CityParams& params, const CheckContext& context, std::vector<Issue>& issues) {
  const Generator* generator = find_generator(context.generators, "building");
  const std::vector<CityBuildingRule>& rules = rules_of(params);
  const HouseRequests requests(params);
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const CityBuildingRule& rule = rules[i];
    const std::string pointer = "/buildings/rules/" + std::to_string(i);
    if (rule.building && rule.building->generator != "building") {
      if (!rule.building->generator.empty()) {
        issues.emplace_back(IssueKind::invalid_value, pointer + "/building/generator",
                            "found " + rule.building->generator + ", expected building");
      }
      continue;
    }
    if (!generator || (rule.attributes.empty() && !rule.floors_as)) continue;
    for (const int floors : {rule.floors[0], rule.floors[1]}) {
      House house;
      house.rule = static_cast<std::uint32_t>(i);
      house.floors = floors;
      house.width = house.depth = 10;
      IssueList found;
      read_parameters(*generator, Json::parse(requests.of(house).parameters), "", context, found);
      for (Issue& issue : found.take()) {
        const std::string name(after(issue.pointer, "/attributes/"));
        if (name.empty()) continue;
        issue.pointer = pointer;
        if (rule.floors_as == name) {
          issue.pointer += "/floors_as";
        } else {
          issue.pointer.append("/attributes/").append(name);
        }
        issues.push_back(std::move(issue));
      }
      if (!issues.empty()) break;
    }
  }
}

}  // namespace seedmesh::city
