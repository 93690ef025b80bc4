#include "core/generators/city/city_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/child.h"
#include "core/generators/city/bridge_mesh.h"
#include "core/generators/city/ground_mesh.h"
#include "core/generators/city/surface.h"
#include "core/generators/city/zoning.h"
#include "core/generators/scene/model_levels.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

struct Look {
  const char* name;
  std::array<std::uint8_t, 3> color;
  float roughness;
};
constexpr Look looks[] = {
    {"asphalt", {0x45, 0x46, 0x48}, 0.95F}, {"junction", {0x48, 0x49, 0x4b}, 0.95F},
    {"sidewalk", {0x9b, 0x98, 0x92}, 0.9F}, {"verge", {0x7f, 0x8a, 0x62}, 1.0F},
    {"park", {0x5f, 0x7d, 0x45}, 1.0F},     {"square", {0xa8, 0x9d, 0x88}, 0.9F},
    {"lot", {0x86, 0x8f, 0x6a}, 1.0F},      {"water", {0x35, 0x55, 0x66}, 0.2F},
};
Material material_of(const Look& look) {
  Material material;
  material.name = look.name;
  material.base_color = {linear_of_srgb(look.color[0]), linear_of_srgb(look.color[1]),
                         linear_of_srgb(look.color[2]), 1};
  material.roughness = look.roughness;
  return material;
}

int add_node(Model& model, std::string name, int parent) {
  Node node;
  node.name = std::move(name);
  node.parent = parent;
  model.nodes.push_back(std::move(node));
  return static_cast<int>(model.nodes.size()) - 1;
}

/// Adds a node with one mesh.
void add_mesh(Model& model, const char* name, const Look& look, Mesh mesh, int parent) {
  MeshGroup group;
  group.name = name;
  Primitive primitive;
  primitive.mesh = std::move(mesh);
  primitive.material = static_cast<int>(model.materials.size());
  model.materials.push_back(material_of(look));
  group.primitives.push_back(std::move(primitive));
  const int node = add_node(model, name, parent);
  model.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(std::move(group));
}

/// One mesh for each kind of part.
void add_ground(Model& model, const CityPlan& plan, const Surface& surface, Job& job) {
  const int ground = add_node(model, "ground", 0);
  for (std::size_t kind = 0; kind < std::size(looks); ++kind) {
    GroundMesh mesh(plan, surface, job), markings(plan, surface, job);
    std::size_t done = 0;
    for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
      const Part& part = plan.parts[n];
      if (static_cast<std::size_t>(part.kind) != kind || part.is_wall) continue;
      if (done++ % 256 == 0) job.check();
      if (part.kind == PartKind::carriageway) {
        mesh.add_carriageway(n, GroundMesh::StreetLayer::asphalt);
        markings.add_carriageway(n, GroundMesh::StreetLayer::markings);
      } else {
        mesh.add_part(n);
      }
      mesh.add_walls(n);
    }
    if (!markings.is_empty()) {
      job.spend(Resource::triangles, markings.triangles());
      add_mesh(model, "markings", {"marking", {0xd8, 0xd8, 0xd2}, 0.8F}, markings.take(job), ground);
    }
    if (mesh.is_empty()) continue;
    job.spend(Resource::triangles, mesh.triangles());
    add_mesh(model, looks[kind].name, looks[kind], mesh.take(job), ground);
  }
}

/// The parts of a town wall.
void add_town_wall(Model& model, const CityPlan& plan, const Surface& surface, Job& job) {
  GroundMesh mesh(plan, surface, job);
  for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
    if (!plan.parts[n].is_wall) continue;
    mesh.add_part(n);
    mesh.add_walls(n);
  }
  if (mesh.is_empty()) return;
  job.spend(Resource::triangles, mesh.triangles());
  add_mesh(model, "wall", {"wall", {0x8d, 0x84, 0x74}, 0.95F}, mesh.take(job), 0);
}

/// The foundations of the houses on ground that is not level.
void add_foundations(Model& model, const CityPlan& plan, const Surface& surface, Job& job) {
  if (surface.is_level()) return;
  GroundMesh mesh(plan, surface, job);
  for (const Lot& lot : plan.lots) {
    if (lot.house) mesh.add_foundation(lot);
  }
  if (mesh.is_empty()) return;
  job.spend(Resource::triangles, mesh.triangles());
  add_mesh(model, "foundations", {"foundation", {0x8f, 0x89, 0x80}, 0.95F}, mesh.take(job), 0);
}

void add_bridges(Model& model, const CityPlan& plan, Job& job) {
  Mesh mesh = bridge_mesh(plan, job);
  if (mesh.elements() == 0) return;
  job.spend(Resource::triangles, mesh.elements());
  add_mesh(model, "bridges", {"bridge", {0x8a, 0x88, 0x84}, 0.9F}, std::move(mesh), 0);
}

int add_material(Model& model, Material material) {
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    if (scene::is_same(model.materials[i], material, scene::Seeds::may_differ)) return static_cast<int>(i);
  }
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

