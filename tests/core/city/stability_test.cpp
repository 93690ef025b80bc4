/// What stays when a request changes a little, and how fast a bad request is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/pipeline.h"
#include "core/schema/json.h"

namespace seedmesh {
namespace {

Request request_of(const Json& parameters, std::uint64_t seed) {
  const Json body = {{"generator", "city"}, {"seed", seed}, {"parameters", parameters}};
  Result<Request> request = read_request(body.dump(), Limits{});
  EXPECT_TRUE(request);
  return *std::move(request);
}

Json plan_of(const Json& parameters, std::uint64_t seed) {
  const Result<std::string> text = derive(request_of(parameters, seed), {});
  EXPECT_TRUE(text);
  return Json::parse(*text)["plan"]["features"];
}

std::string bytes_of(const Json& parameters, int threads) {
  Job::Options options;
  options.threads = threads;
  const Result<Product> product = produce(request_of(parameters, 4), options);
  EXPECT_TRUE(product);
  std::string bytes;
  for (const auto& slice : product->payload.pieces())
    bytes.append(reinterpret_cast<const char*>(slice.data()), slice.size());
  return bytes;
}

/// Streets by their lines, without regard to their direction and heights.
std::set<std::string> lines_of(const Json& features, double east = -1e9, double north = -1e9) {
  std::set<std::string> lines;
  for (const Json& each : features) {
    if (each["properties"]["kind"] != "street") continue;
    Json line = each["geometry"]["coordinates"];
    bool is_far = true;
    for (Json& p : line) {
      p = {p[0], p[1]};
      const double off_east = std::max(0.0, east - p[0].get<double>()),
                   off_north = std::max(0.0, north - p[1].get<double>());
      is_far &= east < -1e8 || std::hypot(off_east, off_north) > 300;
    }
    if (!is_far) continue;
    if (line.back() < line.front()) std::reverse(line.begin(), line.end());
    lines.insert(line.dump());
  }
  return lines;
}

double kept_share(const std::set<std::string>& before, const std::set<std::string>& after) {
  const auto kept = std::count_if(before.begin(), before.end(),
                                  [&](const std::string& each) { return after.contains(each); });
  return static_cast<double>(kept) / static_cast<double>(before.size());
}

const Json grown = Json::parse(R"({"area": {"size": [1600, 1600]}, "maps": {"density": "0.55"},
  "streets": {"pattern": "organic", "branch_probability": 0.4}, "lots": {"method": "none"}, "buildings": {"rules": []}})");

TEST(CityStability, GivesTheSameBytesWithOneTwoAndEightThreads) {
  const Json furnished =
      Json::parse(R"({"area": {"size": [500, 400]}, "furniture": {"lamps": {}, "trees": {}, "cars": {}},
    "parks": {}, "yards": {}, "chunks": {"size": 150}, "maps": {"water": "abs(y + 90) < 12"},
    "buildings": {"variants": 4, "landmarks": [{"model": {"preset": "temple"}, "position": [60, 60], "plot": "block"}]}})");
  const std::string one = bytes_of(furnished, 1);
  ASSERT_GT(one.size(), 100'000U);
  EXPECT_TRUE(one == bytes_of(furnished, 2));
  EXPECT_TRUE(one == bytes_of(furnished, 8));
}

TEST(CityStability, KeepsNearlyAllStreetsFarFromAQuarterThatBecomesDenser) {
  for (const std::uint64_t seed : {3U, 11U}) {
    Json denser = grown;
    denser["maps"]["density"] = "0.55 + 0.3 * (x > 200 && y > 200)";
    const auto far = lines_of(plan_of(grown, seed), 200, 200);
    ASSERT_GT(far.size(), 100U);
    EXPECT_GE(kept_share(far, lines_of(plan_of(denser, seed))), 0.95);
  }
}

// A third of the major streets is missing, which leaves large areas between the others. With seed 4, none of them
// reaches the centre.
TEST(CityStability, KeepsNearlyAllStreetsInLargeAreasWithoutMajorStreets) {
  const Json sparse = Json::parse(R"({"area": {"size": [1700, 1700]}, "maps": {"density": "0.7"},
    "streets": {"pattern": "organic", "major_spacing": 245, "length": 64, "bend": 115, "noise": 25, "snap": 13.2,
      "branch_probability": 0.3, "clearance": 27, "dead_ends": 0.58, "crossings": 0, "fill": 0.62},
    "lots": {"method": "none"}, "buildings": {"rules": []}})");
  for (const std::uint64_t seed : {4U, 9U, 37U}) {
    Json denser = sparse;
    denser["maps"]["density"] = "0.7 + 0.3 * (x > 170 && y > 170)";
    const auto far = lines_of(plan_of(sparse, seed), 170, 170);
    ASSERT_GT(far.size(), 500U) << seed;
    EXPECT_GE(kept_share(far, lines_of(plan_of(denser, seed))), 0.95) << seed;
  }
}

