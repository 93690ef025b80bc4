#include "core/texture/cells.h"

#include <algorithm>
#include <cmath>

#include "core/base/wide.h"

namespace seedmesh::texture {
namespace {

/// Two vectors of 256 bits, so that the processor computes one while it waits for the other.
constexpr int lanes = 16;
constexpr int margin =
    5;  ///< squares beyond the image that displaced texels can reach, with their neighbours

int wrapped(int value, int period) {
  const int rest = value % period;
  return rest < 0 ? rest + period : rest;
}

/// The nine points in and around a square.
struct Near {
  float x[9], y[9], shade[9];
};

/// What is found for a texel, in arrays by texel.
struct Found {
  float *border, *shade, *right, *down;
};

/// What is found for the texels of all lanes.
struct LaneCells {
  float border[lanes], shade[lanes], right[lanes], down[lanes];
};

/// The cells of `lanes` texels in one square: the distance to the border between the nearest and the second nearest
/// point.
inline void find_cells(const Near& near, const float* __restrict at_x, const float* __restrict at_y,
                       LaneCells& cells) {
  for (int k = 0; k < lanes; ++k) {
    const float x = at_x[k], y = at_y[k];
    // Without branches, which the processor could not predict.
    float nearest = 1e9F, second = 1e9F, near_x = 0, near_y = 0, second_x = 0, second_y = 0, own_shade = 0;
#pragma GCC unroll 9
    for (int i = 0; i < 9; ++i) {
      const float dx = near.x[i] - x, dy = near.y[i] - y, own = dx * dx + dy * dy;
      const bool is_nearest = own < nearest, is_second = own < second;
      second_x = is_nearest ? near_x : is_second ? near.x[i] : second_x;
      second_y = is_nearest ? near_y : is_second ? near.y[i] : second_y;
      second = is_nearest ? nearest : is_second ? own : second;
      near_x = is_nearest ? near.x[i] : near_x;
      near_y = is_nearest ? near.y[i] : near_y;
      own_shade = is_nearest ? near.shade[i] : own_shade;
      nearest = is_nearest ? own : nearest;
    }
    const float across_x = second_x - near_x, across_y = second_y - near_y;
    cells.border[k] = (second - nearest) / (2 * std::sqrt(across_x * across_x + across_y * across_y));
    cells.shade[k] = own_shade;
    cells.right[k] = x - near_x;
    cells.down[k] = y - near_y;
  }
}

struct RowInput {
  const Cells::Point* points;
  int pitch;
  Lattice lattice;
  int size;
};

/// All texels of a row. Lanes of several squares are computed for each of these squares.
SEEDMESH_WIDE void find_row(const RowInput& in, const float* __restrict x, const float* __restrict y,
                            const Found& found) {
  float* __restrict border = found.border, * __restrict shade = found.shade;
  float* __restrict right = found.right, * __restrict down = found.down;
  const auto last_column = static_cast<float>(in.lattice.columns + 2 * margin - 2);
  const auto last_row = static_cast<float>(in.lattice.rows + 2 * margin - 2);
  for (int begin = 0; begin < in.size; begin += lanes) {
    int square[lanes];
    for (int k = 0; k < lanes; ++k) {
      const float column = std::clamp(x[begin + k] + margin, 1.0F, last_column);
      const float row = std::clamp(y[begin + k] + margin, 1.0F, last_row);
      square[k] = static_cast<int>(row) * in.pitch + static_cast<int>(column);
    }
    int done = 0;  // lanes, a bit each
    while (done != (1 << lanes) - 1) {
      int first = 0;
      while ((done >> first & 1) != 0) ++first;
      const int own = square[first];
      Near near;
      for (int i = 0; i < 9; ++i) {
        const Cells::Point& point = in.points[own + (i / 3 - 1) * in.pitch + i % 3 - 1];
        near.x[i] = point.x;
        near.y[i] = point.y;
        near.shade[i] = point.shade;
      }
      LaneCells cells;
      find_cells(near, x + begin, y + begin, cells);
      for (int k = 0; k < lanes; ++k) {
        const bool is_own = square[k] == own;
        border[begin + k] = is_own ? cells.border[k] : border[begin + k];
        shade[begin + k] = is_own ? cells.shade[k] : shade[begin + k];
        right[begin + k] = is_own ? cells.right[k] : right[begin + k];
        down[begin + k] = is_own ? cells.down[k] : down[begin + k];
        done |= static_cast<int>(is_own) << k;
      }
    }
  }
}

}  // namespace

Cells::Cells(int size, Lattice lattice, Rng rng)
    : size_(size), lattice_(lattice), pitch_(lattice.columns + 2 * margin) {
  for (int row = -margin; row < lattice.rows + margin; ++row) {
    const Rng of_row = rng.at(static_cast<std::uint64_t>(wrapped(row, lattice.rows)));
    for (int column = -margin; column < lattice.columns + margin; ++column) {
      Rng own = of_row.at(static_cast<std::uint64_t>(wrapped(column, lattice.columns)));
      const auto x = static_cast<float>(own.uniform(0.1, 0.9)), y = static_cast<float>(own.uniform(0.1, 0.9));
      points_.push_back(
          {static_cast<float>(column) + x, static_cast<float>(row) + y, static_cast<float>(own.unit())});
    }
  }
}

CellRows::CellRows(const Cells& cells, const Field& wobble, float strength)
    : cells_(cells), wobble_(wobble), strength_(strength) {
  const auto size = static_cast<std::size_t>(cells.size_);
  for (std::vector<float>* each : {&x_, &y_, &border_, &shade_, &right_, &down_}) each->resize(size);
}

CellRows::Row CellRows::row(int y) {
  const int size = cells_.size_, half = size / 2;
  const float by_x = static_cast<float>(cells_.lattice_.columns) / static_cast<float>(size);
  const float by_y = static_cast<float>(cells_.lattice_.rows) / static_cast<float>(size);
  const float* across = wobble_.row(y);
  const float* down = wobble_.row((y + size / 3) & (size - 1));
  const float at_y = static_cast<float>(y) * by_y;
  for (int x = 0; x < size; ++x)
    x_[static_cast<std::size_t>(x)] = static_cast<float>(x) * by_x + across[x] * strength_;
  for (int x = 0; x < half; ++x) {
    y_[static_cast<std::size_t>(x)] = at_y + down[x + half] * strength_;
    y_[static_cast<std::size_t>(x + half)] = at_y + down[x] * strength_;
  }
  find_row({cells_.points_.data(), cells_.pitch_, cells_.lattice_, size}, x_.data(), y_.data(),
           {border_.data(), shade_.data(), right_.data(), down_.data()});
  return {border_.data(), shade_.data(), right_.data(), down_.data()};
}

}  // namespace seedmesh::texture
