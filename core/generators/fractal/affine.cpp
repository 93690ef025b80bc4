#include "core/generators/fractal/affine.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::fractal {
namespace {

constexpr double tolerance = 1e-9;  ///< relative; above the rounding errors of composed maps

/// Makes element (p, q) of a symmetric matrix 0 by a rotation.
void rotate(glm::dmat3& m, int p, int q) {
  if (m[p][q] == 0) return;
  const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  glm::dmat3 turn(1);
  turn[p][p] = turn[q][q] = c;
  turn[p][q] = -s;
  turn[q][p] = s;
  m = glm::transpose(turn) * m * turn;
}

}  // namespace

double norm(const Affine& map) {
  glm::dmat3 square = glm::transpose(map.linear) * map.linear;
  for (int sweep = 0; sweep < 12; ++sweep) {
    rotate(square, 0, 1);
    rotate(square, 0, 2);
    rotate(square, 1, 2);
  }
  return std::sqrt(std::max({square[0][0], square[1][1], square[2][2], 0.0}));
}

std::optional<double> similarity(const Affine& map) {
  const glm::dmat3 square = glm::transpose(map.linear) * map.linear;
  const double scale = (square[0][0] + square[1][1] + square[2][2]) / 3;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(square[i][j] - (i == j ? scale : 0)) > tolerance * scale) return std::nullopt;
    }
  }
  return std::sqrt(scale);
}

Transform transform_of(const Affine& map, double scale) {
  const double sign = glm::determinant(map.linear) < 0 ? -1 : 1;
  const glm::dmat3 turn = map.linear * (1 / (sign * scale));
  Transform transform;
  transform.translation = glm::vec3(map.offset);
  const glm::dquat q = glm::quat_cast(turn);
  transform.rotation = glm::quat(q / std::sqrt(glm::dot(q, q)));
  transform.scale = glm::vec3(static_cast<float>(sign * scale));
  return transform;
}

}  // namespace seedmesh::fractal
