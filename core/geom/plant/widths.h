#pragma once
/// Laws that compute the radii of a finished skeleton. Each changes Limbs::radius and base_radius alone. If
/// Limbs::share is given, widen_by_longest_chain() and widen_by_pipes() count an internode by its share. Radii
/// therefore change continuously as internodes appear and disappear. Linear time, one thread.
#include "core/geom/plant/limbs.h"

namespace seedmesh {

/// Multiplies every radius by `factor` to the power of the branching order (Limbs::order). Hutsko uses the
/// factor 0.5 for each bracket (2022, table 1.6).
void narrow_by_order(Limbs& limbs, double factor, Job& job);

struct ChainWidths {
  double base = 0.05;  ///< radius at the beginning of the longest chain, m
  double tip = 0;      ///< radius at the end of every chain, m
};

/// The radius at the beginning of an internode depends linearly on the number of internodes in the longest
/// chain that starts with it. It is `tip` for a last internode and `base` for the longest chain of all. The
/// internode ends with the radius at which the longest chain beyond it begins (Tunnel 2012, section 3).
void widen_by_longest_chain(Limbs& limbs, const ChainWidths& widths, Job& job);

struct PipeWidths {
  double tip = 0.005;   ///< radius of an internode without successors, m
  double exponent = 2;  ///< 2: cross-sections add up (Leonardo); Murray's law is 3
};

/// Pipe model (Shinozaki, Yoda, Hozumi and Kira, "A quantitative analysis of plant form", 1964): every tip
/// has a pipe down to the ground. r^exponent of an internode is therefore the sum of r^exponent of the
/// internodes that grow from its end.
void widen_by_pipes(Limbs& limbs, const PipeWidths& widths, Job& job);

}  // namespace seedmesh
