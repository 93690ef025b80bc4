#include "core/generators/city/city_model.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>

#include "core/base/heap.h"
#include "core/generators/city/bridge_mesh.h"
#include "core/generators/city/chunks.h"
#include "core/generators/city/contents.h"
#include "core/generators/city/ground_mesh.h"
#include "core/generators/city/landmarks.h"
#include "core/generators/city/objects.h"
#include "core/generators/city/surface.h"
#include "core/generators/material_members.h"
#include "core/texture/file_size.h"
#include "core/texture/png_image.h"
#include "core/texture/wall.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

struct PartMaterial {
  const char* name;
  std::array<std::uint8_t, 3> color;
  float roughness;
  std::string_view texture = {};  ///< one of texture::wall_kinds(); empty: none
};
constexpr std::string_view asphalt = "asphalt_ground", grass = "grass_ground";
constexpr PartMaterial part_materials[] = {
    {"asphalt", {0x45, 0x46, 0x48}, 0.95F, asphalt}, {"junction", {0x48, 0x49, 0x4b}, 0.95F, asphalt},
    {"sidewalk", {0x9b, 0x98, 0x92}, 0.9F, asphalt}, {"verge", {0x7f, 0x8a, 0x62}, 1.0F, grass},
    {"park", {0x5f, 0x7d, 0x45}, 1.0F, grass},       {"square", {0xa8, 0x9d, 0x88}, 0.9F, "setts_ground"},
    {"lot", {0x86, 0x8f, 0x6a}, 1.0F, grass},        {"water", {0x35, 0x55, 0x66}, 0.2F},
};
constexpr PartMaterial wall_material = {"wall", {0x8d, 0x84, 0x74}, 0.95F, "ashlar"};
constexpr PartMaterial foundation_material = {"foundation", {0x8f, 0x89, 0x80}, 0.95F, asphalt};
constexpr PartMaterial marking_material = {"marking", {0xd8, 0xd8, 0xd2}, 0.8F};

/// The surface of this name in the request; null if there is none.
const auto* given_surface(const PartMaterial& usual, const CityParams& params) {
  const auto found = std::ranges::find(params.surfaces, std::string_view(usual.name), [](const auto& each) {
    return std::string_view(text_of(each.material));
  });
  return found == params.surfaces.end() ? nullptr : &*found;
}

/// The colour of a surface in the request, or the usual one.
std::array<std::uint8_t, 3> color_of(const PartMaterial& usual, const CityParams& params) {
  const auto* given = given_surface(usual, params);
  if (given == nullptr || !given->color) return usual.color;
  return {given->color->red, given->color->green, given->color->blue};
}

Material material_of(const PartMaterial& usual, const CityParams& params) {
  Material material;
  material.name = usual.name;
  const auto [red, green, blue] = color_of(usual, params);
  material.base_color = {linear_of_srgb(red), linear_of_srgb(green), linear_of_srgb(blue), 1};
  material.roughness = usual.roughness;
  if (const auto* given = given_surface(usual, params)) {
    if (given->roughness) material.roughness = static_cast<float>(*given->roughness);
    set_specular(material, given->specular);
    set_emission(material, given->emission);
  }
  return material;
}

/// The same with a texture, unless the request gives a roughness, which applies everywhere, or a colour that is brighter
/// than the texture.
Material textured_material(const PartMaterial& usual, const CityParams& params) {
  Material material = material_of(usual, params);
  const auto* given = given_surface(usual, params);
  if (usual.texture.empty() || (given != nullptr && given->roughness)) return material;
  const glm::vec3 factor = glm::vec3(material.base_color) / texture::grey_of(usual.texture);
  if (std::max({factor.x, factor.y, factor.z}) > 1) return material;
  material.recipe.kind = usual.texture;
  material.recipe.factor = factor;
  // Relief is not visible from the distances of a city, and tangents would add a third to the ground's vertices.
  material.recipe.has_own_sides = true;
  return material;
}

/// Converts texture coordinates in metres to those of the texture of a material.
void fit_texture(Mesh& mesh, const Material& material) {
  const texture::WallKind* kind = texture::wall_kind(material.recipe.kind);
  if (kind == nullptr) return;
  const glm::vec2 repeats = 1.0 / kind->tile;
  for (glm::vec2& uv : mesh.uv[0].span()) uv *= repeats;
}

