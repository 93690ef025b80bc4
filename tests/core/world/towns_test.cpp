/// Towns: their streets, houses and churches on the ground of the world.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/generators/city/plan.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/town.h"
#include "generated/params/city.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

WorldParams land_of_towns() {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 250;
  params.settlements.density = 1;
  params.settlements.towns.share = 1;
  return params;
}

constexpr Rectangle country{0, 0, 40000, 40000};

std::vector<std::shared_ptr<const Site>> towns_of(const World& world, Job& job) {
  std::vector<std::shared_ptr<const Site>> towns;
  for (const auto& site : sites_near(world, country, 0, job)) {
    if (town_of(world, *site, job)->is_built()) towns.push_back(site);
  }
  return towns;
}

Rectangle around(const Site& site, double reach) {
  return {site.east - reach, site.north - reach, site.east + reach, site.north + reach};
}

std::pair<double, double> position_in(const House& h, double u, double v) {
  return {h.east + u * h.length * h.x - v * h.depth * h.y, h.north + u * h.length * h.y + v * h.depth * h.x};
}

bool contains(const House& h, double east, double north) {
  const double x = east - h.east, y = north - h.north;
  return std::abs(x * h.x + y * h.y) < h.length - 0.01 && std::abs(y * h.x - x * h.y) < h.depth - 0.01;
}

double away(const Site& site, double east, double north) {
  return std::sqrt((east - site.east) * (east - site.east) + (north - site.north) * (north - site.north));
}

TileKey leaf_at(const World& world, double east, double north) {
  const auto tile = [&](double at) {
    return static_cast<std::int64_t>(std::floor((at + world.extent / 2) / leaf_side));
  };
  return {world.levels - 1, tile(east), tile(north)};
}

TEST(WorldTowns, HaveHousesOnTheGroundThatMeetNoStreetNoWaterAndNoOtherHouse) {
  const World world = world_of(land_of_towns());
  Job job = test_job();
  const auto towns = towns_of(world, job);
  EXPECT_GE(towns.size(), 10U);
  std::size_t houses = 0, churches = 0;
  for (const auto& site : towns) {
    const auto plan = plan_of(world, *site, job);
    const Ground ground = Ground::with_roads(world, around(*site, farm_reach * site->radius + 60), job);
    for (const House& house : plan->houses) {
      houses += away(*site, house.east, house.north) < site->radius ? 1U : 0U;
      churches += house.kind == House::church ? 1U : 0U;
      EXPECT_LE(house.top - house.floor, house_extent(world).up);
      EXPECT_LE(house.length * house.length + house.depth * house.depth,
                house_extent(world).across * house_extent(world).across);
      for (double u = -1; u <= 1; u += 0.5) {
        for (double v = -1; v <= 1; v += 0.5) {
          const auto [east, north] = position_in(house, u, v);
          const GroundSample sample = ground.at(east, north);
          EXPECT_GE(sample.height, house.low);
          EXPECT_LE(sample.height, house.floor + 0.25) << "between the samples of its floor";
          EXPECT_GT(sample.road, 0);
          EXPECT_GT(sample.shore, 0);
          EXPECT_GT(sample.height, world.params.relief.sea_level);
        }
      }
    }
    for (const House& house : plan->houses) {
      for (const House& other : plan->houses) {
        if (&other == &house || away(*site, house.east, house.north) > site->radius ||
            std::abs(house.east - other.east) > 30 || std::abs(house.north - other.north) > 30)
          continue;
        for (double u = -0.95; u <= 0.96; u += 0.475) {
          for (double v = -0.95; v <= 0.96; v += 0.475) {
            const auto [east, north] = position_in(house, u, v);
            EXPECT_FALSE(contains(other, east, north)) << east << ' ' << north;
          }
        }
      }
    }
  }
  EXPECT_GT(houses, 100 * towns.size());
  EXPECT_GT(2 * churches, towns.size());
}

