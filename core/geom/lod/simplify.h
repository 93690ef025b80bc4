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
/// lines and points stay unchanged. Has to be called before finish()
/// (core/geom/mesh/finish.h), while the indices have 32 bits (`wide`).
///
/// Collapses that cost more than `most_cost` are refused. Its unit is m^4: a squared distance times twice the area of
/// the triangles.
///
/// Returns the number of remaining triangles. Time: n log n, about 2 us for each triangle that is given. Deterministic.
std::uint64_t simplify(std::span<Mesh* const> meshes, std::uint64_t target, const std::vector<bool>& fixed,
                       Job& job, double most_cost = std::numeric_limits<double>::infinity());

}  // namespace seedmesh
