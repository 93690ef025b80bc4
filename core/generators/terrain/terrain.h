#pragma once
/// Height fields and planetoids.
///
///   params -> field_of() -> Field -> grid, rtin or greedy -> meshes, walls, water
///                                 \-> map_file() -> PNG or raw samples
///          -> planet_of() -> Planet -> one closed mesh
///
/// Out: one root node "terrain", the middle of the field at the origin, heights as they are, north towards
/// -Z. docs/terrain.md tells every choice.
#include <vector>

#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/generators/form.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

struct Field;

/// Every fault between parameters, with pointers relative to them. Makes nothing.
std::vector<Issue> check(const TerrainParams& params, const Limits& limits);

/// The model. Issues: those of check(), and of an image that cannot be read.
Result<Model> generate(const TerrainParams& params, Job& job);

/// The model of a field that is at hand: what field_of() gave, and what was done to it since. Planes alone.
/// Issues: a mesh that does not fit the field.
Result<Model> dressed(const TerrainParams& params, const Field& field, Job& job);

/// {width, height, min, max, mean, heights, engines, warnings}: heights in metres, row by row from
/// north-west, for fields of at most 257 x 257; null beyond, and for spheres. `engines`: what is typed in
/// beside the height map of the request (engines.h); null for spheres, and for tiles without low and high.
Result<Json> derive(const TerrainParams& params, Job& job);

/// Triangles of a grid or sphere, without making anything; reduced meshes cannot be told beforehand.
Result<Appraisal> appraise(const TerrainParams& params, const Job& job);

/// No notation, hence no words.
Json vocabulary();

/// The request as a file of another kind than a model: "png16", "png8", "rgb24", "rgba32" or "r16"; by the
/// conventions of the profiles core, unity or unreal.
Result<Array<std::uint8_t>> encode(const TerrainParams& params, const WantedForm& form, Job& job);

/// What keeps such a form from holding what the parameters ask for.
std::vector<Issue> check_form(const TerrainParams& params, const WantedForm& form);

}  // namespace seedmesh::terrain
