/// Villages: lanes, houses, churches and farms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/generators/world/houses.h"
#include "core/generators/world/lanes.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

WorldParams settled_land() {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 250;
  params.settlements.density = 1;
  params.settlements.towns.share = 0;  // towns have tests of their own
  return params;
}

std::vector<std::shared_ptr<const Site>> sites_of(const World& world, Job& job) {
  return sites_near(world, {0, 0, 60000, 60000}, 0, job);
}

/// A position in the plan of a house, by shares from -1 to 1 of its sides.
std::pair<double, double> position_in(const House& h, double u, double v) {
  return {h.east + u * h.length * h.x - v * h.depth * h.y, h.north + u * h.length * h.y + v * h.depth * h.x};
}

bool contains(const House& h, double east, double north) {
  const double x = east - h.east, y = north - h.north;
  return std::abs(x * h.x + y * h.y) < h.length && std::abs(y * h.x - x * h.y) < h.depth;
}

TEST(WorldVillages, HaveHousesThatDoNotMeetAndStandBesideRoads) {
  const World world = world_of(settled_land());
  Job job = test_job();
  int houses = 0, churches = 0, barns = 0, large = 0;
  for (const auto& site : sites_of(world, job)) {
    const auto plan = plan_of(world, *site, job);
    const double reach = farm_reach * site->radius + 60;
    const Ground ground = Ground::with_roads(
        world, {site->east - reach, site->north - reach, site->east + reach, site->north + reach}, job);
    large += site->radius > 100 ? 1 : 0;
    for (const House& house : plan->houses) {
      ++houses;
      churches += house.kind == House::church ? 1 : 0;
      barns += house.kind == House::barn ? 1 : 0;
      EXPECT_LE(house.ridge, house.top);
      EXPECT_GT(house.eaves, house.low);
      for (double u = -1; u <= 1; u += 0.25) {
        for (double v = -1; v <= 1; v += 0.5) {
          const auto [east, north] = position_in(house, u, v);
          EXPECT_GE(ground.at(east, north).height, house.low);
          EXPECT_GT(ground.at(east, north).road, 0);
          for (const House& other : plan->houses) {
            EXPECT_TRUE(&other == &house || !contains(other, east, north));
          }
        }
      }
    }
  }
  EXPECT_GT(houses, 20 * large);
  EXPECT_GT(churches, large / 2);
  EXPECT_LE(churches, static_cast<int>(sites_of(world, job).size()));
  EXPECT_GT(barns, large);
}

/// Measured at the points of lanes, whose first lies on a road.
TEST(WorldVillages, HaveLanesThatLeaveRoadsAndFollowTheGround) {
  const World world = world_of(settled_land());
  Job job = test_job();
  std::size_t lanes = 0, farms = 0;
  for (const auto& site : sites_of(world, job)) {
    const double reach = farm_reach * site->radius;
    const Rectangle box{site->east - reach, site->north - reach, site->east + reach, site->north + reach};
    const Ground bare(world, box, job);
    for (const Lane& lane : lanes_of(world, *site, job)->lanes) {
      ++lanes;
      farms += lane.leads_to_farm ? 1 : 0;
      for (std::size_t k = 1; k < lane.points.size(); ++k) {
        const RoadPoint &a = lane.points[k - 1], &b = lane.points[k];
        const double x = b.east - a.east, y = b.north - a.north;
        EXPECT_LE(std::abs(b.height - a.height), (most_grade + 1e-9) * std::sqrt(x * x + y * y));
        EXPECT_LE(std::abs(b.height - bare.height(b.east, b.north)), 1.5);
        EXPECT_GT(bare.at(b.east, b.north).shore, 20);
      }
    }
  }
  EXPECT_GT(lanes, 100U);
  EXPECT_GT(farms, 20U);
}

}  // namespace
}  // namespace seedmesh::world
