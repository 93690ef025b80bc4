/// Layers and their reach: noise, rivers, ground, plants.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/generators/world/land.h"
#include "core/generators/world/land_rows.h"
#include "core/generators/world/octaves.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/region.h"
#include "core/generators/world/roads.h"
#include "core/generators/world/valley.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

TEST(WorldLayers, NoiseHasItsDerivative) {
  constexpr double by = 1e-6;
  for (int k = 0; k < 200; ++k) {
    const double x = 0.37 * k - 30, y = 5.1 - 0.29 * k;
    const Slope n = noise(99, x, y);
    EXPECT_NEAR((noise(99, x + by, y).value - noise(99, x - by, y).value) / (2 * by), n.east, 1e-6);
    EXPECT_NEAR((noise(99, x, y + by).value - noise(99, x, y - by).value) / (2 * by), n.north, 1e-6);
  }
}

/// In single precision.
TEST(WorldLayers, OctavesAreThoseOfNoise) {
  for (int k = 0; k < 200; ++k) {
    const double east = 913.25 * k - 90000, north = 70000 - 1077.5 * k;
    Octaves<4> octaves;
    double by = 1.0 / 5200;
    for (std::uint64_t key = 1; key <= 4; ++key, by *= 2) octaves.add(key, east, north, by);
    octaves.compute();
    Octaves<4> values = octaves;
    values.compute_values();
    by = 1.0 / 5200;
    for (std::size_t n = 0; n < 4; ++n, by *= 2) {
      const Slope expected = octave(n + 1, east, north, 1 / by), found = octaves.slope(n);
      EXPECT_NEAR(found.value, expected.value, 3e-6);
      EXPECT_NEAR(found.east, expected.east, 1e-5 * by);
      EXPECT_NEAR(found.north, expected.north, 1e-5 * by);
      EXPECT_EQ(found.value, values.value(n));
    }
  }
}

/// The octaves of land have single precision, so that differences over short distances are rough.
TEST(WorldLayers, LandHasItsDerivative) {
  const World world = world_of(mountains_with_woods());
  constexpr double by = 1;
  for (int k = 0; k < 200; ++k) {
    const double x = 913.0 * k + 0.5, y = 77.0 * k - 20000;
    const Slope h = land_at(world, x, y).height;
    const double east = land_at(world, x + by, y).height.value - land_at(world, x - by, y).height.value;
    EXPECT_NEAR(east / (2 * by), h.east, 2e-3);
  }
}

/// Gullies follow the slope, so a step of the slope would be a step of the ground.
TEST(WorldLayers, SlopesOfLandHaveNoStepAtCoasts) {
  WorldParams params = mountains_with_woods();
  params.relief.continents = 36000;
  params.relief.land = 0.4;
  const World world = world_of(params);
  int coasts = 0;
  for (int line = 0; line < 20; ++line) {
    Land before = land_at(world, -40000, 2000.0 * line);
    for (int k = 1; k < 20000; ++k) {
      const Land here = land_at(world, -40000 + 4.0 * k, 2000.0 * line);
      if ((here.coast < 0) != (before.coast < 0)) {
        ++coasts;
        EXPECT_NEAR(here.height.east, before.height.east, 0.012);
        EXPECT_NEAR(here.height.north, before.height.north, 0.012);
      }
      before = here;
    }
  }
  EXPECT_GT(coasts, 20);
}

TEST(WorldLayers, RowsOfLandAreThoseOfSinglePositions) {
  WorldParams params = mountains_with_woods();
  params.relief.terraces = 0.4;
  const World world = world_of(params);
  LandRow land;
  for (int n = 0; n < 40; ++n) {
    Rng rng = Rng::of_seed(3).at(n);
    const RowOfPositions row{std::floor(rng.uniform(-5e5, 5e5)), std::floor(rng.uniform(-5e5, 5e5)),
                             n % 2 == 0 ? 128.0 : 1000.0, 700};
    land_of_row(world, row, land);
    ASSERT_EQ(land.height.size(), row.count);
    for (std::size_t k = 0; k < row.count; k += 7) {
      const Land one = land_at(world, row.west + static_cast<double>(k) * row.spacing, row.north);
      EXPECT_NEAR(static_cast<double>(land.height[k]), one.height.value, 0.02);
      EXPECT_NEAR(static_cast<double>(land.ruggedness[k]), one.ruggedness, 1e-4);
      EXPECT_NEAR(static_cast<double>(land.coast[k]), one.coast, 1e-4);
      for (std::size_t m = 0; m < land.ridges.size(); ++m)
        EXPECT_NEAR(static_cast<double>(land.ridges[m][k]), static_cast<double>(one.ridges[m]), 1e-3);
    }
  }
}

