#include "core/generators/city/roundabouts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/generators/city/city.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

CityPlan made(const CityParams& params, std::uint64_t seed) {
  Job job(seed, Job::Options{});
  Result<CityPlan> plan = plan_of(params, job);
  EXPECT_TRUE(plan);
  return *std::move(plan);
}

CityParams town_with_roundabouts() {
  CityParams params;
  params.area.size = {900, 800};
  params.streets.major_spacing = 200;
  params.streets.roundabouts = 1;
  return params;
}

TEST(Roundabouts, ReplaceJunctionsByRingsAroundAnIslandWithoutLots) {
  std::size_t rings = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const CityPlan plan = made(town_with_roundabouts(), seed);
    double sum = 0;
    for (const Part& part : plan.parts) sum += area_of(part.rings);
    ASSERT_NEAR(sum / area_of(plan.area), 1, 1e-9) << "seed " << seed;
    for (const CmPoint& p : plan.graph.ring_nodes) {
      const auto found = std::find(plan.graph.nodes.begin(), plan.graph.nodes.end(), p);
      ASSERT_NE(found, plan.graph.nodes.end()) << "seed " << seed;
      ASSERT_GE(plan.graph.degree(static_cast<std::uint32_t>(found - plan.graph.nodes.begin())), 2U);
    }
    for (std::size_t n = 0; n < plan.blocks.size(); ++n) {
      const Block& block = plan.blocks[n];
      const bool is_island = std::all_of(block.streets.begin(), block.streets.end(), [&](std::uint32_t edge) {
        return plan.graph.is_on_ring(plan.graph.edges[edge].from) &&
               plan.graph.is_on_ring(plan.graph.edges[edge].to);
      });
      if (!is_island) continue;
      ++rings;
      for (const Part& part : plan.parts) {
        ASSERT_TRUE(part.block != n || part.kind == PartKind::park) << "seed " << seed;
      }
    }
  }
  EXPECT_GT(rings, 20U);
}

TEST(Highways, RunThroughTheCentreAtTheirSpacing) {
  CityParams params;
  params.area.size = {1200, 1000};
  params.streets.major_spacing = 200;
  params.streets.highway_spacing = 600;
  for (const CityPattern pattern : {CityPattern::organic, CityPattern::radial}) {
    params.streets.pattern = pattern;
    const CityPlan plan = made(params, 3);
    double highways = 0, majors = 0;
    for (const PlanarEdge& edge : plan.graph.edges) {
      const double length = distance(plan.graph.nodes[edge.from], plan.graph.nodes[edge.to]) / 100;
      if (edge.tag == static_cast<std::uint32_t>(EdgeClass::highway)) highways += length;
      if (edge.tag == static_cast<std::uint32_t>(EdgeClass::major)) majors += length;
    }
    EXPECT_GT(highways, 1500) << static_cast<int>(pattern);
    EXPECT_GT(majors, highways) << static_cast<int>(pattern);
  }
}

TEST(Roundabouts, LeaveStreetsAloneWithoutAShare) {
  CityParams params = town_with_roundabouts();
  params.streets.roundabouts = 0;
  EXPECT_TRUE(made(params, 1).graph.ring_nodes.empty());
}

}  // namespace
}  // namespace seedmesh::city
