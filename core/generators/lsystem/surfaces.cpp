#include "core/generators/lsystem/surfaces.h"

#include <algorithm>

#include "core/base/math.h"
#include "core/geom/detail.h"
#include "core/geom/leaf_mesh.h"
#include "core/geom/organs.h"
#include "core/texture/leaf.h"

namespace seedmesh::lsystem {
namespace {

using Shape = LsystemShape;

bool is_leaf(const LsystemSurface& surface) {
  return surface.shape != Shape::fruit && surface.shape != Shape::patches;
}

// The shapes that are leaves stand in the schema in the order of LeafShape.
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
  form.coarseness = detail.coarseness();
  const texture::LeafPicture picture =
      texture::leaf_picture(texture::leaf_kind(form.shape, shows_twig(surface)));
  form.twig_leaves = picture.count;
  return leaf_mesh(form, job);
}

/// The picture of the leaf's own kind where it is wanted.
TextureRecipe recipe_of(const LsystemSurface& surface) {
  const bool wanted = surface.picture == LsystemPicture::own ||
                      (surface.picture == LsystemPicture::auto_ && surface.build != LsystemBuild::mesh);
  if (!is_leaf(surface) || !wanted) return {};
  return {std::string(texture::leaf_kind(leaf_shape(surface), shows_twig(surface))), 0, {}};
}

struct Sheets {
  std::vector<Mesh> meshes;
  std::vector<TextureRecipe> recipes;
  std::vector<Sides> sides;
  std::vector<std::string> names;
};

Sheets sheets_of(const LsystemParams& params, const Detail& detail, const Job& job) {
  Sheets sheets;
  for (const auto& [name, surface] : params.surfaces) {
    sheets.meshes.push_back(mesh_of(surface, detail, job));
    sheets.recipes.push_back(recipe_of(surface));
    sheets.sides.push_back(surface.shape == Shape::fruit ? Sides::one : Sides::both);
    sheets.names.push_back(name);
  }
  return sheets;
}

FoliageOptions options_of(const Sheets& sheets, const Organs& organs, const LsystemParams& params,
                          float size) {
  FoliageOptions options;
  options.surfaces = sheets.meshes;
  options.model_size = size;
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

Organs looking(const Organs& organs, const Wardrobe& wardrobe, const Job& job) {
  Organs own(job);
  own.organ.append(organs.organ.span());
  for (Organ& organ : own.organ) organ.color = wardrobe.look_of(organ.color);
  return own;
}

std::string level_name(const std::string& name, int level) {
  return level == 0 ? name : name + "_LOD" + std::to_string(level);
}

void add_merged(Model& model, const Organs& organs, const LsystemParams& params, float size,
                Wardrobe& wardrobe, Job& job) {
  Node node;
  node.name = "organs";
  node.parent = 0;
  for (int level = 0; level < job.demand().lods; ++level) {
    const Detail detail(level);
    const Sheets sheets = sheets_of(params, detail, job);
    Organs own = looking(organs, wardrobe, job);
    thin_out(own, detail.every());
    MeshGroup group{level_name(node.name, level), {}};
    for (Foliage& part : place_organs(own, options_of(sheets, own, params, size), job)) {
      const int material =
          wardrobe.material(part.color, sheets.sides[part.surface], sheets.recipes[part.surface]);
      group.primitives.push_back({std::move(part.mesh), material, {}});
    }
    if (group.primitives.empty()) continue;
    const int mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(group));
    if (node.mesh < 0) {
      node.mesh = mesh;
    } else {
      node.lods.push_back(mesh);
    }
  }
  if (node.mesh >= 0) model.nodes.push_back(std::move(node));
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
  copied(mesh.index.wide, copy.index.wide);
  return copy;
}

/// One node for each surface and look, which the writer turns to as many as there are places.
void add_shared(Model& model, const Organs& organs, const LsystemParams& params, float size,
                Wardrobe& wardrobe, Job& job) {
  std::vector<Sheets> levels;
  for (int level = 0; level < job.demand().lods; ++level)
    levels.push_back(sheets_of(params, Detail(level), job));
  const Organs own = looking(organs, wardrobe, job);
  const Sheets& finest = levels.front();
  for (FoliagePlaces& places : organ_places(own, options_of(finest, own, params, size), job)) {
    Node node;
    node.name = finest.names[places.surface];
    node.parent = 0;
    node.instances.transforms = std::move(places.places);
    const int material =
        wardrobe.material(places.color, finest.sides[places.surface], finest.recipes[places.surface]);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const int mesh = static_cast<int>(model.meshes.size());
      model.meshes.push_back({level_name(node.name, static_cast<int>(level)), {}});
      model.meshes.back().primitives.push_back(
          {copy_of(levels[level].meshes[places.surface], job), material, {}});
      if (level == 0) {
        node.mesh = mesh;
      } else {
        node.lods.push_back(mesh);
      }
    }
    model.nodes.push_back(std::move(node));
  }
}

}  // namespace

void check_surfaces(const LsystemParams& params, std::vector<Issue>& issues) {
  for (const auto& [name, surface] : params.surfaces) {
    const std::string at = "/surfaces/" + name + "/patches";
    if (surface.shape == Shape::patches && surface.patches.empty()) {
      issues.push_back({at, "found no patches; the shape \"patches\" needs at least one"});
    }
    if (surface.shape != Shape::patches && !surface.patches.empty()) {
      issues.push_back({at, "found patches beside the shape \"" + std::string(text_of(surface.shape)) +
                                "\"; expected the shape \"patches\""});
    }
  }
}

void add_organs(Model& model, const Organs& organs, const LsystemParams& params, float size,
                Wardrobe& wardrobe, Job& job) {
  if (organs.organ.empty()) return;
  if (job.demand().share_organs) {
    add_shared(model, organs, params, size, wardrobe, job);
  } else {
    add_merged(model, organs, params, size, wardrobe, job);
  }
}

}  // namespace seedmesh::lsystem