Transform transform_of(const Lot& lot, const Surface& surface) {
  const House& house = *lot.house;
  double lowest = 0;
  const double floor = surface.floor_height(lot, lowest);
  Transform at;
  at.translation = {static_cast<float>(house.position.x), static_cast<float>(floor),
                    static_cast<float>(0 - house.position.y)};
  const math::SinCos half = math::sincos_degrees(house.turn / 2);
  at.rotation = glm::quat(static_cast<float>(half.cos), 0, static_cast<float>(half.sin), 0);
  return at;
}

/// Adds one building with all its copies.
void add_building(Model& model, Model made, const SharedHouse& house, const Surface& surface, int parent,
                  Job& job) {
  const CityPlan& plan = surface.plan();
  std::vector<int> materials;
  for (Material& material : made.materials) {
    for (TextureUse* use :
         {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
          &material.occlusion_texture, &material.emissive_texture}) {
      if (use->texture < 0) continue;
      model.textures.push_back(made.textures[static_cast<std::size_t>(use->texture)]);
      use->texture = static_cast<int>(model.textures.size()) - 1;
    }
    materials.push_back(add_material(model, std::move(material)));
  }
  scene::separate_bodies(made);
  std::vector<std::vector<Primitive>> levels = scene::extract_levels(made, job);
  if (levels.empty() || levels[0].empty()) return;
  MeshGroup group;
  group.name = "building_" + std::to_string(model.meshes.size());
  std::uint64_t triangles = 0;
  for (Primitive& each : levels[0]) {
    if (each.mesh.elements() == 0) continue;
    if (each.material >= 0) each.material = materials[static_cast<std::size_t>(each.material)];
    triangles += each.mesh.elements();
    group.primitives.push_back(std::move(each));
  }
  if (group.primitives.empty()) return;
  job.spend(Resource::triangles, triangles * (house.lots.size() - 1));
  const int node = add_node(model, group.name, parent);
  Node& added = model.nodes[static_cast<std::size_t>(node)];
  added.mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(std::move(group));
  if (house.lots.size() == 1) {
    added.transform = transform_of(plan.lots[house.lots[0]], surface);
    return;
  }
  for (const std::uint32_t lot : house.lots)
    added.instances.transforms.push_back(transform_of(plan.lots[lot], surface));
}

}  // namespace

std::vector<SharedHouse> shared_houses(const CityPlan& plan, const CityParams& params) {
  std::vector<SharedHouse> houses;
  std::map<std::pair<std::uint64_t, std::string>, std::size_t> known;
  for (std::uint32_t i = 0; i < plan.lots.size(); ++i) {
    if (!plan.lots[i].house) continue;
    Child request = request_of(*plan.lots[i].house, params);
    const auto [at, is_new] = known.try_emplace({*request.seed, request.parameters}, houses.size());
    if (is_new) houses.push_back({std::move(request), {}});
    houses[at->second].lots.push_back(i);
  }
  return houses;
}

std::uint64_t ground_triangles(const CityPlan& plan, const Surface& surface, Job& job) {
  std::uint64_t count = 0;
  constexpr std::size_t parts_a_mesh = 256;
  for (std::size_t begin = 0; begin < plan.parts.size(); begin += parts_a_mesh) {
    job.check();
    GroundMesh mesh(plan, surface, job);
    const std::size_t end = std::min(begin + parts_a_mesh, plan.parts.size());
    for (std::size_t n = begin; n < end; ++n) {
      const auto number = static_cast<std::uint32_t>(n);
      if (plan.parts[n].kind == PartKind::carriageway) {
        mesh.add_carriageway(number, GroundMesh::StreetLayer::asphalt);
        mesh.add_carriageway(number, GroundMesh::StreetLayer::markings);
      } else {
        mesh.add_part(number);
      }
      mesh.add_walls(number);
    }
    count += mesh.triangles();
  }
  if (surface.is_level()) return count;
  for (const Lot& lot : plan.lots) count += lot.house ? 10 : 0;
  return count;
}

Result<Model> city_model(const CityPlan& plan, const CityParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Model model;
  model.name = "city";
  add_node(model, "city", -1);
  const Surface surface(plan, params.streets.wards.wall_height, job);
  add_ground(model, plan, surface, job);
  add_town_wall(model, plan, surface, job);
  add_foundations(model, plan, surface, job);
  add_bridges(model, plan, job);
  const std::vector<SharedHouse> houses = shared_houses(plan, params);
  if (houses.empty()) return model;
  const int buildings = add_node(model, "buildings", 0);
  std::vector<std::optional<Result<Model>>> made(houses.size());
  parallel_for(job, houses.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
    made[i].emplace(generate_child(houses[i].request, "/buildings", Rng(0), context));
  });
  for (std::size_t i = 0; i < houses.size(); ++i) {
    if (!*made[i]) return std::move(*made[i]).error();
    add_building(model, std::move(**made[i]), houses[i], surface, buildings, job);
    made[i].reset();
  }
  return model;
}

}  // namespace seedmesh::city
