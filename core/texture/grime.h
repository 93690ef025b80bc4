#pragma once
/// Dirt on walls, as a texture with alpha for faces just in front of the wall. The upper half has streaks
/// below the ends of a sill. The lower half has splashes of rain from the ground, and repeats horizontally.
#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

/// Paints dirt. Cost: about 5 ns a texel.
Relief grime(int size, Rng rng, const Job& job);

}  // namespace seedmesh::texture
