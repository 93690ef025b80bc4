#pragma once
/// Simplification of a finished model, and levels of detail for it.
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/job.h"
#include "core/model/levels.h"

namespace seedmesh {

/// Returns the triangles that a level draws, with all copies.
std::uint64_t drawn_at(const Model& model, std::size_t level);

/// A copy with the same name, materials and triangles. Its memory is charged to the request.
MeshGroup copy_of(const MeshGroup& group);

/// What simplification may remove.
struct SimplifyLimits {
  /// True: separate sheets count as leaves. Some of them may be removed, and the others are
  /// enlarged.
  bool leaves = true;
  /// How far a surface may move, as a share of the model's diagonal. Infinite: no limit, and pieces of any
  /// size may be removed. Otherwise, pieces with an area above (diagonal / 100)^2 are kept.
  double detail = std::numeric_limits<double>::infinity();
};

/// Simplifies the meshes of a level until it draws at most `most` triangles or no more can be removed. Removes
/// some leaves, simplifies the rest, then removes its smallest pieces. All meshes lose the same share, but
/// meshes with fewer than `least` triangles stay. Indices are 32-bit.
void coarsen_all(Model& model, std::size_t level, std::uint64_t most, std::uint64_t least,
                 const SimplifyLimits& limits, Job& job);

/// The same, but keeps the result only if the level then draws at most `most` triangles. Otherwise it
/// restores the meshes and returns false, as soon as an attempt removes less than half of the excess. It
/// needs the memory of the level a second time.
bool coarsen_if_it_fits(Model& model, std::size_t level, std::uint64_t most, const SimplifyLimits& limits,
                        Job& job);

/// Adds a level after the coarsest, with half its triangles. Meshes with fewer than `least` triangles, packed
/// meshes and collision shapes stay as they are. Returns false, without such a level, where more than `share`
/// of the triangles would remain. Indices are 32-bit.
bool add_level(Model& model, std::uint64_t least, double share, const SimplifyLimits& limits, Job& job);

}  // namespace seedmesh
