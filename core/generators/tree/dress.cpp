#include "core/generators/tree/dress.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/parallel.h"
#include "core/generators/tree/collision.h"
#include "core/generators/tree/leaves.h"
#include "core/generators/tree/levels.h"
#include "core/generators/tree/looks.h"
#include "core/generators/tree/range.h"
#include "core/generators/tree/weber_penn_shape.h"
#include "core/geom/coarse_limbs.h"
#include "core/geom/detail.h"
#include "core/geom/graft.h"
#include "core/geom/grow.h"
#include "core/geom/outward.h"

namespace seedmesh::tree {
namespace {

// Of the thickest limb: thinner ones do not grow together with their parent at the coarser levels.
constexpr float thinnest_joint = 0.1F;
// At a level of as many triangles as it may have.
constexpr int attempts = 4;

/// Stems that split without an angle go on as one, and those that turn right round meet themselves.
bool may_overlap(const TreeParams& params) {
  if (params.model != TreeModel::weber_penn) return false;
  const auto levels = weber_penn_levels(params);
  return params.base_splits > 0 || std::any_of(levels.begin(), levels.end(), [](const WeberPennLevel& level) {
           return level.seg_splits > 0 || std::abs(level.curve) + std::abs(level.curve_back) >= 300 ||
                  level.curve_v < -60;
         });
}

GraftOptions graft_options(const TreeParams& params, const Detail& detail) {
  GraftOptions options;
  const double seen = shares_at(params).sides;
  options.sides = std::max(3, math::to_int32(detail.bark_sides(sides_of(params)) * seen));
  options.weld = params.weld;
  options.thinnest = static_cast<float>(params.twig_radius);
  options.wrap = has_bark_picture(params);
  if (params.model == TreeModel::weber_penn && params.LobeDepth > 0 && detail.level() < 2 && seen >= 1) {
    options.lobes = params.Lobes;
    options.lobe_depth = static_cast<float>(params.LobeDepth);
  }
  options.overlaps = may_overlap(params);
  if (params.model == TreeModel::proctree) options.v_scale = static_cast<float>(params.mVMultiplier);
  return options;
}

GraftOptions finest_options(const TreeParams& params, const Job& job) {
  GraftOptions options = graft_options(params, Detail(0));
  options.tangents = job.demand().tangents && job.demand().textures > 0 && has_bark_relief(params);
  return options;
}

/// What moves the tree: bones that grow, wind.
struct Motion {
  std::optional<GrowthPlan> growth;
  std::optional<WindField> wind;
  std::span<const std::uint16_t> bones() const {
    return growth ? growth->bone.span() : std::span<const std::uint16_t>{};
  }
};

/// `bones` of each joint, or empty; `wind` may be null.
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

/// The bark of a level: of fewer limbs and joints, about as many triangles as it may have.
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
    // Forks and collars have more triangles than the tubes that were counted.
    const std::uint64_t made = mesh.elements();
    if (made <= wanted.triangles + wanted.triangles / 100) break;
    coarse.triangles = coarse.triangles * wanted.triangles / made;
  }
  turn_outward(mesh, job);
  return mesh;
}

/// The finest level, where it was made before.
struct Made {
  std::optional<Mesh> bark;
  std::optional<std::vector<Foliage>> leaves;
};

// Bark has at most so many triangles a joint, and no triangle takes so many bytes while it is made.
constexpr std::uint64_t most_triangles_a_joint = 256, most_bytes_a_triangle = 64;

// Of leaves that are made beside the bark, which then has its memory at the same time.
constexpr std::uint64_t most_side_by_side = 1'000'000;

/// Are they so few that no limit can be met? Where one is, what is made first decides about the message.
bool is_modest(const Skeleton& skeleton, std::uint64_t triangles_a_leaf, const Job& job) {
  if (triangles_a_leaf * skeleton.organs.organ.size() > most_side_by_side) return false;
  const std::uint64_t triangles =
      most_triangles_a_joint * skeleton.limbs.size() + triangles_a_leaf * skeleton.organs.organ.size();
  const std::uint64_t left = job.limits().triangles - job.spent(Resource::triangles);
  return triangles < left && most_bytes_a_triangle * triangles < job.limits().memory_bytes / 2;
}

