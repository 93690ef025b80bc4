#include "core/geom/plant/graft/junction_plan.h"

#include <cmath>

namespace seedmesh {
namespace {

// A side limb with at least this share of its parent's radius is thick.
constexpr float thick_share = 0.5F;
// The length of a side limb, in radii, that decides about its junction.
constexpr float length_read = 16;

struct Candidate {
  std::size_t point;
  ChildLimb child;
  bool is_thick;
};

}  // namespace

ChildLimb read_child(const GraftInput& in, std::uint32_t limb) {
  const Limbs& limbs = in.limbs;
  ChildLimb child;
  child.limb = limb;
  std::uint32_t joint = in.chains.head[limb];
  glm::vec3 from = limbs.position[limbs.parent[joint]];
  child.radius = limbs.base_radius[joint];
  float last_length = 0, end = 0;
  for (; joint != Limbs::none; joint = in.chains.next[joint]) {
    const glm::vec3 step = limbs.position[joint] - from;
    const float length = std::sqrt(glm::dot(step, step));
    if (length <= in.scale.shortest) continue;
    if (child.length == 0) child.along = step * (1 / length);
    child.length += length;
    last_length = length;
    end = std::max(limbs.radius[joint], 2 * in.scale.thinnest);
    from = limbs.position[joint];
    if (child.length > length_read * child.radius) break;
  }
  child.tip = child.length - (joint == Limbs::none ? tip_length(end, last_length) : 0);
  return child;
}

void plan_junctions(const GraftInput& in, const LimbAxis& axis, LoopAngles& angles, RingPlan& plan) {
  const float least =
      std::max({least_opened_radius * in.scale.thinnest, in.options.thinnest, in.options.thinnest_joint});
  std::vector<Candidate> candidates;
  for (std::size_t point = 1; point + 1 < axis.point.size(); ++point) {
    if (axis.at[point] <= plan.start) continue;
    for (std::uint32_t limb = in.first_child[axis.joint[point]]; limb != Limbs::none;
         limb = in.next_sibling[limb]) {
      if (in.join[limb] != JoinMode::full) continue;
      ChildLimb child = read_child(in, limb);
      if (child.length == 0 || child.radius < least) continue;
      child.sides = corners_by_table(in.rings, in.options, child.radius);
      child.angles = &angles;
      candidates.push_back({point, child, child.radius > thick_share * axis.radius[point]});
    }
  }
  for (const bool thick : {true, false}) {
    for (const Candidate& candidate : candidates) {
      if (candidate.is_thick == thick) add_junction(plan, axis, candidate.point, candidate.child);
    }
  }
}

}  // namespace seedmesh
