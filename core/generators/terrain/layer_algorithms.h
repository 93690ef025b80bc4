#pragma once
/// The algorithms of layers, with their own parameters on the samples of the terrain.
#include <vector>

#include "core/base/result.h"
#include "core/base/rng.h"
#include "core/generators/terrain/field.h"
#include "core/generators/terrain/planet.h"

namespace seedmesh {
struct TerrainParams;
struct TerrainLayer;
}  // namespace seedmesh

namespace seedmesh::terrain {

/// Adds an error for each member of a layer that its algorithm does not have, and for each invalid value.
void check_layer_algorithm(const TerrainParams& params, std::size_t index, std::vector<Issue>& issues);

struct LayerSource {
  double cell = 1;  ///< distance between samples, in metres
  Rng rng;
};

/// Returns the heights of a layer at the samples of a window. Subdivisions begin with squares of 2^iterations cells,
/// which continue in all directions, so that any window can be made.
Field layer_field(const TerrainParams& params, const TerrainLayer& layer, const Window& window,
                  const LayerSource& source, const Job& job);
/// Writes the heights of a layer to the points of a sphere.
void layer_sphere(const TerrainParams& params, const TerrainLayer& layer, Planet& planet, Rng rng,
                  const Job& job);

}  // namespace seedmesh::terrain
