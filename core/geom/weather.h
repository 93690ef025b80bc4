#pragma once
/// Weather on a finished skeleton: wind, rain and snow bend its limbs by force against thickness.
///
/// Kogovšek 2014, section 3.2.4: first the model without weather, then for each element the force that the
/// weather exerts on it, its turn by that force against its thickness, and all that follows it turned along,
/// from the root to the last leaf. The force is the engineer's: drag of a cylinder in cross flow and of a
/// plate, weight of snow on what lies under it and of water on what is wet. The turn is that of a cantilever
/// (Euler and Bernoulli): bending moment times length by E I with I = pi r^4 / 4, where moment and force are
/// those of everything beyond; no turn goes past the direction of the force.
#include "core/geom/limbs.h"

namespace seedmesh {

struct Weather {
  glm::dvec3 wind{0};      ///< velocity of the air, m/s
  double snow = 0;         ///< kg on each square metre seen from above
  double rain = 0;         ///< kg of water on each square metre of surface (mm)
  double stiffness = 8e9;  ///< Young's modulus E of the wood, Pa; green wood has 5e9 to 1.5e10
};

/// Moves joints, their frames, organs and outlines. Radii, lengths of internodes and the places of roots
/// stay; what began after a move goes with the joint it was moved from (Limbs::anchor). An internode without
/// radius is rigid. Linear time, one thread; about 170 bytes a joint while it runs.
void bend(Skeleton& skeleton, const Weather& weather, Job& job);

}  // namespace seedmesh
