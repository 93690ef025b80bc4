#pragma once
/// What is left of a tree that is seen from afar: Weber and Penn, "Creation and Rendering of Realistic
/// Trees", SIGGRAPH 1995, section 4.9 (degradation at range), for an image 1,000 pixels high of 60 degrees.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// The share of what is drawn at `range` metres. The paper draws the first of every mass of 16 stems and of 4
/// leaves; here each is drawn or not by its place, so that what is drawn from afar is part of what is drawn
/// from nearer.
struct RangeShares {
  double sides = 1;     ///< of the corners of cross-sections: whole to 300 m, a sixth from 800 m on
  double branches = 1;  ///< main branches: whole to 300 m, none from 900 m on
  double twigs = 1;     ///< limbs of branches: whole to 50 m, none from 100 m on
  double leaves = 1;    ///< whole to 50 m (25 m in spring), then fewer, an eighth at least; larger
};
RangeShares shares_at(const TreeParams& params);

/// The share of the leaves that is drawn: of `leaf.density` and `range`; 0: there are none.
double drawn_leaves(const TreeParams& params);

/// Takes out the limbs that are not drawn, with all that they carry; their leaves stay. n time.
void degrade(Skeleton& skeleton, const TreeParams& params, Job& job);

}  // namespace seedmesh::tree
