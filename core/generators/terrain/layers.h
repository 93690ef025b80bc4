#pragma once
/// Terrain by expressions, and layers that are combined with the heights computed before them. They allow
/// users to define height algorithms without programming (Kogovšek 2014, section 6).
#include <vector>

#include "core/base/result.h"
#include "core/generators/terrain/field.h"
#include "core/generators/terrain/planet.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

/// Returns the errors of `expression` and `layers`, with line and column in their texts.
std::vector<Issue> layer_errors(const TerrainParams& params);

/// Returns the heights of `expression` at the samples of a window, which are `cell` metres apart. Throws Stop
/// for a value that is not finite, or above 10,000 km. Cost: about 6 ns a sample for ten arithmetic
/// operations, and 27 ns for each octave of noise.
Field expressed_field(const TerrainParams& params, const Window& window, double cell, Rng rng,
                      const Job& job);

/// Combines all layers with the heights of a window, one after the other. The field has no margin of its own.
void add_layers(const TerrainParams& params, Field& field, const Window& window, double cell, Rng rng,
                const Job& job);

/// The same on a sphere. Before the call, `planet` has the heights of the algorithm, or 0 for the algorithm
/// `expression`.
void express_sphere(const TerrainParams& params, Planet& planet, Rng rng, const Job& job);
void add_layers(const TerrainParams& params, Planet& planet, Rng rng, const Job& job);

}  // namespace seedmesh::terrain
