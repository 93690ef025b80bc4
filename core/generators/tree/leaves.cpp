#include "core/generators/tree/leaves.h"

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"
#include "core/generators/tree/far_leaves.h"
#include "core/generators/tree/materials.h"
#include "core/generators/tree/range.h"
#include "core/geom/lod/detail.h"
#include "core/geom/mesh/finish.h"
#include "core/geom/plant/leaf_mesh.h"
#include "core/geom/plant/tube_formulas.h"
#include "core/texture/leaf.h"

namespace seedmesh::tree {
namespace {

// The schema lists the builds in the order of LeafBuild, after `usual` and `none`.
constexpr int first_build = static_cast<int>(TreeBuild::card);
static_assert(static_cast<int>(TreeBuild::bunch) - first_build == static_cast<int>(LeafBuild::bunch));

// Share of the area of a square that the leaf or the twig on it fills: between 0.32 for needles and 0.59.
constexpr float filled_card = 0.5F;
// The name of a random number.
constexpr std::uint64_t roll_name = 0x526F;
// Crossed rectangles are steep: the normals of their lower sides can then turn up without leaving their face.
constexpr double cross_tilt = 62;
// Headings of leaves (unit vectors) with a shorter horizontal part count as vertical and are not turned.
constexpr float least_level = 0.05F;
// Between both sides of a leaf, as a share of its length: 0.2 to 2 mm.
constexpr float thickness = 0.003F;

/// The frame of a leaf turned about its length by a random angle of up to `most` degrees to either side. Their density
/// grows with the sine of the angle, as that of the slopes of leaves that face all directions alike: few are level.
glm::quat rolled(const Organ& organ, double most) {
  const double share = 2 * static_cast<double>(fraction_of(key_at(organ.key, roll_name))) - 1;
  // With cos(angle) uniform from cos(most) to 1, the sine of half the angle grows with a square root.
  const double sine = math::sincos_degrees(0.5 * most).sin * std::sqrt(std::abs(share));
  const double cosine = std::sqrt(1 - sine * sine);
  return organ.frame *
         glm::quat(static_cast<float>(cosine), 0, static_cast<float>(share < 0 ? -sine : sine), 0);
}

/// The frame turned about its length until its width is level and its upper side up. Vertical frames remain.
glm::quat upright(const glm::quat& frame) {
  const glm::mat3 axes = glm::mat3_cast(frame);
  const glm::vec3 width{-axes[1].z, 0, axes[1].x};
  const float size = std::sqrt(glm::dot(width, width));
  if (size < least_level) return frame;
  const glm::vec3 level = width / size;
  return glm::quat_cast(glm::mat3(level, axes[1], glm::cross(level, axes[1])));
}

/// The area of all faces.
float area_of(const Mesh& mesh) {
  float area = 0;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const glm::vec3& a = mesh.position[mesh.index.at(i)];
    const glm::vec3 across =
        glm::cross(mesh.position[mesh.index.at(i + 1)] - a, mesh.position[mesh.index.at(i + 2)] - a);
    area += 0.5F * std::sqrt(glm::dot(across, across));
  }
  return area;
}

/// The mesh of a leaf with all faces once more as its back, if it has one.
Mesh with_back(Mesh mesh, bool has_back) {
  if (!has_back) return mesh;
  const auto front = static_cast<std::uint32_t>(mesh.position.size());
  const std::size_t corners = mesh.index.wide.size();
  for (std::uint32_t i = 0; i < front; ++i) {
    const glm::vec3 normal = mesh.normal[i];
    mesh.position.push_back(mesh.position[i] - thickness * normal + 0.0F);
    mesh.normal.push_back(-normal + 0.0F);
    mesh.uv[0].push_back(mesh.uv[0][i]);
  }
  for (std::size_t i = 0; i < corners; i += 3) {
    for (const std::size_t corner : {i, i + 2, i + 1})
      mesh.index.wide.push_back(mesh.index.wide[corner] + front);
  }
  return mesh;
}

LeafBuild leaf_build(TreeBuild build) {
  return static_cast<LeafBuild>(std::max(static_cast<int>(build) - first_build, 0));
}

FoliageOptions options_of(const Leaves& leaves, const GenerateContext& context) {
  const Organs& organs = leaves.organs;
  const TreeParams& params = leaves.params;
  FoliageOptions options;
  options.model_size = leaves.model_size;
  options.shade = leaves.shade;
  options.bones = leaves.motion.bones;
  options.wind = leaves.motion.wind;
  const Demand& demand = context.demand;
  options.tangents = demand.tangents && demand.textures > 0 && has_leaf_relief(params, demand);
  options.outward = has_outward_faces(params, demand);
  if ((params.leaf.crown_normals > 0 || options.outward) && !organs.organ.empty()) {
    Box box{organs.organ[0].position, organs.organ[0].position};
    for (const Organ& organ : organs.organ) {
      box.min = glm::min(box.min, organ.position);
      box.max = glm::max(box.max, organ.position);
    }
    // Below the middle, so that the normals of the lowest leaves do not point straight down.
    const glm::vec3 middle = 0.5F * (box.min + box.max), size = box.max - box.min;
    options.crown = glm::vec3(middle.x, middle.y - 0.2F * size.y, middle.z);
    options.crown_axes = 0.5F * glm::max(size, glm::vec3(0.01F * std::max({size.x, size.y, size.z, 1e-3F})));
    options.crown_share = static_cast<float>(params.leaf.crown_normals);
  }
  return options;
}

std::string level_name(const char* name, int level) {
  return level == 0 ? name : name + ("_LOD" + std::to_string(level));
}

void attach(Model& model, Node& node, MeshGroup group) {
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

/// Multiplies the colours of all vertices.
void dim(Mesh& mesh, float factor) {
  const auto parts = static_cast<std::uint32_t>(math::to_int32(256 * static_cast<double>(factor)));
  const auto dimmed = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>((value * parts + 128) / 256);
  };
  for (glm::u8vec4& color : mesh.color) color = {dimmed(color.r), dimmed(color.g), dimmed(color.b), color.a};
}

/// Far leaves have fewer shadows of each other than gain_of() assumes. Measured with the presets.
float of_shadows(const TreeLevels::Plan& plan) {
  if (plan.leaves == LeafDetail::one_card) return 0.83F;
  return plan.level >= 3 ? 0.966F : 1.0F;
}

struct CoarserLeaves {
  std::vector<Foliage> parts;
  /// Where single triangles replace both sides, the factor for their colours as gain_of(); else 0.
  float gain = 0;
};

CoarserLeaves coarser(const Leaves& leaves, TreeLevels& levels, const TreeLevels::Plan& plan,
                      const GenerateContext& context) {
  Job& job = context.job;
  const bool has_back = has_outward_faces(leaves.params, context.demand);
  const Mesh leaf = with_back(far_leaf(leaves.params, plan.leaves, plan.level, job), has_back);
  const Organs fewer = levels.foliage->keep(leaves.organs, plan.share, job);
  const FoliageOptions options = options_of(leaves, context);
  CoarserLeaves made;
  made.parts = place(fewer, leaf, options, job);
  for (Foliage& part : made.parts) {
    dim(part.mesh, dimming(plan.share));
    if (!is_single(plan.leaves) || !has_back) continue;
    part.mesh = outer_sides(part.mesh, leaf, *options.crown, job);
    const Mesh card = with_back(far_leaf(leaves.params, LeafDetail::triangle, plan.level, job), true);
    for (const Foliage& all : place(leaves.organs, card, options, job))
      made.gain = gain_of(all.mesh, part.mesh, job) * of_shadows(plan);
  }
  return made;
}

void add_merged(Model& model, const Leaves& leaves, TreeLevels& levels, const LeafMaterials& materials,
                const GenerateContext& context) {
  Node node;
  node.name = "leaves";
  node.parent = 0;
  const std::uint64_t bark = levels.bark.empty() ? 0 : levels.bark.front();
  for (int level = 0; level < context.demand.lods; ++level) {
    if (!levels.is_needed(level, bark)) continue;
    MeshGroup group{level_name("leaves", level), {}};
    std::vector<Foliage> parts;
    LeafMaterials far;
    if (level == 0) {
      parts = place(leaves.organs, leaves.leaf, options_of(leaves, context), context.job);
    } else {
      const TreeLevels::Plan plan = levels.plan(level, bark);
      CoarserLeaves made = coarser(leaves, levels, plan, context);
      const bool is_sparse = plan.leaves == LeafDetail::one_card;
      if (made.gain > 0)
        far = double_sided(model, materials, {made.gain, is_sparse, "_LOD" + std::to_string(level)});
      parts = std::move(made.parts);
    }
    const LeafMaterials& used = far.material >= 0 ? far : materials;
    for (Foliage& part : parts)
      group.primitives.push_back({std::move(part.mesh), used.material, used.variants});
    if (!group.primitives.empty()) attach(model, node, std::move(group));
  }
  if (node.mesh >= 0) model.nodes.push_back(std::move(node));
}

/// Adds one node with an instance for each leaf.
void add_shared(Model& model, const Leaves& leaves, const LeafMaterials& materials,
                const GenerateContext& context) {
  Job& job = context.job;
  FoliageOptions options = options_of(leaves, context);
  Node node;
  node.name = "leaf";
  node.parent = 0;
  for (int level = 0; level < context.demand.lods; ++level) {
    MeshGroup group{level_name("leaf", level), {}};
    group.primitives.push_back({leaf_of(leaves.params, level, job), materials.material, materials.variants});
    if (level == 0) {
      options.surfaces = std::span(&group.primitives.front().mesh, 1);
      for (FoliageInstances& instances : organ_transforms(leaves.organs, options, job))
        node.instances.transforms = std::move(instances.transforms);
    }
    attach(model, node, std::move(group));
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
  form.tilt = math::radians(cross_tilt);
  form.twig_leaves = texture::leaf_picture(texture::leaf_kind(form.shape, form.shows_twig)).count;
  Mesh mesh = leaf_mesh(form, job);
  order_for_cache(mesh, job);
  return mesh;
}

Mesh drawn_leaf(const TreeParams& params, int level, const GenerateContext& context) {
  return with_back(leaf_of(params, level, context.job), has_outward_faces(params, context.demand));
}

std::optional<FoliageShade> shade_of(const Limbs& limbs, const Organs& organs, const Mesh& leaf,
                                     const TreeParams& params, const GenerateContext& context) {
  const TreeLeaf& given = params.leaf;
  const bool is_uniform = given.tint == 0 && given.hue == 0 && given.occlusion == 0;
  if (is_uniform || context.demand.share_organs || organs.organ.empty()) return std::nullopt;
  FoliageShade::Options options;
  options.tint = static_cast<float>(given.tint);
  options.hue = static_cast<float>(given.hue);
  options.occlusion = static_cast<float>(given.occlusion);
  options.color = color_of_leaves(params);
  const float filled = has_leaf_texture(params) ? filled_card : 1.0F;
  const float sides = has_outward_faces(params, context.demand) ? 2.0F : 1.0F;
  options.leaf_area = area_of(leaf) * filled / sides;
  return FoliageShade(limbs, organs, options, context.job);
}

void fit_leaves(Organs& organs, const TreeParams& params, const Mesh& leaf, const Job& job) {
  const Box box = bounds_of(leaf.position.span());
  const float across = std::max(1e-3F, box.max.x - box.min.x);
  const TreeBuild build = build_of(params);
  const bool is_round = build == TreeBuild::cross || build == TreeBuild::bunch;
  // Fewer leaves at a distance are larger, so that the total area stays the same (section 4.9 of the paper).
  const auto size = static_cast<float>(params.leaf.size / std::sqrt(shares_at(params).leaves));
  job.check();
  for (Organ& organ : organs.organ) {
    const float width = organ.scale.x * size / across, length = organ.scale.y * size;
    organ.scale = {width, length, is_round ? width : length};
    if (build == TreeBuild::cross) organ.frame = upright(organ.frame);
    if (params.leaf.roll > 0) organ.frame = rolled(organ, params.leaf.roll);
  }
}

void add_leaves(Model& model, const Leaves& leaves, TreeLevels& levels, const GenerateContext& context) {
  if (leaves.organs.organ.empty()) return;
  const LeafMaterials materials = add_leaf_materials(model, leaves.params, context);
  if (context.demand.share_organs) {
    add_shared(model, leaves, materials, context);
  } else {
    add_merged(model, leaves, levels, materials, context);
  }
  // Bark has the same material in every season.
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      if (primitive.variant_materials.empty())
        primitive.variant_materials.assign(materials.variants.size(), primitive.material);
    }
  }
}

}  // namespace seedmesh::tree
