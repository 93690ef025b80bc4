#include "core/generators/city/ribbons.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/generators/city/city.h"
#include "core/generators/city/shape.h"
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

}  // namespace
}  // namespace seedmesh::city
