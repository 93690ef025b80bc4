#pragma once
/// The branchlet of a conifer, as leaf_shape.h draws twigs.
#include "core/geom/leaf_shape.h"

namespace seedmesh {

/// `count` shoots full of short needles, the first one the stem with the tip; without the box.
LeafDrawing needle_twig(int count);

}  // namespace seedmesh
