#include "core/generators/city/tensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/math.h"
#include "core/generators/city/city.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

Region square_region() {
  return region_of({{{-50'000, -50'000}, {50'000, -50'000}, {50'000, 50'000}, {-50'000, 50'000}}});
}

/// The angle between two lines in degrees, from 0 to 90.
double between(const dvec2& a, const dvec2& b) {
  const double cosine = std::abs(a.x * b.x + a.y * b.y) / (std::hypot(a.x, a.y) * std::hypot(b.x, b.y));
  return std::acos(std::min(1.0, cosine)) * 180 / math::pi;
}

TensorField field_of(const std::vector<CityTensorField>& fields) {
  CityStreets streets;
  streets.tensor.fields = fields;
  std::vector<Issue> issues;
  TensorField field(streets, square_region(), nullptr, issues);
  EXPECT_TRUE(issues.empty());
  return field;
}

TEST(TensorField, HasTheDirectionsOfItsGrids) {
  CityTensorField grid;
  grid.weight = 1000;
  for (const double angle : {-90.0, -47.0, 0.0, 12.0, 89.0, 135.0, 300.0}) {
    grid.angle = angle;
    const dvec2 wanted(std::cos(angle * math::pi / 180), std::sin(angle * math::pi / 180));
    // The weak grid below turns it by at most asin(0.05 / 1000) / 2 radians.
    EXPECT_LT(between(field_of({grid}).direction_at({1234, -777}), wanted), 0.002) << angle;
  }
}

TEST(TensorField, PointsAtTheCentreOfARadialField) {
  CityTensorField radial;
  radial.field_type = CityFieldType::radial;
  radial.position = {100, -50};
  radial.weight = 1000;
  const TensorField field = field_of({radial});
  for (int turn = 0; turn < 360; turn += 15) {
    const dvec2 ray(std::cos(turn * math::pi / 180), std::sin(turn * math::pi / 180));
    EXPECT_LT(between(field.direction_at(dvec2(10'000, -5'000) + ray * 4000.0), ray), 0.002);
  }
}

TEST(TensorField, AddsDirectionsAsTensorsAndNotAsAngles) {
  // The mean of 2 and 178 degrees is 0 and not 90.
  CityTensorField first, second;
  first.angle = 2;
  second.angle = 178;
  EXPECT_LT(between(field_of({first, second}).direction_at({0, 0}), {1, 0}), 1e-6);
}

TEST(TensorField, FollowsAPolylineNearItAndTheGridFarFromIt) {
  CityTensorField line;
  line.field_type = CityFieldType::polyline;
  line.points = {{-300, -300}, {300, 300}};
  line.size = 50;
  line.weight = 1000;
  const TensorField field = field_of({line});
  EXPECT_LT(between(field.direction_at({1000, 2000}), {1, 1}), 0.1);
  EXPECT_LT(between(field.direction_at({-30'000, 30'000}), {1, 0}), 1e-6);
}

