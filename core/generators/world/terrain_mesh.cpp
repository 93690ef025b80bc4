#include "core/generators/world/terrain_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/palette.h"

namespace seedmesh::world {
namespace {

constexpr double border_share = 0.9;  ///< the greatest deviation along a line, by that of an area
constexpr double far_share = 0.9;     ///< the same for tiles three levels coarser
constexpr double unusual = 1.15;      ///< of the usual skirt: the deepest that was met
constexpr double rounding_steps = 9;  ///< of heights of tiles three levels coarser

TileVertex vertex_of(const World& world, const TileFrame& frame, const TerrainGrid& grid, int column, int row,
                     double base) {
  const GroundSample& sample = grid.at(column, row);
  const double rise_east = grid.at(column + 1, row).height - grid.at(column - 1, row).height;
  const double rise_north = grid.at(column, row + 1).height - grid.at(column, row - 1).height;
  const double run = 2 * grid.spacing;
  const double length = std::sqrt(rise_east * rise_east + rise_north * rise_north + run * run);
  const auto byte = [&](double value) {
    return static_cast<std::int8_t>(math::to_int32(std::floor(value / length * 127 + 0.5)));
  };
  TileVertex vertex;
  const double east = grid.west + column * grid.spacing, north = grid.south + row * grid.spacing;
  vertex.x = static_cast<std::int16_t>(math::to_int32((east - frame.middle_east) / frame.step));
  vertex.y = steps_of(sample.height, base, frame.step);
  vertex.z = static_cast<std::int16_t>(math::to_int32((frame.middle_north - north) / frame.step));
  vertex.normal[0] = byte(-rise_east);
  vertex.normal[1] = byte(run);
  vertex.normal[2] = byte(rise_north);
  const auto color = ground_color(world, sample, east, north, run / length, grid.spacing);
  std::copy(color.begin(), color.end(), vertex.color);
  return vertex;
}

double usual_skirt(const World& world, const TileFrame& frame, const Roughness& rough) {
  return far_share * deviation_of(world, 8 * frame.spacing, rough) +
         border_share * deviation_of(world, frame.spacing, rough) + rounding_steps * frame.step;
}

/// Walls below the border: its vertices in turn, counter-clockwise from above, starting in the south-west.
void add_skirt(TileMesh& mesh, int count, double skirt, double step) {
  std::vector<std::uint32_t> border;
  const auto at = [&](int column, int row) { return static_cast<std::uint32_t>(row * count + column); };
  const int last = count - 1;
  for (int k = 0; k < last; ++k) border.push_back(at(k, 0));
  for (int k = 0; k < last; ++k) border.push_back(at(last, k));
  for (int k = last; k > 0; --k) border.push_back(at(k, last));
  for (int k = last; k > 0; --k) border.push_back(at(0, k));
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const int depth = math::to_int32(std::ceil(skirt / step));
  for (const std::uint32_t top : border) {
    TileVertex low = mesh.vertices[top];
    low.y = static_cast<std::int16_t>(std::max(-32768, low.y - depth));
    mesh.vertices.push_back(low);
  }
  const auto size = static_cast<std::uint32_t>(border.size());
  for (std::uint32_t k = 0; k < size; ++k) {
    const std::uint32_t next = (k + 1) % size;
    for (const std::uint32_t corner : {border[k], first + k, first + next}) mesh.indices.push_back(corner);
    for (const std::uint32_t corner : {border[k], first + next, border[next]}) mesh.indices.push_back(corner);
  }
}

}  // namespace

double skirt_depth(const World& world, const TileFrame& frame, const TerrainGrid& grid) {
  const int last = grid.count - 1;
  Roughness rough;
  double most = 0;
  for (int side = 0; side < 4; ++side) {
    const auto at = [&](int k) -> const GroundSample& {
      return side < 2 ? grid.at(k, side * last) : grid.at((side - 2) * last, k);
    };
    for (int k = 0; k <= last; ++k) {
      rough.add(at(k));
      for (int stride = 2; stride <= 8; stride *= 2) {
        const int from = k / stride * stride, to = std::min(from + stride, last);
        if (from == k || from == to) continue;
        const double t = static_cast<double>(k - from) / (to - from);
        const double chord = at(from).height + t * (at(to).height - at(from).height);
        most = std::max(most, std::abs(at(k).height - chord));
      }
    }
  }
  return std::max(most + rounding_steps * frame.step, usual_skirt(world, frame, rough));
}

double most_skirt(const World& world, const TileFrame& frame, const Roughness& rough) {
  return unusual * usual_skirt(world, frame, rough);
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
  made.mesh.vertices.reserve((cells + 1) * (cells + 1) + 4 * cells);
  made.mesh.indices.reserve(6 * cells * cells + 24 * cells);
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      made.mesh.vertices.push_back(vertex_of(world, frame, grid, column, row, made.height));
    }
  }
  for (int row = 0; row + 1 < count; ++row) {
    for (int column = 0; column + 1 < count; ++column) {
      const auto a = static_cast<std::uint32_t>(row * count + column),
                 b = a + static_cast<std::uint32_t>(count);
      for (const std::uint32_t corner : {a, a + 1, b + 1, a, b + 1, b}) made.mesh.indices.push_back(corner);
    }
  }
  add_skirt(made.mesh, count, skirt, frame.step);
  return made;
}

}  // namespace seedmesh::world
