#pragma once
/// The model of proctree (Paul Brunt, 2012; C++ by Jari Komppa, 2015, 3-clause BSD): a trunk that forks step
/// by step, and branches that fork in two down to a twig at each end. A tree has 2^mLevels * (2 + mTreeSteps)
/// twigs, and one fork less than twigs. Foot at the origin, metres, +Y up.
///
/// As random numbers, the original uses |cos(x + x^2)| with numbers x that repeat. With the sequence
/// "original", the heads of all branches equal those of proctree.js (2012) within rounding. With "keyed",
/// every fork has a random number of its own, evenly distributed, so that a saved mSeed gives a similar tree.
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// Writes the skeleton of a tree of the model `proctree`.
void grow_proctree(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer);

}  // namespace seedmesh::tree
