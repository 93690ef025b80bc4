#pragma once
/// Dirt on walls, as a texture with alpha for faces just before the wall: in the upper half streaks below the ends of a
/// sill, in the lower half what rain splashes up from the ground, which repeats sideways.
#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

/// Paints dirt. Cost: about 5 ns a texel.
Relief grime(int size, Rng rng, const Job& job);

}  // namespace seedmesh::texture
