#include "core/generators/tree/levels.h"

#include <algorithm>
#include <cmath>

#include "core/generators/tree/leaves.h"

namespace seedmesh::tree {
namespace {

// Share of the width of a card that its texture fills.
constexpr float filled_card = 0.7F;
// A twig that is left out opens gaps in the twigs behind it, so each level has only this share fewer.
constexpr double fewer_twigs = 0.1;

}  // namespace

TreeLevels::TreeLevels(const Skeleton& skeleton, const TreeParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (context.demand.lods < 2 || skeleton.organs.organ.empty() || !has_leaves(params)) return;
  has_twigs = build_of(params) == TreeBuild::twig;
  const Mesh coarsest = leaf_of(params, most_levels - 1, job);
  const float filled = build_of(params) == TreeBuild::mesh ? 1.0F : filled_card;
  const Limbs& limbs = skeleton.limbs;
  foliage.emplace(FoliageLevels::Plant{skeleton.organs, std::span(&coarsest, 1), limbs, filled}, job);
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

double TreeLevels::leaves_at(const Detail& detail, std::uint64_t leaf_count, std::uint64_t triangles_per_leaf,
                             std::uint64_t triangles_before) const {
  const double least = has_twigs ? 1 - fewer_twigs * detail.level() : detail.organs();
  const double wanted = std::max(least, foliage->share_for(detail.loss()));
  const auto level = static_cast<std::size_t>(detail.level());
  const std::uint64_t other = level < bark.size() ? bark[level] : 0,
                      most = Detail::fewer_than(triangles_before);
  const double allowed =
      most > other ? static_cast<double>(most - other) /
                         static_cast<double>(std::max<std::uint64_t>(triangles_per_leaf * leaf_count, 1))
                   : 0;
  return std::min(wanted, std::max(least, allowed));
}

}  // namespace seedmesh::tree
