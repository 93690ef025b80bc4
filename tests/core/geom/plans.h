#pragma once
/// Plans for tests.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/geom/polygon/plan.h"

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

inline double rounded_to_millimetres(double value) { return std::round(value * 1000) / 1000; }

inline void round_to_millimetres(Plan& plan) {
  for (PlanRing& ring : plan.rings) {
    for (glm::dvec2& p : ring) p = {rounded_to_millimetres(p.x), rounded_to_millimetres(p.y)};
  }
}

/// A rectangle with corners of up to 40 points, anywhere and turned, to the millimetre or exactly.
inline Plan random_rounded(Rng rng) {
  const double width = rng.uniform(5, 60), depth = rng.uniform(5, 60);
  const double radius = rng.uniform(0.1, 0.5) * std::min(width, depth);
  const std::uint32_t steps = 1 + rng.below(40);
  const glm::dvec2 middles[] = {
      {width - radius, depth - radius}, {radius, depth - radius}, {radius, radius}, {width - radius, radius}};
  PlanRing ring;
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    for (std::uint32_t i = 0; i <= steps; ++i) {
      const math::SinCos at = math::sincos(math::pi / 2 * (corner + static_cast<double>(i) / steps));
      const glm::dvec2 p = middles[corner] + radius * glm::dvec2(at.cos, at.sin);
      if (ring.empty() || glm::length(p - ring.back()) > 1e-3) ring.push_back(p);
    }
  }
  while (glm::length(ring.back() - ring.front()) < 1e-3) ring.pop_back();
  const math::SinCos turn = math::sincos(rng.uniform(0, 7));
  const glm::dvec2 shift{rng.uniform(-100, 100), rng.uniform(-100, 100)};
  for (glm::dvec2& p : ring)
    p = glm::dvec2(p.x * turn.cos - p.y * turn.sin, p.x * turn.sin + p.y * turn.cos) + shift;
  Plan plan = read_plan({ring});
  if (rng.below(2) == 0) round_to_millimetres(plan);
  return plan;
}

/// Right angles that are off by a ten-millionth to a tenth of a metre, as in footprints that were measured.
inline Plan random_near_parallel(Rng rng) {
  Plan plan = random_blocks(rng.at(1), 2 + static_cast<int>(rng.below(6)));
  const double size = rng.uniform(3, 20);
  double noise = 1;
  for (std::uint32_t i = 1 + rng.below(7); i > 0; --i) noise /= 10;
  for (PlanRing& ring : plan.rings) {
    for (glm::dvec2& p : ring) {
      const double x = rng.uniform(-noise, noise);
      p = p * size + glm::dvec2(x, rng.uniform(-noise, noise));
    }
  }
  if (rng.below(2) == 0) round_to_millimetres(plan);
  return plan;
}

/// A few points at uneven angles, some of them almost on the edge between their neighbours.
inline Plan random_uneven(Rng rng) {
  std::vector<double> angles;
  const std::uint32_t count = 3 + rng.below(12);
  for (std::uint32_t i = 0; i < count; ++i) angles.push_back(rng.uniform(0, 2 * math::pi));
  std::sort(angles.begin(), angles.end());
  PlanRing corners, ring;
  for (const double angle : angles) {
    const math::SinCos at = math::sincos(angle);
    corners.push_back(rng.uniform(1, 80) * glm::dvec2(at.cos, at.sin));
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ring.push_back(corners[i]);
    if (rng.below(4) > 0) continue;
    const glm::dvec2 along = corners[(i + 1) % corners.size()] - corners[i];
    const double share = rng.uniform(0.1, 0.9), x = rng.uniform(-0.01, 0.01);
    ring.push_back(corners[i] + along * share + glm::dvec2(x, rng.uniform(-0.01, 0.01)));
  }
  Plan plan = read_plan({ring});
  round_to_millimetres(plan);
  return plan;
}

/// Another plan with thin spikes outwards and slits inwards.
inline Plan random_spiked(Rng rng) {
  Plan plan = rng.below(2) == 0 ? random_rounded(rng.at(1))
                                : random_blocks(rng.at(1), 3 + static_cast<int>(rng.below(4)));
  PlanRing& ring = plan.rings[0];
  for (std::uint32_t i = 1 + rng.below(3); i > 0; --i) {
    const std::uint32_t at = rng.below(static_cast<std::uint32_t>(ring.size()));
    const glm::dvec2 from = ring[at], along = ring[(at + 1) % ring.size()] - from, out{along.y, -along.x};
    const double width = rng.uniform(0.001, 0.2), begin = rng.uniform(0.2, 0.8 - width);
    const double height = rng.uniform(0.1, 2) * (rng.below(4) == 0 ? -0.1 : 1);
    ring.insert(ring.begin() + at + 1,
                {from + along * begin, from + along * (begin + width / 2) + out * height,
                 from + along * (begin + width)});
  }
  return plan;
}

/// A rounded rectangle with up to three courtyards of many corners.
inline Plan random_courtyards(Rng rng) {
  Plan plan = random_rounded(rng.at(1));
  const glm::dvec2 middle = centroid_of(plan.rings[0]);
  const double size = diagonal_of(plan);
  const std::uint32_t holes = 1 + rng.below(3);
  for (std::uint32_t hole = 0; hole < holes; ++hole) {
    const glm::dvec2 center = middle + glm::dvec2((hole - 1.0) * 0.08 * size, 0);
    const double radius = rng.uniform(0.005, 0.035) * size, turn = rng.uniform(0, 7);
    const std::uint32_t corners = 3 + rng.below(12);
    PlanRing ring;
    for (std::uint32_t i = 0; i < corners; ++i) {
      const math::SinCos at = math::sincos(turn + 2 * math::pi * i / corners);
      ring.push_back(center + radius * glm::dvec2(at.cos, at.sin));
    }
    plan.rings.push_back(std::move(ring));
  }
  return read_plan(std::move(plan.rings));
}

/// Of each kind in turn.
inline Plan real_like_plan(Rng rng, std::uint64_t number) {
  switch (number % 7) {
    case 0:
      return random_rounded(rng);
    case 1:
      return random_near_parallel(rng);
    case 2:
      return random_uneven(rng);
    case 3:
      return random_spiked(rng);
    case 4:
      return random_courtyards(rng);
    case 5:
      return random_blocks(rng, 2 + static_cast<int>(number / 7 % 7));
    default:
      return random_star(rng, 3 + static_cast<std::uint32_t>(number / 7 % 20), number / 7 % 2 == 0);
  }
}

}  // namespace seedmesh
