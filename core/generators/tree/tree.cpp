#include "core/generators/tree/tree.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/tree/age.h"
#include "core/generators/tree/dress.h"
#include "core/generators/tree/estimate.h"
#include "core/generators/tree/idle.h"
#include "core/generators/tree/looks.h"
#include "core/generators/tree/proctree.h"
#include "core/generators/tree/range.h"
#include "core/generators/tree/roots.h"
#include "core/generators/tree/sculpt.h"
#include "core/generators/tree/weber_penn.h"
#include "core/generators/tree/weber_penn_shape.h"

namespace seedmesh::tree {
namespace {

/// The request's seed; where it is 0, that of a saved proctree file.
std::uint64_t seed_of(const TreeParams& params, std::uint64_t seed) {
  if (params.model != TreeModel::proctree || seed != 0) return seed;
  return static_cast<std::uint64_t>(params.mSeed);
}

/// How much wider than its own radius the trunk is at the ground.
double foot_flare(const TreeParams& params) {
  if (params.model != TreeModel::weber_penn) return 1 + params.trunk_flare;
  return flared_trunk(params, 0);
}

/// What of a tree is looked at.
struct Wanted {
  double density = 1;       ///< share of the leaves
  double least_radius = 0;  ///< limbs that begin thinner need not be there, as far as that is known early
  bool every_foot = false;  ///< a joint wherever a limb stands, also where the bark needs none
  std::size_t most = 0;     ///< throws SkeletonWriter::Enough beyond so many joints; 0: none are too many
};

/// For a model: limbs that are left out of the bark are of use only to what moves, ages or thins out a tree.
Wanted wanted_for_model(const TreeParams& params, const Job& job) {
  const Demand& demand = job.demand();
  const RangeShares shares = shares_at(params);
  const bool is_plain = demand.lods < 2 && !demand.wind && !demand.growth && !params.age &&
                        demand.collision == CollisionNames::none && shares.branches >= 1 && shares.twigs >= 1;
  Wanted wanted;
  wanted.density = drawn_leaves(params);
  if (is_plain) wanted.least_radius = params.twig_radius;
  return wanted;
}

Skeleton grow(const TreeParams& params, const Wanted& wanted, Job& job) {
  job.progress("derive", 0);
  Skeleton skeleton(job);
  SkeletonWriter writer(skeleton, job, wanted.density);
  if (wanted.most > 0) writer.end_after(wanted.most, leaves_a_joint * wanted.most);
  writer.leave_out_below(wanted.least_radius);
  if (wanted.every_foot) writer.mark_every_foot();
  const Chances chances(params.seeds, seed_of(params, job.seed()));
  switch (params.model) {
    case TreeModel::weber_penn:
      grow_weber_penn(params, chances, writer);
      break;
    case TreeModel::proctree:
      grow_proctree(params, chances, writer);
      break;
    case TreeModel::sculpt:
      grow_sculpt(params, chances, writer);
      break;
  }
  if (params.age) make_young(skeleton, *params.age / params.mature_age, job);
  // As large as the trunk of this age wants them.
  grow_roots(params.roots, writer.radius(0) / foot_flare(params), chances, writer);
  writer.finish();
  if (job.demand().growth) skeleton.limbs.birth = births_of(skeleton.limbs, job);
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
    if (limbs.starts_limb[i] || limbs.parent[parent] == Limbs::none) {
      ++level.count;
      level.radius += static_cast<double>(limbs.base_radius[i]);
    }
  }
  return levels;
}

Json vector(const glm::vec3& v) { return Json::array({v.x + 0.0F, v.y + 0.0F, v.z + 0.0F}); }

}  // namespace

std::vector<Issue> check(const TreeParams& params, const Limits&) {
  std::vector<Issue> issues;
  if (params.mSegments % 2 != 0) {
    issues.push_back({"/mSegments",
                      "found " + std::to_string(params.mSegments) + ", expected an even number of corners", 0,
                      0});
  }
  check_images(params, issues);
  return issues;
}

Result<Model> generate(const TreeParams& params, Job& job) {
  Skeleton skeleton = grow(params, wanted_for_model(params, job), job);
  degrade(skeleton, params, job);
  job.progress("mesh", 0);
  Model model = dress(std::move(skeleton), params, job);
  model.warnings = idle_parameters(params);
  // Leaves that share one mesh have no place for weights of their own.
  if (job.demand().wind && job.demand().share_organs && has_leaves(params))
    model.warnings.push_back(
        {"/output/wind", "leaves that share a mesh have no weights; only bark moves", 0, 0});
  return model;
}

Result<Json> derive(const TreeParams& params, Job& job) {
  Wanted wanted;
  wanted.every_foot = true;
  const Skeleton skeleton = grow(params, wanted, job);
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
  Json warnings = Json::array();
  for (const Warning& each : idle_parameters(params))
    warnings.push_back({{"pointer", "/parameters" + each.pointer}, {"message", each.message}});
  return Json{{"limbs", count},
              {"levels", std::move(levels)},
              {"leaves", skeleton.organs.organ.size()},
              {"height", box.max.y + 0.0F},
              {"bounds", {{"min", vector(box.min)}, {"max", vector(box.max)}}},
              {"warnings", std::move(warnings)}};
}

Result<Appraisal> appraise(const TreeParams& params, const Job& job) {
  Appraisal appraisal;
  appraisal.warnings = idle_parameters(params);
  // A job of its own: what is looked at here is not spent.
  job.check();
  Job::Options options;
  options.limits = job.limits();
  Job own(job.seed(), options);
  own.set_demand({.textures = job.demand().textures});
  try {
    Wanted wanted = wanted_for_model(params, own);
    wanted.most = most_appraised;
    Skeleton skeleton = grow(params, wanted, own);
    degrade(skeleton, params, own);
    appraisal.estimate = estimate_of(std::move(skeleton), params, own);
  } catch (const SkeletonWriter::Enough&) {
    appraisal.estimate = std::nullopt;  // more than is grown in an instant
  }
  return appraisal;
}

Json vocabulary() { return Json::object(); }

}  // namespace seedmesh::tree
