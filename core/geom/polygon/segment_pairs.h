#pragma once
/// Pairs of segments that may be near each other.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/job.h"
#include "core/geom/polygon/cell_grid.h"

namespace seedmesh {

struct Segment {
  glm::dvec2 from, to;
};

/// Whether all of another segment lies farther than `reach` to one side of the line through a segment.
inline bool is_beside(const Segment& segment, const Segment& other, double reach) {
  const glm::dvec2 along = segment.to - segment.from;
  const double most = reach * std::sqrt(along.x * along.x + along.y * along.y);
  const auto side_of = [&](const glm::dvec2& p) {
    return along.x * (p.y - segment.from.y) - along.y * (p.x - segment.from.x);
  };
  const double one = side_of(other.from), two = side_of(other.to);
  return std::min(one, two) > most || std::max(one, two) < -most;
}

/// Calls visit(i, k) for all pairs i < k of segments with points at most `reach` apart, and perhaps for others,
/// until it returns false. i rises, and k rises for each i. Checks stop and deadline if `job` is not null.
/// Cost: n log n and the number of pairs that share a cell of a grid with n cells.
template <class Visit>
void each_near_pair(std::span<const Segment> segments, double reach, const Job* job, const Visit& visit) {
  constexpr std::size_t check_interval = 50'000;
  if (segments.empty()) return;
  glm::dvec2 low = segments[0].from, high = low;
  for (const Segment& each : segments) {
    low = glm::min(low, glm::min(each.from, each.to));
    high = glm::max(high, glm::max(each.from, each.to));
  }
  CellGrid grid;
  grid.reset(low, high, segments.size(), 2 * reach);
  const auto each_cell = [&](std::size_t i, const auto& act) {
    grid.each_cell(std::array{segments[i].from, segments[i].to}, reach, act);
  };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    each_cell(i, [&](std::size_t cell) { grid.add(cell, static_cast<std::uint32_t>(i)); });
    if (job && i % 1024 == 0) job->check();
  }
  // The reach with the rounding of positions.
  const glm::dvec2 size = glm::max(glm::abs(low), glm::abs(high)) + (high - low);
  const double far = reach + 1e-12 * (size.x + size.y);
  std::vector<std::size_t> mark(segments.size(), segments.size());
  std::vector<std::uint32_t> others;
  std::size_t steps = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    others.clear();
    each_cell(i, [&](std::size_t cell) {
      grid.each(cell, [&](std::uint32_t k) {
        ++steps;
        if (k <= i || mark[k] == i) return;
        mark[k] = i;
        ++steps;
        if (!is_beside(segments[i], segments[k], far) && !is_beside(segments[k], segments[i], far))
          others.push_back(k);
      });
    });
    std::sort(others.begin(), others.end());
    steps += 8 * others.size() + 8;
    for (const std::uint32_t k : others) {
      if (!visit(i, static_cast<std::size_t>(k))) return;
    }
    if (steps < check_interval) continue;
    steps = 0;
    if (job) job->check();
  }
}

}  // namespace seedmesh
