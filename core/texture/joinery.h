#pragma once
/// Leaves of doors and shutters of painted wood, as one grey texture of two by two leaves.
#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

constexpr int joinery_across = 2;

/// The leaves of the texture, in rows from the upper left.
enum class Joinery { six_panels, four_panels, planks, louvres };

/// Paints the leaves. Grooves are dark, because dirt collects in them. Cost: about 15 ns a texel.
Relief joinery(int size, Rng rng, const Job& job);

}  // namespace seedmesh::texture