TEST(CityStability, KeepsMostStreetsAtASlightlyGreaterBranchProbability) {
  for (const std::uint64_t seed : {3U, 11U}) {
    Json more = grown;
    more["streets"]["branch_probability"] = 0.41;
    EXPECT_GE(kept_share(lines_of(plan_of(grown, seed)), lines_of(plan_of(more, seed))), 0.6);
  }
}

TEST(CityStability, MovesNoStreetForLotsAndNoLotForBuildingsAndFurniture) {
  Json town = grown;
  town["area"]["size"] = {700, 600};
  town["lots"] = Json::object();
  const auto geometry = [](const Json& features, const std::string& kind) {
    std::set<std::string> found;
    for (const Json& each : features) {
      if (each["properties"]["kind"] == kind) found.insert(each["geometry"].dump());
    }
    return found;
  };
  const Json before = plan_of(town, 7);
  Json lots = town, houses = town;
  lots["lots"] = {{"area", {300, 900}}, {"irregularity", 0.7}, {"method", "skeleton"}};
  houses["buildings"] = {{"rules", {{{"blueprint", "villa"}, {"front", 5}}}}, {"detail", 0}};
  houses["furniture"] = {{"lamps", Json::object()}};
  EXPECT_EQ(geometry(before, "street"), geometry(plan_of(lots, 7), "street"));
  EXPECT_NE(geometry(before, "lot"), geometry(plan_of(lots, 7), "lot"));
  EXPECT_EQ(geometry(before, "street"), geometry(plan_of(houses, 7), "street"));
  EXPECT_EQ(geometry(before, "lot"), geometry(plan_of(houses, 7), "lot"));
}

// Streets with cuts above 8 m are left out of the middle of this town, and a ridge road in the south-east loses its
// connection with the north-west.
TEST(CityOnHills, LinksPartsThatDeepStreetsConnected) {
  const Json hills =
      Json::parse(R"({"area": {"size": [700, 700]}, "streets": {"pattern": "slope", "major_spacing": 160},
    "terrain": {"generator": "terrain", "seed": 7,
      "parameters": {"algorithm": "fbm", "size": 900, "resolution": 97, "wavelength": 540, "amplitude": 30}},
    "lots": {"method": "none"}, "buildings": {"rules": []}})");
  bool is_in_north_west = false, is_in_south_east = false;
  std::map<std::string, std::string> network;  // by node: another node of its network
  const auto find = [&](std::string node) {
    while (network.contains(node) && network[node] != node) node = network[node];
    return node;
  };
  std::set<std::string> nodes;
  for (const Json& each : plan_of(hills, 7)) {
    const Json& properties = each["properties"];
    if (properties["kind"] != "street") continue;
    const Json& start = each["geometry"]["coordinates"][0];
    is_in_north_west |= start[0] < -200 && start[1] > 200;
    is_in_south_east |= start[0] > 200 && start[1] < -200;
    const std::string from = properties["from"], to = properties["to"];
    nodes.insert({from, to});
    network[find(from)] = find(to);
  }
  EXPECT_TRUE(is_in_north_west);
  EXPECT_TRUE(is_in_south_east);
  std::set<std::string> networks;
  for (const std::string& each : nodes) networks.insert(find(each));
  EXPECT_EQ(networks.size(), 1U);
}

