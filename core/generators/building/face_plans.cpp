#include "core/generators/building/face_plans.h"

#include <algorithm>

namespace seedmesh::building {

std::vector<Plan> plans_of(const Solid& solid, const glm::dvec3& size, const FacePlane& plane) {
  std::vector<Plan> plans;
  for (const Face& face : solid.faces) {
    std::vector<PlanRing> rings;
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      PlanRing& ring = rings.emplace_back();
      const Loop& loop = solid.loops[l];
      for (std::uint32_t i = 0; i < loop.count; ++i)
        ring.push_back(plane.flat(solid.points[solid.corners[loop.first + i]] * size));
    }
    plans.push_back(read_plan(std::move(rings)));
  }
  return plans;
}

void remove_repeated_points(Plan& plan) {
  constexpr double same_point = 2e-6;  // share of the diagonal
  if (plan.rings.empty() || plan.rings[0].empty()) return;
  glm::dvec2 low = plan.rings[0][0], high = low;
  for (const glm::dvec2& p : plan.rings[0]) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const double reach = same_point * glm::length(high - low);
  const auto is_near = [reach](const glm::dvec2& a, const glm::dvec2& b) {
    return glm::length(a - b) <= reach;
  };
  for (PlanRing& ring : plan.rings) {
    ring.erase(std::unique(ring.begin(), ring.end(), is_near), ring.end());
    while (ring.size() > 1 && is_near(ring.back(), ring.front())) ring.pop_back();
  }
  if (plan.rings[0].size() < 3) plan.rings.clear();
  std::erase_if(plan.rings, [](const PlanRing& ring) { return ring.size() < 3; });
}

void add_plan(Solid& solid, const Plan& plan, const FacePlane& plane, std::uint8_t tag) {
  Face face{static_cast<std::uint32_t>(solid.loops.size()), static_cast<std::uint32_t>(plan.rings.size()),
            false, tag};
  for (const PlanRing& ring : plan.rings) {
    solid.loops.push_back(
        {static_cast<std::uint32_t>(solid.corners.size()), static_cast<std::uint32_t>(ring.size())});
    for (const glm::dvec2& p : ring) {
      solid.corners.push_back(static_cast<std::uint32_t>(solid.points.size()));
      solid.points.push_back(plane.raised(p, 0));
    }
  }
  solid.faces.push_back(face);
}

}  // namespace seedmesh::building
