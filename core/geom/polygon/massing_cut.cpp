// Triangulated plans that are cut by lines; see massing_cut.h.
#include "core/geom/polygon/massing_cut.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

namespace seedmesh {
namespace {

using glm::dvec2;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Triangle = std::array<std::uint32_t, 3>;

// Points nearer to a line than this share of the diagonal lie on it.
constexpr double on_line = 1e-6;

}  // namespace

CutPlan::CutPlan(const Plan& plan, const Job& job) : slack_(on_line * diagonal_of(plan)) {
  for (const PlanRing& ring : plan.rings) point_.insert(point_.end(), ring.begin(), ring.end());
  const std::vector<std::uint32_t> corners = triangulate(plan, ThinTriangles::keep, &job);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    triangle_.push_back({corners[i], corners[i + 1], corners[i + 2]});
}

void CutPlan::cut(const PlanLine& line, const Job& job) {
  job.check();
  std::vector<double> side(point_.size());
  for (std::size_t i = 0; i < point_.size(); ++i) {
    const double distance = glm::dot(line.normal, point_[i]) - line.offset;
    side[i] = std::abs(distance) <= slack_ ? 0 : distance;
  }
  std::map<Edge, std::uint32_t> crossing;
  const auto point_between = [&](std::uint32_t a, std::uint32_t b) {
    const Edge edge = std::minmax(a, b);
    const auto [at, is_new] = crossing.emplace(edge, static_cast<std::uint32_t>(point_.size()));
    if (is_new) {
      const double share = side[edge.first] / (side[edge.first] - side[edge.second]);
      point_.push_back(point_[edge.first] + (point_[edge.second] - point_[edge.first]) * share);
    }
    return at->second;
  };
  std::vector<Triangle> made;
  made.reserve(triangle_.size());
  for (const Triangle& t : triangle_) {
    const double s0 = side[t[0]], s1 = side[t[1]], s2 = side[t[2]];
    if (std::max({s0, s1, s2}) <= 0 || std::min({s0, s1, s2}) >= 0) {
      made.push_back(t);
      continue;
    }
    // The corner `a` lies on the line, or alone on its side of it.
    std::size_t first = 0;
    if (s1 == 0 || (s0 != 0 && s2 != 0 && (s1 > 0) != (s0 > 0) && (s1 > 0) != (s2 > 0))) first = 1;
    if (s2 == 0 || (s0 != 0 && s1 != 0 && (s2 > 0) != (s0 > 0) && (s2 > 0) != (s1 > 0))) first = 2;
    const std::uint32_t a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    if (side[a] == 0) {
      const std::uint32_t m = point_between(b, c);
      made.push_back({a, b, m});
      made.push_back({a, m, c});
      continue;
    }
    const std::uint32_t m = point_between(a, b), n = point_between(a, c);
    made.push_back({a, m, n});
    made.push_back({m, b, c});
    made.push_back({m, c, n});
  }
  triangle_ = std::move(made);
}

std::vector<std::uint32_t> CutPlan::next_on_border() const {
  std::vector<Edge> edges;
  edges.reserve(3 * triangle_.size());
  for (const Triangle& t : triangle_) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint32_t> next(point_.size());
  for (std::uint32_t i = 0; i < next.size(); ++i) next[i] = i;
  for (const Edge& edge : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), Edge{edge.second, edge.first}))
      next[edge.first] = edge.second;
  }
  return next;
}

}  // namespace seedmesh
