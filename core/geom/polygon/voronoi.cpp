// de Berg, Cheong, van Kreveld and Overmars, "Computational geometry", 2008, section 7.1: a cell is the intersection of
// the half planes of its bisectors; each one is cut off the ring by the rule of Sutherland and Hodgman (1974).
#include "core/geom/polygon/voronoi.h"

#include <glm/geometric.hpp>

namespace seedmesh {
namespace {

using glm::dvec2;
using Ring = std::vector<dvec2>;

/// Keeps the part of a convex ring that is nearer to `p` than to `other`.
void keep_nearer(Ring& ring, Ring& kept, const dvec2& p, const dvec2& other) {
  const dvec2 normal = other - p;
  const double limit = glm::dot(normal, (p + other) / 2.0);
  kept.clear();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double here = glm::dot(normal, a) - limit, next = glm::dot(normal, b) - limit;
    if (here <= 0) kept.push_back(a);
    if ((here < 0 && next > 0) || (here > 0 && next < 0))
      kept.push_back(a + (b - a) * (here / (here - next)));
  }
  ring.swap(kept);
}

}  // namespace

std::vector<Ring> voronoi_cells(std::span<const dvec2> points, const dvec2& low, const dvec2& high,
                                const Job& job) {
  std::vector<Ring> cells(points.size());
  Ring kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    job.check();
    Ring& cell = cells[i];
    cell = {low, {high.x, low.y}, high, {low.x, high.y}};
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (k != i) keep_nearer(cell, kept, points[i], points[k]);
    }
    if (cell.size() < 3) cell.clear();
  }
  return cells;
}

}  // namespace seedmesh
