/// Lanes and tunnels of streets that grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/city/city.h"
#include "core/generators/city/surface.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

constexpr auto minor_tag = static_cast<std::uint32_t>(EdgeClass::minor);
constexpr auto lane_tag = static_cast<std::uint32_t>(EdgeClass::lane);

CityPlan plan_by(const CityParams& params, std::uint64_t seed = 1) {
  Job job(seed, Job::Options{});
  Result<CityPlan> plan = plan_of(params, job);
  EXPECT_TRUE(plan);
  return *std::move(plan);
}

CityParams town(double lane_share) {
  CityParams params;
  params.area.size = {1600, 1600};
  params.streets.lane_share = lane_share;
  return params;
}

std::map<std::uint32_t, double> lengths_by_class(const StreetGraph& graph) {
  std::map<std::uint32_t, double> lengths;
  for (const PlanarEdge& edge : graph.edges)
    lengths[edge.tag] += distance(graph.nodes[edge.from], graph.nodes[edge.to]);
  return lengths;
}

TEST(Lanes, AreTheirShareOfTheMinorStreetsAndMoveNone) {
  const CityPlan without = plan_by(town(0)), with = plan_by(town(0.4)), all = plan_by(town(1));
  EXPECT_EQ(with.graph.nodes, without.graph.nodes);
  ASSERT_EQ(with.graph.edges.size(), without.graph.edges.size());
  const auto before = lengths_by_class(without.graph), after = lengths_by_class(with.graph);
  EXPECT_FALSE(before.contains(lane_tag));
  EXPECT_NEAR(after.at(lane_tag) / before.at(minor_tag), 0.4, 0.06);
  EXPECT_NEAR(after.at(lane_tag) + after.at(minor_tag), before.at(minor_tag), 1);
  EXPECT_FALSE(lengths_by_class(all.graph).contains(minor_tag));
}

TEST(Lanes, AreWholeStreets) {
  const CityPlan plan = plan_by(town(0.4));
  const StreetGraph& graph = plan.graph;
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    if (graph.is_border[node] != 0 || graph.degree(node) != 2) continue;
    std::multiset<std::uint32_t> tags;
    for (const std::uint32_t half : graph.arms.of(node)) tags.insert(graph.edges[half / 2].tag);
    EXPECT_FALSE(tags.contains(lane_tag) && tags.contains(minor_tag)) << node;
  }
}

TEST(Lanes, StayLanesWhereTheShareGrows) {
  const CityPlan few = plan_by(town(0.2)), more = plan_by(town(0.6));
  for (std::uint32_t edge = 0; edge < few.graph.edges.size(); ++edge) {
    if (few.graph.edges[edge].tag != lane_tag) continue;
    EXPECT_EQ(more.graph.edges[edge].tag, lane_tag);
  }
}

/// Level ground with a ridge from south to north.
CityParams town_with_ridge(double tunnel_length) {
  CityParams params;
  params.area.size = {1200, 900};
  params.maps.height = "30 * exp(0 - ((x - 150) / 45) ^ 2)";
  params.streets.major_spacing = 300;
  params.streets.jitter = 0.05;
  params.streets.tunnel_length = tunnel_length;
  return params;
}

TEST(GrownTunnels, PassARidgeThatIsTooSteepForStreets) {
  std::size_t found = 0, shown = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    EXPECT_TRUE(plan_by(town_with_ridge(0), seed).graph.separated.empty());
    const CityPlan plan = plan_by(town_with_ridge(300), seed);
    Job job(seed, Job::Options{});
    const Surface surface(plan, 0, job);
    shown += surface.tunnels().all().size();
    found += plan.graph.separated.size();
    for (const SeparatedStreet& tunnel : plan.graph.separated) {
      EXPECT_EQ(tunnel.level, -1);
      ASSERT_EQ(tunnel.line.size(), 2U);
      EXPECT_LE(distance(tunnel.line[0], tunnel.line[1]), 30'000.01);
      // It passes the crest, which is at x = 150, and begins and ends at streets.
      EXPECT_LT((tunnel.line[0].x - 15'000.0) * (tunnel.line[1].x - 15'000.0), 0);
      for (const std::uint32_t node : {tunnel.from, tunnel.to}) EXPECT_GE(plan.graph.degree(node), 1U);
      const std::vector<ProfilePoint> floor = separated_profile(plan, tunnel);
      for (std::size_t k = 1; k < floor.size(); ++k) {
        const double run = distance(floor[k - 1].at, floor[k].at) / 100;
        EXPECT_LE(std::abs(floor[k].height - floor[k - 1].height) / run,
                  plan.classes[tunnel.tag].grade_limit + 1e-6);
      }
    }
  }
  EXPECT_GE(found, 6U);
  // Nearly all have a mesh: their ends meet straight borders, and no street crosses above where they are shallow.
  EXPECT_GE(static_cast<double>(shown), 0.8 * static_cast<double>(found));
}

TEST(GrownTunnels, DoNotPassValleys) {
  CityParams params = town_with_ridge(300);
  params.maps.height = "0 - 30 * exp(0 - ((x - 150) / 45) ^ 2)";
  for (std::uint64_t seed = 1; seed <= 4; ++seed) EXPECT_TRUE(plan_by(params, seed).graph.separated.empty());
}

}  // namespace
}  // namespace seedmesh::city
