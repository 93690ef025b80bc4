#pragma once
/// Meshes of many pieces with fewer of them: foliage with fewer leaves, limbs without twigs.
#include <cstdint>
#include <limits>

#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Is the mesh made of many small sheets that do not hang together: leaves, cards, blades? Nine in ten are
/// enough.
bool is_foliage(const Mesh& mesh, const Job& job);

/// Keeps so many of the sheets, chosen by their place, that at most `target` triangles are left, at least one
/// sheet. What stays grows about its first vertex by the root of what its number lost, so that the area
/// stays, at most twofold. Not after finish(). n log n.
void thin_sheets(Mesh& mesh, std::uint64_t target, const Job& job);

/// Drops the smallest pieces of a mesh of 16 or more that hang together, as the tubes of twigs, until at most
/// `target` triangles are left; the largest stays whatever it has, and so does what has more than
/// `most_area`. Not after finish(). n log n.
void drop_smallest_pieces(Mesh& mesh, std::uint64_t target, const Job& job,
                          double most_area = std::numeric_limits<double>::infinity());

}  // namespace seedmesh
