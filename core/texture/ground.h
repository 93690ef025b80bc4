#pragma once
/// Details of ground that repeat: near-grey, so that vertex colours give the colour of the land. No painter has
/// features of more than an eighth of the image, so that repeats do not show from afar.
#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

/// The side of the image of a ground in metres.
constexpr double ground_tile = 2;

/// Blades of grass, 4 to 12 cm long, that lie in all directions.
Relief grass_ground(int size, Rng rng, const Job& job);
/// Clods with pebbles and dry stalks.
Relief soil_ground(int size, Rng rng, const Job& job);
/// Bare rock: tilted facets of 5 to 25 cm between thin cracks, with grain, weathered crests and lichen.
Relief rock_ground(int size, Rng rng, const Job& job);
/// Angular stones of 2 to 20 cm.
Relief scree_ground(int size, Rng rng, const Job& job);
/// Sand with ripples of 12 cm, crests across the image's u axis (Sharp, "Wind ripples", 1963).
Relief sand_ground(int size, Rng rng, const Job& job);
/// Snow with low drifts.
Relief snow_ground(int size, Rng rng, const Job& job);
/// The floor of a forest: needles, fallen leaves of 4 to 9 cm and dead twigs.
Relief litter_ground(int size, Rng rng, const Job& job);

}  // namespace seedmesh::texture
