#pragma once
/// What the coarser levels of detail of a tree keep of its leaves and limbs.
#include <optional>
#include <vector>

#include "core/generators/tree/growth_context.h"
#include "core/geom/detail.h"
#include "core/geom/foliage_levels.h"

namespace seedmesh::tree {

struct TreeLevels {
  /// Of a skeleton whose leaves have their size (fit_leaves). Looks at nothing where one level is wanted.
  TreeLevels(const Skeleton& skeleton, const TreeParams& params, Job& job);

  /// The share of `leaves` leaves, of so many triangles each, that stays at a level after one of `before`
  /// triangles: so many that the outline holds, as far as the level still has fewer triangles.
  double leaves_at(const Detail& detail, std::uint64_t leaves, std::uint64_t each,
                   std::uint64_t before) const;

  std::optional<FoliageLevels> foliage;  ///< where there are leaves
  Array<float> shown;                    ///< of each joint; empty: all of it is seen
  double seen = 1;                       ///< of the bark, by its area
  std::vector<std::uint64_t> bark;       ///< triangles of each level, once they are made
};

}  // namespace seedmesh::tree