TEST(WorldLayers, ValleysAreNotBelowHeightsThatTheyAreSaidToBeAbove) {
  Rng rng = Rng::of_seed(11);
  int above = 0, below = 0;
  for (int k = 0; k < 20000; ++k) {
    const double land = rng.uniform(0, 900), ruggedness = rng.unit(), height = land - rng.uniform(0, 300);
    const WatersidePoint waterside{rng.uniform(0, 1.1 * valley_reach), rng.uniform(1, 60),
                                   rng.uniform(0, land)};
    const bool is_lower = valley_side(land, ruggedness, waterside).height < height;
    const bool is_said = is_above(height, land, ruggedness, waterside);
    EXPECT_FALSE(is_lower && is_said) << land << " " << waterside.distance << " " << waterside.water;
    above += is_said ? 1 : 0;
    below += is_lower ? 1 : 0;
  }
  EXPECT_GT(above, 2000);
  EXPECT_GT(below, 2000);
}

/// Every river of 25 regions.
TEST(WorldLayers, RiversOnlyFallAndEndInWater) {
  for (const bool has_sea : {true, false}) {
    WorldParams params = mountains_with_woods();
    params.relief.sea = has_sea;
    const World world = world_of(params);
    Job job = test_job();
    int rivers = 0;
    for (std::int64_t y = -2; y <= 2; ++y) {
      for (std::int64_t x = -2; x <= 2; ++x) {
        const auto region = region_at(world, {x, y}, job);
        std::set<std::string> waters;
        for (const Lake& lake : region->lakes) EXPECT_TRUE(waters.insert(lake.id).second);
        for (const River& river : region->rivers) EXPECT_TRUE(waters.insert(river.id).second);
        for (const River& river : region->rivers) {
          ASSERT_GE(river.points.size(), 2U);
          for (std::size_t k = 1; k < river.points.size(); ++k) {
            ASSERT_LE(river.points[k].water, river.points[k - 1].water) << river.id;
          }
          const RiverPoint& mouth = river.points.back();
          if (river.into == "sea") {
            EXPECT_LE(mouth.water, params.relief.sea_level + 0.05);
          } else {
            EXPECT_TRUE(waters.contains(river.into)) << river.id << " into " << river.into;
          }
          for (const River& other : region->rivers) {
            if (other.id != river.into) continue;
            bool is_met = false;
            for (const RiverPoint& p : other.points) {
              is_met |= p.east == mouth.east && p.north == mouth.north && p.water <= mouth.water;
            }
            EXPECT_TRUE(is_met) << river.id << " into " << river.into;
          }
          ++rivers;
        }
      }
    }
    EXPECT_GT(rivers, 100);
  }
}

/// Here a wide river ends where the course below it is within a lake.
TEST(WorldLayers, RiversEndInLakesThatContainTheCourseBelow) {
  WorldParams params;
  params.origin = {-10, 23};
  params.relief.mountains = 650.181;
  params.relief.hills = 302.753;
  params.relief.ridges = 1;
  params.relief.gullies = 0;
  params.relief.terraces = 0.025;
  params.water.rivers = 0.493;
  params.water.width = 97.053;
  const World world = world_of(params, 396964437);
  Job job = test_job();
  for (std::int64_t y = 16; y <= 18; ++y) {
    for (std::int64_t x = -5; x <= -3; ++x) {
      const auto region = region_at(world, {x, y}, job);
      std::set<std::string> waters = {"sea"};
      for (const Lake& lake : region->lakes) waters.insert(lake.id);
      for (const River& river : region->rivers) waters.insert(river.id);
      for (const River& river : region->rivers)
        EXPECT_TRUE(waters.contains(river.into)) << river.id << " into " << river.into;
    }
  }
}

