#pragma once
/// Fields by faults: random lines, one side of each lifted (Kogovšek 2014, section 5.2.1, formula 5.1;
/// Polack, "Focus on 3D Terrain Programming", 2002).
///
/// Heights are summed as whole micrometres, so that the sum does not depend on the order of faults nor on the
/// window: tiles of one world agree to the bit.
#include <cstdint>
#include <vector>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// The bound of fault i of n by formula 5.1, i from 0: the first is `greatest`, the sum of all
/// n * greatest - (greatest - least) * (n - 1) / 2.
double fault_bound(double greatest, double least, int i, int n);

enum class FaultKind {
  one_sided,  ///< one side rises by a uniform share of the bound: "fault formation"
  normal,     ///< one side rises, the other sinks by a normal deviate with the bound as deviation: "Poisson
              ///< faulting"
};
enum class FaultStep { hard, line, cosine };

struct FaultPlan {
  FaultKind kind = FaultKind::one_sided;
  int planned = 0;  ///< faults under the falling bound
  int extra = 0;    ///< faults after these, bounded by `greatest`
  double greatest = 0, least = 0;
  FaultStep step = FaultStep::hard;
  double width = 0;  ///< of a step that is not hard, in metres
};

/// `world` is the ground that the lines cross: a square of world.width samples. Cost: for hard steps samples
/// + rows * faults, about 2 ns each; for others also the samples inside the slopes.
Field faulted(const FaultPlan& plan, const Window& world, const Window& window, double cell, Rng rng,
              const Job& job);

/// Displacement of fault i: of the lifted side for one_sided, of both, up and down, for normal.
double fault_height(const FaultPlan& plan, int i, Rng rng);

}  // namespace seedmesh::terrain
