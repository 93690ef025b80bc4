/// No option is accepted and ignored: each one changes the plan, or the request gets a warning at its pointer.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/generators/child.h"
#include "core/generators/city/city.h"
#include "generated/params/city.h"
#include "tests/support/context.h"

namespace seedmesh::city {
namespace {

struct Answer {
  std::string plan;
  std::set<std::string> warned;
};

Answer answer_of(const Json& json) {
  IssueList errors;
  Job job(1, Job::Options{});
  const Generator& city = *find_generator(generators(), "city");
  const Generator::Params read = read_parameters(city, json, "", {job, generators()}, errors);
  for (const Issue& each : errors.issues()) ADD_FAILURE() << each.pointer << ": " << each.message;
  const Result<Json> derived = derive(*static_cast<const CityParams*>(read.get()), context_of(job));
  if (!derived) {
    ADD_FAILURE() << derived.error().issues[0].pointer << ": " << derived.error().issues[0].message;
    return {};
  }
  Answer answer;
  answer.plan = (*derived)["plan"].dump();
  for (const Json& each : (*derived)["warnings"]) answer.warned.insert(each["pointer"]);
  return answer;
}

struct Option {
  const char* pointer;
  Json value;
};

void expect_none_ignored(const std::string& name, const Json& base, const std::vector<Option>& options) {
  const Answer usual = answer_of(base);
  for (const Option& option : options) {
    const Json::json_pointer at(option.pointer);
    if (base.contains(at)) continue;
    Json changed = base;
    changed[at] = option.value;
    // A pattern for minor streets that they have already is no change.
    if (option.value == base.value(Json::json_pointer("/streets/pattern"), Json())) changed[at] = "raster";
    const Answer answer = answer_of(changed);
    const bool is_warned =
        std::any_of(answer.warned.begin(), answer.warned.end(), [&](const std::string& pointer) {
          return std::string(option.pointer).starts_with(pointer) && !usual.warned.contains(pointer);
        });
    EXPECT_NE(answer.plan != usual.plan, is_warned)
        << name << ": " << option.pointer << " = " << option.value.dump()
        << (is_warned ? " changes the plan in spite of its warning" : " has neither effect nor warning");
  }
}

/// Hills that streets can climb, a ridge that they cannot, and a river.
Json ground() {
  return {
      {"area", {{"size", {1200, 1000}}}},
      {"maps",
       {{"height", "8 * sin(x / 2) + 40 * exp(0 - ((x - 480) / 25) ^ 2)"}, {"water", "abs(y + 250) < 15"}}}};
}

Json given_streets() {
  const auto street = [](const char* kind, const Json& line) {
    return Json{{"type", "Feature"},
                {"properties", {{"class", kind}}},
                {"geometry", {{"type", "LineString"}, {"coordinates", line}}}};
  };
  return {{"type", "FeatureCollection"},
          {"features",
           {street("highway", {{-600, 0}, {0, 0}, {200, 0}}), street("lane", {{0, 0}, {0, 200}, {200, 200}}),
            street("minor", {{-100, 200}, {0, 200}})}}};
}

const std::vector<Option>& street_options() {
  static const std::vector<Option> all = {
      {"/streets/productions",
       Json::array({"R(del, rule) : del < 0 -> *",
                    "R(del, rule) > I(road, state) : state == SUCCEED { globalGoals(rule, "
                    "road) } -> +(angle) F(length) R(pDel0, pRule0) I(pRoad0, UNASSIGNED)",
                    "R(del, rule) > I(road, state) : state == FAILED -> *",
                    "I(road, state) : state == UNASSIGNED { localConstraints(road) } -> "
                    "I(road, state)",
                    "I(road, state) : state != UNASSIGNED -> *"})},
      {"/streets/pattern", "radial"},
      {"/streets/second_pattern", "radial"},
      {"/streets/minor_pattern", "radial"},
      {"/streets/angle", 20},
      {"/streets/centre", {60, 40}},
      {"/streets/major_spacing", 200},
      {"/streets/highway_spacing", 450},
      {"/streets/block", {70, 110}},
      {"/streets/fill", 0.5},
      {"/streets/length", 55},
      {"/streets/length_spread", 0.8},
      {"/streets/branch_probability", 0.95},
      {"/streets/bend", 110},
      {"/streets/noise", 40},
      {"/streets/jitter", 0.05},
      {"/streets/snap", 10},
      {"/streets/clearance", 50},
      {"/streets/dead_ends", 1},
      {"/streets/crossings", 1},
      {"/streets/lane_share", 0.5},
      {"/streets/roundabouts", 1},
      {"/streets/roundabout_radius", 25},
      {"/streets/bridge_length", 0},
      {"/streets/tunnel_length", 400},
      {"/streets/classes/highway/width", 30},
      {"/streets/classes/lane/width", 3},
      {"/streets/tensor/t_junctions", 1},
      {"/streets/wards/count", 12},
  };
  return all;
}

TEST(UnusedOptions, OfClassesThatNoStreetHasGiveWarnings) {
  Json base = {{"area", {{"size", {600, 600}}}}, {"streets", {{"method", "given"}}}};
  base["given"]["streets"] = given_streets();
  base["given"]["streets"]["features"].erase(0);  // the highway
  using Pointers = std::set<std::string>;
  const auto warned = [&](const Json& classes) {
    Json json = base;
    json["streets"]["classes"] = classes;
    return answer_of(json).warned;
  };
  EXPECT_EQ(warned({{"highway", {{"width", 30}}}}), Pointers{"/streets/classes/highway"});
  EXPECT_EQ(warned({{"major", {{"lanes", 3}}}}), Pointers{"/streets/classes/major"});
  EXPECT_EQ(warned({{"minor", {{"width", 9}}}, {"lane", {{"sidewalk", 1.5}}}}), Pointers{});
  EXPECT_EQ(warned({{"lane", {{"width", 5}, {"grade", 0.2}}}}), Pointers{"/streets/classes/lane/grade"});
  base["maps"]["height"] = "2 * sin(x)";
  EXPECT_EQ(warned({{"lane", {{"width", 5}, {"grade", 0.2}}}}), Pointers{});
}

TEST(UnusedOptions, OfStreetsThatGrowGiveWarnings) {
  for (const char* pattern : {"organic", "raster", "radial", "slope"}) {
    Json base = ground();
    base["streets"]["pattern"] = pattern;
    expect_none_ignored(pattern, base, street_options());
  }
}

TEST(UnusedOptions, OfMinorStreetsWithAPatternOfTheirOwnGiveWarnings) {
  for (const char* pattern : {"organic", "raster", "slope"}) {
    for (const char* minor : {"organic", "raster", "radial", "slope"}) {
      Json base = ground();
      base["streets"]["pattern"] = pattern;
      base["streets"]["minor_pattern"] = minor;
      expect_none_ignored(std::string(pattern) + " with " + minor, base, street_options());
    }
  }
}

TEST(UnusedOptions, OfOtherMethodsGiveWarnings) {
  for (const char* method : {"tensor", "wards", "given"}) {
    Json base = ground();
    base["streets"]["method"] = method;
    // The branches of these wards have no space for other angles, and no road of their gates meets the river.
    if (method == std::string("wards"))
      base["streets"] = {
          {"method", method}, {"noise", 10}, {"bridge_length", 300}, {"wards", {{"gates", 8}}}};
    if (method == std::string("given")) base["given"]["streets"] = given_streets();
    expect_none_ignored(method, base, street_options());
  }
}

TEST(UnusedOptions, OfLotsGiveWarnings) {
  for (const char* method : {"recursive", "offset", "skeleton", "burgage", "none"}) {
    Json base = {{"area", {{"size", {900, 800}}}}, {"lots", {{"method", method}}}};
    expect_none_ignored(method, base,
                        {{"/lots/area", {150, 500}},
                         {"/lots/width", 14},
                         {"/lots/offset_width", 40},
                         {"/lots/irregularity", 0.9},
                         {"/lots/corner_width", 12},
                         {"/lots/corner_angle", 80},
                         {"/lots/simplify", 0},
                         {"/lots/park_share", 0.5},
                         {"/buildings/variants", 50},
                         {"/buildings/detail", 1}});
  }
}

TEST(UnusedOptions, OfBuildingRulesGiveWarnings) {
  const Json own = {{"generator", "building"},
                    {"parameters", {{"rules", "attr floors = 2\nLot --> extrude(floors * 3)"}}}};
  const Json base = {{"area", {{"size", {500, 400}}}}};
  const auto warned = [&](const Json& rule) {
    Json json = base;
    json["buildings"]["rules"] = Json::array({rule});
    return answer_of(json).warned;
  };
  using Pointers = std::set<std::string>;
  EXPECT_EQ(warned({{"blueprint", "church"}, {"floors", {2, 2}}}), Pointers{"/buildings/rules/0/floors"});
  EXPECT_EQ(warned({{"building", own}, {"blueprint", "villa"}, {"floors", {2, 2}}}),
            (Pointers{"/buildings/rules/0/blueprint", "/buildings/rules/0/floors"}));
  EXPECT_EQ(warned({{"building", own}, {"floors_as", "floors"}, {"floors", {2, 2}}}), Pointers{});
  Json bare = base;
  bare["buildings"] = {{"rules", Json::array()}, {"variants", 5}, {"detail", 1}};
  EXPECT_EQ(answer_of(bare).warned, (Pointers{"/buildings/detail", "/buildings/variants"}));
  Json polygon = base;
  polygon["area"]["polygon"] = Json::array({Json::array({{0, 0}, {300, 0}, {300, 300}, {0, 300}})});
  EXPECT_EQ(answer_of(polygon).warned, Pointers{"/area/size"});
}

}  // namespace
}  // namespace seedmesh::city
