#pragma once
/// The branchlet of a conifer, drawn like the twigs of leaf_shape.h.
#include "core/geom/plant/leaf_shape.h"

namespace seedmesh {

/// How needles are arranged on a shoot.
enum class NeedleKind {
  single,  ///< short ones all around the shoot, as of spruces
  paired,  ///< long ones in bundles of two, which form a brush at the end of the shoot, as of pines
};

/// Returns `count` shoots with needles, of which the first is the stem with the tip. `count` is at least 2. Single needles
/// are 0.076 of the length of the stem or shorter, paired ones 0.155: 2.2 cm and 5.9 cm for twigs of 29 and 38 cm. Some
/// needles point toward the viewer and look shorter. Does not set the bounding square (LeafDrawing::low and high).
LeafDrawing needle_twig(NeedleKind kind, int count);

}  // namespace seedmesh
