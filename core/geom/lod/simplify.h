#pragma once
/// Mesh simplification by edge collapse.
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Collapses edges of the meshes, which share one coordinate system, until they have at most `target`
/// triangles together or no allowed collapse is left. Every remaining vertex is an original one with all its
/// attributes. Closed surfaces stay closed and manifold. Borders keep their corners; seams of attributes and
/// between meshes keep their positions. No triangle is flipped, degenerate, duplicated, or faces away from a
/// normal of its corners. The cost of a collapse is the quadric error (Garland and Heckbert, "Surface
/// Simplification Using Quadric Error Metrics", 1997). `fixed` has one entry for each mesh; fixed meshes,
/// lines and points stay unchanged. To be called before finish(), with wide indices.
///
/// No collapse costs more than `most_cost`: a squared distance times twice the area that it is taken over, in
/// m^4.
///
/// Returns the number of remaining triangles. Time: n log n, about 2 us for each triangle that is given. Deterministic.
std::uint64_t simplify(std::span<Mesh* const> meshes, std::uint64_t target, const std::vector<bool>& fixed,
                       Job& job, double most_cost = std::numeric_limits<double>::infinity());

}  // namespace seedmesh
