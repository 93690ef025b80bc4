#pragma once
/// Plans for tests.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/geom/plan.h"

namespace seedmesh {

inline Plan plan_of(PlanRing outer, std::vector<PlanRing> holes = {}) {
  std::vector<PlanRing> rings{std::move(outer)};
  for (PlanRing& hole : holes) rings.push_back(std::move(hole));
  return read_plan(std::move(rings));
}

inline Plan rectangle(double width, double depth) {
  return plan_of({{0, 0}, {width, 0}, {width, depth}, {0, depth}});
}

/// A star with courtyards, or a plan of right angles on a grid with many events at one time.
inline Plan random_star(Rng rng, std::uint32_t corners, bool has_hole) {
  PlanRing outer, hole;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const math::SinCos at = math::sincos(2 * math::pi * i / corners);
    const double radius = rng.uniform(4, 10);
    outer.emplace_back(radius * at.cos, radius * at.sin);
  }
  const std::uint32_t inner = 3 + rng.below(5);
  const double turn = rng.uniform(0, 1);
  for (std::uint32_t i = 0; i < inner; ++i) {
    const math::SinCos at = math::sincos(2 * math::pi * (i + turn) / inner);
    const double radius = rng.uniform(0.4, 1.8);
    hole.emplace_back(radius * at.cos, radius * at.sin);
  }
  return has_hole && corners > 5 ? plan_of(outer, {hole}) : plan_of(outer);
}

/// The outline of cells of a grid that hang together, holes included: parallel edges and simultaneous events.
inline Plan random_blocks(Rng rng, int side) {
  std::vector<std::vector<bool>> is_full(static_cast<std::size_t>(side) + 2,
                                         std::vector<bool>(static_cast<std::size_t>(side) + 2, false));
  const auto at = [&](int x, int y) {
    return is_full[static_cast<std::size_t>(y + 1)][static_cast<std::size_t>(x + 1)];
  };
  int x = side / 2, y = side / 2;
  for (int step = 0; step < side * side; ++step) {
    is_full[static_cast<std::size_t>(y + 1)][static_cast<std::size_t>(x + 1)] = true;
    const std::uint32_t way = rng.below(4);
    x = std::min(std::max(x + (way == 0 ? 1 : way == 1 ? -1 : 0), 0), side - 1);
    y = std::min(std::max(y + (way == 2 ? 1 : way == 3 ? -1 : 0), 0), side - 1);
  }
  // No two cells may meet in a corner alone.
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (int v = -1; v < side; ++v) {
      for (int u = -1; u < side; ++u) {
        if (at(u, v) == at(u + 1, v + 1) && at(u + 1, v) == at(u, v + 1) && at(u, v) != at(u + 1, v)) {
          for (const auto& [p, q] : {std::pair{u, v}, {u + 1, v}, {u, v + 1}, {u + 1, v + 1}}) {
            if (p >= 0 && q >= 0 && p < side && q < side)
              is_full[static_cast<std::size_t>(q + 1)][static_cast<std::size_t>(p + 1)] = true;
          }
          is_changed = true;
        }
      }
    }
  }
  std::vector<PlanRing> rings;
  std::vector<std::pair<std::pair<int, int>, std::pair<int, int>>> sides;
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      if (!at(u, v)) continue;
      if (!at(u, v - 1)) sides.push_back({{u, v}, {u + 1, v}});
      if (!at(u + 1, v)) sides.push_back({{u + 1, v}, {u + 1, v + 1}});
      if (!at(u, v + 1)) sides.push_back({{u + 1, v + 1}, {u, v + 1}});
      if (!at(u - 1, v)) sides.push_back({{u, v + 1}, {u, v}});
    }
  }
  std::vector<bool> is_used(sides.size(), false);
  for (std::size_t first = 0; first < sides.size(); ++first) {
    if (is_used[first]) continue;
    PlanRing ring;
    for (std::size_t i = first; !is_used[i];) {
      is_used[i] = true;
      ring.emplace_back(sides[i].first.first, sides[i].first.second);
      for (std::size_t k = 0; k < sides.size(); ++k) {
        if (sides[k].first == sides[i].second && !is_used[k]) {
          i = k;
          break;
        }
      }
    }
    // Points in the middle of straight edges stay at every third place.
    PlanRing kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[(i + ring.size() - 1) % ring.size()], b = ring[(i + 1) % ring.size()];
      const bool is_straight = (a.x == b.x) || (a.y == b.y);
      if (!is_straight || rng.below(3) == 0) kept.push_back(ring[i]);
    }
    if (signed_area(kept) > 0) {
      rings.insert(rings.begin(), kept);
    } else {
      rings.push_back(kept);
    }
  }
  return read_plan(rings);
}

}  // namespace seedmesh
