#include "core/generators/tree/leaves.h"

#include <algorithm>
#include <cmath>

#include "core/generators/tree/looks.h"
#include "core/generators/tree/range.h"
#include "core/geom/detail.h"
#include "core/geom/finish.h"
#include "core/geom/leaf_mesh.h"
#include "core/texture/leaf.h"

namespace seedmesh::tree {
namespace {

LeafBuild leaf_build(TreeBuild build) {
  switch (build) {
    case TreeBuild::cross:
      return LeafBuild::cross;
    case TreeBuild::curved:
      return LeafBuild::curved;
    case TreeBuild::mesh:
      return LeafBuild::mesh;
    case TreeBuild::twig:
      return LeafBuild::twig;
    case TreeBuild::bunch:
      return LeafBuild::bunch;
    default:
      return LeafBuild::card;
  }
}

FoliageOptions options_of(const Leaves& leaves, const Job& job) {
  const Organs& organs = leaves.organs;
  const TreeParams& params = leaves.params;
  FoliageOptions options;
  options.model_size = leaves.model_size;
  options.tint = static_cast<float>(params.leaf.tint);
  options.bones = leaves.motion.bones;
  options.wind = leaves.motion.wind;
  const Demand& demand = job.demand();
  options.tangents = demand.tangents && demand.textures > 0 && has_leaf_relief(params);
  if (params.leaf.crown_normals > 0 && !organs.organ.empty()) {
    Box box{organs.organ[0].position, organs.organ[0].position};
    for (const Organ& organ : organs.organ) {
      box.min = glm::min(box.min, organ.position);
      box.max = glm::max(box.max, organ.position);
    }
    // A little below the middle, so that the lowest leaves do not look straight down.
    const glm::vec3 middle = 0.5F * (box.min + box.max);
    options.crown = glm::vec3(middle.x, middle.y - 0.2F * (box.max.y - box.min.y), middle.z);
    options.crown_share = static_cast<float>(params.leaf.crown_normals);
  }
  return options;
}

std::string level_name(const char* name, int level) {
  return level == 0 ? name : name + ("_LOD" + std::to_string(level));
}

void put_on(Model& model, Node& node, MeshGroup group) {
  const int mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(std::move(group));
  if (node.mesh < 0) {
    node.mesh = mesh;
  } else {
    node.lods.push_back(mesh);
  }
}

std::vector<Foliage> place(const Organs& organs, const Mesh& leaf, FoliageOptions options, Job& job) {
  options.surfaces = std::span(&leaf, 1);
  return place_organs(organs, options, job);
}

void add_merged(Model& model, const Leaves& leaves, TreeLevels& levels,
                std::optional<std::vector<Foliage>> finest, const LeafLook& look, Job& job) {
  Node node;
  node.name = "leaves";
  node.parent = 0;
  std::uint64_t before = 0;  // triangles of the whole tree at the level before
  for (int level = 0; level < job.demand().lods; ++level) {
    MeshGroup group{level_name("leaves", level), {}};
    std::vector<Foliage> parts;
    if (level == 0) {
      parts = finest ? *std::move(finest) : place(leaves.organs, leaves.leaf, options_of(leaves, job), job);
    } else {
      const Mesh leaf = leaf_of(leaves.params, level, job);
      const double share =
          levels.leaves_at(Detail(level), leaves.organs.organ.size(), leaf.elements(), before);
      const Organs fewer = levels.foliage->keep(leaves.organs, share, job);
      parts = place(fewer, leaf, options_of(leaves, job), job);
    }
    before = levels.bark.empty() ? 0 : levels.bark[static_cast<std::size_t>(level)];
    for (Foliage& part : parts) {
      before += part.mesh.elements();
      group.primitives.push_back({std::move(part.mesh), look.material, look.variants});
    }
    if (!group.primitives.empty()) put_on(model, node, std::move(group));
  }
  if (node.mesh >= 0) model.nodes.push_back(std::move(node));
}

/// One node that the writer turns to as many as there are leaves.
void add_shared(Model& model, const Organs& organs, const TreeParams& params, FoliageOptions options,
                const LeafLook& look, Job& job) {
  Node node;
  node.name = "leaf";
  node.parent = 0;
  for (int level = 0; level < job.demand().lods; ++level) {
    MeshGroup group{level_name("leaf", level), {}};
    group.primitives.push_back({leaf_of(params, level, job), look.material, look.variants});
    if (level == 0) {
      options.surfaces = std::span(&group.primitives.front().mesh, 1);
      for (FoliagePlaces& places : organ_places(organs, options, job))
        node.instances.transforms = std::move(places.places);
    }
    put_on(model, node, std::move(group));
  }
  if (!node.instances.transforms.empty()) model.nodes.push_back(std::move(node));
}

}  // namespace

Mesh leaf_of(const TreeParams& params, int level, const Job& job) {
  const TreeLeaf& leaf = params.leaf;
  LeafForm form;
  form.shape = static_cast<LeafShape>(leaf.leaf_shape);
  form.build = leaf_build(build_of(params));
  form.fold = math::radians(leaf.fold);
  form.droop = math::radians(leaf.droop);
  form.coarseness = leaf.coarseness;
  form.level = level;
  form.shows_twig = shows_twig(params);
  form.twig_leaves = texture::leaf_picture(texture::leaf_kind(form.shape, form.shows_twig)).count;
  Mesh mesh = leaf_mesh(form, job);
  order_for_cache(mesh, job);
  return mesh;
}

/// Organs come with the width and length of a leaf; a leaf's mesh is 1 long and has a width of its own.
void fit_leaves(Organs& organs, const TreeParams& params, const Mesh& leaf, const Job& job) {
  const Box box = bounds_of(leaf.position.span());
  const float across = std::max(1e-3F, box.max.x - box.min.x);
  const TreeBuild build = build_of(params);
  const bool is_round = build == TreeBuild::cross || build == TreeBuild::bunch;
  const double density = drawn_leaves(params);
  const auto size = static_cast<float>(params.leaf.size / std::sqrt(std::max(density, 1e-3)));
  job.check();
  for (Organ& organ : organs.organ) {
    const float width = organ.scale.x * size / across, length = organ.scale.y * size;
    organ.scale = {width, length, is_round ? width : length};
  }
}

OrganPlacing finest_leaves(const Leaves& leaves, Job& job) {
  FoliageOptions options = options_of(leaves, job);
  options.surfaces = std::span(&leaves.leaf, 1);
  return OrganPlacing(leaves.organs, options, job);
}

void add_leaves(Model& model, const Leaves& leaves, TreeLevels& levels,
                std::optional<std::vector<Foliage>> finest, Job& job) {
  if (leaves.organs.organ.empty()) return;
  const LeafLook look = add_leaf_look(model, leaves.params, job);
  if (job.demand().share_organs) {
    add_shared(model, leaves.organs, leaves.params, options_of(leaves, job), look, job);
  } else {
    add_merged(model, leaves, levels, std::move(finest), look, job);
  }
  // Bark looks the same in every season.
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      if (primitive.variant_materials.empty())
        primitive.variant_materials.assign(look.variants.size(), primitive.material);
    }
  }
}

}  // namespace seedmesh::tree
