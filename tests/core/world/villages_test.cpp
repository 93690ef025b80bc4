/// Villages: lanes, houses, churches and farms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/generators/world/houses.h"
#include "core/generators/world/lanes.h"
#include "core/generators/world/openings.h"
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

/// The places of the copies of a node, absolute: east, north, up.
std::vector<std::array<double, 3>> copies_of(const std::string& glb, const std::string& name,
                                             const TileFrame& frame) {
  const GlbParts parts = parts_of(glb);
  std::vector<std::array<double, 3>> places;
  for (const Json& node : parts.json["nodes"]) {
    if (node["name"] != name) continue;
    const Json& copies = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    const Json& accessor = parts.json["accessors"][copies["TRANSLATION"].get<int>()];
    const Json& view = parts.json["bufferViews"][accessor["bufferView"].get<int>()];
    for (int k = 0; k < accessor["count"].get<int>(); ++k) {
      float at[3];
      std::memcpy(at, parts.bytes.data() + view.value("byteOffset", 0) + 12 * k, 12);
      places.push_back({frame.middle_east + at[0], frame.middle_north - at[2], at[1]});
    }
  }
  return places;
}

/// Distance from the nearest wall of a house.
double from_wall(const House& h, double east, double north) {
  const double x = east - h.east, y = north - h.north;
  const double u = std::abs(x * h.x + y * h.y), v = std::abs(y * h.x - x * h.y);
  if (u > h.length + 0.01 || v > h.depth + 0.01) return 1e12;
  return std::min(h.length - u, h.depth - v);
}

TEST(WorldVillages, HaveWindowsAndDoorsInTheWallsOfHouses) {
  const World world = world_of(settled_land());
  Job job = test_job();
  int windows = 0, doors = 0, houses = 0;
  for (const auto& site : sites_of(world, job)) {
    const std::int64_t x = static_cast<std::int64_t>(site->east + world.extent / 2) / 64,
                       y = static_cast<std::int64_t>(site->north + world.extent / 2) / 64;
    const TileKey key{world.levels - 1, x, y};
    const TileFrame frame = frame_of(world, key);
    const std::string glb = tile_glb(world, key, job);
    EXPECT_LE(glb.size(), 40U << 10U);
    const std::vector<House> near =
        houses_near(world, {frame.west, frame.south, frame.west + 64, frame.south + 64}, 0, job);
    houses += static_cast<int>(near.size());
    for (const char* name : {"buildings_windows", "buildings_doors"}) {
      for (const auto& [east, north, up] : copies_of(glb, name, frame)) {
        (name == std::string("buildings_doors") ? doors : windows) += 1;
        double least = 1e12;
        for (const House& house : near) {
          if (up > house.low && up < house.ridge) least = std::min(least, from_wall(house, east, north));
        }
        EXPECT_NEAR(least, 0, 0.01);
      }
    }
  }
  ASSERT_GT(houses, 40);
  EXPECT_GE(doors, houses);
  EXPECT_GT(windows, 4 * houses);
  const std::string hash = opening_asset(world, job)->hash;
  EXPECT_TRUE(shared_file(world, hash, job));
  EXPECT_EQ(opening_asset(world_of(settled_land(), 8), job)->hash, hash);
}

}  // namespace
}  // namespace seedmesh::world