/// Roads, houses and fields around villages: from a rectangle and from one that is wider by a cell of villages.
TEST(WorldLayers, WorksReadWhatIsWithinTheirReachOnly) {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 300;
  params.settlements.density = 1;
  params.fields.share = 0.8;
  const World world = world_of(params);
  Job job = test_job();
  int built = 0, fields = 0, bare = 0;
  std::vector<Rectangle> boxes;
  for (const auto& site : sites_near(world, {0, 0, 60000, 60000}, 0, job)) {
    for (int k = 0; k < 6; ++k) {
      const double east = 64 * std::floor(site->east / 64 + 2 * k - 6),
                   north = 64 * std::floor(site->north / 64 + 3 * k - 8);
      boxes.push_back({east, north, east + 64, north + 64});
    }
  }
  ASSERT_GE(boxes.size(), 100U);
  boxes.resize(std::min<std::size_t>(boxes.size(), 200));
  for (const Rectangle& box : boxes) {
    const Rectangle wider{box.west - site_cell, box.south - site_cell, box.east + site_cell,
                          box.north + site_cell};
    const Ground own = Ground::with_works(world, box, job), more = Ground::with_works(world, wider, job),
                 without(world, box, job);
    for (const double x : {1.0, 17.0, 40.0, 63.0}) {
      for (const double y : {2.0, 31.0, 62.0}) {
        const GroundSample a = own.at(box.west + x, box.south + y), b = more.at(box.west + x, box.south + y);
        ASSERT_EQ(a.height, b.height);
        ASSERT_EQ(a.field, b.field);
        if (a.road < 2) {
          ASSERT_EQ(a.road, b.road);
        }
        if (a.house < 2) {
          ASSERT_EQ(a.house, b.house);
        }
        built += a.road < 0 || a.house < 0 ? 1 : 0;
        fields += a.field >= 0 ? 1 : 0;
        bare += a.height != without.height(box.west + x, box.south + y) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(built, 10);
  EXPECT_GT(fields, 100);
  EXPECT_GT(bare, 50) << "roads change the ground";
}

std::set<std::pair<double, double>> feet_of(const World& world, const Rectangle& box, double reach) {
  Job job = test_job();
  const Ground ground(world, box, job);
  std::set<std::pair<double, double>> feet;
  for (const Plant& plant : plants_in(world, 0, box, ground, job, {1, reach}))
    feet.insert({plant.east, plant.north});
  return feet;
}

TEST(WorldLayers, PlantsCompeteWithinFiveSpacingsOnly) {
  const World world = world_of(mountains_with_woods());
  int differences = 0;
  std::size_t count = 0;
  for (int k = 0; k < 200; ++k) {
    const double east = 64.0 * (251 * k % 1500), north = 64.0 * (97 * k % 1500);
    const Rectangle box{east, north, east + 64, north + 64};
    const auto feet = feet_of(world, box, thinning_rounds);
    count += feet.size();
    ASSERT_EQ(feet, feet_of(world, box, thinning_rounds + 1));
    differences += feet != feet_of(world, box, 0.5 * thinning_rounds) ? 1 : 0;
  }
  EXPECT_GT(count, 1000U);
  EXPECT_GT(differences, 0);
}

TEST(WorldLayers, PlantsKeepTheirSpacingAcrossBorders) {
  const World world = world_of(mountains_with_woods());
  const double spacing = world.params.plants[0].spacing;
  std::vector<std::pair<double, double>> feet;
  std::size_t wooded = 0;
  for (int k = 0; k < 40 && wooded < 4; ++k) {
    feet.clear();
    const double west = 64.0 * (509 * k % 3000), south = 64.0 * (797 * k % 3000);
    std::size_t near_border = 0, inside = 0;
    for (int tile = 0; tile < 64; ++tile) {
      const int column = tile % 8, row = tile / 8;
      const double east = west + 64 * column, north = south + 64 * row;
      for (const auto& [x, y] : feet_of(world, {east, north, east + 64, north + 64}, thinning_rounds)) {
        feet.emplace_back(x, y);
        const double u = std::min(x - east, east + 64 - x), v = std::min(y - north, north + 64 - y);
        (std::min(u, v) < 8 ? near_border : inside) += 1;
      }
    }
    for (std::size_t i = 0; i < feet.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double x = feet[i].first - feet[j].first, y = feet[i].second - feet[j].second;
        ASSERT_GE(x * x + y * y, spacing * spacing);
      }
    }
    if (feet.size() < 1000) continue;
    ++wooded;
    // the outer 8 m are 7/16 of a tile
    const double share = static_cast<double>(near_border) / static_cast<double>(feet.size());
    EXPECT_NEAR(share, 7.0 / 16, 0.04);
  }
  EXPECT_GT(wooded, 0U);
}

struct Value {
  int number = 0;
  static std::uint64_t bytes() { return 1000; }
};

TEST(WorldStore, KeepsTheLastUsedWithinItsBytes) {
  Store store(5000);
  const Job job = test_job();
  int made = 0;
  const auto get = [&](std::int64_t x) {
    return store.get<Value>({1, Store::Layer::region, x, 0, 0}, job, [&] {
      ++made;
      return std::make_shared<const Value>(Value{static_cast<int>(x)});
    });
  };
  for (std::int64_t x = 0; x < 100; ++x) EXPECT_EQ(get(x)->number, x);
  EXPECT_LE(store.bytes(), 5000U);
  EXPECT_EQ(made, 100);
  get(99);
  EXPECT_EQ(made, 100) << "the last is kept";
  get(0);
  EXPECT_EQ(made, 101) << "the first is not";
}

TEST(WorldStore, TriesAgainAfterAnError) {
  Store store;
  const Job job = test_job();
  const Store::Key key{1, Store::Layer::region, 0, 0, 0};
  const auto fails = [&]() -> std::shared_ptr<const Value> {
    job.refuse({IssueKind::internal, "", "stops"});
  };
  EXPECT_THROW(store.get<Value>(key, job, fails), Stop);
  EXPECT_EQ(store.get<Value>(key, job, [] { return std::make_shared<const Value>(Value{5}); })->number, 5);
}

}  // namespace
}  // namespace seedmesh::world
