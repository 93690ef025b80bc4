#pragma once
/// Laws that compute the radii of a finished skeleton. Each replaces Limbs::radius and base_radius; positions
/// stay. An internode with a Limbs::share counts by it, so that radii change continuously as internodes
/// appear and disappear. Linear time, one thread.
#include "core/geom/plant/limbs.h"

namespace seedmesh {

/// Multiplies every radius by `factor` for each branch that its internode is in (Limbs::order): Hutsko's
/// thickness factor of 0.5 for each bracket (2022, table 1.6).
void narrow_by_order(Limbs& limbs, double factor, Job& job);

struct ChainWidths {
  double base = 0.05;  ///< radius at the beginning of the longest chain, m
  double tip = 0;      ///< radius at the end of every chain, m
};

/// The radius at the beginning of an internode depends linearly on the number of internodes in the longest
/// chain that starts with it: from `tip` (the last one) to `base` (the longest chain of all). The internode
/// ends with the radius at which the longest chain beyond it begins (Tunnel 2012, section 3).
void widen_by_longest_chain(Limbs& limbs, const ChainWidths& widths, Job& job);

struct PipeWidths {
  double tip = 0.005;   ///< radius of an internode without successors, m
  double exponent = 2;  ///< 2: cross-sections add up (Leonardo); Murray's law is 3
};

/// Pipe model (Shinozaki, Yoda, Hozumi and Kira, "A quantitative analysis of plant form", 1964): every tip
/// needs a pipe down to the ground, so that r^exponent of an internode is the sum of those that grow from its
/// end.
void widen_by_pipes(Limbs& limbs, const PipeWidths& widths, Job& job);

}  // namespace seedmesh
