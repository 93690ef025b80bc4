#pragma once
/// The branchlet of a conifer, drawn like the twigs of leaf_shape.h.
#include "core/geom/plant/leaf_shape.h"

namespace seedmesh {

/// `count` shoots with short needles; the first one is the stem with the tip. The box is not set.
LeafDrawing needle_twig(int count);

}  // namespace seedmesh
