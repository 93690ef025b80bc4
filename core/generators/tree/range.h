#pragma once
/// The parts of a tree that are generated for a viewing distance. The image is 1,000 pixels high, with a
/// field of view of 60 degrees. Source: Weber and Penn, "Creation and Rendering of Realistic Trees", SIGGRAPH
/// 1995, section 4.9 (degradation at range).
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Whether the number of corners falls linearly with radius and distance, so that no limb is left out at a distance
/// (Kruszewski, 1999).
bool has_linear_faces(const TreeParams& params);

/// The shares of parts that are made at a distance. The paper draws the first of 16 stems and of 4 leaves.
/// Here a random number of each part decides. The parts that are made for a distance are therefore a subset of
/// those for a shorter distance.
struct RangeShares {
  double sides = 1;     ///< corners of cross-sections: all up to 300 m, a sixth from 800 m
  double branches = 1;  ///< main branches: all to 300 m, none from 900 m
  double twigs = 1;     ///< limbs of branches: all to 50 m, none from 100 m
  double leaves = 1;    ///< all up to 50 m (25 m in spring), at least an eighth, enlarged
};
/// Returns the shares for the `range` of a request.
RangeShares shares_at(const TreeParams& params);

/// The share of the leaves that is made, from `leaf.density` and `range`; 0 if there are no leaves.
double drawn_leaves(const TreeParams& params);

/// Removes the limbs that are not made, with their limbs. Leaves stay. Linear in the size of the skeleton.
void degrade(Skeleton& skeleton, const TreeParams& params, Job& job);

}  // namespace seedmesh::tree
