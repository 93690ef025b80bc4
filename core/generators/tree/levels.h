#pragma once
/// What the coarser levels of detail of a tree keep of its leaves and limbs.
#include <optional>

#include "core/generators/tree/growth_context.h"
#include "core/geom/detail.h"
#include "core/geom/foliage_levels.h"

namespace seedmesh::tree {

struct TreeLevels {
  /// Of a skeleton whose leaves have their size (fit_leaves). Looks at nothing where one level is wanted.
  TreeLevels(const Skeleton& skeleton, const TreeParams& params, Job& job);

  std::optional<FoliageLevels> foliage;  ///< where there are leaves
  Array<float> shown;                    ///< of each joint; empty: all of it is seen
  double seen = 1;                       ///< of the bark, by its area
};

}  // namespace seedmesh::tree
