#include "core/generators/tree/levels.h"

#include "core/base/math.h"
#include "core/generators/tree/leaves.h"

namespace seedmesh::tree {
namespace {

// Of the width of a card, what its picture fills.
constexpr float filled_card = 0.7F;

}  // namespace

TreeLevels::TreeLevels(const Skeleton& skeleton, const TreeParams& params, Job& job) {
  const int levels = job.demand().lods;
  const std::size_t count = skeleton.organs.organ.size();
  if (levels < 2 || count == 0 || !has_leaves(params)) return;
  for (int level = 0; level < levels; ++level) {
    const double stay = job.demand().share_organs ? 1 : Detail(level).organs();
    leaves[level] = static_cast<std::uint64_t>(
        math::to_int64(stay * static_cast<double>(count * leaf_of(params, level, job).elements())));
  }
  const Mesh coarsest = leaf_of(params, most_levels - 1, job);
  const float filled = build_of(params) == TreeBuild::mesh ? 1.0F : filled_card;
  foliage.emplace(
      FoliageLevels::Plant{skeleton.organs, std::span(&coarsest, 1), skeleton.limbs, filled}, job);
  shown = foliage->shown(skeleton.limbs, job);
}

std::uint64_t TreeLevels::bark(int level, std::uint64_t finest) const {
  return Detail(level).bark({finest, leaves[0]}, leaves[level]);
}

}  // namespace seedmesh::tree
