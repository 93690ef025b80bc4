#include "core/generators/city/kerb_sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seedmesh::city {

using glm::dvec2;

dvec2 unit_of(const StreetGraph& graph, std::uint32_t half) {
  const dvec2 along =
      in_cm(graph.nodes[end_of(graph.edges, half)]) - in_cm(graph.nodes[start_of(graph.edges, half)]);
  return along / std::sqrt(along.x * along.x + along.y * along.y);
}

std::vector<double> corner_reaches(const StreetGraph& graph, const std::vector<KerbSide>& sides) {
  std::vector<double> reaches(sides.size(), 0);
  for (std::uint32_t half = 0; half < sides.size(); ++half) {
    if (!graph.is_street(half / 2)) continue;
    const dvec2 start = in_cm(graph.nodes[start_of(graph.edges, half)]), d = unit_of(graph, half);
    const KerbSide &left = sides[half], &right = sides[half ^ 1U];
    double reach = 0;
    const auto add = [&](const KerbSide& side) {
      for (const auto* corner : {&side.corner, &side.outer_corner}) {
        for (const CmPoint& p : *corner) reach = std::max(reach, glm::dot(in_cm(p) - start, d));
      }
    };
    if (left.is_laid_out) add(left);
    if (right.is_laid_out) add(sides[right.after]);
    reaches[half] = reach / 100;
  }
  return reaches;
}

CmRing junction_ring(const StreetGraph& graph, const std::vector<KerbSide>& sides, std::uint32_t node) {
  const auto around = graph.arms.of(node);
  CmRing ring;
  std::size_t first = 0;  // behind the outside
  while (first < around.size() && sides[around[first] ^ 1U].is_laid_out) ++first;
  const bool is_open = graph.is_border[node] != 0 || first < around.size();
  for (std::size_t n = 0; n < around.size(); ++n) {
    const std::uint32_t arm = around[(first + n) % around.size()];
    const KerbSide &left = sides[arm], &right = sides[arm ^ 1U];
    if (right.is_laid_out) {
      append_new(ring, right.to);
      append_new(ring, right.cut_to);
    }
    if (!left.is_laid_out) continue;
    append_new(ring, left.cut_from);
    for (std::size_t i = left.corner.size(); i-- > 0;) append_new(ring, left.corner[i]);
  }
  if (is_open) append_new(ring, graph.nodes[node]);
  close(ring);
  return ring;
}

}  // namespace seedmesh::city
