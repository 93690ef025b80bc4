#include "core/generators/world/ground.h"

#include <algorithm>
#include <cmath>

#include "core/base/wide.h"

namespace seedmesh::world {
namespace {

constexpr double channel_reach = 260;  ///< metres; of the exact banks of a river
constexpr double levee = 0.3;          ///< metres of the ground beside a river above its water

Reach reach_of(const RiverPoint& a, const RiverPoint& b) {
  const double x = b.east - a.east, y = b.north - a.north;
  const double square = x * x + y * y, far = valley_reach + 1 + std::sqrt(square) / 2;
  const double by = square > 0 ? 1 / square : 0;
  return {a, b, a.east + x / 2, a.north + y / 2, far * far, x, y, by};
}

struct Nearest {
  double away = 0, share = 0, east = 0, north = 0;
};
Nearest nearest_on(const Reach& reach, double east, double north) {
  const double px = east - reach.from.east, py = north - reach.from.north;
  const double share = std::clamp((px * reach.x + py * reach.y) * reach.by, 0.0, 1.0);
  const double dx = px - share * reach.x, dy = py - share * reach.y;
  return {std::sqrt(dx * dx + dy * dy), share, dx, dy};
}

/// What the water near a position does to it.
struct Waters {
  explicit Waters(double land) : valley(land) {}
  double valley;                                 ///< its height, at most that of the land
  double share = 1;                              ///< share of the slope of the land
  double east = 0, north = 0, pull = 0;          ///< weighted sums of the slopes of valley sides
  double weight = 0, water = 0, half_width = 0;  ///< weighted sums over near rivers
  double away = 1e12;                            ///< distance from the nearest middle of a river
  double bank = 1e12;                            ///< distance from the nearest bank
  double lake = 1e12;                            ///< distance from the nearest shore of a lake
};

/// Slopes are weighted by distance, so that they do not jump between two waters: gullies would have steps there.
/// `offset`: from the water, of any length.
void add_side(Waters& waters, const WatersidePoint& waterside, const Slope& offset, const Land& land) {
  const ValleySide side = valley_side(land.height.value, land.ruggedness, waterside);
  waters.valley = std::min(waters.valley, side.height);
  waters.share = std::min(waters.share, side.share);
  if (offset.value <= 1e-9) return;
  const double t = waterside.distance * (1 / valley_reach), left = 1 - t * t,
               square = waterside.distance * waterside.distance + 400;
  const double weight = left * left / (square * square), along = weight * side.along / offset.value;
  waters.pull += weight;
  waters.east += along * offset.east;
  waters.north += along * offset.north;
}

void add_reach(Waters& waters, const Reach& reach, const Nearest& near, const Land& land) {
  const double water = reach.from.water + near.share * (reach.to.water - reach.from.water);
  const double half = (reach.from.width + near.share * (reach.to.width - reach.from.width)) / 2;
  add_side(waters, {near.away, half, water}, {near.away, near.east, near.north}, land);
  waters.bank = std::min(waters.bank, near.away - half);
  if (near.away >= channel_reach) return;
  waters.away = std::min(waters.away, near.away);
  const double left = 1 - near.away / channel_reach, square = near.away * near.away + 9;
  const double weight = left * left / (square * square);
  waters.weight += weight;
  waters.water += weight * water;
  waters.half_width += weight * half;
}

double mixed(double a, double b, double t) { return a + t * (b - a); }

/// The bed of a lake inside its shore, a beach outside.
double with_lake(double height, const Lake& lake, double away, double shore) {
  const double t = away / shore;
  const double bed = t < 1 ? lake.level - lake.depth * (1 - t * t) : lake.level + 0.05 * (away - shore);
  return mixed(bed, height, smooth_step(away, shore, 1.4 * shore + 60));
}

/// The bed of a river, its banks, and a transition to the land, which does not lie below the water. `share`: how much of it
/// there is, less where the river ends in other water.
double with_river(double height, const Waters& waters, double share) {
  if (waters.weight <= 0 || share <= 0) return height;
  const double water = waters.water / waters.weight, half = waters.half_width / waters.weight;
  const double t = waters.away / half;
  const double depth = 0.5 + 0.09 * half;
  const double bed = t < 1 ? water - depth * (1 - t * t) : water + 0.1 * (waters.away - half);
  const double wide = std::min(channel_reach - 10, 3 * half + 70);
  const double low =
      (1 - smooth_step(waters.away, std::min(wide, 150.0), channel_reach)) * (water + levee - height);
  const double land = height + std::max(0.0, low);
  return mixed(height, mixed(bed, land, smooth_step(waters.away, half + 1, wide)), share);
}

}  // namespace

Ground::Ground(const World& world, const Rectangle& box, Job& job)
    : Ground(world, box, job, world.reach(LayerInput::water, valley_reach)) {}

Ground::Ground(const World& world, const Rectangle& box, Job& job, double reach) : world_(&world) {
  const auto is_near = [&](double w, double s, double e, double n) {
    return w <= box.east + reach && e >= box.west - reach && s <= box.north + reach && n >= box.south - reach;
  };
  for (const CellKey& key : regions_near(world, box.west, box.south, box.east, box.north, reach)) {
    const auto region = region_at(world, key, job);
    for (const River& river : region->rivers) {
      if (!is_near(river.west, river.south, river.east, river.north)) continue;
      for (std::size_t k = 1; k < river.points.size(); ++k) {
        const RiverPoint &a = river.points[k - 1], &b = river.points[k];
        if (!is_near(std::min(a.east, b.east), std::min(a.north, b.north), std::max(a.east, b.east),
                     std::max(a.north, b.north))) {
          continue;
        }
        reaches_.push_back(reach_of(a, b));
      }
    }
    for (const Lake& lake : region->lakes) {
      const double far = 1.3 * lake.radius;
      if (is_near(lake.east - far, lake.north - far, lake.east + far, lake.north + far))
        lakes_.push_back(lake);
    }
  }
}

SEEDMESH_WIDE GroundSample Ground::at(double east, double north) const {
  GroundSample sample;
  Land& land = sample.land;
  land = land_at(*world_, east, north);
  Waters waters(land.height.value);
  for (const Reach& reach : reaches_) {
    const double x = east - reach.middle_east, y = north - reach.middle_north;
    if (x * x + y * y > reach.far) continue;
    const Nearest near = nearest_on(reach, east, north);
    if (near.away < valley_reach) add_reach(waters, reach, near, land);
  }
  for (const Lake& lake : lakes_) {
    const double x = east - lake.east, y = north - lake.north, away = std::sqrt(x * x + y * y);
    const double beyond = away - shore_distance(lake, east, north, away);
    if (beyond >= valley_reach) continue;
    add_side(waters, {std::max(0.0, beyond), 5, lake.level}, {away, x, y}, land);
    waters.bank = std::min(waters.bank, beyond);
    waters.lake = std::min(waters.lake, beyond);
  }
  const double uncut = land.height.value;
  land.height.value = waters.valley;
  if (waters.pull > 0) {
    const double by = (1 - waters.share) / waters.pull;
    land.height.east = waters.share * land.height.east + by * waters.east;
    land.height.north = waters.share * land.height.north + by * waters.north;
  }
  sample.cut = uncut - land.height.value;
  const double dry = smooth_step(waters.bank, 6, 160);
  double height = land.height.value + dry * detail_at(*world_, land, east, north);
  for (const Lake& lake : lakes_) {
    const double x = east - lake.east, y = north - lake.north, away = std::sqrt(x * x + y * y);
    if (away > 3 * lake.radius + 100) continue;
    height = with_lake(height, lake, away, shore_distance(lake, east, north, away));
  }
  double river = smooth_step(waters.lake, -25, 5);
  if (world_->params.relief.sea) river *= smooth_step(uncut - world_->params.relief.sea_level, -1.5, 0.5);
  sample.height = with_river(height, waters, river);
  sample.shore = waters.bank;
  if (!pieces_.empty() || !houses_.empty()) add_works(sample, east, north);
  if (!farmland_.empty()) add_field(sample, east, north);
  return sample;
}

}  // namespace seedmesh::world
