#include "core/import/map_crossings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geom/polygon/orientation.h"

namespace seedmesh {
namespace {

using glm::dvec2;

double rounded(double metres) { return std::floor(metres * 1000 + 0.5) / 1000; }

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Whether a point on the line through a and b lies between them.
bool lies_between(const dvec2& a, const dvec2& b, const dvec2& p) { return glm::dot(p - a, p - b) < 0; }

struct Edge {
  dvec2 a{0}, b{0};
  std::vector<dvec2> points;  ///< between the ends
};

void cut(Edge& first, Edge& second) {
  const int c = orientation(first.a, first.b, second.a), d = orientation(first.a, first.b, second.b),
            a = orientation(second.a, second.b, first.a), b = orientation(second.a, second.b, first.b);
  if (c == 0 && lies_between(first.a, first.b, second.a)) first.points.push_back(second.a);
  if (d == 0 && lies_between(first.a, first.b, second.b)) first.points.push_back(second.b);
  if (a == 0 && lies_between(second.a, second.b, first.a)) second.points.push_back(first.a);
  if (b == 0 && lies_between(second.a, second.b, first.b)) second.points.push_back(first.b);
  if (c * d >= 0 || a * b >= 0) return;
  const dvec2 along = first.b - first.a, other = second.b - second.a;
  const double t = cross(second.a - first.a, other) / cross(along, other);
  const dvec2 p = first.a + along * std::clamp(t, 0.0, 1.0);
  const dvec2 q(rounded(p.x), rounded(p.y));
  first.points.push_back(q);
  second.points.push_back(q);
}

bool boxes_meet(const Edge& first, const Edge& second) {
  return std::min(first.a.x, first.b.x) <= std::max(second.a.x, second.b.x) &&
         std::min(second.a.x, second.b.x) <= std::max(first.a.x, first.b.x) &&
         std::min(first.a.y, first.b.y) <= std::max(second.a.y, second.b.y) &&
         std::min(second.a.y, second.b.y) <= std::max(first.a.y, first.b.y);
}

}  // namespace

PlanRing with_crossings(const PlanRing& ring, const Job* job) {
  std::vector<Edge> edges;
  edges.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()], {}});
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (job) job->check();
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (boxes_meet(edges[i], edges[k])) cut(edges[i], edges[k]);
    }
  }
  PlanRing made;
  for (Edge& edge : edges) {
    const auto nearer = [&](const dvec2& p, const dvec2& q) {
      return glm::dot(p - edge.a, edge.b - edge.a) < glm::dot(q - edge.a, edge.b - edge.a);
    };
    std::stable_sort(edge.points.begin(), edge.points.end(), nearer);
    made.push_back(edge.a);
    for (const dvec2& p : edge.points) {
      if (p != made.back() && p != edge.b) made.push_back(p);
    }
  }
  return made;
}

}  // namespace seedmesh
