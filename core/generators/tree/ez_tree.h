#pragma once
/// The model of ez-tree 1.1 (Daniel Greenheck, MIT). Limbs consist of straight sections. Each section turns by random
/// angles, about its axis, toward a direction and toward a trellis. Limbs of the next level start at random
/// positions on a limb. Unless the form is evergreen, one of them continues the limb at its tip.
///
/// The order of all random choices is that of ez-tree, so that a saved seed gives the same limbs and leaves, within
/// rounding. Foot at the origin, +Y up. Cost: linear in the size of the skeleton.
#include <cstdint>

#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// The random numbers of ez-tree: two multiply-with-carry generators of 16 bits (G. Marsaglia, 1994).
class EzTreeRandom {
 public:
  explicit EzTreeRandom(std::uint64_t seed);
  /// Uniform between `low` and `high`.
  double between(double low, double high);

 private:
  std::uint32_t w_, z_;
};

/// Writes the skeleton of a tree as ez-tree grows it.
void grow_ez_tree(const TreeParams& params, const RandomStreams& random, std::uint64_t seed,
                  SkeletonWriter& writer);

}  // namespace seedmesh::tree
