#include "core/texture/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace seedmesh::texture {
namespace {

// Gradients of Perlin's noise in the plane: sixteen directions, longer than 1 so that values reach about 1.
constexpr float reach = 1.4F, c1 = 0.92388F, s1 = 0.38268F, d1 = 0.70711F;
constexpr glm::vec2 gradients[16] = {{1, 0},    {c1, s1},  {d1, d1},  {s1, c1},   {0, 1},     {-s1, c1},
                                     {-d1, d1}, {-c1, s1}, {-1, 0},   {-c1, -s1}, {-d1, -d1}, {-s1, -c1},
                                     {0, -1},   {s1, -c1}, {d1, -d1}, {c1, -s1}};

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

int wrapped(int value, int period) {
  const int rest = value % period;
  return rest < 0 ? rest + period : rest;
}

std::uint64_t corner_key(Rng rng, Lattice lattice, int column, int row) {
  return rng.at(static_cast<std::uint64_t>(wrapped(row, lattice.rows)))
      .at(static_cast<std::uint64_t>(wrapped(column, lattice.columns)))
      .key();
}

glm::vec2 gradient(Rng rng, Lattice lattice, int column, int row) {
  return gradients[corner_key(rng, lattice, column, row) >> 60U] * reach;
}

/// The noise of one row of texels as, for each lattice corner, slope * (distance to the right) + offset.
struct Knot {
  float slope, offset;
};

struct RowPlan {
  std::vector<Knot> knots;
  std::vector<int> first;  ///< texel where each square begins
};

void plan_row(RowPlan& plan, Rng rng, Lattice lattice, float v) {
  const int row = static_cast<int>(v);
  const float below = v - static_cast<float>(row), s = fade(below);
  for (int i = 0; i <= lattice.columns; ++i) {
    const glm::vec2 a = gradient(rng, lattice, i, row), b = gradient(rng, lattice, i, row + 1);
    const float upper = a.y * below, lower = b.y * (below - 1);
    plan.knots[static_cast<std::size_t>(i)] = {a.x + (b.x - a.x) * s, upper + (lower - upper) * s};
  }
}

template <Fold fold>
void add_rows(Field& field, Lattice lattice, float amplitude, Rng rng, std::size_t begin, std::size_t end) {
  const int size = field.size();
  const float by_texel = static_cast<float>(lattice.columns) / static_cast<float>(size);
  RowPlan plan;
  plan.knots.resize(static_cast<std::size_t>(lattice.columns) + 1);
  for (int i = 0; i <= lattice.columns; ++i) {
    plan.first.push_back((i * size + lattice.columns - 1) / lattice.columns);
  }
  for (std::size_t y = begin; y < end; ++y) {
    const float v = static_cast<float>(y) * static_cast<float>(lattice.rows) / static_cast<float>(size);
    plan_row(plan, rng, lattice, v);
    float* out = field.row(static_cast<int>(y));
    for (int i = 0; i < lattice.columns; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Knot a = plan.knots[at], b = plan.knots[at + 1];
      const auto corner = static_cast<float>(i);
      for (int x = plan.first[at]; x < plan.first[at + 1]; ++x) {
        const float dx = static_cast<float>(x) * by_texel - corner;
        const float left = a.slope * dx + a.offset, right = b.slope * (dx - 1) + b.offset;
        const float n = left + (right - left) * fade(dx);
        out[x] += amplitude * (fold == Fold::ridge ? 1 - std::abs(n) : n);
      }
    }
  }
}

struct CellPoint {
  glm::vec2 place;
  float shade;
};

/// The jittered points of all squares, one in each.
std::vector<CellPoint> cell_points(Lattice lattice, Rng rng) {
  std::vector<CellPoint> points;
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      Rng own(corner_key(rng, lattice, column, row));
      const auto x = static_cast<float>(own.uniform(0.1, 0.9)), y = static_cast<float>(own.uniform(0.1, 0.9));
      points.push_back({{x, y}, static_cast<float>(own.unit())});
    }
  }
  return points;
}

/// The nine points in and around a square; those of the last square are kept for the texels that follow.
class NearPoints {
 public:
  NearPoints(const std::vector<CellPoint>& points, Lattice lattice) : points_(points), lattice_(lattice) {}

