#include "core/generators/city/ribbons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/generators/city/city.h"
#include "core/generators/city/shape.h"
#include "core/pipeline.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

/// A small town whose classes of streets have random widths, so that wide lanes end at narrow streets.
CityParams town_of_random_widths(std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed);
  CityParams params;
  params.area.size = {rng.uniform(250, 600), rng.uniform(250, 600)};
  constexpr CityMethod methods[] = {CityMethod::growth, CityMethod::tensor, CityMethod::wards};
  params.streets.method = methods[rng.below(3)];
  params.streets.wards.count = 6;
  params.streets.wards.size = 60;
  params.streets.lane_share = rng.unit();
  params.streets.major_spacing = rng.uniform(120, 400);
  CityClasses& classes = params.streets.classes;
  classes.major.width = rng.uniform(5, 26);
  classes.minor.width = rng.uniform(3, 26);
  classes.lane.width = rng.uniform(3, 26);
  classes.major.sidewalk = rng.uniform(0.5, 5);
  classes.minor.sidewalk = rng.uniform(0.5, 5);
  classes.lane.sidewalk = rng.uniform(0.5, 5);
  return params;
}

TEST(Ribbons, HaveSimpleOutlinesWhereStreetsOfVeryDifferentWidthsMeet) {
  std::size_t plans = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Job job(seed, Job::Options{});
    const Result<CityPlan> plan = plan_of(town_of_random_widths(seed), job);
    if (!plan) continue;  // no space for the wards
    ++plans;
    double sum = 0;
    for (const Part& part : plan->parts) {
      sum += area_of(part.rings);
      if (part.kind != PartKind::junction && part.kind != PartKind::carriageway) continue;
      ASSERT_TRUE(is_simple(part.rings[0])) << name_of(part.kind) << ", seed " << seed;
      ASSERT_GT(doubled_area(part.rings[0]), 0) << name_of(part.kind) << ", seed " << seed;
    }
    ASSERT_NEAR(sum / area_of(plan->area), 1, 1e-9) << "seed " << seed;
  }
  EXPECT_GT(plans, 200U);
}

/// The outermost streets run around the area, nearer to its border than their sidewalks are wide.
TEST(Ribbons, StayInsideTheAreaAroundARasterThatReachesItsBorder) {
  CityParams params;
  params.area.size = {731, 854};
  params.streets.pattern = CityPattern::raster;
  params.streets.major_spacing = 388;
  params.streets.classes.major = {.width = 20.7, .sidewalk = 5.2};
  Job job(273086, Job::Options{});
  const Result<CityPlan> plan = plan_of(params, job);
  ASSERT_TRUE(plan);
  double sum = 0;
  for (const Part& part : plan->parts) {
    sum += area_of(part.rings);
    EXPECT_GT(area_of(part.rings), 0) << name_of(part.kind);
    for (const CmPoint& p : part.rings[0]) {
      ASSERT_LE(std::abs(p.x), 36'550) << name_of(part.kind);
      ASSERT_LE(std::abs(p.y), 42'700) << name_of(part.kind);
    }
  }
  EXPECT_NEAR(sum, 731 * 854, 1e-3);
}

/// The first street ends at the border, where its kerb ends between the corners of its sidewalk and its carriageway.
TEST(Ribbons, KeepBlocksOffTheKerbOfAStreetThatEndsAtTheBorder) {
  const Result<Request> request = read_request(
      R"({"generator": "city", "parameters": {"area": {"size": [501.57, 450.44]}, "streets": {"method": "given"},
        "lots": {"method": "none"}, "maps": {"water": "abs(x - 0.3 * y - 40) < 12"}, "given": {"streets": {
          "type": "FeatureCollection", "features": [
          {"type": "Feature", "properties": {"highway": "residential"}, "geometry": {"type": "LineString", "coordinates":
            [[-116.25, -224.39], [-123.62, -198.3], [-125.9, -171.76], [-123.08, -144.79], [-106.11, -49.46]]}},
          {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates":
            [[-116.25, -224.39], [-77.57, -225.89], [-38.92, -225.38], [-0.29, -222.86]]}},
          {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates":
            [[-123.08, -144.79], [-61.79, -149.37], [-0.48, -145.08]]}}]}}}})",
      Limits{});
  ASSERT_TRUE(request);
  const Result<std::string> text = derive(*request, {});
  ASSERT_TRUE(text);
  const Json answer = Json::parse(*text);
  std::vector<CmRing> blocks;
  CmRing kerbs;
  for (const Json& each : answer["plan"]["features"]) {
    const std::string kind = each["properties"]["kind"];
    if (kind != "block" && kind != "carriageway" && kind != "sidewalk") continue;
    CmRing ring;
    for (const Json& p : each["geometry"]["coordinates"][0])
      ring.push_back(rounded_cm({p[0].get<double>() * 100, p[1].get<double>() * 100}));
    ring.pop_back();
    if (kind == "block") {
      blocks.push_back(ring);
    } else {
      kerbs.insert(kerbs.end(), ring.begin(), ring.end());
    }
  }
  ASSERT_FALSE(blocks.empty());
  for (const CmRing& block : blocks) {
    for (const CmPoint& p : kerbs) {
      double least = 1e9;
      for (std::size_t i = 0; i < block.size(); ++i) {
        const CmPoint& next = block[(i + 1) % block.size()];
        least = std::min(least, distance_to_segment(in_cm(p), in_cm(block[i]), in_cm(next)));
      }
      EXPECT_TRUE(least < 0.01 || !is_inside(block, in_cm(p))) << p.x << ", " << p.y << ": " << least;
    }
  }
}

/// A shore with bays divides the land on one side of two streets into blocks between the same nodes.
TEST(Blocks, HaveDifferentIdsOnTheSameSideOfTheSameStreets) {
  const Result<Request> request = read_request(
      R"({"generator": "city", "seed": 1, "parameters": {
        "area": {"polygon": [[[334.48, -167.81], [-242.64, 238.07], [-34.56, -340.63]]]}, "streets": {"method": "given"},
        "terrain": {"generator": "terrain", "seed": 868, "parameters": {"algorithm": "fbm", "size": 1400, "amplitude": 21,
          "wavelength": 460, "water_level": -4}}, "maps": {"water": "y < 30 * sin(x) - 100"},
        "lots": {"method": "none"}, "buildings": {"rules": []},
        "given": {"streets": {"type": "FeatureCollection", "features": [
          {"type": "Feature", "properties": {"class": "lane"}, "geometry": {"type": "LineString", "coordinates":
            [[154, -117.2], [231, -111.6]]}},
          {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates":
            [[154, -236.7], [231, -111.6]]}}]}}}})",
      Limits{});
  ASSERT_TRUE(request);
  const Result<std::string> text = derive(*request, {});
  ASSERT_TRUE(text);
  const Json answer = Json::parse(*text);
  std::set<std::string> ids;
  std::size_t blocks = 0;
  for (const Json& each : answer["plan"]["features"]) {
    if (each["properties"]["kind"] != "block") continue;
    ++blocks;
    ids.insert(each["properties"]["id"]);
  }
  EXPECT_GE(blocks, 2U);
  EXPECT_EQ(ids.size(), blocks);
}

}  // namespace
}  // namespace seedmesh::city
