#pragma once
/// The data of simplification (simplify.cpp): quadrics of a surface, and candidates for edge collapses.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <tuple>

namespace seedmesh {

/// A sum of squared distances to planes, as the ten elements of a symmetric matrix.
struct Quadric {
  std::array<double, 10> q{};
  void add(const glm::dvec3& n, double d, double weight) {
    const double terms[10] = {n.x * n.x, n.x * n.y, n.x * n.z, n.x * d, n.y * n.y,
                              n.y * n.z, n.y * d,   n.z * n.z, n.z * d, d * d};
    for (std::size_t i = 0; i < 10; ++i) q[i] += weight * terms[i];
  }
  void add(const Quadric& other) {
    for (std::size_t i = 0; i < 10; ++i) q[i] += other.q[i];
  }
  double at(const glm::dvec3& p) const {
    return q[0] * p.x * p.x + 2 * q[1] * p.x * p.y + 2 * q[2] * p.x * p.z + 2 * q[3] * p.x +
           q[4] * p.y * p.y + 2 * q[5] * p.y * p.z + 2 * q[6] * p.y + q[7] * p.z * p.z + 2 * q[8] * p.z +
           q[9];
  }
};

/// Returns the cost of moving a point onto another: the error of both quadrics there, plus a small term. The term
/// grows with the fourth power of the distance, so that short edges are collapsed first on flat surfaces.
inline double collapse_cost(const Quadric& from, const Quadric& to, const glm::dvec3& at,
                            const glm::dvec3& target) {
  constexpr double length_weight = 1e-6;
  const glm::dvec3 way = target - at;
  Quadric sum = from;
  sum.add(to);
  return std::max(0.0, sum.at(target)) + length_weight * glm::dot(way, way) * glm::dot(way, way);
}

/// Return the next and the previous corner of the same triangle, in an index array.
inline std::size_t after(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
inline std::size_t before(std::size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

/// A collapse onto a neighbour, allowed or not. Nearly always one of the two cheapest is allowed, so that a search of the
/// least is quicker than sorting. There are no initial values, because most of an array of them is not used.
struct CollapsePath {
  double cost;
  std::uint32_t to;
  bool operator<(const CollapsePath& o) const { return cost != o.cost ? cost < o.cost : to < o.to; }
};

/// The cheapest allowed collapse of a point onto a neighbour, with its exact cost. If it is not yet known which
/// collapse is allowed, `to` is no_point and the cost is a lower bound.
struct CollapseCandidate {
  static constexpr std::uint32_t no_point = 0xFFFFFFFFU;
  double cost;
  std::uint32_t from, to, stamp;  ///< to: no_point for a bound
  /// A total order for a heap with the least cost on top; bounds before collapses of the same cost.
  bool operator<(const CollapseCandidate& o) const {
    const bool is_exact = to != no_point, is_other_exact = o.to != no_point;
    return std::tie(cost, is_exact, from, to) > std::tie(o.cost, is_other_exact, o.from, o.to);
  }
};

/// Whether a triangle whose first corner moves turns by less than 78 degrees and does not become a sliver.
inline bool keeps_shape(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& b,
                        const glm::dvec3& d) {
  constexpr double least_turn = 0.2;     // cosine between the face before and after
  constexpr double least_height = 1e-3;  // of the triangle, to its longest side
  const glm::dvec3 old = glm::cross(b - from, d - from), now = glm::cross(b - to, d - to);
  const double now2 = glm::dot(now, now), turn = glm::dot(old, now);
  const double longest =
      std::max({glm::dot(b - to, b - to), glm::dot(d - to, d - to), glm::dot(b - d, b - d)});
  return now2 > least_height * least_height * longest * longest && turn > 0 &&
         turn * turn >= least_turn * least_turn * now2 * glm::dot(old, old);
}

}  // namespace seedmesh
