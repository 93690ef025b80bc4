/// Bounds and errors of tiles from a few samples of the ground. What lies between the samples is bounded by the
/// greatest rise of the finer wavelengths, which follows from the ruggedness of the samples.
#include <algorithm>
#include <cmath>

#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

constexpr int bound_cells = 16;

struct KnownBounds {
  TileBounds box;
  static std::uint64_t bytes() { return sizeof(TileBounds); }
};

/// The geometric error of a tile, and how far ground between samples can be from them, as shares of the side.
double error_share(const World& world, double ruggedness) {
  const WorldRelief& relief = world.params.relief;
  return 0.0015 + 0.002 * std::min(1.0, relief.hills / 100) +
         0.012 * ruggedness * std::min(1.0, relief.mountains / 900);
}

std::shared_ptr<const KnownBounds> known_bounds(const World& world, const TileKey& key, Job& job);

std::shared_ptr<const KnownBounds> measured(const World& world, const TileKey& key, Job& job) {
  const TileFrame frame = frame_of(world, key);
  const TerrainGrid grid = sample_grid(world, frame, bound_cells, 0, job);
  double low = grid.samples[0].height, high = low, rugged = 0;
  for (const GroundSample& sample : grid.samples) {
    low = std::min(low, sample.height);
    high = std::max(high, sample.height);
    rugged = std::max(rugged, sample.land.ruggedness);
  }
  const bool is_leaf = key.level + 1 == world.levels;
  const double share = error_share(world, rugged);
  const double margin = 3 * share * frame.side + frame.step;
  auto known = std::make_shared<KnownBounds>();
  TileBounds& box = known->box;
  box.west = frame.west - static_cast<double>(world.east);
  box.south = frame.south - static_cast<double>(world.north);
  box.east = box.west + frame.side;
  box.north = box.south + frame.side;
  box.low = std::floor(low - margin - skirt_depth(world, frame) - frame.step);
  box.high = std::ceil(high + margin);
  box.geometric_error = is_leaf ? 0 : share * frame.side;
  if (key.level == 0) return known;
  const TileBounds& parent = known_bounds(world, {key.level - 1, key.x / 2, key.y / 2}, job)->box;
  box.low = std::max(box.low, parent.low);
  box.high = std::min(box.high, parent.high);
  box.geometric_error = std::min(box.geometric_error, 0.75 * parent.geometric_error);
  return known;
}

std::shared_ptr<const KnownBounds> known_bounds(const World& world, const TileKey& key, Job& job) {
  return world.store->get<KnownBounds>({world.id, Store::Layer::bounds, key.x, key.y, key.level}, job,
                                       [&] { return measured(world, key, job); });
}

}  // namespace

double greatest_error(const World& world) { return error_share(world, 1) * world.extent; }

TileBounds tile_bounds(const World& world, const TileKey& key, Job& job) {
  return known_bounds(world, key, job)->box;
}

}  // namespace seedmesh::world
