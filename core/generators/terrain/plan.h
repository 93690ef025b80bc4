#pragma once
/// What the parameters of a request mean together: defaults that depend on others, and faults that no schema
/// can tell.
#include <vector>

#include "core/base/job.h"
#include "core/generators/terrain/colors.h"
#include "core/generators/terrain/faults.h"
#include "core/generators/terrain/filters.h"
#include "core/generators/terrain/noise.h"
#include "core/generators/terrain/planet.h"
#include "core/generators/terrain/subdivide.h"

namespace seedmesh {
struct TerrainParams;
struct TerrainHydraulic;
}  // namespace seedmesh

namespace seedmesh::terrain {

// Samples a side of the largest field.
constexpr int longest_side = 16'385;

/// Rounds, faults or octaves that are planned, and with those that are extra.
int planned_iterations(const TerrainParams& params);
int all_iterations(const TerrainParams& params);

double amplitude_of(const TerrainParams& params);
SquareSubdivision square_plan(const TerrainParams& params);
NestedSubdivision nested_plan(const TerrainParams& params);
FaultPlan fault_plan(const TerrainParams& params);
NoisePlan noise_plan(const TerrainParams& params);

/// Where the samples lie that were asked for: of a tile, in its world.
Window place_of(const TerrainParams& params);

/// Samples a side that the algorithm makes; of a sphere along an edge of the cube. 0 for an image.
int made_side(const TerrainParams& params);
/// The same of the finished field, after `resample`.
int finished_side(const TerrainParams& params);

/// The heights that colours of a tile are spread over, the same for all tiles of a world.
Range nominal_range(const TerrainParams& params);

PaletteName palette_of(const TerrainParams& params);

/// Every fault between parameters, pointers relative to them.
std::vector<Issue> faults_between(const TerrainParams& params, const Limits& limits);

/// The field with all its filters; margin 1 where it is a tile, else 0. Issues: an image that cannot be read.
Result<Field> field_of(const TerrainParams& params, Job& job);

/// Points along an edge of the cube of a planetoid's coarser level; level 0 has those of the request.
std::int32_t planet_side(const TerrainParams& params, int level);

/// The planetoid at a level of detail: the same heights at fewer points.
Planet planet_of(const TerrainParams& params, int level, Job& job);

}  // namespace seedmesh::terrain
