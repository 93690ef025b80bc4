/// Bounds and errors of tiles. All tiles of one file of a tileset, four levels and the links below them, are bounded
/// together. What lies between the samples of the ground is bounded by their greatest deviation. Tiles above the links have the union of the boxes below them.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/generators/world/areas.h"
#include "core/generators/world/ground_cover.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/river_mesh.h"
#include "core/generators/world/terrain_mesh.h"
#include "core/generators/world/valley.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

constexpr double least_fall = 0.99;  ///< greatest ratio of the error of a tile to that of its parent

struct Block {
  int depth = 0;  ///< levels below the root
  std::array<std::vector<TileBounds>, levels_a_block + 1> tiles;
  std::uint64_t bytes() const {
    std::uint64_t sum = sizeof(Block);
    for (const auto& level : tiles) sum += level.size() * sizeof(TileBounds);
    return sum;
  }
};

std::shared_ptr<const Block> block_at(const World& world, const TileKey& root, Job& job);

/// How far plants and houses stand out of a tile in plan.
double across(const World& world) {
  const double plants = world.has(Layer::plants) ? plant_extent(world).across : 0;
  const double houses = world.has(Layer::buildings) ? house_extent(world).across : 0;
  return std::max(plants, houses);
}

TileBounds in_plan(const World& world, const TileKey& key) {
  const TileFrame frame = frame_of(world, key);
  const double out = across(world);
  TileBounds box;
  box.west = frame.west - static_cast<double>(world.east) - out;
  box.south = frame.south - static_cast<double>(world.north) - out;
  box.east = box.west + frame.side + 2 * out;
  box.north = box.south + frame.side + 2 * out;
  return box;
}

constexpr double plant_error = 1.0 / 192;  ///< share of the side of a tile

/// What deviations are multiplied by, so that no tile of the presets has a greater one: errors_test.cpp measures them.
double margin_of(const Roughness& rough) {
  return rough.mesh_deviation.is_estimate && !rough.mesh_deviation.has_detail ? 1.4 : 1.05;
}

/// What the model gives too much for terraces, whose edges rarely lie beside other deviations. Skirts keep it.
double terrace_factor(const World& world) { return 1 - 0.13 * world.params.relief.terraces; }

/// The deviation where samples of the land alone are as far apart as those of the tile. It is a weighted sum of the
/// deviation of cells twice as wide, of the models without and with water, and of the most bent cells. The weights are fitted to
/// 5,600 tiles of the presets and of worlds with random parameters. They leave 0.2 % of them below their deviation.
double estimated_deviation(const World& world, double spacing, const Roughness& rough) {
  constexpr double mesh_share = 0.66, land_share = 0.78, water_share = 1.15, bent_share = 0.76;
  Roughness model = rough;
  model.mesh_deviation.most = 0;
  model.measured = 0;
  const double all = deviation_of(world, spacing, model);
  model.valley = 0;
  const double land = deviation_of(world, spacing, model);
  return mesh_share * rough.mesh_deviation.most + land_share * land +
         water_share * std::max(0.0, all - land) + bent_share * rough.measured;
}

/// The depth of a river bed on level ground that cells with an edge of this length do not show. Some tiles have no other
/// water. Boxes and skirts include the heights of water.
double bed_error(double spacing, const Roughness& rough) {
  constexpr double bank = 0.17;      ///< slope from samples on both sides to the bed
  constexpr double depth = 2.3;      ///< metres of the land beside a narrow river above its bed
  constexpr double by_width = 0.22;  ///< more of them for each metre of half the width
  const bool is_measured = rough.mesh_deviation.spacing == spacing && rough.mesh_deviation.has_valleys &&
                           !rough.mesh_deviation.is_estimate;
  const double deep = depth + (is_measured ? 0 : by_width * rough.river);
  return rough.valley > 0 ? std::min(bank * spacing, deep) : 0;
}