/// The middle of a street is at the height of the ground, up to the bed below the surface and to crossings with others.
TEST(WorldTowns, HaveStreetsThatFollowTheGroundWithinTheTown) {
  const World world = world_of(land_of_towns());
  Job job = test_job();
  double greatest = 0;
  std::size_t points = 0, high = 0;
  for (const auto& site : towns_of(world, job)) {
    const Ground ground = Ground::with_roads(world, around(*site, site->radius + 60), job);
    const Ground bare(world, around(*site, site->radius + 60), job);
    for (const Lane& street : town_of(world, *site, job)->streets) {
      for (std::size_t k = 1; k < street.points.size(); ++k) {
        const RoadPoint &a = street.points[k - 1], &b = street.points[k];
        const double run = away(Site{{}, true, true, a.east, a.north}, b.east, b.north);
        EXPECT_LE(std::abs(b.height - a.height), 0.121 * run + 1e-6);
        EXPECT_LE(away(*site, b.east, b.north), site->radius);
        EXPECT_GT(bare.at(b.east, b.north).shore, 10);
        const double off = std::abs(ground.height((a.east + b.east) / 2, (a.north + b.north) / 2) -
                                    (a.height + b.height) / 2);
        greatest = std::max(greatest, off);
        ++points;
        high += off > 0.3 ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(points, 1000U);
  EXPECT_LE(greatest, 1.2);
  EXPECT_LE(50 * high, points) << "of 50 pieces at most one is more than 0.3 m from the ground";
}

/// Streets, blocks, lots and greens cover a town once: each edge of a part is that of one other part in the opposite
/// direction, or lies on the outline, whose corners are whole centimetres.
TEST(WorldTowns, AreAnExactPartition) {
  const World world = world_of(land_of_towns());
  Job job = test_job();
  for (const auto& site : towns_of(world, job)) {
    const Result<city::CityPlan> plan = town_plan(world, *site, job);
    ASSERT_TRUE(plan);
    double whole = 0;
    std::set<std::array<std::int32_t, 4>> edges;
    for (const city::Part& part : plan->parts) {
      whole += city::area_of(part.rings);
      for (const CmRing& ring : part.rings) {
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const CmPoint &a = ring[k], &b = ring[(k + 1) % ring.size()];
          EXPECT_TRUE(edges.insert({a.x, a.y, b.x, b.y}).second) << "two parts have the same edge";
        }
      }
    }
    for (const auto& [ax, ay, bx, by] : edges) {
      if (edges.contains({bx, by, ax, ay})) continue;
      const glm::dvec2 middle{(ax + bx) / 2.0, (ay + by) / 2.0};
      double nearest = 1e12;
      const CmRing& outline = plan->area[0];
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const CmPoint &a = outline[k], &b = outline[(k + 1) % outline.size()];
        nearest = std::min(nearest, distance_to_segment(middle, in_cm(a), in_cm(b)));
      }
      EXPECT_LE(nearest, 2) << "centimetres from the outline";
    }
    EXPECT_NEAR(whole, city::area_of(plan->area), 1);
    EXPECT_GT(plan->lots.size(), 50U);
  }
}

TEST(WorldTowns, AreJoinedToTheRoadsOfTheWorld) {
  const World world = world_of(land_of_towns());
  Job job = test_job();
  std::size_t roads = 0, joined = 0;
  for (const auto& site : towns_of(world, job)) {
    const auto town = town_of(world, *site, job);
    for (const auto& road : roads_near(world, around(*site, 1), 0, job)) {
      ++roads;
      const auto is_on_road = [&](const RoadPoint& p) {
        for (std::size_t k = 1; k < road->points.size(); ++k) {
          const RoadPoint &a = road->points[k - 1], &b = road->points[k];
          const double x = b.east - a.east, y = b.north - a.north, px = p.east - a.east,
                       py = p.north - a.north;
          const double t = std::clamp((px * x + py * y) / (x * x + y * y), 0.0, 1.0);
          if (std::abs(px - t * x) < 1 && std::abs(py - t * y) < 1) return true;
        }
        return false;
      };
      joined += std::any_of(town->streets.begin(), town->streets.end(), [&](const Lane& street) {
        return is_on_road(street.points.front()) || is_on_road(street.points.back());
      });
    }
  }
  EXPECT_GT(roads, 10U);
  EXPECT_GE(10 * joined, 9 * roads);
}

TEST(WorldTowns, HaveTheSameTilesOnAnyNumberOfThreads) {
  std::set<std::string> found;
  for (const int threads : {1, 2, 8}) {
    const World world = world_of(land_of_towns());
    Job::Options options;
    options.threads = threads;
    Job job(0, options);
    const auto towns = towns_of(world, job);
    ASSERT_FALSE(towns.empty());
    const Site& site = *towns.front();
    std::string all;
    for (const double off : {-150.0, -40.0, 30.0, 120.0})
      all += tile_glb(world, leaf_at(world, site.east + off, site.north + 20), job);
    found.insert(all);
  }
  EXPECT_EQ(found.size(), 1U);
}

TEST(WorldTowns, HaveLeavesThatMeetAtTheirBorders) {
  const World world = world_of(land_of_towns());
  Job job = test_job();
  std::size_t pairs = 0;
  for (const auto& site : towns_of(world, job)) {
    const TileKey west = leaf_at(world, site->east, site->north);
    const Terrain a = terrain_of(tile_glb(world, west, job)),
                  b = terrain_of(tile_glb(world, {west.level, west.x + 1, west.y}, job));
    std::size_t shared = 0;
    for (const auto& [position, vertex] : a) {
      const auto other = b.find(position);
      if (other == b.end()) continue;
      ++shared;
      EXPECT_EQ(other->second.top, vertex.top);
      EXPECT_EQ(other->second.normal, vertex.normal);
    }
    EXPECT_EQ(shared, 33U);
    ++pairs;
  }
  EXPECT_GE(pairs, 10U);
}

TEST(WorldTowns, DoNotExistWithoutAShare) {
  WorldParams params = land_of_towns();
  params.settlements.towns.share = 0;
  const World world = world_of(params);
  Job job = test_job();
  EXPECT_TRUE(towns_of(world, job).empty());
}

/// With right angles instead of bends, all streets but the given ones have two directions.
TEST(WorldTowns, HaveTheStreetsOfTheirRequest) {
  WorldParams params = land_of_towns();
  params.settlements.towns.city =
      Child{"city", std::nullopt, R"({"streets":{"pattern":"raster","block":[60,80]}})"};
  const World world = world_of(params);
  Job job = test_job();
  double along = 0, all = 0;
  for (const auto& site : towns_of(world, job)) {
    for (const Lane& street : town_of(world, *site, job)->streets) {
      const RoadPoint &a = street.points.front(), &b = street.points.back();
      const double x = std::abs(b.east - a.east), y = std::abs(b.north - a.north);
      all += std::max(x, y);
      if (std::min(x, y) < 0.1 * std::max(x, y)) along += std::max(x, y);
    }
  }
  EXPECT_GT(all, 1000);
  EXPECT_GT(along, 0.75 * all);
}

TEST(WorldTowns, RefuseParametersOfACityThatTheWorldGives) {
  WorldParams params = land_of_towns();
  params.settlements.towns.city =
      Child{"city", std::nullopt,
            R"({"area":{"size":[500,500]},"maps":{"height":"x"},"streets":{"method":"wards"}})"};
  std::set<std::string> pointers;
  for (const Issue& issue : issues_of(params)) pointers.insert(issue.pointer);
  const std::string at = "/settlements/towns/city/parameters/";
  EXPECT_EQ(pointers, (std::set<std::string>{at + "area", at + "maps", at + "streets/wards/wall_height"}));
  params.settlements.towns.city = Child{"tree", std::nullopt, "{}"};
  ASSERT_EQ(issues_of(params).size(), 1U);
  EXPECT_EQ(issues_of(params)[0].pointer, "/settlements/towns/city/generator");
}

}  // namespace
}  // namespace seedmesh::world
