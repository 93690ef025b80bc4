/// Reaches of layers: tiles have the same bytes where a layer reads more than its reach, and others where it reads half.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/generators/world/houses.h"
#include "core/generators/world/region.h"
#include "core/generators/world/roads.h"
#include "core/generators/world/town.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

/// Mountains, so that valleys are deep and wide.
WorldParams with_valleys() {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 3000;
  params.water.rivers = 1;
  return params;
}

/// Villages far apart, with long roads on uneven ground.
WorldParams inhabited() {
  WorldParams params = mountains_with_woods();
  params.relief.mountains = 200;
  params.relief.hills = 120;
  params.relief.land = 1;
  params.settlements.density = 0.3;
  params.settlements.radius = 400;
  params.roads.longest = 12000;
  params.fields.share = 0.9;
  params.plants.clear();
  return params;
}

/// What a layer makes, as text: the same where its bits are.
using Made = std::vector<std::string>;

void add_bits(std::string& text, double value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The water of 25 regions.
Made regions_of(const World& world, Job& job) {
  Made made;
  for (std::int64_t y = -2; y <= 2; ++y) {
    for (std::int64_t x = -2; x <= 2; ++x) {
      std::string& text = made.emplace_back();
      for (const River& river : region_at(world, {x, y}, job)->rivers) {
        text += river.id + river.into;
        for (const RiverPoint& p : river.points) {
          for (const double value : {p.east, p.north, p.water, p.width, p.cut}) add_bits(text, value);
        }
      }
    }
  }
  return made;
}

/// Heights in 200 squares of 64 m.
Made heights_of(const World& world, const std::vector<Rectangle>& boxes, bool has_roads, Job& job) {
  Made made;
  for (const Rectangle& box : boxes) {
    const Ground ground = has_roads ? Ground::with_roads(world, box, job) : Ground(world, box, job);
    std::string& text = made.emplace_back();
    for (double x = 0; x <= 64; x += 8) {
      for (double y = 0; y <= 64; y += 8) add_bits(text, ground.height(box.west + x, box.south + y));
    }
  }
  return made;
}

Rectangle square_at(double east, double north) {
  const double west = 64 * std::floor(east / 64), south = 64 * std::floor(north / 64);
  return {west, south, west + 64, south + 64};
}

std::vector<Rectangle> beside_rivers(Job& job) {
  const World world = world_of(with_valleys());
  std::vector<Rectangle> boxes;
  for (std::int64_t y = 0; y < 3; ++y) {
    for (std::int64_t x = 0; x < 3; ++x) {
      for (const River& river : region_at(world, {x, y}, job)->rivers) {
        const RiverPoint &a = river.points.front(), &b = river.points.back();
        for (const double share : {0.3, 0.6})
          boxes.push_back(
              square_at(a.east + share * (b.east - a.east) + 600, a.north + share * (b.north - a.north)));
      }
    }
  }
  boxes.resize(std::min<std::size_t>(boxes.size(), 200));
  return boxes;
}

constexpr Rectangle country{0, 0, 120000, 120000};

/// Near the ends of roads, the longest first: there, the other end is far away.
std::vector<Rectangle> beside_roads(Job& job) {
  const World world = world_of(inhabited());
  std::vector<std::shared_ptr<const Road>> roads = roads_near(world, country, 0, job);
  const auto length = [](const Road& road) {
    const RoadPoint &a = road.points.front(), &b = road.points.back();
    return std::max(std::abs(a.east - b.east), std::abs(a.north - b.north));
  };
  std::sort(roads.begin(), roads.end(),
            [&](const auto& a, const auto& b) { return length(*a) > length(*b); });
  std::vector<Rectangle> boxes;
  for (const auto& road : roads) {
    for (const std::size_t k : {std::size_t{12}, road->points.size() - 13}) {
      if (k < road->points.size()) boxes.push_back(square_at(road->points[k].east, road->points[k].north));
    }
  }
  boxes.resize(std::min<std::size_t>(boxes.size(), 200));
  return boxes;
}

/// Leaves with the houses that are farthest from the middles of their villages, and among fields.
Made leaves_of(const World& world, Job& job) {
  const World known = world_of(inhabited());
  const auto leaf = [&](double east, double north) {
    const auto tile = [&](double at) {
      return static_cast<std::int64_t>(std::floor((at + world.extent / 2) / leaf_side));
    };
    return tile_glb(world, {world.levels - 1, tile(east), tile(north)}, job);
  };
  Made made;
  for (const auto& site : sites_near(known, country, 0, job)) {
    if (made.size() >= 200) break;
    const auto away = [&](const House& h) {
      return std::max(std::abs(h.east - site->east), std::abs(h.north - site->north));
    };
    const auto plan = plan_of(known, *site, job);
    const auto& houses = plan->houses;
    const auto far = std::max_element(houses.begin(), houses.end(),
                                      [&](const House& a, const House& b) { return away(a) < away(b); });
    if (far != houses.end()) made.push_back(leaf(far->east, far->north));
    for (const double share : {-0.75, -0.6, 0.6, 0.75})
      made.push_back(leaf(site->east + share * known.params.fields.reach * site->radius, site->north));
  }
  return made;
}

/// Towns on uneven ground.
WorldParams with_towns() {
  WorldParams params = inhabited();
  params.settlements.density = 1;
  params.settlements.towns.share = 1;
  return params;
}

/// The streets and houses of towns.
Made towns_of(const World& world, Job& job) {
  Made made;
  for (const auto& site : sites_near(world, {0, 0, 80000, 80000}, 0, job)) {
    const auto town = town_of(world, *site, job);
    std::string& text = made.emplace_back();
    for (const Lane& street : town->streets) {
      for (const RoadPoint& p : street.points) {
        for (const double value : {p.east, p.north, p.height}) add_bits(text, value);
      }
    }
    for (const TownHouse& house : town->houses) {
      for (const double value : {house.east, house.north, house.turn}) add_bits(text, value);
    }
  }
  return made;
}

std::size_t differences(const Made& a, const Made& b) {
  std::size_t count = a.size() == b.size() ? 0 : 1;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) count += a[k] != b[k] ? 1U : 0U;
  return count;
}

