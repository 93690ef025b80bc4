/// Options of a city whose effect has a closed form: maps as images, zones, cut corners, fronts, trees and highways.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/child.h"
#include "core/generators/city/city.h"
#include "core/generators/city/objects.h"
#include "core/generators/city/rings.h"
#include "generated/params/city.h"
#include "tests/support/context.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

/// An image of one black pixel in the west and one white pixel in the east.
const std::string black_and_white =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR4nGNg+A8AAQIBAEK+vGgAAAAASUVORK5CYII=";

CityParams params_of(const Json& json) {
  IssueList errors;
  Job job(1, Job::Options{});
  const Generator& city = *find_generator(generators(), "city");
  const Generator::Params read = read_parameters(city, json, "", {job, generators()}, errors);
  for (const Issue& each : errors.issues()) ADD_FAILURE() << each.pointer << ": " << each.message;
  return *static_cast<const CityParams*>(read.get());
}

CityPlan plan_with(const Json& json, std::uint64_t seed = 1) {
  Job job(seed, Job::Options{});
  Result<CityPlan> plan = plan_of(params_of(json), job);
  EXPECT_TRUE(plan);
  return *std::move(plan);
}

std::vector<std::string> warned_pointers(const Json& json) {
  Job job(1, Job::Options{});
  const Result<Json> answer = derive(params_of(json), context_of(job));
  std::vector<std::string> pointers;
  if (!answer) return pointers;
  for (const Json& each : (*answer)["warnings"]) pointers.push_back(each["pointer"]);
  return pointers;
}

TEST(HeightMap, IsTheRangeOfHeightsTimesTheBrightness) {
  const CityPlan plan = plan_with({{"area", {{"size", {400, 300}}}},
                                   {"maps", {{"height", black_and_white}, {"height_range", {10, 18}}}}});
  // The middles of the pixels are 100 m west and east of the origin; between them the brightness is linear.
  for (const auto& [east, height] :
       {std::pair{-200, 10}, {-100, 10}, {0, 14}, {50, 16}, {100, 18}, {200, 18}})
    EXPECT_NEAR(plan.landform->at(dvec2(east, 40)), height, 1e-6) << east;
}

TEST(HeightMap, RaisesTheInsideOfItsPolygons) {
  const Json square = {{"type", "Polygon"},
                       {"coordinates", {{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}, {-50, -50}}}}};
  const CityPlan plan =
      plan_with({{"area", {{"size", {400, 300}}}}, {"maps", {{"height", square}, {"height_range", {2, 5}}}}});
  EXPECT_EQ(plan.landform->at({0, 0}), 5);
  EXPECT_EQ(plan.landform->at({60, 0}), 2);
}

TEST(HeightMap, WarnsOfARangeBesideAnExpression) {
  Json city = {{"area", {{"size", {300, 300}}}}, {"maps", {{"height", "x / 50"}, {"height_range", {0, 8}}}}};
  const std::vector<std::string> pointers = warned_pointers(city);
  EXPECT_EQ(std::count(pointers.begin(), pointers.end(), "/maps/height_range"), 1);
  city["maps"]["height"] = black_and_white;
  EXPECT_TRUE(warned_pointers(city).empty());
}

TEST(Zones, CanBeExpressionsAndImages) {
  for (const std::string& area : {std::string("x > 0"), black_and_white}) {
    const CityPlan plan = plan_with(
        {{"area", {{"size", {600, 400}}}}, {"maps", {{"zones", {{{"zone", "east"}, {"area", area}}}}}}});
    std::size_t inside = 0;
    for (const Lot& lot : plan.lots) {
      const double east = in_metres(lot.corners[0]).x;
      if (std::abs(east) < 60) continue;
      EXPECT_EQ(lot.zone, east > 0 ? "east" : "") << east;
      inside += east > 0 ? 1 : 0;
    }
    EXPECT_GT(inside, 20U);
  }
}

TEST(CornerCut, TakesFourTrianglesFromEachSquareBlock) {
  Json city = {{"area", {{"size", {800, 800}}}},
               {"streets", {{"pattern", "raster"}, {"fill", 1}, {"block", {100, 100}}}},
               {"lots", {{"park_share", 0}}}};
  const CityPlan sharp = plan_with(city);
  city["lots"]["corner_width"] = 14;
  const CityPlan cut = plan_with(city);
  ASSERT_EQ(sharp.blocks.size(), cut.blocks.size());
  std::size_t compared = 0;
  for (std::size_t i = 0; i < cut.blocks.size(); ++i) {
    const Block &before = sharp.blocks[i], &after = cut.blocks[i];
    if (before.streets.size() != 4) continue;
    // The cut across a right angle is the hypotenuse of half a square: its area is a quarter of its square.
    EXPECT_NEAR(area_of(before.rings) - area_of(after.rings), 4 * 14 * 14 / 4.0, 0.5);
    ++compared;
  }
  EXPECT_GT(compared, 10U);
  double parts = 0;
  for (const Part& part : cut.parts) parts += area_of(part.rings);
  EXPECT_NEAR(parts, 800.0 * 800.0, 1e-6);
}

