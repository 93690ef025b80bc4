/// Bounds and errors of tiles from a few samples of the ground. What lies between the samples is bounded by the
/// greatest rise of the finer wavelengths, which follows from the ruggedness of the samples.
#include <algorithm>
#include <cmath>

#include "core/generators/world/error_model.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

constexpr int bound_cells = tile_cells;  ///< so that a box has the samples of its tile
constexpr double between_samples =
    1.1;  ///< of the error at the distance of samples: how far ground can be outside

constexpr double widest_lake_spacing = 512;  ///< metres; coarser tiles draw no lakes
constexpr double highest_lift = 2.5;         ///< metres that rivers lie above their water

struct KnownBounds {
  TileBounds box;
  static std::uint64_t bytes() { return sizeof(TileBounds); }
};

std::shared_ptr<const KnownBounds> known_bounds(const World& world, const TileKey& key, Job& job);

/// Bounds of tiles from here upwards do without roads and allow for their earthworks.
constexpr double widest_measured_works = 512;
Works works_of(const TileFrame& frame) {
  return frame.side > widest_measured_works ? Works::none : Works::roads;
}

/// Properties of a tile from a few samples.
struct Samples {
  double low = 1e12, high = -1e12, shore = 1e12, road = 1e12;
  Roughness roughness;
  bool has_plants = false;
  double rise = 0;       ///< the greatest between neighbouring samples
  double border = 1e12;  ///< the lowest height at the border, from which the skirt hangs
};

Samples samples_of(const World& world, const TileFrame& frame, Job& job) {
  Samples found;
  const TerrainGrid grid = sample_grid(world, frame, bound_cells, 0, job, works_of(frame));
  for (int row = 0; row < grid.count; ++row) {
    for (int column = 0; column < grid.count; ++column) {
      const GroundSample& sample = grid.at(column, row);
      found.low = std::min(found.low, sample.height);
      found.high = std::max(found.high, sample.height);
      const bool is_border = row == 0 || column == 0 || row + 1 == grid.count || column + 1 == grid.count;
      if (is_border) found.border = std::min(found.border, sample.height);
      found.roughness.ruggedness = std::max(found.roughness.ruggedness, sample.land.ruggedness);
      if (column > 0)
        found.rise = std::max(found.rise, std::abs(sample.height - grid.at(column - 1, row).height));
      if (row > 0)
        found.rise = std::max(found.rise, std::abs(sample.height - grid.at(column, row - 1).height));
      found.shore = std::min(found.shore, sample.shore);
      found.road = std::min(found.road, sample.road);
      if (found.has_plants || !world.has(Layer::plants)) continue;
      const double east = grid.west + column * grid.spacing, north = grid.south + row * grid.spacing;
      for (const WorldClass& plant : world.params.plants) {
        found.has_plants |= may_grow(world, plant, sample, east, north);
      }
    }
  }
  found.roughness.is_near_water = found.shore < 120 + grid.spacing;
  return found;
}

/// The highest point of the roads in a tile; bridges can be above all ground of the tile.
double highest_road(const World& world, const TileFrame& frame, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  const Ground ground = Ground::with_roads(world, box, job);
  double height = -1e12;
  for (const RoadPiece& p : ground.road_pieces()) {
    const bool is_outside = std::min(p.from_east, p.to_east) > box.east + 8 ||
                            std::max(p.from_east, p.to_east) < box.west - 8 ||
                            std::min(p.from_north, p.to_north) > box.north + 8 ||
                            std::max(p.from_north, p.to_north) < box.south - 8;
    if (!is_outside) height = std::max({height, p.from_height, p.to_height});
  }
  return height + 1;
}

/// The highest water of a river inside a rectangle, if any; it is where the river enters.
double entry_of(const Reach& reach, const Rectangle& box) {
  double first = 0, last = 1;
  const auto cut = [&](double from, double to, double low, double high) {
    const double along = to - from;
    if (std::abs(along) < 1e-9) {
      if (from < low || from > high) last = -1;
      return;
    }
    const double a = (low - from) / along, b = (high - from) / along;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  };
  const double w = reach.to.width;
  cut(reach.from.east, reach.to.east, box.west - w, box.east + w);
  cut(reach.from.north, reach.to.north, box.south - w, box.north + w);
  if (first > last) return -1e12;
  return reach.from.water + first * (reach.to.water - reach.from.water);
}