/// Asphalt with stripes across the image: as many pixels without, with and without paint.
Material striped_material(const char* name, const std::array<int, 3>& stripes, const CityParams& params,
                          Model& model, const Job& job) {
  constexpr std::uint32_t height = 4;
  const PartMaterial& street = part_materials[static_cast<std::size_t>(PartKind::carriageway)];
  const std::array<std::uint8_t, 3> plain = color_of(street, params),
                                    paint = color_of(marking_material, params);
  std::vector<std::byte> pixels;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::size_t stripe = 0; stripe < 3; ++stripe) {
      for (int i = 0; i < stripes[stripe]; ++i) {
        for (const std::uint8_t channel : stripe == 1 ? paint : plain) pixels.push_back(std::byte{channel});
      }
    }
  }
  const auto width = static_cast<std::uint32_t>(stripes[0] + stripes[1] + stripes[2]);
  Material material = material_of(street, params);
  material.name = name;
  material.base_color = glm::vec4(1);
  material.base_color_texture = {static_cast<int>(model.textures.size()), 0, true};
  model.textures.push_back(
      texture::png_image(name, {width, height, 3, 8, pixels}, texture::PngEffort::small, job));
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
  fit_texture(mesh, material);
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
  pieces.reserve(sorted.size());
  for (auto& [key, parts] : sorted) pieces.push_back({key.first, key.second, std::move(parts)});
  return pieces;
}

/// The meshes of the ground of one chunk and kind: without textures, all markings are one mesh.
struct GroundMeshes {
  GroundMesh plain, markings, crossings, lane_lines;
  bool has_textures;

  GroundMeshes(const CityPlan& plan, const Surface& surface, bool textures, const Job& job)
      : plain(plan, surface, textures, job),
        markings(plan, surface, textures, job),
        crossings(plan, surface, textures, job),
        lane_lines(plan, surface, textures, job),
        has_textures(textures) {}

  void add(const Part& part, std::uint32_t number) {
    using Layer = GroundMesh::StreetLayer;
    if (part.kind == PartKind::carriageway) {
      plain.add_carriageway(number, Layer::asphalt);
      markings.add_carriageway(number, Layer::stop_lines);
      (has_textures ? crossings : markings).add_carriageway(number, Layer::crossings);
      (has_textures ? lane_lines : markings).add_carriageway(number, Layer::lane_lines);
    } else {
      plain.add_part(number);
    }
    plain.add_walls(number);
  }

  void weld_if_large(Job& job) {
    for (GroundMesh* each : {&plain, &markings, &crossings, &lane_lines}) each->weld_if_large(job);
  }
};

/// Whether what stands in a level city depends on the outlines of its parts.
bool needs_outlines(const CityPlan& plan, const CityParams& params) {
  return !plan.landmarks.empty() || params.parks || params.yards || has_street_furniture(params);
}

/// One mesh for each kind of part in each chunk. Frees the outlines of the plan that nothing needs any more.
void add_ground(Model& model, CityPlan& plan, Surface& surface, const CityParams& params, ChunkNodes& nodes,
                const GenerateContext& context) {
  Job& job = context.job;
  const bool keeps_outlines = !surface.is_level() || needs_outlines(plan, params);
  std::map<std::string, int> materials;
  const auto add = [&](const char* name, const auto& make_material, GroundMesh& mesh, std::uint32_t chunk) {
    if (mesh.is_empty()) return;
    job.spend(Resource::triangles, mesh.triangles());
    const auto [material, is_new] = materials.try_emplace(name, static_cast<int>(model.materials.size()));
    if (is_new) model.materials.push_back(make_material());
    Mesh made = mesh.take(job);
    fit_texture(made, model.materials[static_cast<std::size_t>(material->second)]);
    add_mesh(model, name, material->second, std::move(made), nodes.group(chunk, "ground"));
  };
  for (const GroundPiece& piece : ground_pieces(plan, nodes.chunks())) {
    GroundMeshes meshes(plan, surface, context.demand.textures > 0, job);
    std::size_t done = 0;
    for (const std::uint32_t n : piece.parts) {
      if (done++ % 256 == 0) job.check();
      meshes.add(plan.parts[n], n);
      meshes.weld_if_large(job);
      if (!keeps_outlines) plan.parts[n].rings = {};
    }
    const PartMaterial& usual = part_materials[static_cast<std::size_t>(piece.kind)];
    const auto striped = [&](const char* name, const std::array<int, 3>& stripes) {
      return [&model, &params, &job, name, stripes] {
        return striped_material(name, stripes, params, model, job);
      };
    };
    add(
        "markings", [&] { return material_of(marking_material, params); }, meshes.markings, piece.chunk);
    add("crossings", striped("crossing", {16, 16, 0}), meshes.crossings, piece.chunk);
    add("lane_lines", striped("lane_line", {24, 16, 24}), meshes.lane_lines, piece.chunk);
    add(
        usual.name, [&] { return textured_material(usual, params); }, meshes.plain, piece.chunk);
    if (!nodes.chunks().is_divided() && piece.kind == PartKind::carriageway) surface.release_strips();
    constexpr std::size_t many_parts = 5000;
    if (!keeps_outlines && piece.parts.size() >= many_parts) return_unused_heap();
  }
}

