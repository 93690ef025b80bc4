#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/roads.h"

namespace seedmesh::world {
namespace {

constexpr int candidates = 8;
constexpr double grid = 128;  ///< metres; settlements are on nodes of the grid of roads

/// How suitable a position is; below 0 is unsuitable.
double suitability(const World& world, double east, double north, Site& site, Job& job) {
  const Land land = land_at(world, east, north);
  const double slope = std::sqrt(land.height.east * land.height.east + land.height.north * land.height.north);
  if (slope > 0.16 || (world.params.relief.sea && land.height.value < world.params.relief.sea_level + 6))
    return -1;
  const Ground ground(world, {east, north, east, north}, job);
  const GroundSample sample = ground.at(east, north);
  const double height = sample.height;
  if (sample.shore < 60 || (world.params.relief.sea && height < world.params.relief.sea_level + 3)) return -1;
  const Climate climate = climate_at(world, east, north, height);
  if (climate.temperature < -3) return -1;
  const double water = 1 - smooth_step(sample.shore, 150, 1200);
  if (climate.moisture < 0.2 && water < 0.2) return -1;
  const double coast = world.params.relief.sea ? 1 - smooth_step(land.coast, 0.02, 0.12) : 0;
  site.east = east;
  site.north = north;
  site.height = height;
  site.waterside = std::max(water, coast);
  return 1 - 5 * slope - land.ruggedness + water;
}

std::shared_ptr<const Site> make_site(const World& world, const CellKey& cell, Job& job) {
  auto site = std::make_shared<Site>();
  site->cell = cell;
  const std::uint64_t key = cell_key(world.key ^ 0x53495445U, cell.x, cell.y);
  double best = 0;
  for (int k = 0; k < candidates; ++k) {
    Rng rng(key_at(key, static_cast<std::uint64_t>(k)));
    const auto along = [&](std::int64_t of) {
      const double at = (static_cast<double>(of) + rng.uniform(0.15, 0.85)) * site_cell;
      return (std::floor(at / grid) + 0.5) * grid;
    };
    const double east = along(cell.x), north = along(cell.y);
    Site tried = *site;
    const double value = suitability(world, east, north, tried, job) + 0.2 * rng.unit();
    if (value <= best) continue;
    best = value;
    *site = tried;
    site->is_settled = true;
  }
  Rng rng(key);
  if (rng.unit() >= world.params.settlements.density) site->is_settled = false;
  // few large villages and many small ones
  const double size = rng.unit();
  site->radius = world.params.settlements.radius * (0.3 + 0.7 * size * size);
  const WorldTowns& towns = world.params.settlements.towns;
  const double share = towns.share * (towns.share < 1 ? 0.4 + 1.2 * site->waterside : 1);
  Rng town = Rng(key).at("town");
  site->is_town = towns.share > 0 && town.unit() < share;
  if (site->is_town) site->radius = towns.radius * town.uniform(0.6, 1);
  return site;
}

}  // namespace

double greatest_radius(const World& world) {
  const WorldSettlements& settlements = world.params.settlements;
  return settlements.towns.share > 0 ? std::max(settlements.radius, settlements.towns.radius)
                                     : settlements.radius;
}

std::string name_of(const Site& site) {
  return 's' + std::to_string(site.cell.x) + "_" + std::to_string(site.cell.y);
}

std::shared_ptr<const Site> site_at(const World& world, const CellKey& cell, Job& job) {
  return world.store->get<Site>({world.id, Store::Layer::site, cell.x, cell.y, 0}, job,
                                [&] { return make_site(world, cell, job); });
}

std::vector<std::shared_ptr<const Site>> sites_near(const World& world, const Rectangle& box, double reach,
                                                    Job& job) {
  std::vector<std::shared_ptr<const Site>> found;
  if (world.params.settlements.density <= 0) return found;
  const auto cell = [](double v) { return math::to_int64(std::floor(v / site_cell)); };
  for (std::int64_t y = cell(box.south - reach); y <= cell(box.north + reach); ++y) {
    job.check();
    for (std::int64_t x = cell(box.west - reach); x <= cell(box.east + reach); ++x) {
      auto site = site_at(world, {x, y}, job);
      if (site->is_settled && site->east >= box.west - reach && site->east <= box.east + reach &&
          site->north >= box.south - reach && site->north <= box.north + reach) {
        found.push_back(std::move(site));
      }
    }
  }
  return found;
}

}  // namespace seedmesh::world
