#pragma once
/// Removal of pieces of meshes: leaves of foliage, twigs of limbs.
#include <cstdint>
#include <limits>

#include "core/base/job.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Whether a mesh has at least 16 pieces, nine tenths or more of which are small open sheets, such as leaves, cards
/// and blades.
bool is_foliage(const Mesh& mesh, const Job& job);

/// Removes sheets, selected by a hash of their position, until at most `target` triangles are left, but keeps
/// at least one. The remaining sheets are scaled about their first vertex, at most by 2, so that the total
/// area is kept. Call it before finish(). Time: n log n.
void thin_sheets(Mesh& mesh, std::uint64_t target, const Job& job);

/// Removes the smallest connected pieces of a mesh with at least 16, such as tubes of twigs, until at most
/// `target` triangles are left. The largest piece is kept, and so are pieces whose area exceeds `most_area`.
/// Call it before finish(). Time: n log n.
void drop_smallest_pieces(Mesh& mesh, std::uint64_t target, const Job& job,
                          double most_area = std::numeric_limits<double>::infinity());

}  // namespace seedmesh
