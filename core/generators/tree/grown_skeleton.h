#pragma once
/// Converts the internodes of the model `grown` to the limbs and leaves that all models of a tree have.
#include "core/generators/tree/grown_plant.h"

namespace seedmesh::tree {

/// The last year of a plant, and the share of it that has passed: 0 .. 1.
struct GrownTime {
  std::uint16_t year = 0;
  double share = 1;
};

/// Writes the tree with the number 0, without its neighbours. At a node, the thickest internode continues the limb,
/// and the others begin limbs. Limbs are smoothed, thick ones more than thin ones. They have joints where they
/// bend or where other limbs begin. Leaves are on wood of the last `leaf_years`.
void write_grown(const GrownPlant& plant, const TreeParams& params, const GrownTime& time,
                 const RandomStreams& random, SkeletonWriter& writer);

}  // namespace seedmesh::tree
