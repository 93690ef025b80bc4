#include "core/generators/tree/range.h"

#include <algorithm>

#include "core/generators/tree/materials.h"
#include "core/geom/lod/detail.h"

namespace seedmesh::tree {
namespace {

// Metres: the distance to which all twigs are made; the distance over which stems disappear; that at which
// leaves do.
constexpr double twigs_whole = 50, stems_by = 600;
constexpr double leaves_gone = 200, spring_leaves_gone = 100;
// The paper draws 13,312 leaves of a near aspen, and 1,664 points for a distant one.
constexpr double least_leaves = 1.0 / 8;
constexpr double least_sides = 1.0 / 6;

bool is_drawn_limb(std::uint64_t key, double share) { return is_drawn(mix(key ^ 0x4A9E), share); }

}  // namespace

bool has_linear_faces(const TreeParams& params) {
  return params.model == TreeModel::sculpt && params.sculpt.faces == TreeFaces::linear;
}

RangeShares shares_at(const TreeParams& params) {
  const double range = params.range;
  const bool is_linear = has_linear_faces(params);
  const double stems = std::clamp((is_linear ? 1 : 1.5) - range / stems_by, 0.0, 1.0);
  const double gone = params.season == TreeSeason::spring ? spring_leaves_gone : leaves_gone;
  RangeShares shares;
  shares.sides = std::max(least_sides, stems);
  shares.branches = is_linear ? 1 : stems;
  shares.twigs = is_linear ? 1 : std::clamp(2 - range / twigs_whole, 0.0, 1.0);
  shares.leaves = std::clamp(4.0 / 3 - range / (0.75 * gone), least_leaves, 1.0);
  return shares;
}

double drawn_leaves(const TreeParams& params) {
  return has_leaves(params) ? params.leaf.density * shares_at(params).leaves : 0;
}

void degrade(Skeleton& skeleton, const TreeParams& params, Job& job) {
  const RangeShares shares = shares_at(params);
  if (shares.branches >= 1 && shares.twigs >= 1) return;
  const Limbs& limbs = skeleton.limbs;
  Array<std::uint8_t> stays(job, limbs.size(), std::uint8_t{1});
  // For each joint, the nearest one toward the root that stays.
  Array<std::uint32_t> stands_for(job, limbs.size());
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    if (parent != Limbs::none) {
      const bool begins = limbs.starts_limb[i] && limbs.order[i] > 0;
      const double share = limbs.order[i] > 1 ? shares.twigs : shares.branches;
      stays[i] = stays[parent] && (!begins || is_drawn_limb(limbs.key[i], share)) ? 1 : 0;
    }
    stands_for[i] = stays[i] ? static_cast<std::uint32_t>(i) : stands_for[parent];
  }
  KeptLimbs kept = keep(limbs, stays, job);
  for (Organ& organ : skeleton.organs.organ) {
    if (organ.limb_joint != Limbs::none) organ.limb_joint = kept.new_index[stands_for[organ.limb_joint]];
  }
  skeleton.limbs = std::move(kept.limbs);
}

}  // namespace seedmesh::tree
