#pragma once
/// Measures of small polygons.
#include <span>

#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

/// The sides of the box of least area around a ring, in centimetres; the direction is that of the long side.
struct LeastBox {
  double short_side = 0, long_side = 0;
  double narrowest = 0;  ///< least short side of all boxes whose area is less than 2 % larger
  glm::dvec2 centre{0}, long_direction{1, 0};
};
/// Returns the box of least area around a ring.
LeastBox least_box(std::span<const CmPoint> ring);

/// Returns the convex hull, counter-clockwise (Andrew 1979).
CmRing hull_of(std::span<const CmPoint> ring);

/// Returns the cosine of the sharpest inner corner of a counter-clockwise ring; -1 if there is none.
double sharpest_cosine(std::span<const CmPoint> ring);

/// Whether a ring has no corner sharper than this cosine, both with and without its corners that are less than 2 cm from
/// the line between their neighbours. Cost: linear, where it has no such corners.
bool is_blunt(std::span<const CmPoint> ring, double most_cosine);

/// Returns a ring without the corners that are less than `least`, in centimetres, from the line between their
/// neighbours. At least three corners stay.
CmRing without_bends(std::span<const CmPoint> ring, double least);

/// Whether a counter-clockwise ring has a part narrower than `least` (cm), measured between a corner and an opposite
/// edge. Cost: quadratic.
bool has_narrow_part(std::span<const CmPoint> ring, double least);

/// Whether no two of the rings meet. Cost: quadratic.
bool are_apart(std::span<const CmRing> rings);

}  // namespace seedmesh::city
