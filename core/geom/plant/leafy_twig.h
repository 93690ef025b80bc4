#pragma once
/// Twigs of broadleaf trees in the plane.
#include "core/geom/plant/leaf_shape.h"

namespace seedmesh {

/// A stem with two side shoots, which bear `count` copies of `leaf` together. A leaf is 1.2 / sqrt(count) of the
/// twig long, a narrow one up to 1.6 times that. Leaves stand alternately, at angles that vary, are larger in the middle of a shoot, and leave gaps
/// of about half of the square between them.
LeafDrawing leafy_twig(const LeafDrawing& leaf, int count);

}  // namespace seedmesh
