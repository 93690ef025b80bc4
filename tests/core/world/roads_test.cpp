/// Settlements, roads and houses.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

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

/// The graph of roads without the limit of length is connected: it contains the minimum spanning tree (Toussaint 1980).
/// So each settlement whose nearest neighbour is within that limit has an edge, and what is not reached is cut off
/// by the limit, by water or by grades.
TEST(WorldRoads, ReachEverySettlementThatIsNotCutOff) {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 0;
  params.relief.hills = 20;
  params.relief.land = 1;
  params.relief.gullies = 0;
  params.relief.sea = false;
  params.water.rivers = 0.3;
  params.settlements.density = 1;
  const World world = world_of(params);
  Job job = test_job();
  // roads between settlements of the country may lead through others around it
  constexpr double around = 20000;
  const auto sites = sites_near(world, country, around, job);
  const auto is_inside = [](const Site& site) {
    return site.east >= country.west && site.east <= country.east && site.north >= country.south &&
           site.north <= country.north;
  };
  std::map<std::string, std::size_t> number;
  std::vector<std::size_t> group(sites.size());
  for (std::size_t k = 0; k < sites.size(); ++k) {
    number[name_of(*sites[k])] = k;
    group[k] = k;
  }
  const auto root = [&](std::size_t k) {
    while (group[k] != k) k = group[k];
    return k;
  };
  for (const auto& road : roads_near(world, country, around, job)) {
    const std::string ends = road->id.substr(1);
    const std::size_t middle = ends.find('s', 1) - 1;
    const auto a = number.find(ends.substr(0, middle)), b = number.find(ends.substr(middle + 1));
    if (a != number.end() && b != number.end()) group[root(a->second)] = root(b->second);
  }
  // the same by Kruskal's rule: all pairs within the limit
  std::vector<std::size_t> possible(sites.size());
  for (std::size_t k = 0; k < sites.size(); ++k) possible[k] = k;
  const auto possible_root = [&](std::size_t k) {
    while (possible[k] != k) k = possible[k];
    return k;
  };
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double x = sites[i]->east - sites[j]->east, y = sites[i]->north - sites[j]->north;
      if (std::sqrt(x * x + y * y) <= params.roads.longest) possible[possible_root(i)] = possible_root(j);
    }
  }
  std::size_t reached = 0, wanted = 0;
  std::map<std::size_t, std::map<std::size_t, std::size_t>> parts;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    if (!is_inside(*sites[k])) continue;
    ++wanted;
    ++parts[possible_root(k)][root(k)];
  }
  EXPECT_GT(wanted, 20U);
  for (const auto& [land, groups] : parts) {
    std::size_t most = 0;
    for (const auto& [each, count] : groups) most = std::max(most, count);
    reached += most;
  }
  EXPECT_EQ(reached, wanted) << "settlements within the limit of each other are joined by roads";
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
  std::vector<House> houses = houses_near(world, country, 0, job);
  std::erase_if(houses, [](const House& house) { return house.kind == House::wall; });
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
