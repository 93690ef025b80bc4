#pragma once
/// Affine maps of space.
#include <glm/glm.hpp>
#include <optional>

#include "core/model/model.h"

namespace seedmesh::fractal {

/// The map x -> linear * x + offset.
struct Affine {
  glm::dmat3 linear{1};
  glm::dvec3 offset{0};

  glm::dvec3 operator()(const glm::dvec3& p) const { return linear * p + offset; }
};

/// Applies `inner` first, then `outer`.
inline Affine compose(const Affine& outer, const Affine& inner) {
  return {outer.linear * inner.linear, outer(inner.offset)};
}

/// Returns the largest factor by which the map stretches a direction: the root of the largest eigenvalue of AᵀA, by
/// Jacobi rotations (Golub and Van Loan, "Matrix Computations", 8.5).
double norm(const Affine& map);

/// Returns the scale factor if the map is a similarity (reflections included), else nullopt.
std::optional<double> similarity(const Affine& map);

/// Returns the map as scale, rotation and translation. It must be a similarity with the factor `scale`.
Transform transform_of(const Affine& map, double scale);

}  // namespace seedmesh::fractal
