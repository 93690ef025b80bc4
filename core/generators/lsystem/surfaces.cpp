#include "core/generators/lsystem/surfaces.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "core/geom/lod/detail.h"
#include "core/geom/lod/foliage_levels.h"
#include "core/geom/mesh/flatten.h"
#include "core/geom/plant/leaf_mesh.h"
#include "core/geom/plant/organs.h"
#include "core/gltf/read/read.h"
#include "core/model/build.h"
#include "core/model/levels.h"
#include "core/texture/leaf.h"

namespace seedmesh::lsystem {
namespace {

using Shape = LsystemShape;
bool is_leaf(const LsystemSurface& surface) { return static_cast<int>(surface.shape) < leaf_shape_count; }

// The leaf shapes come first in the schema, in the order of LeafShape.
static_assert(static_cast<int>(Shape::fruit) == leaf_shape_count);

LeafShape leaf_shape(const LsystemSurface& surface) { return static_cast<LeafShape>(surface.shape); }

LeafBuild leaf_build(const LsystemSurface& surface) {
  switch (surface.build) {
    case LsystemBuild::mesh:
      return LeafBuild::mesh;
    case LsystemBuild::card:
      return LeafBuild::card;
    case LsystemBuild::cross:
      return LeafBuild::cross;
    case LsystemBuild::curved:
      return LeafBuild::curved;
    case LsystemBuild::twig:
      return LeafBuild::twig;
    case LsystemBuild::bunch:
      return LeafBuild::bunch;
  }
  return LeafBuild::mesh;
}

bool shows_twig(const LsystemSurface& surface) {
  return surface.build == LsystemBuild::twig || surface.build == LsystemBuild::bunch;
}

Mesh mesh_of(const LsystemSurface& surface, const Detail& detail, const Job& job) {
  if (surface.shape == Shape::fruit) {
    return fruit_mesh({.pointed = surface.pointed, .sides = detail.sides(10)}, job);
  }
  if (surface.shape == Shape::sphere) return ball_mesh(detail.sides(12), job);
  if (surface.shape == Shape::disc) return disc_mesh(detail.sides(16), job);
  if (surface.shape == Shape::patches) {
    std::vector<glm::vec3> points;
    for (const auto& patch : surface.patches) {
      for (const auto& p : patch) {
        points.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
      }
    }
    const PatchBasis basis =
        surface.basis == LsystemBasis::bezier ? PatchBasis::bezier : PatchBasis::b_spline;
    return patch_mesh({points, basis, std::max(1, detail.stacks(surface.divisions))}, job);
  }
  LeafForm form;
  form.shape = leaf_shape(surface);
  form.build = leaf_build(surface);
  form.fold = math::radians(surface.fold);
  form.droop = math::radians(surface.droop);
  form.level = detail.level();
  const texture::LeafPicture picture =
      texture::leaf_picture(texture::leaf_kind(form.shape, shows_twig(surface)));
  form.twig_leaves = picture.count;
  return leaf_mesh(form, job);
}

/// Returns the texture of the leaf kind where it is requested.
TextureRecipe recipe_of(const LsystemSurface& surface) {
  const bool wanted = surface.picture == LsystemPicture::own ||
                      (surface.picture == LsystemPicture::auto_ && surface.build != LsystemBuild::mesh);
  if (!is_leaf(surface) || !wanted) return {};
  return {std::string(texture::leaf_kind(leaf_shape(surface), shows_twig(surface))), 0, {}};
}

Mesh copy_of(const Mesh& mesh, const Job& job) {
  Mesh copy;
  const auto copied = [&job](const auto& from, auto& to) {
    to = std::decay_t<decltype(from)>(job);
    to.append(from.span());
  };
  copied(mesh.position, copy.position);
  copied(mesh.normal, copy.normal);
  copied(mesh.uv[0], copy.uv[0]);
  copied(mesh.color, copy.color);
  copied(mesh.index.wide, copy.index.wide);
  return copy;
}

/// Models used as surfaces: by name, one primitive for each material, with material indices of the plant.
using SurfaceModels = std::map<std::string, std::vector<Primitive>>;

Model guest_of(const LsystemSurface& surface, const std::string& name, const GenerateContext& context) {
  Job& job = context.job;
  const std::string at = "/surfaces/" + name;
  const Rng stream = job.rng().at("surface").at(name);
  Result<Model> model = surface.model ? generate_child(*surface.model, at + "/model", stream, context)
                                      : read_glb(*surface.glb, at + "/glb", job);
  if (!model) job.refuse(model.error().issues.front());
  return std::move(*model);
}

/// Moves materials, textures and warnings of a surface model into the plant.
std::vector<Primitive> imported(Model surface_model, Model& model, const std::string& pointer, Job& job) {
  std::vector<Primitive> parts = flatten(surface_model, job);
  std::erase_if(parts, [](const Primitive& part) {
    return part.mesh.topology != Topology::triangles || part.mesh.elements() == 0;
  });
  if (parts.empty()) {
    job.refuse(
        {IssueKind::invalid_value, pointer, "found a model without triangles; a surface needs triangles"});
  }
  const int materials = move_materials(model, surface_model);
  for (Primitive& part : parts) {
    if (part.material >= 0) part.material += materials;
    if (part.mesh.normal.empty())
      job.refuse({IssueKind::invalid_value, pointer, "found a model without normals"});
  }
  return parts;
}

/// Creates each surface model that organs use once.
SurfaceModels surface_models_of(Model& model, const Organs& organs, const LsystemParams& params,
                                const GenerateContext& context) {
  Job& job = context.job;
  std::vector<bool> used(params.surfaces.size(), false);
  for (const Organ& organ : organs.organ) used[organ.surface] = true;
  SurfaceModels surface_models;
  std::size_t number = 0;
  for (const auto& [name, surface] : params.surfaces) {
    if (surface.shape == Shape::model && used[number]) {
      surface_models[name] = imported(guest_of(surface, name, context), model, "/surfaces/" + name, job);
    }
    ++number;
  }
  return surface_models;
}

/// Meshes of organs, one or more for each surface of the request.
struct Sheets {
  std::vector<Mesh> meshes;
  std::vector<TextureRecipe> recipes;
  std::vector<Sides> sides;
  std::vector<std::string> names;
  std::vector<int> materials;        ///< -1: material of the organ
  std::vector<std::uint32_t> first;  ///< first mesh of each surface, and the end

