#pragma once
/// Fields by fault formation: random lines, each raising one side (Kogovšek 2014, section 5.2.1,
/// formula 5.1; Polack, "Focus on 3D Terrain Programming", 2002).
///
/// Heights are sums of whole micrometres. The sum therefore depends neither on the order of faults nor on the
/// window, and tiles of one world agree exactly.

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// Returns the bound of fault i of n by formula 5.1, with i from 0. The first bound is `greatest`; the sum of
/// all is n * greatest - (greatest - least) * (n - 1) / 2.
double fault_bound(double greatest, double least, int i, int n);

enum class FaultKind {
  one_sided,  ///< one side rises by a uniform share of the bound: "fault formation"
  normal,     ///< one side rises and the other sinks by a normal deviate: "Poisson faulting"
};
enum class FaultStep { hard, line, cosine };

struct FaultPlan {
  FaultKind kind = FaultKind::one_sided;
  int planned = 0;  ///< number of faults whose bound decreases from `greatest` to `least`
  int extra = 0;    ///< number of faults after these, with the bound `greatest`
  double greatest = 0, least = 0;
  FaultStep step = FaultStep::hard;
  double width = 0;  ///< width of a soft step, in metres
};

/// Returns the field of `window`. `world` is the ground that the lines cross, a square of world.width
/// samples. Cost: about 2 ns for each sample, and for each row of each fault. Soft steps add the samples inside their
/// slopes for each fault.
Field faulted(const FaultPlan& plan, const Window& world, const Window& window, double cell, Rng rng,
              const Job& job);

/// Returns the displacement of fault i in metres. For one_sided, it applies to the raised side. For normal,
/// one side rises and the other side sinks by it.
double fault_height(const FaultPlan& plan, int i, Rng rng);

}  // namespace seedmesh::terrain
