#pragma once
/// Pairs of segments that may be near each other.
#include <algorithm>
#include <array>

#include "core/base/job.h"
#include "core/geom/polygon/cell_grid.h"

namespace seedmesh {

struct Segment {
  glm::dvec2 from, to;
};

/// Calls visit(i, k) for all pairs i < k of segments with points at most `reach` apart, and perhaps for others,
/// until it returns false. i rises, and k rises for each i. Checks stop and deadline if `job` is not null.
/// Cost: n log n and the number of pairs that share a cell of a grid with n cells.
template <class Visit>
void each_near_pair(std::span<const Segment> segments, double reach, const Job* job, const Visit& visit) {
  constexpr std::size_t looks_a_check = 50'000;
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
  std::vector<std::size_t> mark(segments.size(), segments.size());
  std::vector<std::uint32_t> others;
  std::size_t looks = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    others.clear();
    each_cell(i, [&](std::size_t cell) {
      grid.each(cell, [&](std::uint32_t k) {
        ++looks;
        if (k <= i || mark[k] == i) return;
        mark[k] = i;
        others.push_back(k);
      });
    });
    std::sort(others.begin(), others.end());
    looks += 8 * others.size() + 8;
    for (const std::uint32_t k : others) {
      if (!visit(i, static_cast<std::size_t>(k))) return;
    }
    if (looks < looks_a_check) continue;
    looks = 0;
    if (job) job->check();
  }
}

}  // namespace seedmesh