/// The level of the highest river or lake in a tile; its surface can be above all sampled ground.
double highest_water(const World& world, const TileFrame& frame, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  const Ground ground(world, box, job, 100);
  double level = -1e12;
  for (const Lake& lake : ground.lakes()) level = std::max(level, lake.level);
  for (const Reach& reach : ground.reaches()) level = std::max(level, entry_of(reach, box));
  return level;
}

bool has_houses(const World& world, const TileFrame& frame, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  return !sites_near(world, box, world.params.settlements.radius, job).empty();
}

std::shared_ptr<const KnownBounds> measured(const World& world, const TileKey& key, Job& job) {
  const TileFrame frame = frame_of(world, key);
  const Samples samples = samples_of(world, frame, job);
  const int above_leaves = world.levels - 1 - key.level;
  const double error = error_of(world, frame.side, samples.roughness);
  const bool is_leaf = above_leaves == 0;
  const double margin = is_leaf ? 0 : between_samples * error_of(world, frame.side, samples.roughness);
  const double steep = !is_leaf && frame.side <= widest_measured_works ? 0.35 * samples.rise : 0;  // cliffs
  const bool has_sites = world.params.settlements.density > 0;
  const double works =
      has_sites && works_of(frame) == Works::none && frame.spacing < works_spacing ? most_works : 0;
  const double above = has_sites && (above_leaves > 3 || has_houses(world, frame, job)) ? house_height : 0;
  const double around = std::max(plant_extent(world).across, has_sites ? house_reach : 0);
  const PlantExtent plants{
      around, std::max(above, samples.has_plants || above_leaves > 3 ? plant_extent(world).up : 0)};
  auto known = std::make_shared<KnownBounds>();
  TileBounds& box = known->box;
  box.west = frame.west - static_cast<double>(world.east) - plants.across;
  box.south = frame.south - static_cast<double>(world.north) - plants.across;
  box.east = box.west + frame.side + 2 * plants.across;
  box.north = box.south + frame.side + 2 * plants.across;
  const bool is_built = has_sites && frame.side <= widest_measured_works && samples.road < 64;
  const double cutting = is_built && !is_leaf ? std::min(most_works, 0.04 * frame.side) + 1 : 0;
  const bool is_wet = world.params.relief.sea && samples.low - margin < world.params.relief.sea_level;
  double top = is_wet ? std::max(samples.high, world.params.relief.sea_level) : samples.high;
  if (is_built) top = std::max(top, highest_road(world, frame, job));
  if (samples.roughness.is_near_water && frame.spacing <= widest_lake_spacing) {
    top = std::max(top, highest_water(world, frame, job)) + highest_lift;
  }
  // descendants lie between the samples, with shorter skirts; the skirt of the tile hangs from its border alone
  const double between = margin + steep + works + cutting;
  const double hanging = is_leaf ? 0 : skirt_depth(world, frame.side / 2);
  const double cellar = above > 0 ? most_cellar : 0;
  const double lowest = std::min(samples.border - skirt_depth(world, frame.side),
                                 samples.low - between - std::max(cellar, hanging));
  box.low = std::floor((lowest - 2 * frame.step) * 4) / 4;
  box.high = std::ceil((top + between + plants.up + 2 * frame.step) * 4) / 4;
  box.geometric_error = above_leaves == 0 ? 0 : error;
  if (key.level == 0) return known;
  const TileBounds& parent = known_bounds(world, {key.level - 1, key.x / 2, key.y / 2}, job)->box;
  box.low = std::max(box.low, parent.low);
  box.high = std::min(box.high, parent.high);
  box.geometric_error = std::min(box.geometric_error, 0.9 * parent.geometric_error);
  return known;
}

std::shared_ptr<const KnownBounds> known_bounds(const World& world, const TileKey& key, Job& job) {
  return world.store->get<KnownBounds>({world.id, Store::Layer::bounds, key.x, key.y, key.level}, job,
                                       [&] { return measured(world, key, job); });
}

}  // namespace

double greatest_error(const World& world) {
  double error = 0;
  for (int level = 0; level < world.levels; ++level) {
    const double scale = static_cast<double>(std::int64_t{1} << level);
    error = std::max(error, scale * error_of(world, world.extent / scale, {1, true}));
  }
  return error;
}

TileBounds tile_bounds(const World& world, const TileKey& key, Job& job) {
  return known_bounds(world, key, job)->box;
}

}  // namespace seedmesh::world
