#pragma once
/// Selects the leaves and limbs of a tree that remain at coarser levels of detail.
///
/// Levels have 100, 40, 15, 5 and 3 % of the triangles. Leaves lose triangles first, because their textures
/// keep the outline. Bent cards become flat quads, then triangles, then single triangles that are visible
/// from both sides. If this does not save enough triangles, leaves are left out in the order of
/// FoliageLevels.
#include <optional>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/tree/far_leaves.h"
#include "core/generators/tree/skeleton_writer.h"
#include "core/geom/lod/detail.h"
#include "core/geom/lod/foliage_levels.h"

namespace seedmesh::tree {

struct TreeLevels {
  /// Requires a skeleton for which fit_leaves() has run. Does nothing if there is only one level of detail.
  TreeLevels(const Skeleton& skeleton, const TreeParams& params, const GenerateContext& context);

  struct Plan {
    int level = 1;
    LeafDetail leaves = LeafDetail::bent;
    double share = 1;        ///< share of the leaves that remains
    std::uint64_t bark = 0;  ///< greatest number of triangles of the bark
  };
  /// The plan of a coarser level. `finest` is the number of triangles of the bark at the finest level.
  Plan plan(int level, std::uint64_t finest) const;

  /// False for levels that no output shows: those that exceed the budget, and those after one that is within it.
  bool is_needed(int level, std::uint64_t finest) const;

  std::optional<FoliageLevels> foliage;  ///< if there are leaves
  Array<float> shown;                    ///< visible share of the bark of each joint; empty: all of it
  double seen = 1;                       ///< visible share of the area of the whole bark
  std::vector<std::uint64_t> bark;       ///< triangles of the bark of each level so far

 private:
  /// The planned triangles of a level.
  double planned(int level, std::uint64_t finest) const;

  /// Triangles of a leaf that is built in one way.
  struct Build {
    LeafDetail detail;
    std::uint64_t triangles;
  };
  int coarsest_ = 0;           ///< level
  std::uint64_t budget_ = 0;   ///< triangles of the only level that remains; 0: all levels remain
  std::uint64_t count_ = 0;    ///< number of leaves
  std::uint64_t of_leaf_ = 0;  ///< triangles of a leaf at the finest level
  bool has_far_leaves_ = false;
  std::vector<Build> builds_;        ///< builds in descending order of triangles
  std::vector<std::uint64_t> bent_;  ///< triangles of a bent leaf by level
};

}  // namespace seedmesh::tree
