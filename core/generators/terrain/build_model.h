#pragma once
/// Builds models of fields and planetoids: meshes, levels of detail, textures, walls and water.
#include <memory>

#include "core/generators/api.h"
#include "core/generators/terrain/refined_ground.h"
#include "core/model/model.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

/// Returns the model of a field with the requested levels of detail. A level is dropped where it does not
/// have fewer triangles than the one before. Level k of a grid has about every 2^k-th sample; level k of a
/// reduced mesh has 2^k times the error. Where pieces or tiles are adjacent, all levels have the same border.
Model build_field_model(const TerrainParams& params, const Field& field, const GenerateContext& context);

/// Returns the refined ground of a field, or null without `refine`. Refuses a refinement that does not fit the field.
std::shared_ptr<const RefinedGround> refined_ground(const TerrainParams& params, const Field& field,
                                                    const Job& job);

/// The kind of the textures of a planetoid with details.
constexpr const char* rock_kind = "rock_ground";

/// Returns the model of a planetoid. Level k has 2^k times fewer points along an edge of its cube.
Model build_planet_model(const TerrainParams& params, const GenerateContext& context);

/// Returns the number of points along an edge of the cube of a planetoid's sea at a level.
std::int32_t sea_side(const TerrainParams& params, int level);

}  // namespace seedmesh::terrain