TEST(TensorField, FollowsTheBorderOfAnAreaWithoutWater) {
  CityTensorField boundary;
  boundary.field_type = CityFieldType::boundary;
  boundary.weight = 1000;
  const TensorField field = field_of({boundary});
  EXPECT_LT(between(field.direction_at({49'000, 100}), {0, 1}), 0.01);
}

TEST(TensorField, NeedsTwoPointsOfAPolyline) {
  CityStreets streets;
  streets.tensor.fields.resize(2);
  streets.tensor.fields[1].field_type = CityFieldType::polyline;
  std::vector<Issue> issues;
  const TensorField field(streets, square_region(), nullptr, issues);
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].pointer, "/streets/tensor/fields/1/points");
}

TEST(PatternMap, BlendsTensorsByItsValue) {
  // Halfway between the directions 50 degrees (the raster) and 90 degrees (the ray) the mean of the doubled angles 100
  // and 180 degrees is 140 degrees, so that the direction is 70 degrees.
  Job job(1, Job::Options{});
  std::vector<Issue> issues;
  const auto map = FieldMap::read("0.5 + x / 400", "/maps/pattern", {0, 0}, {1, 1}, job, issues);
  ASSERT_TRUE(map);
  CityStreets streets;
  streets.pattern = CityPattern::raster;
  streets.second_pattern = CitySecondPattern::radial;
  streets.angle = 50;
  const TensorField field(streets, *map, nullptr, job.rng());
  const auto at = [](double degrees) {
    return dvec2(std::cos(degrees * math::pi / 180), std::sin(degrees * math::pi / 180));
  };
  EXPECT_LT(between(field.direction_at({0, 20'000}), at(70)), 2);
  EXPECT_LT(between(field.direction_at({-20'000, 20'000}), at(50)), 1e-6);
  EXPECT_LT(between(field.direction_at({20'000, 20'000}), at(45)), 2);
  EXPECT_EQ(field.organic_share_at({0, 0}), 0);
}

TEST(PatternMap, TurnsAnOrganicPatternByAtMostFortyDegrees) {
  Job job(5, Job::Options{});
  std::vector<Issue> issues;
  const auto map = FieldMap::read("(x > 0) / 2", "/maps/pattern", {0, 0}, {1, 1}, job, issues);
  ASSERT_TRUE(map);
  const TensorField field({}, *map, nullptr, job.rng());
  double most = 0;
  for (int x = -200; x < 0; ++x) {
    for (int y = -50; y < 50; ++y)
      most = std::max(most, between(field.direction_at({x * 1000.0, y * 1000.0}), {1, 0}));
  }
  EXPECT_LE(most, 40);
  EXPECT_GT(most, 20);
  EXPECT_EQ(field.organic_share_at({-100, 0}), 1);
  EXPECT_EQ(field.organic_share_at({100, 0}), 0.5);
}

/// The share of the length of streets in a half of the area that runs within 6 degrees of the axes.
double aligned_share(const StreetGraph& graph, bool is_east) {
  double all = 0, aligned = 0;
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (!graph.is_street(e)) continue;
    const dvec2 a = in_cm(graph.nodes[graph.edges[e].from]), b = in_cm(graph.nodes[graph.edges[e].to]);
    if ((a.x > 10'000) != is_east || (a.x < -10'000) == is_east) continue;
    const double off = between(b - a, {1, 0}), length = std::hypot(b.x - a.x, b.y - a.y);
    all += length;
    if (std::min(off, 90 - off) < 6) aligned += length;
  }
  return aligned / all;
}

TEST(PatternMap, GivesEachHalfItsPattern) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    CityParams params;
    params.area.size = {1200, 800};
    params.maps.pattern = "x > 0";
    params.streets.major_spacing = 150;
    Job job(seed, Job::Options{});
    const Result<CityPlan> plan = plan_of(params, job);
    ASSERT_TRUE(plan);
    EXPECT_GT(aligned_share(plan->graph, true), 0.85) << "the raster, seed " << seed;
    EXPECT_LT(aligned_share(plan->graph, false), 0.5) << "the organic half, seed " << seed;
  }
}

TEST(PatternMap, RefusesOtherMethodsAndEqualPatterns) {
  CityParams params;
  params.maps.pattern = "x + ";
  params.streets.method = CityMethod::wards;
  params.streets.pattern = CityPattern::slope;
  params.streets.second_pattern = CitySecondPattern::slope;
  Job job(1, Job::Options{});
  std::vector<std::string> pointers;
  for (const Issue& each : check(params, {job})) pointers.push_back(each.pointer);
  EXPECT_EQ(pointers,
            (std::vector<std::string>{"/maps/pattern", "/maps/pattern", "/streets/second_pattern"}));
}

CityPlan tensor_town(const std::vector<CityTensorField>& fields, double t_junctions, std::uint64_t seed,
                     double size = 1400) {
  CityParams params;
  params.area.size = {size, size};
  params.streets.method = CityMethod::tensor;
  params.streets.major_spacing = 200;
  params.streets.tensor.fields = fields;
  params.streets.tensor.t_junctions = t_junctions;
  // Major streets alone.
  params.streets.productions = {"R(del, rule) -> *", "I(road, state) -> *"};
  Job job(seed, Job::Options{});
  Result<CityPlan> plan = plan_of(params, job);
  EXPECT_TRUE(plan);
  return *std::move(plan);
}

TEST(TensorStreets, RunAlongOrAcrossTheField) {
  CityTensorField radial;
  radial.field_type = CityFieldType::radial;
  radial.weight = 100;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const StreetGraph graph = tensor_town({radial}, 0, seed).graph;
    int streets = 0;
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      if (!graph.is_street(e)) continue;
      const dvec2 a = in_cm(graph.nodes[graph.edges[e].from]), b = in_cm(graph.nodes[graph.edges[e].to]);
      const dvec2 middle = (a + b) / 2.0;
      if (std::hypot(middle.x, middle.y) < 15'000) continue;
      ++streets;
      const double off = between(b - a, middle);
      EXPECT_LT(std::min(off, 90 - off), 8) << "seed " << seed;
    }
    EXPECT_GT(streets, 200);
  }
}

TEST(TensorStreets, KeepTheirSpacingOnAGrid) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const CityPlan plan = tensor_town({}, 0, seed);
    double length = 0;
    for (std::uint32_t e = 0; e < plan.graph.edges.size(); ++e) {
      if (plan.graph.is_street(e))
        length +=
            distance(plan.graph.nodes[plan.graph.edges[e].from], plan.graph.nodes[plan.graph.edges[e].to]);
    }
    // Lines in two directions with spacings from 0.95 to twice that; 2 / spacing metres for each square metre.
    const double density = length / 100 / area_of(plan.area);
    EXPECT_LT(density, 2 / (0.95 * 200)) << "seed " << seed;
    EXPECT_GT(density, 2 / (1.95 * 200)) << "seed " << seed;
  }
}

TEST(TensorStreets, LoseArmsOfTheirShareOfCrossings) {
  const auto share_of_three = [](double t_junctions) {
    double three = 0, four = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const StreetGraph graph = tensor_town({}, t_junctions, seed, 3000).graph;
      for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
        if (graph.is_border[node] != 0) continue;
        three += graph.degree(node) == 3 ? 1 : 0;
        four += graph.degree(node) == 4 ? 1 : 0;
      }
    }
    return three / (three + four);
  };
  const double none = share_of_three(0), some = share_of_three(0.3), many = share_of_three(1);
  EXPECT_LT(none, 0.15);
  EXPECT_GT(some, none + 0.2);
  EXPECT_GT(many, some + 0.2);
}

}  // namespace
}  // namespace seedmesh::city
