#include "core/generators/world/world.h"

#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/terrain_indices.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {
namespace {

constexpr std::uint64_t model_triangles = 2 * tile_cells * tile_cells;

}  // namespace

std::vector<Issue> check(const WorldParams& params, const CheckContext&) { return issues_of(params); }

/// The model has the vertices of the root tile without its skirt.
Result<Model> generate(const WorldParams& params, const GenerateContext& context) {
  Job& job = context.job;
  const Result<World> world = read_world(params, job.seed());
  if (!world) return world.error();
  job.progress("mesh", 0);
  job.spend(Resource::triangles, model_triangles);
  const TileFrame frame = frame_of(*world, {});
  const TerrainGrid grid = sample_grid(*world, frame, tile_cells, 1, job);
  const TerrainMesh terrain = terrain_mesh(*world, frame, grid, 0);
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  const std::size_t count = (tile_cells + 1) * (tile_cells + 1);
  mesh.position.reserve(count);
  mesh.normal.reserve(count);
  mesh.color.reserve(count);
  mesh.index.wide.reserve(3 * model_triangles);
  for (std::size_t k = 0; k < count; ++k) {
    const TileVertex& v = terrain.vertices[k];
    const glm::dvec3 at = glm::dvec3(v.x, v.y, v.z) * frame.step + glm::dvec3(0, terrain.height, 0);
    mesh.position.push_back(glm::vec3(at));
    mesh.normal.push_back(math::unit(glm::vec3(v.normal[0], v.normal[1], v.normal[2]), {0, 1, 0}));
    mesh.color.push_back({v.color[0], v.color[1], v.color[2], v.color[3]});
  }
  const auto indices = terrain_indices_of(*world, job);
  for (std::size_t k = 0; k < 3 * model_triangles; ++k) mesh.index.wide.push_back(indices->corners[k]);
  Model model;
  model.name = "world";
  model.materials.emplace_back().name = "ground";
  MeshGroup& group = model.meshes.emplace_back();
  group.name = "terrain";
  group.primitives.push_back({std::move(mesh), 0, {}});
  Node& node = model.nodes.emplace_back();
  node.name = "terrain";
  node.mesh = 0;
  return model;
}

Result<Json> derive(const WorldParams& params, const GenerateContext& context) {
  const Result<World> world = read_world(params, context.job.seed());
  if (!world) return world.error();
  Json answer = {{"levels", world->levels}, {"extent", world->extent}, {"origin", params.origin}};
  answer["sea_level"] = params.relief.sea ? Json(params.relief.sea_level) : Json();
  answer["warnings"] = Json::array();
  return answer;
}

Result<Appraisal> appraise(const WorldParams& params, const GenerateContext&) {
  if (std::vector<Issue> issues = issues_of(params); !issues.empty())
    return Error{Code::invalid, std::move(issues)};
  Appraisal appraisal;
  Estimate estimate;
  estimate.triangles = model_triangles;
  estimate.bytes = model_triangles * 20;
  estimate.exact = true;
  appraisal.estimate = estimate;
  return appraisal;
}

Json vocabulary() { return Json::object(); }

}  // namespace seedmesh::world
