#include "core/generators/building/ground.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace seedmesh::building {
namespace {

using Point = std::array<double, 2>;
using Ring = std::vector<Point>;

constexpr std::size_t most_points = 5'000;

/// Without the last point where it repeats the first.
Ring opened(Ring ring) {
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

double doubled_area(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += (a[0] - ring[0][0]) * (b[1] - ring[0][1]) - (b[0] - ring[0][0]) * (a[1] - ring[0][1]);
  }
  return sum;
}

double side(const Point& a, const Point& b, const Point& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

bool is_between(const Point& a, const Point& b, const Point& p) {
  return std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= p[1] &&
         p[1] <= std::max(a[1], b[1]);
}

/// Do the segments have a point in common?
bool meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double p = side(a, b, c), q = side(a, b, d), r = side(c, d, a), s = side(c, d, b);
  if (((p > 0) != (q > 0)) && ((r > 0) != (s > 0)) && p != 0 && q != 0 && r != 0 && s != 0) return true;
  return (p == 0 && is_between(a, b, c)) || (q == 0 && is_between(a, b, d)) ||
         (r == 0 && is_between(c, d, a)) || (s == 0 && is_between(c, d, b));
}

bool contains(const Ring& ring, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    if (p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1])) inside = !inside;
  }
  return inside;
}

std::string crosses_itself(std::size_t point) {
  return "the edge from here meets the edge from point " + std::to_string(point) +
         " of the ring: it crosses itself";
}

std::string pointer_to(std::size_t ring) { return "/footprint/" + std::to_string(ring); }

/// The first corner whose edge runs across an earlier one; none where no two cross.
std::optional<std::pair<std::size_t, std::size_t>> crossing_of(const Ring& ring) {
  const auto runs_across = [&](std::size_t i, std::size_t k) {
    const Point &a = ring[i], &b = ring[i + 1], &c = ring[k], &d = ring[(k + 1) % ring.size()];
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
  };
  for (std::size_t i = 0; i + 2 < ring.size(); ++i) {
    for (std::size_t k = i + 2; k < ring.size(); ++k) {
      if (runs_across(i, k)) return std::pair{i, k};
    }
  }
  return std::nullopt;
}

/// A ring whose area is 0: a line, or an eight whose halves cancel.
Issue issue_of_flat(const Ring& ring, const std::string& pointer) {
  const auto crossing = ring.size() <= most_points ? crossing_of(ring) : std::nullopt;
  if (!crossing) return {pointer, "the ring has no area"};
  return {pointer + "/" + std::to_string(crossing->second), crosses_itself(crossing->first)};
}

/// The first pair of edges that meet though they are no neighbours.
void check_crossings(const std::vector<Ring>& rings, std::vector<Issue>& issues) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const Point &a = rings[r][i], &b = rings[r][(i + 1) % rings[r].size()];
      for (std::size_t s = r; s < rings.size(); ++s) {
        const std::size_t count = rings[s].size();
        for (std::size_t k = s == r ? i + 1 : 0; k < count; ++k) {
          const bool is_next = s == r && (k == i + 1 || (k + 1) % count == i);
          const Point &c = rings[s][k], &d = rings[s][(k + 1) % count];
          const bool folds = is_next && count > 2 && side(a, b, k == i + 1 ? d : c) == 0 &&
                             (k == i + 1 ? is_between(a, b, d) || is_between(c, d, a)
                                         : is_between(a, b, c) || is_between(c, d, b));
          if (is_next ? !folds : !meet(a, b, c, d)) continue;
          issues.push_back(
              {pointer_to(s) + "/" + std::to_string(k),
               s == r ? crosses_itself(i) : "the edge from here meets ring " + std::to_string(r)});
          return;
        }
      }
    }
  }
}

}  // namespace

std::vector<Issue> check_footprint(const Rings& given) {
  std::vector<Issue> issues;
  std::vector<Ring> rings;
  std::size_t points = 0;
  for (std::size_t r = 0; r < given.size(); ++r) {
    rings.push_back(opened(given[r]));
    points += given[r].size();
    for (std::size_t i = 0; i + 1 < rings[r].size(); ++i) {
      if (rings[r][i] == rings[r][i + 1])
        issues.push_back(
            {pointer_to(r) + "/" + std::to_string(i + 1), "the point repeats the one before it"});
    }
    if (rings[r].size() < 3)
      issues.push_back({pointer_to(r), "found " + std::to_string(rings[r].size()) +
                                           " different points, expected at least 3"});
    else if (std::abs(doubled_area(rings[r])) < 1e-6)
      issues.push_back(issue_of_flat(rings[r], pointer_to(r)));
  }
  if (points > most_points) {
    issues.push_back({"/footprint", "found " + std::to_string(points) + " points, expected at most " +
                                        std::to_string(most_points)});
  }
  if (!issues.empty()) return issues;
  check_crossings(rings, issues);
  for (std::size_t r = 1; r < rings.size() && issues.empty(); ++r) {
    if (!contains(rings[0], rings[r][0]))
      issues.push_back({pointer_to(r), "the hole lies outside the outer ring"});
    for (std::size_t s = 1; s < r; ++s) {
      if (contains(rings[s], rings[r][0]) || contains(rings[r], rings[s][0]))
        issues.push_back({pointer_to(r), "the hole lies inside another hole"});
    }
  }
  return issues;
}

Solid footprint_of(const Rings& given, glm::dvec3& origin, glm::dvec3& size) {
  Solid solid;
  for (std::size_t r = 0; r < given.size(); ++r) {
    Ring ring = opened(given[r]);
    // Seen from above x runs right and z towards the viewer: counter-clockwise is a negative area.
    if ((doubled_area(ring) > 0) == (r == 0)) std::ranges::reverse(ring);
    solid.loops.push_back(
        {static_cast<std::uint32_t>(solid.corners.size()), static_cast<std::uint32_t>(ring.size())});
    for (const Point& p : ring) {
      solid.corners.push_back(static_cast<std::uint32_t>(solid.points.size()));
      solid.points.emplace_back(p[0], 0, p[1]);
    }
  }
  solid.faces.push_back({0, static_cast<std::uint32_t>(given.size()), false});
  fit(solid, origin, size);
  return solid;
}

}  // namespace seedmesh::building
