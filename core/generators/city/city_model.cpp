#include "core/generators/city/city_model.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>

#include "core/generators/city/bridge_mesh.h"
#include "core/generators/city/chunks.h"
#include "core/generators/city/contents.h"
#include "core/generators/city/ground_mesh.h"
#include "core/generators/city/landmarks.h"
#include "core/generators/city/surface.h"
#include "core/generators/material_members.h"
#include "core/texture/png.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

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
constexpr Look marking_look = {"marking", {0xd8, 0xd8, 0xd2}, 0.8F};

Material material_of(const Look& look, const CityParams& params) {
  Material material;
  material.name = look.name;
  material.base_color = {linear_of_srgb(look.color[0]), linear_of_srgb(look.color[1]),
                         linear_of_srgb(look.color[2]), 1};
  material.roughness = look.roughness;
  for (const auto& own : params.surfaces) {
    if (text_of(own.material) != std::string_view(look.name)) continue;
    if (own.color) {
      material.base_color = {linear_of_srgb(own.color->red), linear_of_srgb(own.color->green),
                             linear_of_srgb(own.color->blue), 1};
    }
    if (own.roughness) material.roughness = static_cast<float>(*own.roughness);
    set_specular(material, own.specular);
    set_emission(material, own.emission);
  }
  return material;
}

/// The colour of a surface in the request, or its own.
std::array<std::uint8_t, 3> color_of(const Look& look, const CityParams& params) {
  for (const auto& own : params.surfaces) {
    if (own.color && text_of(own.material) == std::string_view(look.name))
      return {own.color->red, own.color->green, own.color->blue};
  }
  return look.color;
}

/// Asphalt with dashes: a third of the image along the street.
Material lane_line_material(const CityParams& params, Model& model, const Job& job) {
  constexpr std::uint32_t width = 48, height = 4;
  const Look& asphalt = looks[static_cast<std::size_t>(PartKind::carriageway)];
  const std::array<std::uint8_t, 3> gap = color_of(asphalt, params), dash = color_of(marking_look, params);
  std::vector<std::byte> pixels;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const bool is_dash = i % width >= width / 3 && i % width < width * 2 / 3;
    for (const std::uint8_t channel : is_dash ? dash : gap) pixels.push_back(std::byte{channel});
  }
  const Array<std::uint8_t> file =
      texture::encode_png({width, height, 3, 8, pixels}, texture::PngEffort::small, job);
  auto image = std::make_shared<Image>();
  image->name = "lane_line";
  image->bytes.assign(file.span().begin(), file.span().end());
  Material material = material_of(asphalt, params);
  material.name = "lane_line";
  material.base_color = glm::vec4(1);
  material.base_color_texture = {static_cast<int>(model.textures.size()), 0, true};
  model.textures.push_back(std::move(image));
  return material;
}

/// Adds a node with one mesh.
void add_mesh(Model& model, const char* name, int material, Mesh mesh, int parent) {
  MeshGroup group;
  group.name = name;
  Primitive primitive;
  primitive.mesh = std::move(mesh);
  primitive.material = material;
  group.primitives.push_back(std::move(primitive));
  const int node = add_node(model, name, parent);
  model.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(std::move(group));
}

/// The same with a material of its own.
void add_mesh(Model& model, const char* name, Material material, Mesh mesh, int parent) {
  model.materials.push_back(std::move(material));
  add_mesh(model, name, static_cast<int>(model.materials.size()) - 1, std::move(mesh), parent);
}

/// Parts of one chunk and kind.
struct GroundPiece {
  std::uint32_t chunk = 0;
  PartKind kind = PartKind::verge;
  std::vector<std::uint32_t> parts;
};

/// All parts but walls, by chunk and kind.
std::vector<GroundPiece> ground_pieces(const CityPlan& plan, const Chunks& chunks) {
  std::map<std::pair<std::uint32_t, PartKind>, std::vector<std::uint32_t>> sorted;
  for (std::uint32_t i = 0; i < plan.parts.size(); ++i) {
    const Part& part = plan.parts[i];
    if (!part.is_wall) sorted[{chunks.of(part), part.kind}].push_back(i);
  }
  std::vector<GroundPiece> pieces;
  for (auto& [key, parts] : sorted) pieces.push_back({key.first, key.second, std::move(parts)});
  return pieces;
}

