#include "core/texture/bond.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::texture {

Courses::Courses(const Bond& bond, int size) : bond_(bond), size_(size) {
  const float width = static_cast<float>(bond.tile.x / bond.columns);
  for (Along* along : {&even_, &odd_}) {
    const float moved = along == &odd_ ? bond.shift : 0;
    for (int x = 0; x < size; ++x) {
      const float u =
          (static_cast<float>(x) + 0.5F) * static_cast<float>(bond.columns) / static_cast<float>(size) +
          moved;
      const float within = u - std::floor(u);
      along->column.push_back(static_cast<int>(u) % bond.columns);
      along->x.push_back(within);
      along->to_side.push_back(std::min(within, 1 - within) * width);
    }
  }
}

Courses::Row Courses::row(int y) const {
  const float v = (static_cast<float>(y) + 0.5F) * static_cast<float>(bond_.rows) / static_cast<float>(size_);
  const int row = static_cast<int>(v);
  const float within = v - std::floor(v), height = static_cast<float>(bond_.tile.y / bond_.rows);
  const Along& along = row % 2 == 1 ? odd_ : even_;
  return {row,
          within,
          std::min(within, 1 - within) * height,
          along.x.data(),
          along.to_side.data(),
          along.column.data()};
}

PieceNumbers::PieceNumbers(const Bond& bond, Rng rng) : columns_(bond.columns) {
  for (int row = 0; row < bond.rows; ++row) {
    const Rng of_row = rng.at(static_cast<std::uint64_t>(row));
    for (int column = 0; column < bond.columns; ++column) {
      Rng own = of_row.at(static_cast<std::uint64_t>(column));
      numbers_.push_back(static_cast<float>(own.unit()));
    }
  }
}

}  // namespace seedmesh::texture