  void add(Mesh mesh, const LsystemSurface& surface, const std::string& name, int material) {
    meshes.push_back(std::move(mesh));
    recipes.push_back(recipe_of(surface));
    const bool closed = surface.shape == Shape::fruit || surface.shape == Shape::sphere;
    sides.push_back(closed ? Sides::one : Sides::both);
    names.push_back(name);
    materials.push_back(material);
  }
  int material(std::uint32_t sheet, std::int16_t color, MaterialSet& material_set) const {
    return materials[sheet] >= 0 ? materials[sheet]
                                 : material_set.material(color, sides[sheet], recipes[sheet]);
  }
};

Sheets sheets_of(const LsystemParams& params, const SurfaceModels& surface_models, const Detail& detail,
                 const Job& job) {
  Sheets sheets;
  for (const auto& [name, surface] : params.surfaces) {
    sheets.first.push_back(static_cast<std::uint32_t>(sheets.meshes.size()));
    if (surface.shape != Shape::model) {
      sheets.add(mesh_of(surface, detail, job), surface, name, -1);
      continue;
    }
    const auto surface_model = surface_models.find(name);
    if (surface_model == surface_models.end()) continue;
    for (const Primitive& part : surface_model->second)
      sheets.add(copy_of(part.mesh, job), surface, name, part.material);
  }
  sheets.first.push_back(static_cast<std::uint32_t>(sheets.meshes.size()));
  return sheets;
}

/// Expands organs of surfaces to one organ for each mesh of the surface.
Organs on_sheets(const Organs& organs, const Sheets& sheets, const Job& job) {
  Organs all(job);
  for (Organ organ : organs.organ) {
    const std::uint32_t surface = organ.surface;
    for (organ.surface = sheets.first[surface]; organ.surface < sheets.first[surface + 1]; ++organ.surface) {
      Organ own = organ;
      if (sheets.materials[organ.surface] >= 0) own.color = 0;
      all.organ.push_back(own);
    }
  }
  return all;
}

FoliageOptions options_of(const Sheets& sheets, const PlantOrgans& plant_organs,
                          const LsystemParams& params) {
  const Organs& organs = plant_organs.organs;
  FoliageOptions options;
  options.surfaces = sheets.meshes;
  options.model_size = plant_organs.size;
  options.bones = plant_organs.bones;
  if (params.crown_normals > 0 && organs.organ.size() > 0) {
    Box box{organs.organ[0].position, organs.organ[0].position};
    for (const Organ& organ : organs.organ) {
      box.min = glm::min(box.min, organ.position);
      box.max = glm::max(box.max, organ.position);
    }
    options.crown = (box.min + box.max) * 0.5F;
    options.crown_share = static_cast<float>(params.crown_normals);
  }
  return options;
}

Organs with_material_index(const Organs& organs, const MaterialSet& material_set, const Job& job) {
  Organs own(job);
  own.organ.append(organs.organ.span());
  for (Organ& organ : own.organ) organ.color = material_set.index_of(organ.color);
  return own;
}

/// Returns the coarsest mesh of each surface, as its footprint.
std::vector<Mesh> footprints_of(const LsystemParams& params, const SurfaceModels& surface_models,
                                const Job& job) {
  Sheets sheets = sheets_of(params, surface_models, Detail(most_levels - 1), job);
  std::vector<Mesh> footprints(params.surfaces.size());
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    if (sheets.first[i] < sheets.first[i + 1]) footprints[i] = std::move(sheets.meshes[sheets.first[i]]);
  }
  return footprints;
}

std::uint64_t triangles_of(const Organs& organs, const Sheets& sheets) {
  std::uint64_t triangles = 0;
  for (const Organ& organ : organs.organ) {
    for (std::uint32_t i = sheets.first[organ.surface]; i < sheets.first[organ.surface + 1]; ++i)
      triangles += sheets.meshes[i].elements();
  }
  return triangles;
}

/// Returns the number of triangles of the model at a level so far.
std::uint64_t shown_at(const Model& model, int level) {
  std::uint64_t triangles = 0;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const auto last = std::min(static_cast<std::size_t>(level), node.lods.size());
    const int mesh = last == 0 ? node.mesh : node.lods[last - 1];
    for (const Primitive& part : model.meshes[static_cast<std::size_t>(mesh)].primitives)
      triangles += part.mesh.elements();
  }
  return triangles;
}