/// One mesh for each kind of part in each chunk.
void add_ground(Model& model, const Surface& surface, const CityParams& params, const Chunks& chunks,
                ChunkNodes& nodes, const GenerateContext& context) {
  Job& job = context.job;
  const CityPlan& plan = surface.plan();
  std::map<std::string, int> materials;
  const auto add = [&](const char* name, const auto& make_material, GroundMesh& mesh, std::uint32_t chunk) {
    if (mesh.is_empty()) return;
    job.spend(Resource::triangles, mesh.triangles());
    const auto [material, is_new] = materials.try_emplace(name, static_cast<int>(model.materials.size()));
    if (is_new) model.materials.push_back(make_material());
    add_mesh(model, name, material->second, mesh.take(job), nodes.group(chunk, "ground"));
  };
  // Without textures, lane lines are not dashed.
  const bool has_dashes = context.demand.textures > 0;
  for (const GroundPiece& piece : ground_pieces(plan, chunks)) {
    GroundMesh mesh(plan, surface, job), markings(plan, surface, job), lane_lines(plan, surface, job);
    std::size_t done = 0;
    for (const std::uint32_t n : piece.parts) {
      if (done++ % 256 == 0) job.check();
      if (piece.kind == PartKind::carriageway) {
        mesh.add_carriageway(n, GroundMesh::StreetLayer::asphalt);
        markings.add_carriageway(n, GroundMesh::StreetLayer::markings);
        (has_dashes ? lane_lines : markings).add_carriageway(n, GroundMesh::StreetLayer::lane_lines);
      } else {
        mesh.add_part(n);
      }
      mesh.add_walls(n);
    }
    const Look& look = looks[static_cast<std::size_t>(piece.kind)];
    add("markings", [&] { return material_of(marking_look, params); }, markings, piece.chunk);
    add("lane_lines", [&] { return lane_line_material(params, model, job); }, lane_lines, piece.chunk);
    add(look.name, [&] { return material_of(look, params); }, mesh, piece.chunk);
  }
}

/// The parts of a town wall.
void add_town_wall(Model& model, const CityPlan& plan, const Surface& surface, const CityParams& params,
                   Job& job) {
  GroundMesh mesh(plan, surface, job);
  for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
    if (!plan.parts[n].is_wall) continue;
    mesh.add_part(n);
    mesh.add_walls(n);
  }
  if (mesh.is_empty()) return;
  job.spend(Resource::triangles, mesh.triangles());
  add_mesh(model, "wall", material_of({"wall", {0x8d, 0x84, 0x74}, 0.95F}, params), mesh.take(job), 0);
}

/// The foundations of the buildings on ground that is not level.
void add_foundations(Model& model, const CityPlan& plan, const Surface& surface, const CityParams& params,
                     Job& job) {
  if (surface.is_level()) return;
  GroundMesh mesh(plan, surface, job);
  for (const Lot& lot : plan.lots) {
    if (lot.house) mesh.add_foundation(lot.footing());
  }
  for (const Landmark& landmark : plan.landmarks) {
    if (const auto footing = footing_of(landmark)) mesh.add_foundation(*footing);
  }
  if (mesh.is_empty()) return;
  job.spend(Resource::triangles, mesh.triangles());
  add_mesh(model, "foundations", material_of({"foundation", {0x8f, 0x89, 0x80}, 0.95F}, params),
           mesh.take(job), 0);
}

void add_bridges(Model& model, const CityPlan& plan, const CityParams& params, Job& job) {
  Mesh mesh = bridge_mesh(plan, job);
  if (mesh.elements() == 0) return;
  job.spend(Resource::triangles, mesh.elements());
  add_mesh(model, "bridges", material_of({"bridge", {0x8a, 0x88, 0x84}, 0.9F}, params), std::move(mesh), 0);
}

}  // namespace

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
        mesh.add_carriageway(number, GroundMesh::StreetLayer::lane_lines);
      } else {
        mesh.add_part(number);
      }
      mesh.add_walls(number);
    }
    count += mesh.triangles();
  }
  if (surface.is_level()) return count;
  for (const Lot& lot : plan.lots) count += lot.house ? 10 : 0;
  for (const Landmark& landmark : plan.landmarks) count += footing_of(landmark) ? 10 : 0;
  return count;
}

Result<Model> city_model(const CityPlan& plan, const CityParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Model model;
  model.name = "city";
  add_node(model, "city", -1);
  const Surface surface(plan, params.streets.wards.wall_height, job);
  const Chunks chunks(plan, params);
  ChunkNodes nodes(model, chunks);
  add_ground(model, surface, params, chunks, nodes, context);
  add_town_wall(model, plan, surface, params, job);
  add_foundations(model, plan, surface, params, job);
  add_bridges(model, plan, params, job);
  if (auto error = add_contents(model, nodes, chunks, surface, params, context)) return std::move(*error);
  return model;
}

}  // namespace seedmesh::city
