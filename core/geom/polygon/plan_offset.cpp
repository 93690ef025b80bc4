// Plans with moved edges; see plan.h.
#include <algorithm>
#include <cmath>

#include "core/geom/polygon/straight_skeleton.h"

namespace seedmesh {
namespace {

using glm::dvec2;

struct Loop {
  PlanRing ring;
  std::vector<std::uint32_t> source;
};

/// Groups outer rings with the holes inside them.
std::vector<DerivedPlan> nest(std::vector<Loop> loops) {
  std::vector<DerivedPlan> plans;
  for (Loop& loop : loops) {
    if (signed_area(loop.ring) > 0) plans.push_back({{{std::move(loop.ring)}}, std::move(loop.source)});
  }
  for (Loop& loop : loops) {
    if (loop.ring.empty()) continue;
    DerivedPlan* owner = nullptr;
    for (DerivedPlan& plan : plans) {
      // Of nested outer rings, the smallest that contains the hole.
      if (!contains(Plan{{plan.plan.rings[0]}}, loop.ring[0])) continue;
      if (!owner || signed_area(plan.plan.rings[0]) < signed_area(owner->plan.rings[0])) owner = &plan;
    }
    if (!owner) continue;
    owner->plan.rings.push_back(std::move(loop.ring));
    owner->source.insert(owner->source.end(), loop.source.begin(), loop.source.end());
  }
  return plans;
}

DerivedPlan itself(const Plan& plan) {
  DerivedPlan same{plan, {}};
  for (std::uint32_t i = 0; i < edge_count(plan); ++i) same.source.push_back(i);
  return same;
}

bool is_none_positive(std::span<const double> distances) {
  return std::none_of(distances.begin(), distances.end(), [](double d) { return d > 0; });
}

PlanRing ring_of(const StraightSkeleton& skeleton, const std::vector<std::uint32_t>& nodes) {
  PlanRing ring;
  for (const std::uint32_t node : nodes) ring.emplace_back(skeleton.node[node]);
  return ring;
}

}  // namespace

Setback setback(const Plan& plan, std::span<const double> distances, const Job& job) {
  Setback result;
  if (is_none_positive(distances)) {
    result.remainder.push_back(itself(plan));
    return result;
  }
  const StraightSkeleton skeleton = straight_skeleton(plan, {distances, 1}, job);
  if (!skeleton.is_sound) {
    result.remainder.push_back(itself(plan));
    return result;
  }
  std::vector<Loop> loops;
  for (const SkeletonFront& front : skeleton.fronts)
    loops.push_back({ring_of(skeleton, front.node), front.edge});
  result.remainder = nest(std::move(loops));
  for (const SkeletonFace& face : skeleton.faces) {
    if (face.is_step || !(distances[face.edge] > 0)) continue;
    PlanStrip strip{face.edge, {{ring_of(skeleton, face.outline)}}};
    for (const auto& hole : face.holes) strip.plan.rings.push_back(ring_of(skeleton, hole));
    result.strips.push_back(std::move(strip));
  }
  return result;
}

std::vector<DerivedPlan> outset(const Plan& plan, std::span<const double> distances, const Job& job) {
  if (is_none_positive(distances)) return {itself(plan)};
  // Reversed rings: what moves inwards now moves outwards.
  Plan turned;
  std::vector<std::uint32_t> source;
  std::vector<double> speed;
  std::uint32_t first = 0;
  for (const PlanRing& ring : plan.rings) {
    const auto count = static_cast<std::uint32_t>(ring.size());
    turned.rings.emplace_back(ring.rbegin(), ring.rend());
    for (std::uint32_t i = 0; i < count; ++i) {
      source.push_back(first + (2 * count - 2 - i) % count);
      speed.push_back(distances[source.back()]);
    }
    first += count;
  }
  const StraightSkeleton skeleton = straight_skeleton(turned, {speed, 1}, job);
  if (!skeleton.is_sound) return {itself(plan)};
  std::vector<Loop> loops;
  for (const SkeletonFront& front : skeleton.fronts) {
    Loop loop{ring_of(skeleton, front.node), {}};
    std::reverse(loop.ring.begin(), loop.ring.end());
    const std::size_t count = front.edge.size();
    for (std::size_t i = 0; i < count; ++i)
      loop.source.push_back(source[front.edge[(2 * count - 2 - i) % count]]);
    loops.push_back(std::move(loop));
  }
  return nest(std::move(loops));
}

std::vector<DerivedPlan> offset(const Plan& plan, double distance, const Job& job) {
  const std::vector<double> distances(edge_count(plan), std::abs(distance));
  return distance < 0 ? setback(plan, distances, job).remainder : outset(plan, distances, job);
}

}  // namespace seedmesh
