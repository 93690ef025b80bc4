/// Rivers and the ground beside them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/generators/world/ground.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

std::vector<WorldParams> lands() {
  WorldParams plain;
  plain.water.rivers = 1;
  WorldParams high = mountains_with_woods();
  high.relief.sea = false;
  WorldParams terraces = mountains_with_woods();
  terraces.relief.terraces = 0.6;
  return {plain, mountains_with_woods(), high, terraces};
}

struct Banks {
  int seen = 0, low = 0;
  double lowest = 0;  ///< of the ground above the water
};

/// Both banks of a river at each second point, up to 60 m from the water.
void look_at_banks(const World& world, const River& river, Job& job, Banks& banks) {
  for (std::size_t k = 1; k + 1 < river.points.size(); k += 2) {
    const RiverPoint &a = river.points[k - 1], &p = river.points[k], &b = river.points[k + 1];
    const double x = b.east - a.east, y = b.north - a.north, length = std::sqrt(x * x + y * y);
    const Ground ground(world, {p.east, p.north, p.east, p.north}, job, valley_reach + 100);
    for (const double side : {-1.0, 1.0}) {
      for (const double out : {2.0, 8.0, 25.0, 60.0}) {
        const double by = side * (p.width / 2 + out) / length;
        const double east = p.east - by * y, north = p.north + by * x;
        const GroundSample sample = ground.at(east, north);
        const bool is_coast = world.params.relief.sea &&
                              land_at(world, east, north).height.value < world.params.relief.sea_level + 1;
        const bool is_shore =
            std::any_of(ground.lakes().begin(), ground.lakes().end(), [&](const Lake& lake) {
              const double dx = east - lake.east, dy = north - lake.north,
                           away = std::sqrt(dx * dx + dy * dy);
              return away < shore_distance(lake, east, north, away) + 40;
            });
        if (is_coast || is_shore || sample.shore < 1.5) continue;  // other water
        // the water of the nearest reach: near the mouth of a tributary that is the main river
        double nearest = 1e12, water = 0;
        for (const Reach& reach : ground.reaches()) {
          const double px = east - reach.from.east, py = north - reach.from.north;
          const double t = std::clamp((px * reach.x + py * reach.y) * reach.by, 0.0, 1.0);
          const double away = std::hypot(px - t * reach.x, py - t * reach.y);
          if (away >= nearest) continue;
          nearest = away;
          water = reach.from.water + t * (reach.to.water - reach.from.water);
        }
        ++banks.seen;
        banks.low += sample.height < water - 0.05 ? 1 : 0;
        banks.lowest = std::min(banks.lowest, sample.height - water);
      }
    }
  }
}

/// Rivers of four regions of each land.
TEST(WorldRivers, LieBetweenBanksThatAreNotLowerThanTheirWater) {
  int number = 0;
  for (const WorldParams& params : lands()) {
    const World world = world_of(params);
    Job job = test_job();
    Banks banks;
    for (std::int64_t n = 0; n < 4; ++n) {
      for (const River& river : region_at(world, {n % 2, n / 2}, job)->rivers)
        look_at_banks(world, river, job, banks);
    }
    EXPECT_GT(banks.seen, 2000);
    EXPECT_LE(banks.low, banks.seen / 500)
        << "land " << number << ": " << banks.low << " of " << banks.seen << ", by " << banks.lowest;
    ++number;
  }
}

/// A tributary that is higher than the valley of its main river would stand on a dyke.
TEST(WorldRivers, MeetTheWaterThatTheyFlowInto) {
  for (const WorldParams& params : lands()) {
    const World world = world_of(params);
    Job job = test_job();
    int met = 0;
    for (std::int64_t n = 0; n < 9; ++n) {
      const auto region = region_at(world, {n % 3 - 1, n / 3 - 1}, job);
      for (const River& river : region->rivers) {
        const RiverPoint& mouth = river.points.back();
        for (const Lake& lake : region->lakes) {
          if (lake.id != river.into) continue;
          EXPECT_EQ(mouth.water, lake.level);
        }
        for (const River& other : region->rivers) {
          if (other.id != river.into) continue;
          const auto there = std::find_if(other.points.begin(), other.points.end(), [&](const RiverPoint& p) {
            return p.east == mouth.east && p.north == mouth.north;
          });
          ASSERT_NE(there, other.points.end());
          EXPECT_EQ(there->water, mouth.water);
          ++met;
        }
      }
    }
    EXPECT_GT(met, 50);
  }
}

}  // namespace
}  // namespace seedmesh::world