/// Heights are rounded to steps, here and in tiles below. Tiles that leave plants out lack more of them the wider they
/// are, up to the height of the plants.
double error_of(const World& world, const TileFrame& frame, const Roughness& rough, double plant_height) {
  const double plants = std::min(plant_error * frame.side, plant_height);
  const bool is_estimate =
      rough.mesh_deviation.is_estimate && !rough.mesh_deviation.has_detail && frame.spacing == coarse_spacing;
  const double deviation = is_estimate ? estimated_deviation(world, frame.spacing, rough)
                                       : margin_of(rough) * deviation_of(world, frame.spacing, rough);
  const double ground = std::max(terrace_factor(world) * deviation, bed_error(frame.spacing, rough));
  return std::max(ground, plants) + frame.step;
}

/// Whether tiles show the sea.
bool has_sea(const World& world) { return world.params.relief.sea && world.has(Layer::water); }

/// Detail along lines, and at the tallest plants, by that of an area. The borders of 1,300 squares have at most 0.95 of
/// it and half of them less than 0.65; where the land is lowest, it is rarely the greatest.
constexpr double line_share = 0.85;

/// The roughness on which the skirts of tiles depend. `range`: of the heights of the land around them.
Roughness of_skirts(const TileFrame& frame, Roughness rough, double range) {
  if (frame.side > widest_known_rivers) rough.valley = std::min(rough.valley, valley_of_skirts(range));
  return rough;
}

/// The lowest that the own skirt of a tile hangs. `spacing`: of the samples of the block. `between`: how far ground can
/// be below samples. Vertices at the border of a tile that are no samples can be rougher than those that are.
double own_skirt(const World& world, const TileFrame& frame, const Area& area, double spacing,
                 double between) {
  const Roughness rough = frame.spacing < spacing ? area.rough : area.rough_border();
  const double below = spacing < coarse_spacing ? between : line_share * between;
  // heights are rounded to steps, depths of skirts up to whole steps
  const double skirt = most_skirt(world, frame, of_skirts(frame, rough, area.high - area.low));
  return std::min(area.border() - below, area.border_cut()) - skirt - 1.5 * frame.step;
}

/// How far samples of a tile can be from those of its block, which are `spacing` apart. Wide blocks have samples of the
/// land alone, which lack detail; Area::lowest is below all valleys.
Margins at_samples(const World& world, double spacing, const Roughness& rough) {
  return spacing < coarse_spacing ? Margins{} : detail_of(world, rough);
}

/// How far ground between the samples of a block can be from them. Valleys and cuttings do not rise above them.
Margins between_samples(const World& world, double spacing, Roughness rough) {
  if (spacing >= coarse_spacing) return detail_of(world, rough, land_deviation_of(world, spacing, rough));
  rough.mesh_deviation = {};
  const double all = deviation_of(world, spacing, rough);
  rough.valley = 0;
  rough.works = 0;
  return {all, deviation_of(world, spacing, rough)};
}

/// The highest that rivers on the terrain of a tile lie.
double draped_top(const World& world, const TileFrame& frame, const Area& area, double between) {
  return world.has(Layer::water) ? area.high + between + drape_lift(frame.spacing) + 2 * frame.step
                                 : area.high;
}

/// Heights of boxes have few digits; those of small tiles, which are low, are finer.
double digits_of(const TileFrame& frame) { return frame.side > 8192 ? 4 : 16; }
double rounded_down(double height, const TileFrame& frame) {
  return std::floor(height * digits_of(frame)) / digits_of(frame);
}
double rounded_up(double height, const TileFrame& frame) {
  return std::ceil(height * digits_of(frame)) / digits_of(frame);
}

/// The roughness of an area as the tiles below a link have it. Their samples have the slopes of valley sides, which those
/// of the land alone lack.
Roughness rough_of_tiles_below(const World& world, int level, const Area& area, double spacing) {
  Roughness rough = area.rough;
  const bool has_valleys = spacing < coarse_spacing || spacing_of_areas(world, level + 1) >= coarse_spacing;
  if (!has_valleys && rough.valley > 0)
    rough.slope = std::max(rough.slope, steepest_side(rough.ruggedness, rough.valley));
  return rough;
}

