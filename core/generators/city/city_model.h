#pragma once
/// Builds the model of a city plan: one ground mesh for each kind of area, kerbs, and houses as copies of
/// shared meshes.
#include "core/generators/api.h"
#include "core/generators/city/plan.h"

namespace seedmesh {
struct CityParams;
}
namespace seedmesh::texture {
class TextureSizes;
}

namespace seedmesh::city {

class Surface;

/// Returns the number of triangles of the ground of a plan and of its foundations. Builds these meshes to count them.
std::uint64_t ground_triangles(const CityPlan& plan, const Surface& surface, bool has_textures, Job& job);

/// Adds the textures of the ground, for an estimate.
void add_ground_textures(texture::TextureSizes& sizes, const Surface& surface, const CityParams& params);

/// Returns the model of a plan. Its nodes are: "city" > "ground" > one node and mesh for each kind of part
/// ("asphalt", "junction", ..., "lot"); "city" > "buildings" > one node for each shared building; "city" >
/// "landmarks", "furniture", "trees", "borders". With chunks, these groups are below a node for each chunk.
/// Spends Resource::triangles. Frees the outlines of parts that are not needed after their meshes are made, so
/// that large models take less memory.
Result<Model> city_model(CityPlan& plan, const CityParams& params, const GenerateContext& context);

}  // namespace seedmesh::city
