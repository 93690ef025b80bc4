#pragma once
/// Height fields and planetoids.
///
///   params -> field_of() -> Field -> grid, rtin or greedy -> meshes, walls, water
///                                 \-> map_file() -> PNG or raw samples
///          -> planet_of() -> Planet -> one closed mesh
///
/// The model has one root node "terrain" with the centre of the field at the origin, unchanged heights, and
/// north towards -Z. docs/terrain.md describes all choices.
#include <vector>

#include "core/generators/api.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

struct Field;

/// Returns all errors that the schema cannot express, with pointers relative to the parameters. Generates
/// nothing.
std::vector<Issue> check(const TerrainParams& params, const Limits& limits);

/// Generates the model. Errors: those of check(), and an unreadable image.
Result<Model> generate(const TerrainParams& params, const GenerateContext& context);

/// Returns the model of a given field, for example a modified result of field_of(). Not for spheres. Issues:
/// a mesh type that does not fit the field.
Result<Model> dressed(const TerrainParams& params, const Field& field, const GenerateContext& context);

/// Returns {width, height, min, max, mean, heights, engines, warnings}. Heights are in metres, row by row
/// from the north-west, for fields of at most 257 x 257; otherwise, and for spheres, they are null. `engines`
/// has the import settings of the height map (game_engines.h); it is null for spheres, and for tiles without low
/// and high.
Result<Json> derive(const TerrainParams& params, const GenerateContext& context);

/// Returns the triangles of a grid or sphere without generating; the size of reduced meshes is unknown.
Result<Appraisal> appraise(const TerrainParams& params, const GenerateContext& context);

/// Returns an empty vocabulary, because terrain has no notation.
Json vocabulary();

/// Returns the request as a file of another format: "png16", "png8", "rgb24", "rgba32" or "r16", with the
/// conventions of the profiles core, unity or unreal.
Result<Array<std::uint8_t>> encode(const TerrainParams& params, const WantedFormat& form,
                                   const GenerateContext& context);

/// Returns why such a format cannot represent the parameters.
std::vector<Issue> check_format(const TerrainParams& params, const WantedFormat& form);

/// Returns the extent in metres for which quantized files choose the step of their grid: that of a tile with
/// the greatest usual range of heights, the same for all tiles of a world; 0 without a tile.
float tile_extent(const TerrainParams& params);

}  // namespace seedmesh::terrain
