#pragma once
/// Details of ground that repeat: near-grey, so that vertex colours give the colour of the land.
#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

/// The side of the image of a ground in metres.
constexpr double ground_tile = 3;

/// Soil with short plants and gravel.
Relief soil_ground(int size, Rng rng, const Job& job);
/// Broken rock: plates and cracks.
Relief rock_ground(int size, Rng rng, const Job& job);
/// Sand with ripples of 8 to 15 cm, crests across the image's u axis (Sharp, "Wind ripples", 1963).
Relief sand_ground(int size, Rng rng, const Job& job);
/// Snow with low drifts.
Relief snow_ground(int size, Rng rng, const Job& job);

}  // namespace seedmesh::texture