/// Returns the share of organs that a level keeps: enough to keep the outline, within the `left` triangles of
/// the budget. `whole` is the number for all organs.
double organs_at(const Detail& detail, const FoliageLevels& levels, std::uint64_t whole, std::uint64_t left) {
  const double share = static_cast<double>(left) / static_cast<double>(std::max<std::uint64_t>(whole, 1));
  return std::max(detail.organs(), std::min(levels.share_for(detail.loss()), share));
}

void add_merged(Model& model, const PlantOrgans& plant_organs, const LsystemParams& params,
                const SurfaceModels& surface_models, MaterialSet& material_set,
                const GenerateContext& context) {
  Job& job = context.job;
  Node node;
  node.name = "organs";
  node.parent = 0;
  const Organs all = with_material_index(plant_organs.organs, material_set, job);
  std::optional<FoliageLevels> levels;
  if (context.demand.lods > 1) {
    const std::vector<Mesh> footprints = footprints_of(params, surface_models, job);
    levels.emplace(FoliageLevels::Plant{all, footprints, Limbs(job), 1}, job);
  }
  std::uint64_t before = 0;  // triangles of the whole plant at the previous level
  for (int level = 0; level < context.demand.lods; ++level) {
    const Detail detail(level);
    const Sheets sheets = sheets_of(params, surface_models, detail, job);
    const std::uint64_t whole = triangles_of(all, sheets);
    Organs fewer(job);
    const std::uint64_t others = shown_at(model, level), most = Detail::fewer_than(before);
    const std::uint64_t left = most > others ? most - others : 0;
    if (level > 0) fewer = levels->keep(all, organs_at(detail, *levels, whole, left), job);
    const Organs& own = level > 0 ? fewer : all;
    MeshGroup group{level_name(node.name, level), {}};
    const FoliageOptions options = options_of(sheets, {own, plant_organs.size, plant_organs.bones}, params);
    for (Foliage& part : place_organs(on_sheets(own, sheets, job), options, job)) {
      const int material = sheets.material(part.surface, part.color, material_set);
      group.primitives.push_back({std::move(part.mesh), material, {}});
    }
    before = others;
    for (const Primitive& part : group.primitives) before += part.mesh.elements();
    if (!group.primitives.empty()) add_level(node, add_mesh(model, std::move(group)));
  }
  if (node.mesh >= 0) model.nodes.push_back(std::move(node));
}

