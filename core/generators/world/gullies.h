#pragma once
/// Gullies along slopes as a function of one position: stripes across the slope, blended between jittered cells.
///
/// After the description of Rune Skovbo Johansen ("Fast and Gorgeous Erosion Filter", 2026), which continues work of
/// Clay John (2018) and Fewes (2023). The code is our own.
#include <array>

#include "core/generators/world/noise.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

constexpr double widest_gully = 420;   ///< metres between gullies of the first octave
constexpr double gully_fall = 0.47;    ///< distance of gullies divided by that of the octave before
constexpr double gully_depth = 0.055;  ///< depth of a gully divided by its distance from the next

/// Returns the metres to add to the ground, mostly negative. `slope`: the ground with its derivative. The result is
/// discontinuous only where the slope is discontinuous.
double gullies_at(const std::array<std::uint64_t, gully_octaves>& keys, const Slope& slope, double east,
                  double north);

}  // namespace seedmesh::world
