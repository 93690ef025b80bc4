/// Settlements, roads and houses.
#include <gtest/gtest.h>

#include <cmath>

#include "core/generators/world/houses.h"
#include "core/generators/world/roads.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

constexpr Rectangle country{0, 0, 40000, 40000};

World settled() {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 500;
  params.settlements.density = 1;
  return world_of(params);
}

TEST(WorldRoads, HaveAGradeOfAtMostTenPercent) {
  const World world = settled();
  Job job = test_job();
  const auto roads = roads_near(world, country, 0, job);
  EXPECT_GT(roads.size(), 5U);
  for (const auto& road : roads) {
    for (std::size_t k = 1; k < road->points.size(); ++k) {
      const RoadPoint &a = road->points[k - 1], &b = road->points[k];
      const double run =
          std::sqrt((a.east - b.east) * (a.east - b.east) + (a.north - b.north) * (a.north - b.north));
      ASSERT_GT(run, 0);
      ASSERT_LE(std::abs(b.height - a.height), most_grade * run + 1e-9) << road->id;
    }
  }
}

/// A hill of 20 m on level ground: the road cuts it off by half at a grade of 10 %.
TEST(WorldRoads, CutHillsAndFillHollows) {
  std::vector<double> along, ground;
  for (int k = 0; k <= 40; ++k) {
    along.push_back(10.0 * k);
    ground.push_back(k == 20 ? 20 : 0);
  }
  const std::vector<double> heights = graded(along, ground);
  ASSERT_EQ(heights.size(), ground.size());
  EXPECT_DOUBLE_EQ(heights[20], 10.5);  // half of 1 m, 10 m beside it on the ground, and 20 m
  EXPECT_EQ(heights.front(), 0);
  EXPECT_EQ(heights.back(), 0);
  EXPECT_TRUE(graded({0, 100}, {0, 11}).empty()) << "ends too steep";
}

/// The same roads from any rectangle, whatever was asked before.
TEST(WorldRoads, AreTheSameFromEveryTile) {
  const World one = settled(), other = settled();
  Job job = test_job();
  const auto all = roads_near(one, country, 0, job);
  int met = 0;
  for (const auto& road : all) {
    const RoadPoint& p = road->points[road->points.size() / 2];
    for (const auto& twin : roads_near(other, {p.east, p.north, p.east + 1, p.north + 1}, 0, job)) {
      if (twin->id != road->id) continue;
      ++met;
      ASSERT_EQ(twin->points.size(), road->points.size());
      EXPECT_EQ(twin->points[3].height, road->points[3].height);
    }
  }
  EXPECT_EQ(met, static_cast<int>(all.size()));
}

TEST(WorldRoads, LeaveTheSamplesOfCoarseTilesUntouched) {
  const World world = settled();
  Job job = test_job();
  int touched = 0, near_roads = 0;
  for (const auto& road : roads_near(world, country, 0, job)) {
    for (std::size_t k = 0; k < road->points.size(); k += 3) {
      const RoadPoint& p = road->points[k];
      const double east = std::floor(p.east / works_spacing + 0.5) * works_spacing;
      const double north = std::floor(p.north / works_spacing + 0.5) * works_spacing;
      const Rectangle box{std::min(east, p.east), std::min(north, p.north), std::max(east, p.east),
                          std::max(north, p.north)};
      const Ground bare(world, box, job), built = Ground::with_roads(world, box, job);
      ASSERT_EQ(bare.height(east, north), built.height(east, north));
      ++near_roads;
      touched += bare.height(p.east, p.north) != built.height(p.east, p.north) ? 1 : 0;
    }
  }
  EXPECT_GT(near_roads, 100);
  EXPECT_GT(touched, near_roads / 2);
}

TEST(WorldHouses, StandApartAndBesideRoads) {
  const World world = settled();
  Job job = test_job();
  const std::vector<House> houses = houses_near(world, country, 0, job);
  EXPECT_GT(houses.size(), 20U);
  const Ground ground = Ground::with_roads(world, country, job);
  for (std::size_t i = 0; i < houses.size(); ++i) {
    EXPECT_GT(ground.at(houses[i].east, houses[i].north).road, std::min(houses[i].depth, houses[i].length));
    EXPECT_LE(std::max(houses[i].length, houses[i].depth), house_extent(world).across);
    for (std::size_t j = 0; j < i; ++j) {
      const double x = houses[i].east - houses[j].east, y = houses[i].north - houses[j].north;
      ASSERT_GE(std::sqrt(x * x + y * y),
                std::min(houses[i].depth, houses[i].length) + std::min(houses[j].depth, houses[j].length));
    }
  }
}

}  // namespace
}  // namespace seedmesh::world