struct Trial {
  const char* name;
  LayerInput layer;
  double cell;  ///< metres, or cells of a region
  WorldParams params;
  std::function<Made(const World&)> made;
};

/// Reaches of plants, which are counted in their spacings, are tested with the layers.
TEST(WorldReach, IsEnoughAndHalfOfItIsNot) {
  Job job = test_job();
  const std::vector<Rectangle> rivers = beside_rivers(job), roads = beside_roads(job);
  ASSERT_EQ(rivers.size(), 200U);
  ASSERT_GE(roads.size(), 150U);
  const auto leaves = [&](const World& world) { return leaves_of(world, job); };
  const Trial trials[] = {
      {"region", LayerInput::cells, 1, with_valleys(), [&](const World& w) { return regions_of(w, job); }},
      {"water", LayerInput::water, drain_cell, with_valleys(),
       [&](const World& w) { return heights_of(w, rivers, false, job); }},
      {"roads", LayerInput::roads, site_cell, inhabited(),
       [&](const World& w) { return heights_of(w, roads, true, job); }},
      {"works", LayerInput::works, 128, inhabited(),
       [&](const World& w) { return heights_of(w, roads, true, job); }},
      {"fields", LayerInput::fields, site_cell, inhabited(), leaves},
      {"houses", LayerInput::houses, site_cell, inhabited(), leaves},
      {"towns", LayerInput::towns, town_lattice, with_towns(),
       [&](const World& w) { return towns_of(w, job); }}};
  for (const Trial& trial : trials) {
    const Made known = trial.made(world_of(trial.params));
    const auto layer = static_cast<std::size_t>(trial.layer);
    World more = world_of(trial.params);
    more.reach_more[layer] = trial.cell;
    EXPECT_EQ(differences(known, trial.made(more)), 0U) << trial.name << " with one cell more";
    World less = world_of(trial.params);
    less.reach_factor[layer] = 0.5;
    EXPECT_GT(differences(known, trial.made(less)), 0U) << trial.name << " with half of its reach";
  }
}

}  // namespace
}  // namespace seedmesh::world
