#include "core/generators/building/shape_grammar/open_equations.h"

#include <cmath>

namespace seedmesh::building {
namespace {

constexpr double no_pivot = 1e-9;  ///< a smaller part of a column depends on the others

}  // namespace

void add_rows(Rows& rows, const OpenAnchor& anchor, const glm::dvec3& q, bool is_flat) {
  const std::size_t count = unknowns_of(anchor.changes.size());
  for (int axis = 0; axis < 3; ++axis) {
    if (is_flat && axis == 1) continue;
    std::vector<double> row(count + 1, 0.0);
    if (is_flat) {  // N = (a, -b; b, a)
      row[0] = axis == 0 ? q.x : q.z;
      row[1] = axis == 0 ? -q.z : q.x;
      row[axis == 0 ? 2 : 3] = 1;
    } else {
      row[0] = q[axis];
      row[1 + static_cast<std::size_t>(axis)] = 1;
    }
    for (std::size_t k = 0; k < anchor.changes.size(); ++k) row[4 + k] = -anchor.changes[k][axis];
    row[count] = anchor.at[axis];
    rows.push_back(std::move(row));
  }
}

std::size_t solve(const Rows& rows, std::vector<double>& x) {
  const std::size_t count = rows.empty() ? 0 : rows[0].size() - 1, height = rows.size();
  // One allocation, because searches solve millions of small systems: the orthonormal columns, of each column its
  // parts along them, and the right side.
  std::vector<double> memory(count * height + count * count + height, 0.0);
  double* const basis = memory.data();
  double* const upper = basis + count * height;
  double* const right = upper + count * count;
  std::size_t rank = 0;
  const auto dot = [&](const double* a, const double* b) {
    double sum = 0;
    for (std::size_t i = 0; i < height; ++i) sum += a[i] * b[i];
    return sum;
  };
  for (std::size_t c = 0; c < count; ++c) {
    double* const column = basis + rank * height;
    for (std::size_t i = 0; i < height; ++i) column[i] = rows[i][c];
    const double length = std::sqrt(dot(column, column));
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes rounding
      for (std::size_t k = 0; k < rank; ++k) {
        const double* const other = basis + k * height;
        const double part = dot(other, column);
        upper[c * count + k] += part;
        for (std::size_t i = 0; i < height; ++i) column[i] -= part * other[i];
      }
    }
    const double rest = std::sqrt(dot(column, column));
    if (!(rest > no_pivot * length)) continue;
    upper[c * count + rank] = rest;
    for (std::size_t i = 0; i < height; ++i) column[i] /= rest;
    ++rank;
  }
  if (rank < count) return rank;
  for (std::size_t i = 0; i < height; ++i) right[i] = rows[i][count];
  x.assign(count, 0.0);
  for (std::size_t c = count; c-- > 0;) {
    double value = dot(basis + c * height, right);
    for (std::size_t k = c + 1; k < count; ++k) value -= upper[k * count + c] * x[k];
    x[c] = value / upper[c * count + c];
  }
  return count;
}

}  // namespace seedmesh::building