TEST(CornerCut, LeavesCornersThatAreWiderThanItsAngle) {
  Json city = {{"area", {{"size", {800, 800}}}},
               {"streets", {{"pattern", "raster"}, {"fill", 1}, {"block", {100, 100}}}}};
  const CityPlan sharp = plan_with(city);
  city["lots"] = {{"corner_width", 14}, {"corner_angle", 80}};
  const CityPlan cut = plan_with(city);
  ASSERT_EQ(sharp.blocks.size(), cut.blocks.size());
  for (std::size_t i = 0; i < cut.blocks.size(); ++i) EXPECT_EQ(sharp.blocks[i].rings, cut.blocks[i].rings);
}

TEST(Simplify, JoinsEdgesThatTurnByLessToOneFront) {
  // One block with five edges, two of which turn by 2 atan(0.2) = 22.6 degrees.
  const Json ring = {{-100, -60}, {0, -80}, {100, -60}, {100, 60}, {-100, 60}, {-100, -60}};
  Json city = {
      {"area", {{"size", {400, 400}}}},
      {"given",
       {{"streets",
         {{"type", "FeatureCollection"},
          {"features",
           {{{"type", "Feature"}, {"geometry", {{"type", "LineString"}, {"coordinates", ring}}}}}}}}}},
      {"streets", {{"method", "given"}}},
      {"lots", {{"method", "skeleton"}, {"area", {50, 100'000}}, {"park_share", 0}}}};
  for (const auto& [angle, lots] : {std::pair{22.0, 5U}, {23.5, 4U}}) {
    city["lots"]["simplify"] = angle;
    EXPECT_EQ(plan_with(city).lots.size(), lots) << angle;
  }
}

/// How many trees stand along streets of each class.
std::map<std::string, std::size_t> trees_by_class(const Json& json) {
  const CityParams params = params_of(json);
  const CityPlan plan = plan_with(json);
  Job job(1, Job::Options{});
  std::map<std::string, std::size_t> counts;
  for (const ObjectKind& kind : street_furniture(plan, params, job)) {
    if (kind.name != "trees") continue;
    for (const CityObject& each : kind.objects) ++counts[plan.class_of(plan.parts[each.part].street).name];
  }
  return counts;
}

TEST(StreetTrees, HaveTheSpacingOfTheClass) {
  Json city = {{"area", {{"size", {900, 900}}}}, {"furniture", {{"trees", {{"spacing", 10}, {"share", 1}}}}}};
  const auto usual = trees_by_class(city);
  ASSERT_GT(usual.at("major"), 100U);
  ASSERT_GT(usual.at("minor"), 100U);
  city["streets"]["classes"] = {{"minor", {{"trees", 0}}}, {"major", {{"trees", 5}}}};
  const auto changed = trees_by_class(city);
  EXPECT_FALSE(changed.contains("minor"));
  EXPECT_NEAR(static_cast<double>(changed.at("major")) / static_cast<double>(usual.at("major")), 2, 0.35);
  city.erase("furniture");
  EXPECT_GT(trees_by_class(city).at("major"), 100U);
}

TEST(TensorHighways, AreStreamlinesAtTheirSpacing) {
  const CityPlan plan =
      plan_with({{"area", {{"size", {3000, 3000}}}},
                 {"streets",
                  {{"method", "tensor"},
                   {"highway_spacing", 1000},
                   {"major_spacing", 250},
                   {"tensor", {{"t_junctions", 0}, {"fields", {{{"type", "grid"}, {"weight", 100}}}}}}}}});
  std::set<std::int32_t> east, north;  // lines, metres
  double length = 0;
  for (std::uint32_t edge = 0; edge < plan.graph.edges.size(); ++edge) {
    if (!plan.graph.is_street(edge) || plan.class_of(edge).name != "highway") continue;
    const dvec2 a = in_metres(plan.graph.nodes[plan.graph.edges[edge].from]),
                b = in_metres(plan.graph.nodes[plan.graph.edges[edge].to]);
    length += std::hypot(b.x - a.x, b.y - a.y);
    const bool is_east = std::abs(b.x - a.x) > std::abs(b.y - a.y);
    (is_east ? east : north).insert(static_cast<std::int32_t>(std::lround((is_east ? a.y : a.x) / 30)));
  }
  // Lines 620 m to 1,900 m apart: two to five of each direction, each through the whole area.
  for (const auto& lines : {east, north}) {
    EXPECT_GE(lines.size(), 2U);
    EXPECT_LE(lines.size(), 5U);
    for (auto line = lines.begin(); std::next(line) != lines.end(); ++line)
      EXPECT_GE((*std::next(line) - *line) * 30, 590);
  }
  EXPECT_NEAR(length / 3000, static_cast<double>(east.size() + north.size()), 0.5);
}

}  // namespace
}  // namespace seedmesh::city