  /// The distance from `at` (in squares) to the border between its nearest and second nearest point.
  void find_cell(glm::vec2 at, float& border, float& shade) {
    const int column = static_cast<int>(std::floor(at.x)), row = static_cast<int>(std::floor(at.y));
    if (column != column_ || row != row_ || is_empty_) fill(column, row);
    std::array<float, count> distance;
    for (std::size_t i = 0; i < count; ++i) {
      const float x = x_[i] - at.x, y = y_[i] - at.y;
      distance[i] = x * x + y * y;
    }
    // Without branches, which the processor could not predict.
    float nearest = 1e9F, second = 1e9F;
    std::uint32_t near_point = 0, second_point = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const float own = distance[i];
      const bool is_nearest = own < nearest, is_second = own < second;
      second_point = is_nearest ? near_point : is_second ? i : second_point;
      second = is_nearest ? nearest : is_second ? own : second;
      near_point = is_nearest ? i : near_point;
      nearest = is_nearest ? own : nearest;
    }
    shade = shade_[near_point];
    const glm::vec2 across = (glm::vec2(x_[second_point], y_[second_point]) - at) -
                             (glm::vec2(x_[near_point], y_[near_point]) - at);
    const float length = std::sqrt(across.x * across.x + across.y * across.y);
    border = length > 0 ? (second - nearest) / (2 * length) : 0;
  }

 private:
  static constexpr std::size_t count = 9;

  void fill(int column, int row) {
    column_ = column;
    row_ = row;
    is_empty_ = false;
    std::size_t i = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      const int r = wrapped(row + dy, lattice_.rows) * lattice_.columns;
      for (int dx = -1; dx <= 1; ++dx, ++i) {
        const CellPoint& point =
            points_[static_cast<std::size_t>(r + wrapped(column + dx, lattice_.columns))];
        x_[i] = static_cast<float>(column + dx) + point.place.x;
        y_[i] = static_cast<float>(row + dy) + point.place.y;
        shade_[i] = point.shade;
      }
    }
  }

  const std::vector<CellPoint>& points_;
  Lattice lattice_;
  int column_ = 0, row_ = 0;
  bool is_empty_ = true;
  std::array<float, count> x_{}, y_{}, shade_{};
};

}  // namespace

Field::Field(const Job& job, int size, float value)
    : size_(size), values_(job, static_cast<std::size_t>(size) * static_cast<std::size_t>(size), value) {}

float Field::sample(float x, float y) const {
  const float left = std::floor(x), top = std::floor(y);
  const int i = static_cast<int>(left), j = static_cast<int>(top);
  const float u = x - left, v = y - top;
  const float upper = at(i, j) + (at(i + 1, j) - at(i, j)) * u;
  const float lower = at(i, j + 1) + (at(i + 1, j + 1) - at(i, j + 1)) * u;
  return upper + (lower - upper) * v;
}

void add_noise(Field& field, Lattice lattice, float amplitude, Rng rng, const Job& job, Fold fold) {
  if (std::max(lattice.columns, lattice.rows) > field.size() / 2) return;
  parallel_for(job, static_cast<std::size_t>(field.size()), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 if (fold == Fold::ridge) {
                   add_rows<Fold::ridge>(field, lattice, amplitude, rng, begin, end);
                 } else {
                   add_rows<Fold::plain>(field, lattice, amplitude, rng, begin, end);
                 }
               });
}

void add_noise(Field& field, Lattice lattice, Octaves octaves, float amplitude, Rng rng, const Job& job) {
  for (int i = 0; i < octaves.count; ++i) {
    add_noise(field, lattice, amplitude, rng.at(static_cast<std::uint64_t>(i)), job);
    lattice = {2 * lattice.columns, 2 * lattice.rows};
    amplitude *= octaves.gain;
  }
}

Cells cells(int size, Lattice lattice, Rng rng, const Field* wobble, float strength, const Job& job) {
  Cells made{Field(job, size), Field(job, size)};
  const std::vector<CellPoint> points = cell_points(lattice, rng);
  const float by_x = static_cast<float>(lattice.columns) / static_cast<float>(size);
  const float by_y = static_cast<float>(lattice.rows) / static_cast<float>(size);
  parallel_for(job, static_cast<std::size_t>(size), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 NearPoints near_points(points, lattice);
                 for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
                   float* border = made.border.row(y);
                   float* shade = made.shade.row(y);
                   for (int x = 0; x < size; ++x) {
                     glm::vec2 at{static_cast<float>(x) * by_x, static_cast<float>(y) * by_y};
                     if (wobble)
                       at += glm::vec2(wobble->at(x, y), wobble->at(x + size / 2, y + size / 3)) * strength;
                     near_points.find_cell(at, border[x], shade[x]);
                   }
                 }
               });
  return made;
}

}  // namespace seedmesh::texture
