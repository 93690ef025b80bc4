#pragma once
/// The linear equations of points of a left shape with open variables (open_pairs.h).
#include "core/generators/building/shape_grammar/open_pairs.h"

namespace seedmesh::building {

/// Each row has the coefficients of the unknowns, and the right side last.
using Rows = std::vector<std::vector<double>>;

/// Four numbers of the similarity (in space its rotation is known), then the variables.
inline std::size_t unknowns_of(std::size_t variables) { return 4 + variables; }

/// Adds the equations of one anchor at the point q.
void add_rows(Rows& rows, const OpenAnchor& anchor, const glm::dvec3& q, bool is_flat);

/// Solves the equations by least squares, with orthogonal columns (Gram and Schmidt). Returns the rank; `x` is
/// set if it is full.
std::size_t solve(const Rows& rows, std::vector<double>& x);

}  // namespace seedmesh::building
