#include "core/generators/world/terrain_indices.h"

#include <bit>

#include "core/base/math.h"
#include "core/generators/world/asset.h"
#include "core/generators/world/ground_texture.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {
namespace {

void append_float(std::string& out, float value) {
  const auto word = std::bit_cast<std::uint32_t>(value);
  for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>((word >> shift) & 255U);
}

/// Appends the triangles of tiles with `cells` cells along a side, to a multiple of 4 bytes.
FilePart append_indices(std::string& file, int cells) {
  const std::vector<std::uint16_t> corners = terrain_indices(cells + 1);
  const FilePart part{file.size(), corners.size()};
  for (const std::uint16_t corner : corners) {
    file += static_cast<char>(corner & 255U);
    file += static_cast<char>(corner >> 8U);
  }
  file.resize((file.size() + 3) & ~std::size_t{3});
  return part;
}

/// Appends the coordinates of a grid of `count` x `count` vertices with a skirt. They are turned and bent, so that repeats
/// do not lie in straight rows, but differ by whole repeats from border to border, so that tiles meet.
FilePart append_coordinates(std::string& file, int count) {
  constexpr double bend = 0.4;  // of a repeat
  FilePart part{file.size(), 0};
  const auto add = [&](int vertex) {
    const double x = static_cast<double>(vertex % count) / (count - 1),  // exact
        y = static_cast<double>(vertex / count) / (count - 1);
    const math::SinCos around_x = math::sincos_degrees(360 * x), around_y = math::sincos_degrees(360 * y);
    append_float(file, static_cast<float>(texture_repeats_along * x + texture_repeats_across * y +
                                          bend * around_y.sin + bend / 2 * around_x.cos));
    append_float(file, static_cast<float>(texture_repeats_along * y - texture_repeats_across * x +
                                          bend * around_x.sin - bend / 2 * around_y.cos));
    ++part.count;
  };
  for (int k = 0; k < count * count; ++k) add(k);
  for (const std::uint16_t top : border_of_grid(count)) add(top);
  return part;
}

}  // namespace

std::vector<std::uint16_t> border_of_grid(int count) {
  std::vector<std::uint16_t> border;
  const auto at = [&](int column, int row) { return static_cast<std::uint16_t>(row * count + column); };
  const int last = count - 1;
  border.reserve(4 * static_cast<std::size_t>(last));
  for (int k = 0; k < last; ++k) border.push_back(at(k, 0));
  for (int k = 0; k < last; ++k) border.push_back(at(last, k));
  for (int k = last; k > 0; --k) border.push_back(at(k, last));
  for (int k = last; k > 0; --k) border.push_back(at(0, k));
  return border;
}

std::vector<std::uint16_t> terrain_indices(int count) {
  std::vector<std::uint16_t> corners;
  const auto add = [&](int a, int b, int c) {
    for (const int corner : {a, b, c}) corners.push_back(static_cast<std::uint16_t>(corner));
  };
  for (int row = 0; row + 1 < count; ++row) {
    for (int column = 0; column + 1 < count; ++column) {
      const int a = row * count + column, b = a + count;
      add(a, a + 1, b + 1);
      add(a, b + 1, b);
    }
  }
  const std::vector<std::uint16_t> border = border_of_grid(count);
  const int first = count * count, size = static_cast<int>(border.size());
  for (int k = 0; k < size; ++k) {
    const int next = (k + 1) % size;
    const int top = border[static_cast<std::size_t>(k)], top_next = border[static_cast<std::size_t>(next)];
    add(top, first + k, first + next);
    add(top, first + next, top_next);
  }
  return corners;
}

std::shared_ptr<const TerrainFile> terrain_file(const World& world, const Job& job) {
  return world.store->get<TerrainFile>({0, Store::Layer::file, -1, 0, 0}, job, [] {
    TerrainFile made;
    made.indices = append_indices(made.file, tile_cells);
    made.dense_indices = append_indices(made.file, dense_cells);
    made.coordinates = append_coordinates(made.file, tile_cells + 1);
    made.dense_coordinates = append_coordinates(made.file, dense_cells + 1);
    made.hash = hash_of(made.file);
    return std::make_shared<const TerrainFile>(std::move(made));
  });
}

}  // namespace seedmesh::world
