#include "core/generators/tree/build_model.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/generators/limb_bodies/limb_bodies.h"
#include "core/generators/tree/leaves.h"
#include "core/generators/tree/levels.h"
#include "core/generators/tree/materials.h"
#include "core/generators/tree/range.h"
#include "core/generators/tree/weber_penn_shape.h"
#include "core/geom/lod/coarse_limbs.h"
#include "core/geom/lod/detail.h"
#include "core/geom/mesh/split_inward_corners.h"
#include "core/geom/plant/graft/graft.h"
#include "core/geom/plant/grow.h"
#include "core/model/build.h"
#include "core/texture/bark.h"

namespace seedmesh::tree {
namespace {

// At coarser levels, limbs below this share of the largest radius are not joined to their parent.
constexpr float thinnest_joint = 0.1F;
// Attempts to reach the number of triangles of a level.
constexpr int attempts = 4;

/// Can limbs overlap? Stems may split without an angle, and strongly curved ones may meet themselves.
bool may_overlap(const TreeParams& params) {
  if (params.model != TreeModel::weber_penn) return false;
  const auto levels = weber_penn_levels(params);
  return params.base_splits > 0 || params.branches_0 > 1 ||
         std::any_of(levels.begin(), levels.end(), [](const WeberPennLevel& level) {
           return level.seg_splits > 0 || std::abs(level.curve) + std::abs(level.curve_back) >= 300 ||
                  level.curve_v < -60;
         });
}

GraftOptions graft_options(const TreeParams& params, const Detail& detail) {
  GraftOptions options;
  const double seen = shares_at(params).sides;
  options.sides = std::max(3, math::to_int32(detail.bark_sides(sides_of(params)) * seen));
  if (has_linear_faces(params)) options.corner_exponent = 1;
  options.weld = params.weld;
  options.thinnest = static_cast<float>(params.twig_radius);
  options.wrap = has_bark_texture(params);
  if (has_generated_bark(params)) options.least_repeats = texture::least_bark_strip;
  if (params.model == TreeModel::weber_penn && params.LobeDepth > 0 && detail.level() < 2 && seen >= 1) {
    options.lobes = params.Lobes;
    options.lobe_depth = static_cast<float>(params.LobeDepth);
  }
  options.overlaps = may_overlap(params);
  if (params.model == TreeModel::proctree) options.v_scale = static_cast<float>(params.mVMultiplier);
  return options;
}

GraftOptions finest_options(const TreeParams& params, const GenerateContext& context) {
  GraftOptions options = graft_options(params, Detail(0));
  options.tangents = context.demand.tangents && context.demand.textures > 0 && has_bark_relief(params);
  return options;
}

/// What moves the tree: growth with bones, and wind.
struct Motion {
  std::optional<GrowthPlan> growth;
  std::optional<WindField> wind;
  std::span<const std::uint16_t> bones() const {
    return growth ? growth->bone.span() : std::span<const std::uint16_t>{};
  }
};

/// `bones` has an entry for each joint, or none; `wind` may be null.
Mesh bark_of(const Limbs& limbs, const GraftOptions& wanted, std::span<const std::uint16_t> bones,
             const WindField* wind, Job& job) {
  GraftOptions options = wanted;
  Array<std::uint32_t> joints(job);
  if (wind || !bones.empty()) options.joints = &joints;
  Mesh mesh = graft(limbs, options, job);
  if (!bones.empty()) {
    mesh.bone = Array<std::uint16_t>(job, mesh.position.size());
    for (std::size_t i = 0; i < joints.size(); ++i) mesh.bone[i] = bones[joints[i]];
  }
  if (wind) add_wind(mesh, joints, *wind, job);
  return mesh;
}

/// The bark of a coarser level, with fewer limbs and joints and about `wanted.triangles` triangles.
Mesh coarser_bark(const Limbs& limbs, const CoarseOptions& wanted, GraftOptions options, const Motion& motion,
                  Job& job) {
  CoarseOptions coarse = wanted;
  const float most = thickest(limbs);
  options.pointed = coarse.pointed;
  options.every_bend = true;
  Mesh mesh;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const CoarseLimbs kept = coarsen(limbs, coarse, job);
    Array<std::uint16_t> bones(job);
    if (motion.growth) {
      for (const std::uint32_t joint : kept.was) bones.push_back(motion.growth->bone[joint]);
    }
    std::optional<WindField> wind;
    if (motion.wind) wind.emplace(kept.limbs, kept.was.span(), *motion.wind, job);
    options.thinnest_joint = thinnest_joint * most;
    mesh = bark_of(kept.limbs, options, bones.span(), wind ? &*wind : nullptr, job);
    // coarsen() counts tubes; forks and collars have more triangles.
    const std::uint64_t made = mesh.elements();
    if (made <= wanted.triangles + wanted.triangles / 100) break;
    coarse.triangles = coarse.triangles * wanted.triangles / made;
  }
  split_inward_corners(mesh, job);
  return mesh;
}

void add_bark(Model& model, const Limbs& limbs, const TreeParams& params, const Motion& motion,
              TreeLevels& levels, const GenerateContext& context) {
  Job& job = context.job;
  Node node;
  node.name = "bark";
  node.parent = 0;
  const int material = add_bark_material(model, params, job);
  GraftOptions finest = finest_options(params, context);
  Array<glm::vec3> drawn(job);  // positions of the joints in the finest level
  if (context.demand.lods > 1) {
    drawn.append(limbs.position.span());
    finest.drawn = &drawn;
  }
  std::uint64_t triangles = 0, before = 0;  // of the finest level and of the previous one
  for (int level = 0; level < context.demand.lods; ++level) {
    if (!levels.is_needed(level, triangles)) continue;
    const Detail detail(level);
    Mesh mesh;
    if (level == 0) {
      mesh = bark_of(limbs, finest, motion.bones(), motion.wind ? &*motion.wind : nullptr, job);
      triangles = mesh.elements();
    } else {
      const GraftOptions options = graft_options(params, detail);
      CoarseOptions coarse;
      coarse.triangles = std::min(levels.plan(level, triangles).bark, Detail::fewer_than(before));
      coarse.sides = options.sides;
      coarse.finest_sides = finest.sides;
      coarse.pointed = true;
      coarse.shown = levels.shown.span();
      coarse.drawn = drawn.span();
      coarse.bones = motion.bones();
      mesh = coarser_bark(limbs, coarse, options, motion, job);
    }
    before = mesh.elements();
    levels.bark.push_back(before);
    if (mesh.position.empty()) continue;
    const int number = static_cast<int>(model.meshes.size());
    model.meshes.push_back({level == 0 ? "bark" : "bark_LOD" + std::to_string(level), {}});
    model.meshes.back().primitives.push_back({std::move(mesh), material, {}});
    if (node.mesh < 0) {
      node.mesh = number;
    } else {
      node.lods.push_back(number);
    }
  }
  if (node.mesh >= 0) model.nodes.push_back(std::move(node));
}

float size_of(const Limbs& limbs) {
  const Box box = bounds_of(limbs.position.span());
  return glm::length(box.max - box.min);
}

}  // namespace

