#pragma once
/// Affine maps of space: what a copy machine does to its element.
#include <glm/glm.hpp>
#include <optional>

#include "core/model/model.h"

namespace seedmesh::fractal {

/// x -> linear * x + offset.
struct Affine {
  glm::dmat3 linear{1};
  glm::dvec3 offset{0};

  glm::dvec3 operator()(const glm::dvec3& p) const { return linear * p + offset; }
};

/// First `inner`, then `outer`.
inline Affine compose(const Affine& outer, const Affine& inner) {
  return {outer.linear * inner.linear, outer(inner.offset)};
}

/// The greatest factor by which the map stretches any direction: the root of the greatest eigenvalue of
/// AᵀA, by Jacobi's rotations (Golub and Van Loan, "Matrix Computations", 8.5).
double norm(const Affine& map);

/// The factor of a similarity (it scales all directions alike; mirrors allowed), else nullopt.
std::optional<double> similarity(const Affine& map);

/// The map as scale, turn and move, where it is a similarity.
Transform transform_of(const Affine& map, double scale);

}  // namespace seedmesh::fractal
