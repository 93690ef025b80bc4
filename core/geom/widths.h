#pragma once
/// Laws that give a whole skeleton its radii after it was drawn. Each replaces Limbs::radius and base_radius
/// and reads nothing but the tree and what it says it reads; positions stay. An internode of which there is a
/// share (Limbs::share) counts by it, so that radii change continuously as internodes come and go. Linear
/// time, one thread.
#include "core/geom/limbs.h"

namespace seedmesh {

/// Every radius times `factor` for each branch that its internode stands in (Limbs::order): Hutsko's
/// thickness factor of 0.5 a bracket (2022, table 1.6).
void narrow_by_order(Limbs& limbs, double factor, Job& job);

struct ChainWidths {
  double base = 0.05;  ///< radius where the longest chain of the skeleton begins, m
  double tip = 0;      ///< radius at the end of every chain, m
};

/// The radius where an internode begins follows the number of links in the longest chain of internodes that
/// starts with it (Tunnel 2012, section 3): linear between tip (no link left) and base (the longest chain of
/// all); the internode ends as thick as the longest chain beyond it begins.
void widen_by_longest_chain(Limbs& limbs, const ChainWidths& widths, Job& job);

struct PipeWidths {
  double tip = 0.005;   ///< radius of an internode that nothing grows from, m
  double exponent = 2;  ///< 2: cross-sections add up (Leonardo); Murray's law is 3
};

/// Pipe model (Shinozaki, Yoda, Hozumi and Kira, "A quantitative analysis of plant form", 1964): every tip
/// needs a pipe down to the ground, so that r^exponent of an internode is the sum over those that grow from
/// its end.
void widen_by_pipes(Limbs& limbs, const PipeWidths& widths, Job& job);

}  // namespace seedmesh
