#pragma once
/// Pieces that lie on the ground: blades, stones and leaves, drawn into a relief. The higher cover the lower.
#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

/// A number of pieces of one kind. Lengths are shares of the image. Each piece has a key of its own.
struct Pieces {
  int count = 0;
  float shortest = 0, longest = 0;
  float width = 0.1F;       ///< by length
  float low = 0, high = 1;  ///< heights of the middle
  float differ = 0.5F;      ///< of the tones
};

/// Draws blades, stalks and needles, darker towards their base. `clumps` is added to the tones.
void add_blades(Relief& relief, const Pieces& pieces, const Field& clumps, Rng rng, const Job& job);

/// Draws stones: domes cut by a few planes, each with a tone of its own, darker towards their foot.
void add_stones(Relief& relief, const Pieces& pieces, Rng rng, const Job& job);

/// Draws fallen leaves: tilted and curled, pointed at both ends, with a midrib that shows as a groove.
void add_leaves(Relief& relief, const Pieces& pieces, Rng rng, const Job& job);

}  // namespace seedmesh::texture
