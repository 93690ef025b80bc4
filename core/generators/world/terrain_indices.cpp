#include "core/generators/world/terrain_indices.h"

#include "core/generators/world/asset.h"

namespace seedmesh::world {

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

TerrainIndices terrain_indices(int count) {
  TerrainIndices made;
  const auto add = [&](int a, int b, int c) {
    for (const int corner : {a, b, c}) made.corners.push_back(static_cast<std::uint16_t>(corner));
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
  for (const std::uint16_t corner : made.corners) {
    made.file += static_cast<char>(corner & 255U);
    made.file += static_cast<char>(corner >> 8U);
  }
  made.hash = hash_of(made.file);
  return made;
}

std::shared_ptr<const TerrainIndices> terrain_indices_of(const World& world, int cells, const Job& job) {
  return world.store->get<TerrainIndices>({0, Store::Layer::file, -1, 0, cells}, job, [cells] {
    return std::make_shared<const TerrainIndices>(terrain_indices(cells + 1));
  });
}

}  // namespace seedmesh::world
