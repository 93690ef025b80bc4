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

/// Returns long thin shoots that hang beside each other, as those of weeping willows do, with `count` narrow copies of
/// `leaf` together, alternately left and right. A leaf is 0.2 of the twig long; many are seen from the side. Leaves point
/// to the ends of the shoots, which they leave by 15 to 45 degrees. The twig is 0.6 times as wide as long; on a square
/// card, leaves are a fifth to a tenth as wide as long.
LeafDrawing hanging_twig(const LeafDrawing& leaf, int count);

}  // namespace seedmesh
