#include "core/generators/city/footprints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/city/city.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

/// A feature with a rectangle of the given extent, turned about its middle.
Json footprint(const glm::dvec2& middle, const glm::dvec2& size, double degrees, Json properties) {
  const math::SinCos turn = math::sincos_degrees(degrees);
  Json ring = Json::array();
  for (const glm::dvec2& sign : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}) {
    const glm::dvec2 p = sign * size / 2.0;
    ring.push_back({middle.x + p.x * turn.cos - p.y * turn.sin, middle.y + p.x * turn.sin + p.y * turn.cos});
  }
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "Polygon"}, {"coordinates", Json::array({ring})}}}};
}

CityParams city_of(Json features, IssueList& errors) {
  return read_city(
      {{"area", {{"size", {600, 500}}}},
       {"given", {{"footprints", {{"type", "FeatureCollection"}, {"features", std::move(features)}}}}}},
      "", errors);
}

TEST(GivenFootprints, AreClearOfStreetsAndOtherHouses) {
  std::size_t in_plan = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng draw(seed);
    Json features = Json::array();
    for (int n = 0; n < 24; ++n) {
      features.push_back(footprint({draw.uniform(-260, 260), draw.uniform(-210, 210)},
                                   {draw.uniform(6, 20), draw.uniform(6, 20)}, draw.uniform(0, 90),
                                   {{"floors", 2}}));
    }
    IssueList errors;
    const CityParams params = city_of(std::move(features), errors);
    ASSERT_TRUE(errors.take().empty());
    Job job(seed, Job::Options{});
    const Result<CityPlan> plan = plan_of(params, job);
    ASSERT_TRUE(plan);
    std::vector<Issue> issues;
    const std::vector<GivenFootprint> given = given_footprints(params, issues);
    ASSERT_EQ(given.size(), 24U);
    ASSERT_EQ(plan->landmarks.size(), 24U);
    const FootprintIndex index(given);
    for (std::uint32_t edge = 0; edge < plan->graph.edges.size(); ++edge) {
      if (!plan->graph.is_street(edge)) continue;
      const glm::dvec2 a = in_metres(plan->graph.nodes[plan->graph.edges[edge].from]),
                       b = in_metres(plan->graph.nodes[plan->graph.edges[edge].to]);
      const double half = plan->class_of(edge).width / 2;
      for (int k = 0; k <= 40; ++k)
        EXPECT_FALSE(index.is_near(a + (b - a) * (k / 40.0), half)) << "seed " << seed;
    }
    for (const Lot& lot : plan->lots) {
      in_plan += lot.landmark != no_index ? 1 : 0;
      if (!lot.house) continue;
      EXPECT_FALSE(index.is_near(lot.house->position, 0)) << "seed " << seed;
    }
  }
  EXPECT_GT(in_plan, 20U);
}

TEST(GivenFootprints, BecomeBuildingsOfTheirHeight) {
  IssueList errors;
  const CityParams params = city_of(Json::array({footprint({10, 20}, {8, 6}, 0, {{"height", 12.5}}),
                                                 footprint({90, 20}, {8, 6}, 0, Json::object())}),
                                    errors);
  std::vector<Issue> issues;
  const std::vector<Landmark> landmarks = landmarks_of(given_footprints(params, issues));
  ASSERT_EQ(landmarks.size(), 2U);
  EXPECT_EQ(landmarks[0].position, glm::dvec2(10, 20));
  const Json request = Json::parse(landmarks[0].request.parameters);
  EXPECT_EQ(request["footprint"], Json::parse("[[[-4,3],[4,3],[4,-3],[-4,-3]]]"));
  EXPECT_NE(request["rules"].get<std::string>().find("extrude(12.5)"), std::string::npos);
  EXPECT_NE(landmarks[1].request.parameters.find("extrude(9)"), std::string::npos);
}

TEST(GivenFootprints, AreRefusedWithThePointerOfTheirError) {
  IssueList errors;
  Json bent = footprint({0, 0}, {8, 6}, 0, {{"height", "tall"}});
  bent["geometry"]["coordinates"] = Json::parse("[[[0,0],[10,10],[10,0],[0,10],[0,0]]]");
  const CityParams params =
      city_of(Json::array({bent, footprint({90, 20}, {8, 6}, 0, {{"height", 0.5}})}), errors);
  std::vector<Issue> issues;
  given_footprints(params, issues);
  ASSERT_EQ(issues.size(), 3U);
  EXPECT_EQ(issues[0].pointer, "/given/footprints/features/0/properties/height");
  EXPECT_EQ(issues[1].pointer, "/given/footprints/features/0/geometry");
  EXPECT_EQ(issues[2].pointer, "/given/footprints/features/1/properties/height");
}

/// RFC 7946, section 3.1: a coordinates array may be empty, and the object then counts as null.
TEST(GivenFootprints, MayHaveNoCoordinates) {
  IssueList errors;
  Json features = Json::array();
  for (const char* geometry :
       {R"({"type":"Polygon","coordinates":[]})", R"({"type":"MultiPolygon","coordinates":[]})",
        R"({"type":"MultiPolygon","coordinates":[[]]})"})
    features.push_back({{"type", "Feature"}, {"geometry", Json::parse(geometry)}});
  features.push_back(footprint({0, 0}, {8, 6}, 0, Json::object()));
  const CityParams params = city_of(std::move(features), errors);
  ASSERT_TRUE(errors.empty());
  std::vector<Issue> issues;
  const std::vector<GivenFootprint> given = given_footprints(params, issues);
  EXPECT_TRUE(issues.empty());
  ASSERT_EQ(given.size(), 1U);
  EXPECT_EQ(given[0].pointer, "/given/footprints/features/3");
  EXPECT_EQ(landmarks_of(given).size(), 1U);
}

}  // namespace
}  // namespace seedmesh::city
