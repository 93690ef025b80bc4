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

  /// The share of the leaves that remains at a level: enough to keep the outline of the crown, but so few
  /// that the level has fewer triangles than the previous one.
  double leaves_at(const Detail& detail, std::uint64_t leaf_count, std::uint64_t triangles_per_leaf,
                   std::uint64_t triangles_before) const;

  std::optional<FoliageLevels> foliage;  ///< if there are leaves
  Array<float> shown;                    ///< visible share of the bark of each joint; empty: all of it
  bool has_twigs = false;                ///< the leaves are pictures of twigs, through which one sees
  double seen = 1;                       ///< visible share of the area of the whole bark
  std::vector<std::uint64_t> bark;       ///< triangles of the bark of each level so far
};

}  // namespace seedmesh::tree