/// Leaves beside the bark, where that is of use.
Made make_both(const Skeleton& skeleton, const TreeParams& params, const Motion& motion, const Leaves& leaves,
               Job& job) {
  Made made;
  const bool has_levels = job.demand().lods > 1;  // which ask the finest where it draws the joints
  if (!has_threads(job) || has_levels || job.demand().share_organs || leaves.organs.organ.empty())
    return made;
  if (!is_modest(skeleton, leaves.leaf.elements(), job)) return made;
  OrganPlacing placing = finest_leaves(leaves, job);
  Beside beside(
      job, [&] { return placing.prepare(); }, [&](std::size_t piece) { placing.place(piece); });
  made.bark = bark_of(skeleton.limbs, finest_options(params, job), motion.bones(),
                      motion.wind ? &*motion.wind : nullptr, job);
  beside.finish();
  made.leaves = placing.take();
  return made;
}

void add_bark(Model& model, const Limbs& limbs, const TreeParams& params, const Motion& motion,
              TreeLevels& levels, std::optional<Mesh> finest_mesh, Job& job) {
  Node node;
  node.name = "bark";
  node.parent = 0;
  const int material = add_bark_look(model, params, job);
  GraftOptions finest = finest_options(params, job);
  Array<glm::vec3> drawn(job);  // where the finest level draws the joints
  if (job.demand().lods > 1) {
    drawn.append(limbs.position.span());
    finest.drawn = &drawn;
  }
  std::uint64_t triangles = 0, before = 0;  // of the finest level, and of the one before
  for (int level = 0; level < job.demand().lods; ++level) {
    const Detail detail(level);
    Mesh mesh;
    if (level == 0) {
      mesh = finest_mesh ? *std::move(finest_mesh)
                         : bark_of(limbs, finest, motion.bones(), motion.wind ? &*motion.wind : nullptr, job);
      triangles = mesh.elements();
    } else {
      const GraftOptions options = graft_options(params, detail);
      CoarseOptions coarse;
      coarse.triangles = std::min(detail.bark(triangles, levels.seen), Detail::fewer_than(before));
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

Model dress(Skeleton skeleton, const TreeParams& params, Job& job) {
  Model model;
  model.name = "tree";
  Node root;
  root.name = "tree";
  model.nodes.push_back(std::move(root));
  Motion motion;
  if (job.demand().growth) {
    if (job.demand().share_organs)
      Job::reject(
          {"/output/instancing", "found leaves as nodes; the growth animation needs them merged", 0, 0});
    motion.growth = plan_growth(skeleton.limbs, {.most_bones = job.demand().most_bones}, job);
  }
  if (job.demand().wind) motion.wind.emplace(skeleton.limbs, job);
  Mesh leaf;
  if (has_leaves(params)) {
    leaf = leaf_of(params, 0, job);
    fit_leaves(skeleton.organs, params, leaf, job);
  }
  TreeLevels levels(skeleton, params, job);
  LeafMotion moved;
  if (motion.growth) moved.bones = motion.growth->bone.span();
  if (motion.wind) moved.wind = &*motion.wind;
  const Organs none(job);
  const Leaves leaves{has_leaves(params) ? skeleton.organs : none, leaf, params, moved,
                      size_of(skeleton.limbs)};
  Made made = make_both(skeleton, params, motion, leaves, job);
  add_bark(model, skeleton.limbs, params, motion, levels, std::move(made.bark), job);
  add_collision(model, skeleton.limbs, job);
  if (!motion.wind) skeleton.limbs = Limbs(job);  // its memory goes back before the leaves need theirs
  add_leaves(model, leaves, levels, std::move(made.leaves), job);
  if (motion.growth) add_growth(model, *motion.growth);
  return model;
}

}  // namespace seedmesh::tree
