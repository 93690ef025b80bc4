#pragma once
/// Interprets the parameters of a request together: dependent defaults, and errors that the schema cannot
/// express.
#include <vector>

#include "core/base/job.h"
#include "core/generators/terrain/colors.h"
#include "core/generators/terrain/faults.h"
#include "core/generators/terrain/filters.h"
#include "core/generators/terrain/fracture.h"
#include "core/generators/terrain/noise.h"
#include "core/generators/terrain/planet.h"
#include "core/generators/terrain/subdivide.h"

namespace seedmesh {
struct TerrainParams;
struct TerrainHydraulic;
}  // namespace seedmesh

namespace seedmesh::terrain {

/// Largest number of samples along a side of a field.
constexpr int longest_side = 16'385;

/// Returns the number of rounds, faults or octaves of the request, without `extra_iterations`.
int planned_iterations(const TerrainParams& params);
/// Returns the same number with `extra_iterations`.
int all_iterations(const TerrainParams& params);

double amplitude_of(const TerrainParams& params);
SquareSubdivision square_plan(const TerrainParams& params);
NestedSubdivision nested_plan(const TerrainParams& params);
FaultPlan fault_plan(const TerrainParams& params);
NoisePlan noise_plan(const TerrainParams& params);
FracturePlan fracture_plan(const TerrainParams& params);

/// Returns the window of the requested samples; for a tile, in its world.
Window window_of(const TerrainParams& params);

/// Returns true where the number of rounds determines the resolution.
bool is_subdivided(const TerrainParams& params);
/// Returns the number of samples along a side that the algorithm generates; for a sphere, along an edge of
/// its cube; 0 for an image.
int made_side(const TerrainParams& params);
/// Returns the number of samples along a side of the finished field, after `resample`.
int finished_side(const TerrainParams& params);
/// Returns the number of samples along one side of the world that the tile is a part of. Requires a tile.
std::int64_t samples_across(const TerrainParams& params);

/// Returns the range of heights for the colours of a tile, the same for all tiles of a world.
Range nominal_range(const TerrainParams& params);

PaletteName palette_of(const TerrainParams& params);

/// Returns all errors that the schema cannot express, with pointers relative to the parameters.
std::vector<Issue> errors_between(const TerrainParams& params, const Limits& limits);

/// Generates the heights of the algorithm at the samples of a window, without layers and filters. Not for images.
Field algorithm_field(const TerrainParams& params, const Window& window, double cell, Rng rng,
                      const Job& job);
/// Writes the heights of the algorithm to the points of a sphere.
void algorithm_sphere(const TerrainParams& params, Planet& planet, Rng rng, const Job& job);

/// Generates the field and applies all filters. The field of a tile has a margin of one sample. Issues: an unreadable
/// image.
Result<Field> field_of(const TerrainParams& params, Job& job);

/// Evaluates the expressions at the samples of the field, if these are at most 2,100,000, and discards the
/// values. Like field_of(), it throws Stop if a value is not finite. Filters are not run.
void try_expressions(const TerrainParams& params, Job& job);

/// Returns the number of points along an edge of the cube of a planetoid at a level; level 0 has that of the
/// request.
std::int32_t planet_side(const TerrainParams& params, int level);

/// Generates the planetoid at a level of detail: the same heights at fewer points.
Planet planet_of(const TerrainParams& params, int level, Job& job);

}  // namespace seedmesh::terrain
