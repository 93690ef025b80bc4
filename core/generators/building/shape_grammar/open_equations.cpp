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
  const std::size_t count = rows.empty() ? 0 : rows[0].size() - 1;
  std::vector<std::vector<double>> basis;         // orthonormal columns
  std::vector<std::vector<double>> upper(count);  // of each column: its parts along the basis
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  for (std::size_t c = 0; c < count; ++c) {
    std::vector<double> column;
    for (const std::vector<double>& row : rows) column.push_back(row[c]);
    const double length = std::sqrt(dot(column, column));
    upper[c].assign(basis.size() + 1, 0.0);
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes rounding
      for (std::size_t k = 0; k < basis.size(); ++k) {
        const double part = dot(basis[k], column);
        upper[c][k] += part;
        for (std::size_t i = 0; i < column.size(); ++i) column[i] -= part * basis[k][i];
      }
    }
    const double rest = std::sqrt(dot(column, column));
    if (!(rest > no_pivot * length)) continue;
    upper[c][basis.size()] = rest;
    for (double& each : column) each /= rest;
    basis.push_back(std::move(column));
  }
  if (basis.size() < count) return basis.size();
  std::vector<double> right;
  for (const std::vector<double>& row : rows) right.push_back(row[count]);
  x.assign(count, 0.0);
  for (std::size_t c = count; c-- > 0;) {
    double value = dot(basis[c], right);
    for (std::size_t k = c + 1; k < count; ++k) value -= upper[k][c] * x[k];
    x[c] = value / upper[c][c];
  }
  return count;
}

}  // namespace seedmesh::building