/// Adds one node for each surface and material. The writer instantiates it at each transform.
void add_shared(Model& model, const PlantOrgans& plant_organs, const LsystemParams& params,
                const SurfaceModels& surface_models, MaterialSet& material_set,
                const GenerateContext& context) {
  Job& job = context.job;
  std::vector<Sheets> levels;
  for (int level = 0; level < context.demand.lods; ++level)
    levels.push_back(sheets_of(params, surface_models, Detail(level), job));
  const Organs own = with_material_index(plant_organs.organs, material_set, job);
  const Sheets& finest = levels.front();
  const FoliageOptions options = options_of(finest, {own, plant_organs.size, {}}, params);
  for (FoliageInstances& instances : organ_transforms(on_sheets(own, finest, job), options, job)) {
    Node node;
    node.name = finest.names[instances.surface];
    node.parent = 0;
    node.instances.transforms = std::move(instances.transforms);
    const int material = finest.material(instances.surface, instances.color, material_set);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      add_level(node, add_mesh(model, level_name(node.name, level),
                               copy_of(levels[level].meshes[instances.surface], job), material));
    }
    model.nodes.push_back(std::move(node));
  }
}

}  // namespace

void check_surfaces(const LsystemParams& params, std::vector<Issue>& issues) {
  for (const auto& [name, surface] : params.surfaces) {
    const std::string at = "/surfaces/" + name + "/patches";
    if (surface.shape == Shape::patches && surface.patches.empty()) {
      issues.push_back(
          {missing_for({"shape"}), at, "found no patches; the shape \"patches\" needs at least one"});
    }
    if (surface.shape != Shape::patches && !surface.patches.empty()) {
      issues.push_back({conflict_with({"shape"}), at,
                        "found patches with the shape \"" + std::string(text_of(surface.shape)) +
                            "\"; expected the shape \"patches\""});
    }
    const int models = (surface.model ? 1 : 0) + (surface.glb ? 1 : 0);
    const bool is_model = surface.shape == Shape::model;
    if (models != (is_model ? 1 : 0)) {
      issues.push_back({conflict_with({"shape", "model", "glb"}), "/surfaces/" + name,
                        is_model ? "found " + std::to_string(models) +
                                       " models; the shape \"model\" needs either model or glb"
                                 : "found a model with the shape \"" + std::string(text_of(surface.shape)) +
                                       "\"; expected the shape \"model\""});
    }
    if (surface.glb && !is_glb_uri(*surface.glb)) {
      issues.push_back({IssueKind::invalid_value, "/surfaces/" + name + "/glb",
                        "expected a GLB as \"data:model/gltf-binary;base64,…\""});
    }
  }
}

void add_organs(Model& model, const PlantOrgans& plant_organs, const LsystemParams& params,
                MaterialSet& material_set, const GenerateContext& context) {
  if (plant_organs.organs.organ.empty()) return;
  const SurfaceModels surface_models = surface_models_of(model, plant_organs.organs, params, context);
  if (context.demand.share_organs) {
    add_shared(model, plant_organs, params, surface_models, material_set, context);
  } else {
    add_merged(model, plant_organs, params, surface_models, material_set, context);
  }
}

}  // namespace seedmesh::lsystem
