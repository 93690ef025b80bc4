#include "core/generators/world/world.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/terrain_indices.h"
#include "core/generators/world/terrain_mesh.h"
#include "core/generators/world/water_mesh.h"
#include "core/model/empty_mesh.h"

namespace seedmesh::world {
namespace {

constexpr std::uint64_t terrain_triangles = 2 * tile_cells * tile_cells;
constexpr std::uint64_t usual_rivers =
    300;  ///< triangles of lakes and rivers in the root tile of a small world

/// The first `vertices` vertices of a tile, and triangles of them. `height`: metres at position 0.
struct Part {
  const std::vector<TileVertex>& vertices;
  std::size_t vertex_count;
  double height;
};

template <class Corners>
Mesh mesh_of(const Part& part, const Corners& corners, std::size_t corner_count, double step, Job& job) {
  Mesh mesh = empty_mesh(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.position.reserve(part.vertex_count);
  mesh.normal.reserve(part.vertex_count);
  mesh.color.reserve(part.vertex_count);
  mesh.index.wide.reserve(corner_count);
  for (std::size_t k = 0; k < part.vertex_count; ++k) {
    const TileVertex& v = part.vertices[k];
    const glm::dvec3 at = glm::dvec3(v.x, v.y, v.z) * step + glm::dvec3(0, part.height, 0);
    mesh.position.push_back(glm::vec3(at));
    mesh.normal.push_back(math::unit(glm::vec3(v.normal[0], v.normal[1], v.normal[2]), {0, 1, 0}));
    mesh.color.push_back({v.color[0], v.color[1], v.color[2], v.color[3]});
  }
  for (std::size_t k = 0; k < corner_count; ++k) mesh.index.wide.push_back(corners[k]);
  return mesh;
}

/// Adds a node with a mesh and a material of its own.
void add_part(Model& model, const Surface& surface, const char* name, Mesh mesh) {
  Material& material = model.materials.emplace_back();
  material.name = surface.name;
  material.roughness = static_cast<float>(surface.roughness);
  const int number = static_cast<int>(model.meshes.size());
  MeshGroup& group = model.meshes.emplace_back();
  group.name = name;
  group.primitives.push_back({std::move(mesh), number, {}});
  Node& node = model.nodes.emplace_back();
  node.name = name;
  node.mesh = number;
}

}  // namespace

std::vector<Issue> check(const WorldParams& params, const CheckContext&) { return issues_of(params); }

/// The model has the vertices of the root tile without its skirt.
Result<Model> generate(const WorldParams& params, const GenerateContext& context) {
  Job& job = context.job;
  const Result<World> world = read_world(params, job.seed());
  if (!world) return world.error();
  job.progress("mesh", 0);
  const TileFrame frame = frame_of(*world, {});
  const TerrainGrid grid = sample_grid(*world, frame, tile_cells, 1, job);
  const TerrainMesh terrain = terrain_mesh(*world, frame, grid, 0);
  Model model;
  model.name = "world";
  if (world->has(Layer::terrain)) {
    job.spend(Resource::triangles, terrain_triangles);
    constexpr std::size_t vertices = (tile_cells + 1) * (tile_cells + 1);
    const std::vector<std::uint16_t> indices = terrain_indices(tile_cells + 1);
    add_part(model, ground_surface, "terrain",
             mesh_of({terrain.vertices, vertices, terrain.height}, indices, 3 * terrain_triangles, frame.step,
                     job));
  }
  if (world->has(Layer::water)) {
    const WaterMesh water = water_of(*world, frame, {grid, terrain.height}, job);
    const TileMesh& mesh = water.mesh;
    job.spend(Resource::triangles, mesh.indices.size() / 3);
    if (!mesh.indices.empty()) {
      add_part(model, water_surface, "water",
               mesh_of({mesh.vertices, mesh.vertices.size(), water.height}, mesh.indices, mesh.indices.size(),
                       frame.step, job));
    }
  }
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
  const auto has = [&](WorldLayersItem layer) {
    return std::find(params.layers.begin(), params.layers.end(), layer) != params.layers.end();
  };
  Estimate estimate;
  if (has(WorldLayersItem::terrain)) estimate.triangles += terrain_triangles;
  if (has(WorldLayersItem::water) && params.relief.sea) estimate.triangles += 2;
  if (has(WorldLayersItem::water) && params.extent < dry_spacing * tile_cells)
    estimate.triangles += usual_rivers;
  estimate.bytes = estimate.triangles * 20;
  appraisal.estimate = estimate;
  return appraisal;
}

Json vocabulary() { return Json::object(); }

}  // namespace seedmesh::world
