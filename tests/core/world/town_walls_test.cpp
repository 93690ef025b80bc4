/// Walls and squares of towns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/generators/world/houses.h"
#include "core/generators/world/town.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

WorldParams walled_land(double share) {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 250;
  params.settlements.density = 1;
  params.settlements.towns.share = 1;
  params.settlements.towns.walls = share;
  return params;
}

constexpr Rectangle country{0, 0, 40000, 40000};

/// Half of the plan of a block, turned: whether it holds a position.
bool holds(const House& h, double east, double north) {
  const double x = east - h.east, y = north - h.north;
  return std::abs(x * h.x + y * h.y) < h.length && std::abs(y * h.x - x * h.y) < h.depth;
}

bool is_fountain(const House& h, const Town& town) {
  return town.has_square && std::abs(h.east - town.square_east) < 0.01 &&
         std::abs(h.north - town.square_north) < 0.01;
}

/// Calls `body` with the site and the plan of streets and lots of each town.
template <class Body>
void each_town(const World& world, Job& job, const Body& body) {
  for (const auto& site : sites_near(world, country, 0, job)) {
    const auto town = town_of(world, *site, job);
    if (town->is_built()) body(*site, *town);
  }
}

TEST(WorldTownWalls, KeepOffRoadsAndHousesAndEncloseTheLots) {
  const World world = world_of(walled_land(1));
  Job job = test_job();
  std::size_t walled = 0, pieces = 0;
  each_town(world, job, [&](const Site& site, const Town& town) {
    const auto plan = plan_of(world, site, job);
    const double reach = site.radius + 60;
    const Ground ground = Ground::with_roads(
        world, {site.east - reach, site.north - reach, site.east + reach, site.north + reach}, job);
    std::vector<std::pair<double, double>> directions;  // angle and distance
    for (const House& wall : plan->walls) {
      if (is_fountain(wall, town)) continue;
      ++pieces;
      const double x = wall.east - site.east, y = wall.north - site.north;
      directions.emplace_back(std::atan2(y, x), std::hypot(x, y));
      for (const double u : {-0.9, 0.0, 0.9}) {
        const double east = wall.east + u * wall.length * wall.x,
                     north = wall.north + u * wall.length * wall.y;
        const GroundSample sample = ground.at(east, north);
        EXPECT_GT(sample.road, 0) << "a wall stands on a road";
        EXPECT_GT(sample.shore, 0) << "a wall stands in water";
        EXPECT_GT(sample.height, wall.low) << "a wall hangs above the ground";
        EXPECT_GT(wall.top, sample.height + 2);
        for (const House& house : plan->houses) EXPECT_FALSE(holds(house, east, north));
      }
    }
    walled += directions.empty() ? 0 : 1;
    for (const TownHouse& house : town.houses) {
      const double x = house.east - site.east, y = house.north - site.north, angle = std::atan2(y, x);
      for (const auto& [other, distance] : directions) {
        if (std::abs(other - angle) >= 0.02) continue;
        EXPECT_GT(distance, std::hypot(x, y)) << "a house outside of the wall";
      }
    }
  });
  EXPECT_GE(walled, 10U);
  EXPECT_GT(pieces, 60 * walled);
}

TEST(WorldTownWalls, StandAroundTheShareOfTownsThatIsAskedFor) {
  Job job = test_job();
  for (const auto& [share, low, high] : {std::array{0.0, 0.0, 0.0}, {0.5, 0.15, 0.85}}) {
    const World world = world_of(walled_land(share));
    double towns = 0, walled = 0;
    each_town(world, job, [&](const Site& site, const Town&) {
      towns += 1;
      walled += plan_of(world, site, job)->walls.size() > 2 ? 1 : 0;
    });
    EXPECT_GE(walled, low * towns);
    EXPECT_LE(walled, high * towns);
  }
}

TEST(WorldSquares, HaveNoHouseAndNoStreet) {
  const World world = world_of(walled_land(0));
  Job job = test_job();
  std::size_t towns = 0, squares = 0;
  each_town(world, job, [&](const Site& site, const Town& town) {
    ++towns;
    if (!town.has_square) return;
    ++squares;
    const double inside = 0.85 * square_radius;
    for (const House& house : plan_of(world, site, job)->houses) {
      for (int k = 0; k < 8; ++k) {
        const double turn = 0.7853981633974483 * k;
        EXPECT_FALSE(holds(house, town.square_east + inside * std::cos(turn),
                           town.square_north + inside * std::sin(turn)));
      }
      EXPECT_FALSE(holds(house, town.square_east, town.square_north));
    }
    for (const Lane& street : town.streets) {
      for (const RoadPoint& p : street.points)
        EXPECT_GT(std::hypot(p.east - town.square_east, p.north - town.square_north), inside);
    }
  });
  EXPECT_GE(2 * squares, towns) << "of " << towns << " towns, " << squares << " have a square";
}

}  // namespace
}  // namespace seedmesh::world