/// The box of a tile of the lowest level of a block.
TileBounds link_bounds(const World& world, const TileKey& key, const Area& area, double spacing) {
  const TileFrame frame = frame_of(world, key);
  const bool is_leaf = key.level == world.levels - 1;
  const auto [below, between] = between_samples(world, spacing, area.rough);
  const WorldRelief& relief = world.params.relief;
  double low = std::min(area.low - below, area.lowest), high = std::max(area.high + between, area.highest);
  if (has_sea(world) && low < relief.sea_level) high = std::max(high, relief.sea_level);
  high = std::max(high, draped_top(world, frame, area, between));
  const double share = spacing < coarse_spacing ? 1 : line_share;
  if (!is_leaf) {
    const TileFrame child = frame_of(world, {key.level + 1, 2 * key.x, 2 * key.y});
    const Roughness rough = of_skirts(child, rough_of_tiles_below(world, key.level, area, spacing),
                                      area.high + between - area.low + below);
    low = std::min(low, std::min(area.low - share * below, area.lowest) - most_skirt(world, child, rough));
  }
  if (area.plant_height > 0) {
    const PlantExtent plants = plant_extent(area.plant_height);
    high = std::max(high, area.high + share * between + area.plant_top);
    low = std::min(low, area.low - below - plants.down);
  }
  if (has_ground_cover(world)) {
    high = std::max(high, area.high + share * between + cover_height);
    low = std::min(low, area.low - below - cover_depth);
  }
  const double own_below = frame.spacing < spacing ? below : at_samples(world, spacing, area.rough).below;
  low = std::min(low - frame.step, own_skirt(world, frame, area, spacing, own_below));
  TileBounds box = in_plan(world, key);
  box.low = rounded_down(low, frame);
  box.high = rounded_up(high + frame.step, frame);
  box.geometric_error = is_leaf ? 0 : error_of(world, frame, area.rough, area.plant_height);
  return box;
}

/// The box of a tile above others. `spacing`: of the samples of the block.
TileBounds bounds_above(const World& world, const TileKey& key, const Area& area, double spacing,
                        const std::array<const TileBounds*, 4>& below) {
  const TileFrame frame = frame_of(world, key);
  const WorldRelief& relief = world.params.relief;
  TileBounds box = in_plan(world, key);
  const auto [below_samples, above_samples] = frame.spacing < spacing
                                                  ? between_samples(world, spacing, area.rough)
                                                  : at_samples(world, spacing, area.rough);
  box.low = own_skirt(world, frame, area, spacing, below_samples);
  box.high = -1e12;
  for (const TileBounds* child : below) {
    box.low = std::min(box.low, child->low);
    box.high = std::max(box.high, child->high);
  }
  double top = draped_top(world, frame, area, above_samples);
  if (has_sea(world) && box.low < relief.sea_level) top = std::max(top, relief.sea_level + 2 * frame.step);
  box.high = std::max(box.high, rounded_up(top, frame));
  box.low = rounded_down(box.low, frame);
  box.geometric_error = error_of(world, frame, area.rough, area.plant_height);
  for (const TileBounds* child : below)
    box.geometric_error = std::max(box.geometric_error, child->geometric_error / least_fall);
  return box;
}

void limit(TileBounds& box, const TileBounds& above) {
  box.low = std::max(box.low, above.low);
  box.high = std::min(box.high, above.high);
  box.geometric_error = std::min(box.geometric_error, least_fall * above.geometric_error);
}

/// Keeps what was found of the triangles of a tile `depth` levels below that of a block.
void set_met(Area& area, const Areas& found, int depth, std::size_t tile, const TileFrame& frame) {
  const std::vector<double>& mesh_deviation = found.deviations[static_cast<std::size_t>(depth)];
  if (mesh_deviation.empty()) return;
  const double finer = std::min(found.spacing, frame.spacing / (frame.spacing == coarse_spacing ? 4 : 2));
  area.rough.mesh_deviation = {mesh_deviation[tile], frame.spacing,    finer,
                               found.has_valleys,    found.has_detail, found.spacing >= frame.spacing};
}

