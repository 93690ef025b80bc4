#include "core/generators/world/ground_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/generators/world/instances.h"
#include "core/generators/world/leaf_texture.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/plant_builder.h"
#include "core/generators/world/plant_layer.h"

namespace seedmesh::world {
namespace {

constexpr std::uint64_t key = 0x434F564552U;
constexpr double patch_wavelength = 17, flower_wavelength = 41;  ///< metres
constexpr double margin = 1.5;  ///< metres from the corners of cells with pieces to water and roads
constexpr std::array<const char*, cover_shapes> names{"terrain_tufts", "terrain_straw", "terrain_flowers",
                                                      "terrain_stones"};

/// Of a leaf without its pieces; their nodes and accessors take up to 3,700 bytes more, and a leaf has at most 40 KB.
constexpr std::size_t most_leaf_bytes = 36 << 10;
constexpr std::size_t piece_bytes = 24;  ///< position and scale

/// The share of cells that have a piece, by shape.
using Densities = std::array<double, cover_shapes>;

Densities densities_on(GroundKind kind, const Climate& climate, double flowering) {
  const bool is_dry = climate.moisture < 0.3, is_cold = climate.temperature < -1;
  switch (kind) {
    case GroundKind::grass:
      if (is_cold) return {0.1, 0.3, 0.02, 0.03};
      return {0.46, 0.05, 0.12 * smooth_step(flowering, 0.05, 0.4), 0.008};
    case GroundKind::soil:
      return is_dry || is_cold ? Densities{0.01, 0.14, 0, 0.1} : Densities{0.24, 0.05, 0.01, 0.03};
    case GroundKind::rock:
      return {0.03, 0.04, 0, 0.26};
    case GroundKind::sand:
      return {0, 0.05, 0, 0.06};
    case GroundKind::snow:
      return {0, 0, 0, 0.02};
    case GroundKind::land:
      return {};
  }
  return {};
}

Rgba rgba_of(const Color& color, double light) {
  Rgba out = linear_color(color);
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(math::to_int32(std::min(255.0, light * out[k])));
  return out;
}

/// The height of the triangles of the terrain in a cell, at a share of its side east and north.
double height_in(const TerrainGrid& grid, int column, int row, double east, double north) {
  const double sw = grid.at(column, row).height, ne = grid.at(column + 1, row + 1).height;
  if (east > north) {
    const double se = grid.at(column + 1, row).height;
    return sw + east * (se - sw) + north * (ne - se);
  }
  const double nw = grid.at(column, row + 1).height;
  return sw + north * (nw - sw) + east * (ne - nw);
}

bool is_bare(const World& world, const GroundSample& sample) {
  return sample.shore < margin || sample.road < margin || (sample.field >= 0 && !sample.is_hedge) ||
         (world.params.relief.sea && sample.height < world.params.relief.sea_level + margin);
}

bool is_bare_cell(const World& world, const TerrainGrid& grid, int column, int row) {
  return is_bare(world, grid.at(column, row)) || is_bare(world, grid.at(column + 1, row)) ||
         is_bare(world, grid.at(column, row + 1)) || is_bare(world, grid.at(column + 1, row + 1));
}

}  // namespace

bool has_ground_cover(const World& world) {
  return world.has(Layer::terrain) && world.has(Layer::plants) && !world.params.plants.empty();
}

CoverFile cover_file(const World& world) {
  const WorldColors& colors = world.params.colors;
  PlantBuilder builder(key);
  CoverFile made;
  for (std::size_t shape = 0; shape < cover_shapes; ++shape) {
    switch (static_cast<CoverShape>(shape)) {
      case CoverShape::tuft:
        builder.tuft(20, {0.46, 0.3}, rgba_of(colors.grass, 1.05));
        break;
      case CoverShape::straw:
        builder.tuft(14, {0.4, 0.25}, rgba_of(colors.dry, 1));
        break;
      case CoverShape::flowers:
        builder.tuft(11, {0.45, 0.2}, rgba_of(colors.grass, 1));
        builder.heads(9, {0.45, 0.26}, {235, 228, 190, 255});
        break;
      case CoverShape::stone:
        builder.revolve({{0.24, -0.05}, {0.28, 0.08}, {0.19, 0.2}, {0.02, 0.25}}, 6,
                        rgba_of(colors.rock, 0.95), plain_surface, 0.45);
        break;
    }
    made.starts[shape + 1] = builder.corners();
  }
  made.file = builder.file();
  made.file.hash = hash_of(made.file.bytes);
  return made;
}

namespace {

/// A cell of the grid: its number, its south-western corner and its kind of ground.
struct Cell {
  int column = 0, row = 0;
  double west = 0, south = 0;
  GroundKind kind = GroundKind::grass;
};

struct Piece {
  std::size_t shape = 0;
  std::array<double, 3> at{};  ///< from the middle of the tile
  std::array<float, 3> scale{};
};

/// Adds at most one piece, chosen by the noise of patches and a random number of the cell.
void add_piece(std::vector<Piece>& pieces, const World& world, const TileFrame& frame,
               const TerrainGrid& grid, const Cell& cell) {
  Rng rng(cell_key(world.key ^ key, math::to_int64(cell.west / grid.spacing),
                   math::to_int64(cell.south / grid.spacing)));
  const double east = rng.unit(), north = rng.unit();
  double chosen = rng.unit();
  const double uneven = rng.uniform(-0.3, 0.3), t = rng.unit(), flat = rng.uniform(0.7, 1);
  const double patch = octave(world.key ^ key, cell.west, cell.south, patch_wavelength).value;
  const double flowering = octave(world.key ^ (key + 1), cell.west, cell.south, flower_wavelength).value;
  const double dense = smooth_step(patch + uneven, -0.35, 0.4);
  const Climate climate = climate_at(world, cell.west, cell.south, grid.at(cell.column, cell.row).height);
  const Densities densities = densities_on(cell.kind, climate, flowering);
  for (std::size_t shape = 0; shape < cover_shapes; ++shape) {
    chosen -= dense * densities[shape];
    if (chosen >= 0) continue;
    const double size = 0.5 + 1.5 * t * t;
    const auto wide = static_cast<float>(size), high = static_cast<float>(size * flat);
    pieces.push_back({shape,
                      {cell.west + east * grid.spacing - frame.middle_east,
                       height_in(grid, cell.column, cell.row, east, north),
                       frame.middle_north - cell.south - north * grid.spacing},
                      {wide, high, wide}});
    return;
  }
}

}  // namespace

void add_ground_cover(Glb& glb, const World& world, const TileFrame& frame, const TerrainGrid& grid,
                      const TerrainMesh& terrain, Job& job) {
  std::vector<Piece> pieces;
  for (int row = 0; row + 1 < grid.count; ++row) {
    job.check();
    for (int column = 0; column + 1 < grid.count; ++column) {
      if (is_bare_cell(world, grid, column, row)) continue;
      add_piece(pieces, world, frame, grid,
                {column, row, grid.west + column * grid.spacing, grid.south + row * grid.spacing,
                 terrain.kinds[static_cast<std::size_t>(row * grid.count + column)]});
    }
  }
  const std::size_t size = glb.size();
  const std::size_t most = size < most_leaf_bytes ? (most_leaf_bytes - size) / piece_bytes : 0;
  const std::size_t kept = std::min(most, pieces.size());
  if (kept == 0) return;
  std::array<Instances, cover_shapes> copies;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if ((k + 1) * kept / pieces.size() == k * kept / pieces.size()) continue;
    copies[pieces[k].shape].add(pieces[k].at, pieces[k].scale);
  }
  const CoverFile made = cover_file(world);
  const std::string image = shared_files + leaf_texture(world, job)->hash + ".png";
  const SharedPlants shared = add_shared_plants(glb, made.file, "ground_cover", image);
  for (std::size_t shape = 0; shape < cover_shapes; ++shape) {
    if (copies[shape].count() == 0) continue;
    const std::size_t first = made.starts[shape], count = made.starts[shape + 1] - first;
    job.spend(Resource::triangles, copies[shape].count() * count / 3);
    copies[shape].add_to(glb, names[shape], {add_plant_mesh(glb, shared, names[shape], first, count)});
  }
}

}  // namespace seedmesh::world
