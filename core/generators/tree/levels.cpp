#include "core/generators/tree/levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/generators/tree/leaves.h"
#include "core/generators/tree/materials.h"

namespace seedmesh::tree {
namespace {

// Share of the width of a card that its texture fills.
constexpr float filled_card = 0.7F;
// Shares of the triangles of the finest level.
constexpr std::array<double, most_levels> level_shares{1, 0.4, 0.15, 0.05, 0.03};
// Share of the triangles of a level that bark may have where leaves need the others. Far away, twigs are too thin to
// be seen.
constexpr std::array<double, most_levels> bark_shares{1, 0.3, 0.3, 0.2, 0.2};
// A build of leaves is used if at least this share of them can remain. Otherwise leaves get fewer triangles.
constexpr double fullest = 0.7;
// The brightest linear colour of leaves that can become brighter by the factors of single triangles.
constexpr float most_to_brighten = 0.65F;
// The triangles of a level by those of its plan. Forks add some to the bark, but few limbs may need less.
constexpr double most_of_plan = 1.1, least_of_plan = 0.7;
// The least share of the leaves that remains.
constexpr double least_leaves = 0.2;

/// Single triangles get a brighter colour in place of the light on backs, up to twice as bright. White has none.
bool is_too_bright(const TreeParams& params) {
  const glm::vec3 color = color_of_leaves(params);
  return std::max({color.x, color.y, color.z}) > most_to_brighten;
}

}  // namespace

TreeLevels::TreeLevels(const Skeleton& skeleton, const TreeParams& params, const GenerateContext& context) {
  Job& job = context.job;
  coarsest_ = context.demand.lods - 1;
  if (context.demand.first_fit && !context.demand.share_organs) budget_ = context.demand.most_triangles;
  if (context.demand.lods < 2 || skeleton.organs.organ.empty() || !has_leaves(params)) return;
  count_ = skeleton.organs.organ.size();
  of_leaf_ = drawn_leaf(params, 0, context).elements();
  for (int level = 0; level < context.demand.lods; ++level)
    bent_.push_back(drawn_leaf(params, level, context).elements());
  has_far_leaves_ = has_far_leaves(params, context);
  const std::uint64_t sides = has_outward_faces(params, context.demand) ? 2 : 1;
  if (has_far_leaves_) {
    for (const LeafDetail detail :
         {LeafDetail::square, LeafDetail::triangle, LeafDetail::single, LeafDetail::one_card}) {
      if (is_single(detail) && sides == 2 && is_too_bright(params)) break;
      const std::uint64_t triangles =
          far_leaf(params, detail, 1, job).elements() * (is_single(detail) ? 1 : sides);
      if (triangles < (builds_.empty() ? of_leaf_ + 1 : builds_.back().triangles))
        builds_.push_back({detail, triangles});
    }
  }
  const Mesh ranked =
      has_far_leaves_ ? far_leaf(params, LeafDetail::square, 1, job) : leaf_of(params, most_levels - 1, job);
  const float filled = build_of(params) == TreeBuild::mesh ? 1.0F : filled_card;
  const Limbs& limbs = skeleton.limbs;
  foliage.emplace(FoliageLevels::Plant{skeleton.organs, std::span(&ranked, 1), limbs, filled}, job);
  shown = foliage->shown(limbs, job);
  double all = 0, free = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    const glm::vec3 step = limbs.position[i] - limbs.position[parent];
    const auto area =
        static_cast<double>(std::sqrt(glm::dot(step, step)) * (limbs.base_radius[i] + limbs.radius[i]));
    all += area;
    free += area * static_cast<double>(shown[i]);
  }
  seen = all > 0 ? free / all : 1;
}

TreeLevels::Plan TreeLevels::plan(int level, std::uint64_t finest) const {
  const Detail detail(level);
  Plan plan;
  plan.level = level;
  plan.bark = detail.bark(finest, seen);
  if (!foliage) return plan;
  const auto count = static_cast<double>(count_);
  const double bark_share = bark_shares[static_cast<std::size_t>(level)];
  const double all = level_shares[static_cast<std::size_t>(level)] *
                     (static_cast<double>(finest) + count * static_cast<double>(of_leaf_));
  const double for_leaves = (1 - bark_share) * all;
  if (!has_far_leaves_) {
    const auto triangles = static_cast<double>(bent_[static_cast<std::size_t>(level)]);
    plan.share = std::clamp(for_leaves / (count * triangles), detail.organs(), 1.0);
    return plan;
  }
  double used = 0;
  for (const Build& build : builds_) {
    const double most = count * static_cast<double>(build.triangles);
    plan.leaves = build.detail;
    plan.share = std::clamp(for_leaves / most, least_leaves, 1.0);
    used = plan.share * most;
    if (for_leaves >= fullest * most) break;
  }
  plan.bark = std::min(plan.bark, static_cast<std::uint64_t>(std::max(all - used, bark_share * all)));
  return plan;
}

double TreeLevels::planned(int level, std::uint64_t finest) const {
  const auto count = static_cast<double>(count_);
  if (level == 0) return static_cast<double>(finest) + count * static_cast<double>(of_leaf_);
  const Plan own = plan(level, finest);
  if (!foliage) return static_cast<double>(own.bark);
  std::uint64_t of_leaf = bent_[static_cast<std::size_t>(level)];
  for (const Build& build : builds_) {
    if (has_far_leaves_ && build.detail == own.leaves) of_leaf = build.triangles;
  }
  return static_cast<double>(own.bark) + own.share * count * static_cast<double>(of_leaf);
}

bool TreeLevels::is_needed(int level, std::uint64_t finest) const {
  if (budget_ == 0 || level == 0) return true;
  const auto budget = static_cast<double>(budget_);
  for (int finer = 0; finer < level; ++finer) {
    if (planned(finer, finest) * most_of_plan <= budget) return false;
  }
  return level == coarsest_ || planned(level, finest) * least_of_plan <= budget;
}

}  // namespace seedmesh::tree