int sides_of(const TreeParams& params) {
  return params.model == TreeModel::proctree ? std::max(3, params.mSegments) : params.sides;
}

GraftOptions bark_options(const TreeParams& params) { return graft_options(params, Detail(0)); }

Model build_model(Skeleton skeleton, const TreeParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Model model;
  model.name = "tree";
  add_node(model, "tree", -1);
  Motion motion;
  if (context.demand.growth) {
    if (context.demand.share_organs) {
      job.refuse({conflict_with({"animation"}), "/output/instancing",
                  "found leaves as nodes; the growth animation needs them merged"});
    }
    motion.growth = plan_growth(skeleton.limbs, {.most_bones = context.demand.most_bones}, job);
  }
  if (context.demand.wind) motion.wind.emplace(skeleton.limbs, job);
  Mesh leaf;
  if (has_leaves(params)) {
    leaf = drawn_leaf(params, 0, context);
    fit_leaves(skeleton.organs, params, leaf, job);
  }
  TreeLevels levels(skeleton, params, context);
  LeafMotion moved;
  if (motion.growth) moved.bones = motion.growth->bone.span();
  if (motion.wind) moved.wind = &*motion.wind;
  const Organs none(job);
  std::optional<FoliageShade> shade;
  if (has_leaves(params)) shade = shade_of(skeleton.limbs, skeleton.organs, leaf, params, context);
  const Leaves leaves{has_leaves(params) ? skeleton.organs : none,
                      leaf,
                      params,
                      moved,
                      size_of(skeleton.limbs),
                      shade ? &*shade : nullptr};
  add_bark(model, skeleton.limbs, params, motion, levels, context);
  if (context.demand.collision != CollisionNames::none)
    add_limb_bodies(model, limb_bodies(skeleton.limbs, BelowGround::left_out, context.job), context);
  if (!motion.wind) skeleton.limbs = Limbs(job);  // frees memory for the leaves
  add_leaves(model, leaves, levels, context);
  if (motion.growth) add_growth(model, *motion.growth);
  return model;
}

}  // namespace seedmesh::tree