Block make_block(const World& world, const TileKey& root, Job& job) {
  Block block;
  block.depth = std::min(levels_a_block, world.levels - 1 - root.level);
  const Areas found = areas_below(world, root, block.depth, job);
  std::vector<Area> areas = found.links;
  const double spacing = found.spacing;
  for (int d = block.depth; d >= 0; --d) {
    const int count = 1 << d;
    auto& tiles = block.tiles[static_cast<std::size_t>(d)];
    std::vector<Area> finer;
    if (d < block.depth) {
      finer.swap(areas);
      areas.assign(static_cast<std::size_t>(count) * static_cast<std::size_t>(count), {});
    }
    for (int y = 0; y < count; ++y) {
      for (int x = 0; x < count; ++x) {
        const TileKey key{root.level + d, (root.x << d) + x, (root.y << d) + y};
        const auto own = static_cast<std::size_t>(y * count + x);
        if (d == block.depth) {
          set_met(areas[own], found, d, own, frame_of(world, key));
          tiles.push_back(link_bounds(world, key, areas[own], spacing));
          continue;
        }
        const auto& below = block.tiles[static_cast<std::size_t>(d + 1)];
        const std::size_t sw = 4 * own - 2 * static_cast<std::size_t>(x),
                          nw = sw + 2 * static_cast<std::size_t>(count);
        areas[own] = joined(finer[sw], finer[sw + 1], finer[nw], finer[nw + 1]);
        set_met(areas[own], found, d, own, frame_of(world, key));
        tiles.push_back(bounds_above(world, key, areas[own], spacing,
                                     {&below[sw], &below[sw + 1], &below[nw], &below[nw + 1]}));
      }
    }
  }
  if (root.level > 0) {
    const TileBounds above = tile_bounds(world, root, job);
    block.tiles[0][0] = above;  // as the link that leads here
  }
  for (int d = 1; d <= block.depth; ++d) {
    const std::size_t count = std::size_t{1} << d;
    auto& tiles = block.tiles[static_cast<std::size_t>(d)];
    for (std::size_t k = 0; k < tiles.size(); ++k) {
      limit(tiles[k],
            block.tiles[static_cast<std::size_t>(d - 1)][k / count / 2 * (count / 2) + k % count / 2]);
    }
  }
  return block;
}

std::shared_ptr<const Block> block_at(const World& world, const TileKey& root, Job& job) {
  return world.store->get<Block>({world.id, Store::Layer::bounds, root.x, root.y, root.level}, job,
                                 [&] { return std::make_shared<const Block>(make_block(world, root, job)); });
}

}  // namespace

double greatest_error(const World& world) {
  const Roughness rough = roughest(world);
  double error = 0;
  double tallest = 0;
  for (const WorldClass& plant : world.params.plants) tallest = std::max(tallest, plant.height);
  for (int level = 0; level < world.levels; ++level) {
    const double scale = static_cast<double>(std::int64_t{1} << level);
    error = std::max(error, scale * error_of(world, frame_of(world, {level, 0, 0}), rough, tallest));
  }
  return error;
}

TileBounds tile_bounds(const World& world, const TileKey& key, Job& job) {
  // a tile that is the root of a block is a link of the block above
  const int above = key.level == 0 ? 0 : (key.level - 1) % levels_a_block + 1;
  const TileKey root{key.level - above, key.x >> above, key.y >> above};
  const std::int64_t x = key.x - (root.x << above), y = key.y - (root.y << above);
  const auto block = block_at(world, root, job);
  return block->tiles[static_cast<std::size_t>(above)][static_cast<std::size_t>((y << above) + x)];
}

}  // namespace seedmesh::world
