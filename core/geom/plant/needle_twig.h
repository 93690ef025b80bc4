#pragma once
/// The branchlet of a conifer, drawn like the twigs of leaf_shape.h.
#include "core/geom/plant/leaf_shape.h"

namespace seedmesh {

/// Returns `count` shoots with short needles, of which the first is the stem with the tip. Does not set the bounding
/// square (LeafDrawing::low and high).
LeafDrawing needle_twig(int count);

}  // namespace seedmesh
