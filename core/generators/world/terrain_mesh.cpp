#include "core/generators/world/terrain_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/areas.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/terrain_indices.h"

namespace seedmesh::world {
namespace {

constexpr double border_share = 0.9;     ///< the greatest deviation along a line, by that of an area
constexpr double far_share = 0.9;        ///< the same for the coarsest tiles beside it
constexpr double unusual = 1.15;         ///< share of the usual skirt: the deepest that boxes include
constexpr double wide_unusual = 1.05;    ///< the same for tiles wider than `widest_known_rivers`
constexpr double widest_fine_rise = 64;  ///< metres
constexpr double fine_share = 0.7;       ///< share of normals that follow the slope of finer levels
constexpr double rounding_steps = 9;  ///< steps by which heights of the coarsest tiles beside it are rounded

/// Rises by a metre east and north.
struct Rise {
  double east = 0, north = 0;
};

/// What samples far apart leave out of the ground around one of them: its slope at finer levels, away from water.
Rise fine_rise(const World& world, const GroundSample& sample, double east, double north, double spacing) {
  const double by = std::clamp(spacing / 4, 8.0, widest_fine_rise);
  const double here = detail_at(world, sample.land, east, north);
  return {sample.land.height.east + (detail_at(world, sample.land, east + by, north) - here) / by,
          sample.land.height.north + (detail_at(world, sample.land, east, north + by) - here) / by};
}

/// A vertex and the kind of its ground.
struct Corner {
  TileVertex vertex;
  GroundKind kind = GroundKind::grass;
};

/// What a slope is multiplied by, for shading alone. Wide samples leave most of the slope out, and land without shades looks flat
/// from afar. Gentle slopes gain most.
double exaggeration(double spacing, double slope) {
  return 1 + 4.5 * smooth_step(spacing, 64, 1024) / (1 + 10 * slope);
}

Corner corner_of(const World& world, const GroundColors& colors, const TileFrame& frame,
                 const TileGround& ground, int column, int row) {
  const TerrainGrid& grid = ground.grid;
  const GroundSample& sample = grid.at(column, row);
  const double east = grid.west + column * grid.spacing, north = grid.south + row * grid.spacing;
  const double run = 2 * grid.spacing;
  Rise seen{(grid.at(column + 1, row).height - grid.at(column - 1, row).height) / run,
            (grid.at(column, row + 1).height - grid.at(column, row - 1).height) / run};
  Rise fine = seen;
  const double share = fine_share * smooth_step(grid.spacing, 12, 64) * smooth_step(sample.shore, 20, 200);
  if (share > 0) {
    fine = fine_rise(world, sample, east, north, grid.spacing);
    seen.east += share * (fine.east - seen.east);
    seen.north += share * (fine.north - seen.north);
  }
  const double more = exaggeration(grid.spacing, std::sqrt(seen.east * seen.east + seen.north * seen.north));
  seen.east *= more;
  seen.north *= more;
  const double length = std::sqrt(seen.east * seen.east + seen.north * seen.north + 1);
  const double steepness = 1 / std::sqrt(fine.east * fine.east + fine.north * fine.north + 1);
  const auto byte = [&](double value) {
    return static_cast<std::int8_t>(math::to_int32(std::floor(value / length * 127 + 0.5)));
  };
  Corner corner;
  TileVertex& vertex = corner.vertex;
  vertex.x = static_cast<std::int16_t>(math::to_int32((east - frame.middle_east) / frame.step));
  vertex.y = steps_of(sample.height, ground.base, frame.step);
  vertex.z = static_cast<std::int16_t>(math::to_int32((frame.middle_north - north) / frame.step));
  vertex.normal[0] = byte(-seen.east);
  vertex.normal[1] = byte(1);
  vertex.normal[2] = byte(seen.north);
  const double around = grid.at(column + 1, row).height + grid.at(column - 1, row).height +
                        grid.at(column, row + 1).height + grid.at(column, row - 1).height;
  // as tiles with the usual number of cells
  const double resolved = frame.side / tile_cells;
  const GroundForm form{steepness, more * (around / 4 - sample.height) / grid.spacing, resolved,
                        frame.spacing <= widest_textured_spacing};
  const GroundLook look = ground_look(world, colors, sample, {east, north}, form);
  std::copy(look.color.begin(), look.color.end(), vertex.color);
  corner.kind = look.kind;
  return corner;
}

double usual_skirt(const World& world, const TileFrame& frame, const Roughness& rough) {
  return far_share * deviation_of(world, far_spacing(world, frame.side), rough) +
         border_share * deviation_of(world, frame.spacing, rough) + rounding_steps * frame.step;
}

double unusual_share(const TileFrame& frame) {
  return frame.side > widest_known_rivers ? wide_unusual : unusual;
}

double uncut(const GroundSample& sample) { return sample.land.height.value + sample.cut; }

/// The greatest slope of the land without valleys at the border of a tile, between samples `stride` apart.
double slope_of_border(const TerrainGrid& grid, double spacing, int stride) {
  const int last = grid.count - 1 - stride;
  double most = 0;
  const auto look_at = [&](int i, int j) {
    const double here = uncut(grid.at(i, j));
    const double east = uncut(grid.at(i + stride, j)) - here, north = uncut(grid.at(i, j + stride)) - here;
    most = std::max(most, east * east + north * north);
  };
  for (int k = 0; k <= last; k += stride) {
    look_at(k, 0);
    look_at(k, last);
    look_at(0, k);
    look_at(last, k);
  }
  return std::sqrt(most) / (stride * spacing);
}

/// Vertices below those of the border.
void add_skirt(TerrainMesh& mesh, int count, double skirt, double step) {
  const int depth = math::to_int32(std::ceil(skirt / step));
  for (const std::uint16_t top : border_of_grid(count)) {
    TileVertex low = mesh.vertices[top];
    low.y = static_cast<std::int16_t>(std::max(-32768, low.y - depth));
    mesh.vertices.push_back(low);
    mesh.kinds.push_back(mesh.kinds[top]);
  }
}

}  // namespace

double skirt_depth(const World& world, int level, const TerrainGrid& grid) {
  const TileFrame frame = frame_of(world, {level, 0, 0});
  const int last = grid.count - 1;
  const int widest = math::to_int32(far_spacing(world, frame.side) / frame.spacing);
  Roughness rough;
  double most = 0, lowest_land = 1e12, highest_land = -1e12;
  for (int side = 0; side < 4; ++side) {
    const auto at = [&](int k) -> const GroundSample& {
      return side < 2 ? grid.at(k, side * last) : grid.at((side - 2) * last, k);
    };
    for (int k = 0; k <= last; ++k) {
      rough.add(at(k));
      lowest_land = std::min(lowest_land, uncut(at(k)));
      highest_land = std::max(highest_land, uncut(at(k)));
      for (int stride = 2; stride <= widest; stride *= 2) {
        const int from = k / stride * stride, to = std::min(from + stride, last);
        if (from == k || from == to) continue;
        const double t = static_cast<double>(k - from) / (to - from);
        const double chord = at(from).height + t * (at(to).height - at(from).height);
        most = std::max(most, std::abs(at(k).height - chord));
      }
    }
  }
  // as areas_below() finds them, so that boxes contain the skirts
  const double spacing = spacing_of_areas(world, level);
  if (spacing >= coarse_spacing) {
    const int stride = std::max(1, math::to_int32(spacing / frame.spacing));
    rough.slope = slope_of_border(grid, frame.spacing, stride);
  }
  if (frame.side > widest_known_rivers)
    rough.valley = std::min(rough.valley, valley_of_skirts(highest_land - lowest_land));
  const double usual = usual_skirt(world, frame, rough);
  return std::clamp(most + rounding_steps * frame.step, usual, unusual_share(frame) * usual);
}

double most_skirt(const World& world, const TileFrame& frame, Roughness rough) {
  if (!world.has(Layer::terrain)) return 0;
  rough.mesh_deviation = {};  // no tile depends on it, and skirts cover the gaps to neighbours
  return unusual_share(frame) * usual_skirt(world, frame, rough);
}

std::int16_t steps_of(double height, double base, double step) {
  return static_cast<std::int16_t>(
      std::clamp(math::to_int32(std::floor(height / step + 0.5) - base / step), -32768, 32767));
}

double base_of(double low, double high, double step) {
  return std::floor((low + high) / 2 / step + 0.5) * step;
}

TerrainMesh terrain_mesh(const World& world, const TileFrame& frame, const TerrainGrid& grid, double skirt) {
  TerrainMesh made;
  const int count = grid.count;
  double low = grid.at(0, 0).height, high = low;
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      low = std::min(low, grid.at(column, row).height);
      high = std::max(high, grid.at(column, row).height);
    }
  }
  made.height = base_of(low, high, frame.step);
  const auto cells = static_cast<std::size_t>(count - 1);
  made.vertices.reserve((cells + 1) * (cells + 1) + 4 * cells);
  made.kinds.reserve((cells + 1) * (cells + 1) + 4 * cells);
  const GroundColors colors(world);
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const Corner corner = corner_of(world, colors, frame, {grid, made.height}, column, row);
      made.vertices.push_back(corner.vertex);
      made.kinds.push_back(corner.kind);
    }
  }
  add_skirt(made, count, skirt, frame.step);
  return made;
}

}  // namespace seedmesh::world
