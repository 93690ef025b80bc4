/// Walls of towns: a ring outside the lots, with gates between two towers where streets and roads pass.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/town.h"

namespace seedmesh::world {
namespace {

constexpr double outside = 9;      ///< metres from the outline of the town to the wall
constexpr double piece = 7;        ///< metres of a straight piece
constexpr double tower_every = 6;  ///< pieces
constexpr double wall_height = 5.5, tower_height = 8, half_wall = 0.7, half_tower = 2;
constexpr double foot = 1.2;       ///< metres that a wall reaches into the ground
constexpr double gate = 2.5;       ///< metres between a wall and a road
constexpr double least_shore = 4;  ///< metres between a wall and water
constexpr double steepest = 0.5;   ///< rise over run of the ground along a piece

using Point = std::array<double, 2>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1]}; }
double length_of(const Point& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1]); }

/// The outline moved outwards, with corners smoothed twice (Chaikin 1974).
std::vector<Point> ring_of(const Town& town, const Site& site) {
  std::vector<Point> ring;
  ring.reserve(town.outline.size());
  for (const Point& p : town.outline) {
    const Point from{p[0] - site.east, p[1] - site.north};
    const double by = 1 + outside / std::max(1.0, length_of(from));
    ring.push_back({site.east + by * from[0], site.north + by * from[1]});
  }
  for (int round = 0; round < 2; ++round) {
    std::vector<Point> cut;
    cut.reserve(2 * ring.size());
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point &a = ring[k], &b = ring[(k + 1) % ring.size()];
      for (const double t : {0.25, 0.75}) cut.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
    ring = std::move(cut);
  }
  return ring;
}

/// Positions at equal distances along a ring.
std::vector<Point> divided(const std::vector<Point>& ring) {
  double length = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) length += length_of(ring[(k + 1) % ring.size()] - ring[k]);
  const double step = length / std::max(3.0, std::floor(length / piece));
  std::vector<Point> corners;
  corners.reserve(static_cast<std::size_t>(math::to_int32(length / step)) + 1);
  double left = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point &a = ring[k], way = ring[(k + 1) % ring.size()] - a;
    const double side = length_of(way);
    for (; left < side; left += step)
      corners.push_back({a[0] + left / side * way[0], a[1] + left / side * way[1]});
    left -= side;
  }
  return corners;
}

House block_at(const Point& middle, const Point& way, double half_length, double half_depth) {
  House block;
  block.kind = House::wall;
  block.east = middle[0];
  block.north = middle[1];
  block.x = way[0];
  block.y = way[1];
  block.length = half_length;
  block.depth = half_depth;
  block.wall_light = 0.72F;
  block.roof_light = 0.6F;
  return block;
}

void raise(House& block, double low, double high) {
  block.low = low - foot;
  block.eaves = block.ridge = block.top = high;
}

/// A wall between two corners. False where a road, water or a slope is in its way.
bool add_piece(const Ground& ground, const Point& a, const Point& b, bool has_sea_at, double sea_level,
               std::vector<House>& walls) {
  const Point way = b - a, middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  const double length = length_of(way);
  double low = 1e12, high = -1e12;
  for (const Point& p : {a, middle, b}) {
    const GroundSample sample = ground.at(p[0], p[1]);
    if (sample.road < gate || sample.shore < least_shore) return false;
    if (has_sea_at && sample.height < sea_level + 1) return false;
    low = std::min(low, sample.height);
    high = std::max(high, sample.height);
  }
  if (length <= 0 || high - low > steepest * length) return false;
  House wall = block_at(middle, {way[0] / length, way[1] / length}, length / 2 + 0.2, half_wall);
  raise(wall, low, high + wall_height);
  walls.push_back(wall);
  return true;
}

void add_tower(const Ground& ground, const Point& at, const Point& way, std::vector<House>& walls) {
  const GroundSample sample = ground.at(at[0], at[1]);
  if (sample.road < half_tower || sample.shore < least_shore) return;
  House tower = block_at(at, way, half_tower, half_tower);
  raise(tower, sample.height - 1, sample.height + tower_height);
  walls.push_back(tower);
}

}  // namespace

std::vector<House> town_walls(const World& world, const Site& site, const Town& town, const Ground& ground) {
  std::vector<House> walls;
  Rng rng(cell_key(world.key ^ 0x57414C4CU, site.cell.x, site.cell.y));
  if (!town.is_built() || rng.unit() >= world.params.settlements.towns.walls) return walls;
  const std::vector<Point> corners = divided(ring_of(town, site));
  const WorldRelief& relief = world.params.relief;
  const std::size_t count = corners.size();
  std::vector<bool> has_wall(count);
  for (std::size_t k = 0; k < count; ++k) {
    has_wall[k] =
        add_piece(ground, corners[k], corners[(k + 1) % count], relief.sea, relief.sea_level, walls);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const bool before = has_wall[(k + count - 1) % count], after = has_wall[k];
    const bool is_regular = before && after && k % static_cast<std::size_t>(tower_every) == 0;
    if (before == after && !is_regular) continue;
    const Point way = corners[(k + 1) % count] - corners[(k + count - 1) % count];
    const double length = std::max(1e-6, length_of(way));
    add_tower(ground, corners[k], {way[0] / length, way[1] / length}, walls);
  }
  return walls;
}

}  // namespace seedmesh::world