// The ground is so steep that few pieces keep the grade limit of major streets.
const Json steep =
    Json::parse(R"({"area": {"size": [1000, 1000]}, "maps": {"density": "0.62"}, "lots": {"method": "none"},
  "terrain": {"generator": "terrain", "seed": 7, "parameters": {"algorithm": "fbm", "size": 1200, "resolution": 241,
    "wavelength": 700, "amplitude": 48, "iterations": 4}}, "buildings": {"rules": []},
  "streets": {"pattern": "slope", "major_spacing": 190, "length": 80, "branch_probability": 0.6, "dead_ends": 0.2,
    "classes": {"major": {"width": 12, "lanes": 3, "grade": 0.14}, "minor": {"width": 8, "grade": 0.2}}}})");

TEST(CityOnHills, KeepsNearlyAllStreetsFarFromAQuarterThatBecomesDenser) {
  for (const std::uint64_t seed : {8U, 12U, 33U}) {
    Json denser = steep;
    denser["maps"]["density"] = "0.62 + 0.3 * (x > 100 && y > 100)";
    const auto far = lines_of(plan_of(steep, seed), 100, 100);
    ASSERT_GT(far.size(), 150U);
    EXPECT_GE(kept_share(far, lines_of(plan_of(denser, seed))), 0.95) << seed;
  }
}

TEST(CityOnHills, HasStreetsInNearlyAllSquaresOf250Metres) {
  std::size_t squares = 0;
  for (const std::uint64_t seed : {4U, 9U, 29U, 34U}) {
    std::set<std::pair<int, int>> found;
    for (const Json& each : plan_of(steep, seed)) {
      if (each["properties"]["kind"] != "street") continue;
      for (const Json& p : each["geometry"]["coordinates"])
        found.emplace(static_cast<int>(std::floor(p[0].get<double>() / 250)),
                      static_cast<int>(std::floor(p[1].get<double>() / 250)));
    }
    squares += static_cast<std::size_t>(std::count_if(found.begin(), found.end(), [](const auto& each) {
      return each.first >= -2 && each.first < 2 && each.second >= -2 && each.second < 2;
    }));
  }
  EXPECT_GE(squares, 4 * 15U);
}

TEST(BadCities, AreRefusedWithinATenthOfASecondWithTheirPointers) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"area": {"size": [0, 500]}})", "/parameters/area/size/0"},
      {R"({"area": {"polygon": [[[0, 0], [500, 500], [500, 0], [0, 500]]]}})", "/parameters/area/polygon"},
      {R"({"lots": {"area": [800, 200]}})", "/parameters/lots/area"},
      {R"({"lots": {"area": [40, 90], "width": 60}})", "/parameters/lots/width"},
      {R"({"maps": {"density": "x +* 2"}})", "/parameters/maps/density"},
      {R"({"maps": {"density": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUg=="}})",
       "/parameters/maps/density"},
      {R"({"maps": {"zones": [{"zone": "a", "area": {"type": "Polygon", "coordinates": [[[0, 0], [1, 1]]]}}]}})",
       "/parameters/maps/zones/0"},
      {R"({"streets": {"method": "given"}, "given": {"streets": {"type": "FeatureCollection", "features": [
          {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[-200, 0], [200, 0]]}},
          {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0, -200], [0, 200]]}}]}}})",
       "/parameters/given/streets/features/1"},
      {R"({"furniture": {"cars": {"spacing": 2}}})", "/parameters/furniture/cars/spacing"},
      {R"({"furniture": {"lamps": {"models": [{"preset": "no_such_lamp"}]}}})",
       "/parameters/furniture/lamps/models/0"},
      {R"({"buildings": {"landmarks": [{"position": [0, 0]}]}})", "/parameters/buildings/landmarks/0"},
      {R"({"buildings": {"rules": [{"frontage": [40, 10]}]}})", "/parameters/buildings/rules/0/frontage"}};
  for (const auto& [parameters, pointer] : cases) {
    const std::string body = std::string(R"({"generator": "city", "parameters": )") + parameters + "}";
    const auto start = std::chrono::steady_clock::now();
    const Result<Request> request = read_request(body, Limits{});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    ASSERT_FALSE(request) << parameters;
    const auto& issues = request.error().issues;
    const auto points = [&, &wanted = pointer](const Issue& each) {
      return each.pointer.starts_with(wanted);
    };
    EXPECT_TRUE(std::any_of(issues.begin(), issues.end(), points))
        << parameters << ": " << issues.front().pointer;
    EXPECT_LT(took.count(), 0.1) << parameters;
  }
}

}  // namespace
}  // namespace seedmesh
