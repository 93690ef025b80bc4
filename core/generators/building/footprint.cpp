#include "core/generators/building/footprint.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/geom/polygon/segment_pairs.h"

namespace seedmesh::building {
namespace {

using Point = std::array<double, 2>;
using Ring = std::vector<Point>;

constexpr std::size_t most_points = 5'000;

/// The ring without a last point that repeats the first.
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

/// Whether the segments have a common point.
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

std::vector<Segment> edges_of(const std::vector<Ring>& rings) {
  std::vector<Segment> edges;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      edges.push_back({{a[0], a[1]}, {b[0], b[1]}});
    }
  }
  return edges;
}

/// The first pair of edges that cross, by their first corners; none if no edges cross.
std::optional<std::pair<std::size_t, std::size_t>> crossing_of(const Ring& ring, const Job* job) {
  std::optional<std::pair<std::size_t, std::size_t>> found;
  each_near_pair(edges_of({ring}), 0, job, [&](std::size_t i, std::size_t k) {
    if (k == i + 1) return true;
    const Point &a = ring[i], &b = ring[i + 1], &c = ring[k], &d = ring[(k + 1) % ring.size()];
    if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) found = {i, k};
    return !found;
  });
  return found;
}

/// The issue of a ring whose area is 0: a line, or a figure of eight.
Issue issue_of_flat(const Ring& ring, const std::string& pointer, const Job* job) {
  const auto crossing = crossing_of(ring, job);
  if (!crossing) return {IssueKind::invalid_value, pointer, "the ring has no area"};
  return {IssueKind::invalid_value, pointer + "/" + std::to_string(crossing->second),
          crosses_itself(crossing->first)};
}

/// Adds an issue for the first pair of edges that meet without being neighbours.
void check_crossings(const std::vector<Ring>& rings, const Job* job, std::vector<Issue>& issues) {
  std::vector<std::pair<std::size_t, std::size_t>> number;  // of an edge: its ring and its first corner
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) number.emplace_back(r, i);
  }
  each_near_pair(edges_of(rings), 0, job, [&](std::size_t first, std::size_t second) {
    const std::size_t r = number[first].first, i = number[first].second;
    const std::size_t s = number[second].first, k = number[second].second, count = rings[s].size();
    const Point &a = rings[r][i], &b = rings[r][(i + 1) % rings[r].size()];
    const Point &c = rings[s][k], &d = rings[s][(k + 1) % count];
    const bool is_next = s == r && (k == i + 1 || (k + 1) % count == i);
    const bool folds = is_next && count > 2 && side(a, b, k == i + 1 ? d : c) == 0 &&
                       (k == i + 1 ? is_between(a, b, d) || is_between(c, d, a)
                                   : is_between(a, b, c) || is_between(c, d, b));
    if (is_next ? !folds : !meet(a, b, c, d)) return true;
    issues.emplace_back(IssueKind::invalid_value, pointer_to(s) + "/" + std::to_string(k),
                        s == r ? crosses_itself(i) : "the edge from here meets ring " + std::to_string(r));
    return false;
  });
}

}  // namespace

std::vector<Issue> check_footprint(const Rings& given, const Job* job) {
  std::size_t points = 0;
  for (const Ring& ring : given) points += ring.size();
  if (points > most_points) {
    return {limit_issue({Resource::points, most_points, points},
                        "found " + std::to_string(points) + " points, expected at most " +
                            std::to_string(most_points) + "; leave out points that hardly change the outline",
                        "/footprint")};
  }
  std::vector<Issue> issues;
  std::vector<Ring> rings;
  for (std::size_t r = 0; r < given.size(); ++r) {
    rings.push_back(opened(given[r]));
    for (std::size_t i = 0; i + 1 < rings[r].size(); ++i) {
      if (rings[r][i] == rings[r][i + 1]) {
        issues.emplace_back(IssueKind::invalid_value, pointer_to(r) + "/" + std::to_string(i + 1),
                            "the point repeats the point before it");
      }
    }
    if (rings[r].size() < 3) {
      issues.emplace_back(
          IssueKind::out_of_range, pointer_to(r),
          "found " + std::to_string(rings[r].size()) + " different points, expected at least 3");
    } else if (std::abs(doubled_area(rings[r])) < 1e-6) {
      issues.push_back(issue_of_flat(rings[r], pointer_to(r), job));
    }
  }
  if (!issues.empty()) return issues;
  check_crossings(rings, job, issues);
  for (std::size_t r = 1; r < rings.size() && issues.empty(); ++r) {
    if (!contains(rings[0], rings[r][0]))
      issues.emplace_back(IssueKind::invalid_value, pointer_to(r), "the hole lies outside the outer ring");
    for (std::size_t s = 1; s < r; ++s) {
      if (contains(rings[s], rings[r][0]) || contains(rings[r], rings[s][0]))
        issues.emplace_back(IssueKind::invalid_value, pointer_to(r), "the hole lies inside another hole");
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
