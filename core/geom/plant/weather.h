#pragma once
/// Bends the limbs of a finished skeleton by wind, rain and snow, depending on force and thickness.
///
/// After Kogovšek 2014, section 3.2.4: first the model is made without weather. Then, from the root to the
/// last leaf, the force of the weather turns each element depending on its thickness. All elements beyond
/// it turn with it.
/// - Forces act on internodes (the drag of a cylinder in cross flow) and on outlines (the drag of a plate). The
///   weight of snow follows from the horizontal area, and that of water from the wet area. Organs move, but no force
///   acts on them.
/// - Each internode turns like a cantilever (Euler and Bernoulli): by bending moment times length divided by E I, with
///   I = pi r^4 / 4. Moment and force are those of all parts beyond. No internode turns beyond the direction of the
///   force.
#include "core/geom/plant/limbs.h"

namespace seedmesh {

struct Weather {
  glm::dvec3 wind{0};      ///< velocity of the air, m/s
  double snow = 0;         ///< kg for each square metre seen from above
  double rain = 0;         ///< kg of water for each square metre of surface (mm)
  double stiffness = 8e9;  ///< Young's modulus E of the wood, Pa; green wood has 5e9 to 1.5e10
};

/// Moves joints, their frames, organs and outlines. Radii and lengths of internodes stay, and so do roots without an
/// anchor. A part that begins after the turtle moved without drawing follows the joint where it left (Limbs::anchor).
/// An internode without radius is rigid. Linear time, one thread; about 170 bytes a joint while it runs.
void bend(Skeleton& skeleton, const Weather& weather, Job& job);

}  // namespace seedmesh
