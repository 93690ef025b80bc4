#pragma once
/// Twigs of broadleaf trees in the plane.
#include "core/geom/plant/leaf_shape.h"

namespace seedmesh {

/// How leaves stand along a shoot.
enum class Phyllotaxis {
  alternate,  ///< one at a node, on both sides in turn
  opposite,   ///< two at a node
};

/// Returns a stem with two side shoots, which bear `count` copies of `leaf` together. A leaf is 1.5 / sqrt(count) of
/// the twig long, a narrow one up to 1.6 times that. Leaves are larger in the middle of a shoot; some hang or are seen
/// from the side, and look shorter or narrower. They leave gaps of about half of the square between them.
LeafDrawing leafy_twig(const LeafDrawing& leaf, int count, Phyllotaxis phyllotaxis);

}  // namespace seedmesh
