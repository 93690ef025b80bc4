#pragma once
/// Buildings and areas of a scene that are given by their outlines, as maps have them.
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/scene/shapes.h"
#include "core/geom/polygon/massing.h"
#include "core/model/model.h"

namespace seedmesh {
struct SceneBuilding;
struct SceneParams;
}  // namespace seedmesh

namespace seedmesh::scene {

class Ground;

/// Up to this number of buildings, each is a node of its own. More buildings are merged into meshes of about
/// merged_vertices vertices.
constexpr std::size_t most_building_nodes = 2000;
constexpr std::size_t merged_vertices = 60'000;

/// Errors that the schema cannot express, with pointers into the parameters: outlines that cross themselves, a floor
/// above the roof, options without effect.
void check_outlines(const SceneParams& params, const Job& job, std::vector<Issue>& issues);

/// Returns the plan of rings whose positions are (east, south), in metres. In the plan, y points north.
Plan plan_of_rings(const std::vector<std::vector<std::array<double, 2>>>& rings);

/// Adds the areas and the buildings below the first node. A building is one closed mesh about the middle of its
/// footprint; its node stands on the lowest ground below its outer ring. Spends triangles; an exceeded limit
/// points to the building. Adds warnings about roofs that have another shape or a smaller height than requested.
void add_outlines(Model& model, const SceneParams& params, const Ground& ground, Job& job);

/// Returns the rectangle around each building, which later layers keep away from.
Array<Footprint> footprints_of_buildings(const SceneParams& params, const Job& job);

/// Returns an estimate of the triangles of the areas and buildings.
std::uint64_t expected_triangles(const SceneParams& params);

}  // namespace seedmesh::scene
