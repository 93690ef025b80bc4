#pragma once
/// Fields and planetoids in their looks: meshes, levels of detail, pictures, walls and water of one request.
#include "core/generators/terrain/field.h"
#include "core/model/model.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

/// The model of a field, with as many levels of detail as the job's demand asks for, as far as each has fewer
/// triangles than the one before. Level k of a grid has about every 2^k-th sample, of the reduced meshes 2^k
/// times the error. Where pieces or tiles lie side by side all levels have the same border.
Model dressed_field(const TerrainParams& params, const Field& field, Job& job);

/// A planetoid; level k has 2^k times fewer points along an edge of its cube.
Model dressed_planet(const TerrainParams& params, Job& job);

}  // namespace seedmesh::terrain
