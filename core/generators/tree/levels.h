#pragma once
/// Which leaves and limbs of a tree remain at coarser levels of detail.
#include <optional>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/tree/skeleton_writer.h"
#include "core/geom/lod/detail.h"
#include "core/geom/lod/foliage_levels.h"

namespace seedmesh::tree {

struct TreeLevels {
  /// Needs a skeleton after fit_leaves(). Does nothing if there is only one level of detail.
  TreeLevels(const Skeleton& skeleton, const TreeParams& params, const GenerateContext& context);

  /// The share of `leaves` leaves, of `each` triangles each, that remains at a level: enough to keep the
  /// outline of the crown, but so few that the level has fewer triangles than the previous one, which has
  /// `before`.
  double leaves_at(const Detail& detail, std::uint64_t leaves, std::uint64_t each,
                   std::uint64_t before) const;

  std::optional<FoliageLevels> foliage;  ///< if there are leaves
  Array<float> shown;                    ///< visible share of the bark of each joint; empty: all of it
  double seen = 1;                       ///< visible share of the area of the bark
  std::vector<std::uint64_t> bark;       ///< triangles of the levels that are made
};

}  // namespace seedmesh::tree
