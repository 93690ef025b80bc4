#include "core/generators/tree/tree.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/tree/age.h"
#include "core/generators/tree/build_model.h"
#include "core/generators/tree/estimate.h"
#include "core/generators/tree/ez_tree.h"
#include "core/generators/tree/grown.h"
#include "core/generators/tree/materials.h"
#include "core/generators/tree/proctree.h"
#include "core/generators/tree/range.h"
#include "core/generators/tree/roots.h"
#include "core/generators/tree/sculpt.h"
#include "core/generators/tree/weber_penn.h"
#include "core/generators/tree/weber_penn_shape.h"
#include "core/generators/unused.h"
#include "core/schema/warning_list.h"
#include "generated/params/tree_unused.h"

namespace seedmesh::tree {
namespace {

/// The seed of the request, or of a saved proctree file if the former is 0 or the sequence is that of proctree.
std::uint64_t seed_of(const TreeParams& params, std::uint64_t seed) {
  if (params.model != TreeModel::proctree || (seed != 0 && params.sequence == TreeSequence::keyed))
    return seed;
  return static_cast<std::uint64_t>(params.mSeed);
}

/// Factor for the radius of the trunk at the ground.
double foot_flare(const TreeParams& params) {
  if (params.model != TreeModel::weber_penn) return 1 + params.trunk_flare;
  return flared_trunk(params, 0);
}

/// The parts of a skeleton that are needed.
struct Wanted {
  double density = 1;       ///< share of the leaves
  double least_radius = 0;  ///< limbs that begin thinner may be left out
  bool every_foot = false;  ///< a joint wherever a limb begins, even where the bark needs none
  std::size_t most = 0;     ///< joints beyond which the attempt is abandoned; 0: no limit
};

/// For a model. Limbs without bark are needed only for levels of detail, wind, growth, age and collision.
Wanted wanted_for_model(const TreeParams& params, const GenerateContext& context) {
  const Demand& demand = context.demand;
  const RangeShares shares = shares_at(params);
  const bool is_young = params.age && params.model != TreeModel::grown;
  const bool is_plain = demand.lods < 2 && !demand.wind && !demand.growth && !is_young &&
                        demand.collision == CollisionNames::none && shares.branches >= 1 && shares.twigs >= 1;
  Wanted wanted;
  wanted.density = drawn_leaves(params);
  if (is_plain) wanted.least_radius = params.twig_radius;
  return wanted;
}

Skeleton grow(const TreeParams& params, const Wanted& wanted, const GenerateContext& context) {
  Job& job = context.job;
  job.progress("derive", 0);
  Skeleton skeleton(job);
  SkeletonWriter writer(skeleton, job, wanted.density);
  if (wanted.most > 0) writer.end_after(wanted.most, leaves_a_joint * wanted.most);
  writer.leave_out_below(wanted.least_radius);
  if (wanted.every_foot) writer.mark_every_foot();
  const RandomStreams random(params.seeds, seed_of(params, job.seed()));
  switch (params.model) {
    case TreeModel::weber_penn:
      grow_weber_penn(params, random, writer);
      break;
    case TreeModel::proctree:
      grow_proctree(params, random, writer);
      break;
    case TreeModel::sculpt:
      grow_sculpt(params, random, writer);
      break;
    case TreeModel::ez_tree:
      grow_ez_tree(params, random, job.seed(), writer);
      break;
    case TreeModel::grown:
      grow_grown(params, random, writer);
      break;
  }
  const bool has_own_age = params.model == TreeModel::grown;
  if (params.age && !has_own_age) make_young(skeleton, *params.age / params.mature_age, job);
  // Roots have the size that fits the trunk at this age.
  grow_roots(params.roots, writer.radius(0) / foot_flare(params), random, writer);
  writer.finish();
  if (context.demand.growth) skeleton.limbs.birth = births_of(skeleton.limbs, job);
  return skeleton;
}

struct LevelFigures {
  std::uint64_t count = 0;
  double length = 0, radius = 0;
};

std::vector<LevelFigures> figures_of(const Limbs& limbs) {
  std::vector<LevelFigures> levels;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    const std::size_t order = limbs.order[i];
    if (order >= levels.size()) levels.resize(order + 1);
    LevelFigures& level = levels[order];
    level.length += static_cast<double>(glm::distance(limbs.position[i], limbs.position[parent]));
    // In the model ez_tree, a limb of the next level may continue its parent.
    if (limbs.starts_limb[i] || limbs.parent[parent] == Limbs::none ||
        limbs.order[i] != limbs.order[parent]) {
      ++level.count;
      level.radius += static_cast<double>(limbs.base_radius[i]);
    }
  }
  return levels;
}

/// Warns of the entries of the list of levels of a model that have no effect.
void warn_of_levels(const std::string& model, int levels, std::size_t given, std::vector<Warning>& warnings) {
  for (std::size_t i = static_cast<std::size_t>(levels); i < given; ++i) {
    warnings.push_back(
        {"/" + model + "/level/" + std::to_string(i),
         "This level has no effect unless `" + model + ".levels` is greater than " + std::to_string(i) + ".",
         0, 0});
  }
}

Json vector(const glm::vec3& v) { return Json::array({v.x + 0.0F, v.y + 0.0F, v.z + 0.0F}); }

}  // namespace