/// The parts of a town wall.
void add_town_wall(Model& model, const CityPlan& plan, const Surface& surface, const CityParams& params,
                   Job& job) {
  GroundMesh mesh(plan, surface, false, job);
  for (std::uint32_t n = 0; n < plan.parts.size(); ++n) {
    if (!plan.parts[n].is_wall) continue;
    mesh.add_part(n);
    mesh.add_walls(n);
  }
  if (mesh.is_empty()) return;
  job.spend(Resource::triangles, mesh.triangles());
  add_mesh(model, "wall", textured_material(wall_material, params), mesh.take(job), 0);
}

/// The foundations of the buildings on ground that is not level.
void add_foundations(Model& model, const CityPlan& plan, const Surface& surface, const CityParams& params,
                     Job& job) {
  if (surface.is_level()) return;
  GroundMesh mesh(plan, surface, false, job);
  for (const Lot& lot : plan.lots) {
    if (lot.house) mesh.add_foundation(lot.footing());
  }
  for (const Landmark& landmark : plan.landmarks) {
    if (const auto footing = footing_of(landmark)) mesh.add_foundation(*footing);
  }
  if (mesh.is_empty()) return;
  job.spend(Resource::triangles, mesh.triangles());
  add_mesh(model, "foundations", textured_material(foundation_material, params), mesh.take(job), 0);
}

/// Frees what houses on level ground do not need.
void release_streets(CityPlan& plan) {
  plan.graph = {};
  plan.kerbs = {};
  plan.corner_reaches = {};
  plan.blocks = {};
  for (Lot& lot : plan.lots) lot.corners = {};
}

void add_bridges_and_tunnels(Model& model, Mesh bridges, const Surface& surface, const CityParams& params,
                             Job& job) {
  const auto add = [&](Mesh mesh, const char* name, const PartMaterial& usual) {
    if (mesh.elements() == 0) return;
    job.spend(Resource::triangles, mesh.elements());
    add_mesh(model, name, material_of(usual, params), std::move(mesh), 0);
  };
  add(std::move(bridges), "bridges", {"bridge", {0x8a, 0x88, 0x84}, 0.9F});
  add(tunnel_mesh(surface, job), "tunnels", {"tunnel", {0x7d, 0x7b, 0x77}, 0.95F});
}

}  // namespace

std::uint64_t ground_triangles(const CityPlan& plan, const Surface& surface, bool has_textures, Job& job) {
  std::uint64_t count = 0;
  constexpr std::size_t parts_a_mesh = 256;
  for (std::size_t begin = 0; begin < plan.parts.size(); begin += parts_a_mesh) {
    job.check();
    GroundMeshes meshes(plan, surface, has_textures, job);
    const std::size_t end = std::min(begin + parts_a_mesh, plan.parts.size());
    for (std::size_t n = begin; n < end; ++n) meshes.add(plan.parts[n], static_cast<std::uint32_t>(n));
    for (const GroundMesh* each : {&meshes.plain, &meshes.markings, &meshes.crossings, &meshes.lane_lines})
      count += each->triangles();
  }
  if (surface.is_level()) return count;
  for (const Lot& lot : plan.lots) count += lot.house ? 10 : 0;
  for (const Landmark& landmark : plan.landmarks) count += footing_of(landmark) ? 10 : 0;
  return count;
}

void add_ground_textures(texture::TextureSizes& sizes, const Surface& surface, const CityParams& params) {
  std::array<bool, std::size(part_materials)> is_used{};
  bool has_wall = false;
  for (const Part& part : surface.plan().parts)
    (part.is_wall ? has_wall : is_used[static_cast<std::size_t>(part.kind)]) = true;
  const auto add = [&](const PartMaterial& usual) { sizes.add(textured_material(usual, params)); };
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (is_used[i]) add(part_materials[i]);
  }
  if (has_wall) add(wall_material);
  if (!surface.is_level() && !surface.plan().lots.empty()) add(foundation_material);
}

Result<Model> city_model(CityPlan& plan, const CityParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Model model;
  model.name = "city";
  add_node(model, "city", -1);
  Surface surface(plan, params.streets.wards.wall_height, job);
  const Chunks chunks(plan, params);
  ChunkNodes nodes(model, chunks);
  Mesh bridges = bridge_mesh(plan, job);
  add_ground(model, plan, surface, params, nodes, context);
  add_town_wall(model, plan, surface, params, job);
  add_foundations(model, plan, surface, params, job);
  add_bridges_and_tunnels(model, std::move(bridges), surface, params, job);
  if (auto warning = tunnel_warning(surface)) model.warnings.push_back(*std::move(warning));
  surface.release_edges();
  if (surface.is_level() && !needs_outlines(plan, params)) release_streets(plan);
  if (job.budget()->prefers_low_memory()) return_unused_heap();
  if (auto error = add_contents(model, nodes, chunks, surface, params, context)) return std::move(*error);
  return model;
}

}  // namespace seedmesh::city
