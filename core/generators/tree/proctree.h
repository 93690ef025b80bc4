#pragma once
/// The model of proctree (Paul Brunt, 2012; C++ by Jari Komppa, 2015, 3-clause BSD): a trunk that forks step
/// by step, branches that fork in two down to a twig at each end. A tree has 2^(mLevels+1) + mTreeSteps
/// 2^mLevels twigs and one fork less. Foot at the origin, metres, +Y up.
///
/// The original draws |cos(x + x^2)| at numbers that repeat; here every fork draws at its own place, evenly,
/// so that a saved mSeed gives a like tree, not the same.
#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

void grow_proctree(const TreeParams& params, const Chances& chances, SkeletonWriter& writer);

}  // namespace seedmesh::tree