std::vector<Issue> check(const TreeParams& params, const Limits&) {
  std::vector<Issue> issues;
  if (params.mSegments % 2 != 0) {
    issues.emplace_back(IssueKind::invalid_value, "/mSegments",
                        "found " + std::to_string(params.mSegments) + ", expected an even number of corners");
  }
  check_images(params, issues);
  return issues;
}

std::vector<Warning> warnings_of(const TreeParams& params) {
  std::vector<Warning> warnings = warnings_of(unused_parameters(params));
  // How many entries of the list are used is more than x-applies-when can say.
  if (params.model == TreeModel::sculpt)
    warn_of_levels("sculpt", params.sculpt.levels, params.sculpt.level.size(), warnings);
  if (params.model == TreeModel::grown)
    warn_of_levels("grown", params.grown.levels, params.grown.level.size(), warnings);
  return warnings;
}

/// The warnings for a request with this seed.
static std::vector<Warning> warnings_with_seed(const TreeParams& params, std::uint64_t seed) {
  std::vector<Warning> warnings = warnings_of(params);
  if (params.model == TreeModel::proctree && params.mSeed != TreeParams{}.mSeed &&
      seed_of(params, seed) == seed && seed != static_cast<std::uint64_t>(params.mSeed)) {
    warnings.push_back({"/mSeed",
                        "`mSeed` has no effect unless the seed of the request is 0 or `sequence` is original",
                        0, 0});
  }
  return warnings;
}

Result<Model> generate(const TreeParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Skeleton skeleton = grow(params, wanted_for_model(params, context), context);
  degrade(skeleton, params, job);
  job.progress("mesh", 0);
  Model model = build_model(std::move(skeleton), params, context);
  model.warnings = warnings_with_seed(params, job.seed());
  if (context.demand.wind && context.demand.share_organs && has_leaves(params)) {
    model.warnings.push_back(
        {"/output/wind", "Leaves that share a mesh have no weights, so only bark moves.", 0, 0});
  }
  return model;
}

Result<Json> derive(const TreeParams& params, const GenerateContext& context) {
  Wanted wanted;
  wanted.every_foot = true;
  const Skeleton skeleton = grow(params, wanted, context);
  const Limbs& limbs = skeleton.limbs;
  Json levels = Json::array();
  std::uint64_t count = 0;
  for (const LevelFigures& level : figures_of(limbs)) {
    const double share = level.count ? 1.0 / static_cast<double>(level.count) : 0;
    levels.push_back(
        {{"count", level.count}, {"length", level.length * share}, {"radius", level.radius * share}});
    count += level.count;
  }
  const Box box = bounds_of(limbs.position.span());
  return Json{{"limbs", count},
              {"levels", std::move(levels)},
              {"leaves", skeleton.organs.organ.size()},
              {"height", box.max.y + 0.0F},
              {"bounds", {{"min", vector(box.min)}, {"max", vector(box.max)}}},
              {"warnings", warning_list(warnings_with_seed(params, context.job.seed()))}};
}

Result<Appraisal> appraise(const TreeParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Appraisal appraisal;
  appraisal.warnings = warnings_with_seed(params, job.seed());
  Job own = job.for_estimate();
  const GenerateContext sketch{own,
                               {.two_sided_leaves = context.demand.two_sided_leaves,
                                .wind = context.demand.wind,
                                .textures = context.demand.textures,
                                .tangents = context.demand.tangents},
                               context.generators};
  const bool is_small = attempt([&] {
    Wanted wanted = wanted_for_model(params, sketch);
    wanted.most = most_appraised;
    Skeleton skeleton = grow(params, wanted, sketch);
    degrade(skeleton, params, own);
    appraisal.estimate = estimate_of(std::move(skeleton), params, sketch);
  });
  if (!is_small) appraisal.estimate = std::nullopt;  // it takes longer than an estimate may
  return appraisal;
}

Json vocabulary() { return Json::object(); }

}  // namespace seedmesh::tree
