// Faces of a planar graph; see planar_graph.h.
#include <algorithm>

#include "core/base/disjoint_sets.h"
#include "core/geom/polygon/planar_graph.h"

namespace seedmesh {
namespace {

/// By half-edge: the next one around the face to its left. It is the arm at the end that follows the way back
/// in clockwise order.
std::vector<std::uint32_t> next_half_edges(std::span<const CmPoint> nodes, std::span<const PlanarEdge> edges,
                                           const PlanarArms& arms) {
  std::vector<std::uint32_t> next(edges.size() * 2, PlanarFaces::none);
  for (std::uint32_t node = 0; node < nodes.size(); ++node) {
    const auto around = arms.of(node);
    for (std::size_t i = 0; i < around.size(); ++i)
      next[around[i] ^ 1U] = around[(i + around.size() - 1) % around.size()];
  }
  return next;
}

/// Whether `p` lies inside the loop, by the edges that a ray to the east crosses.
bool contains(const PlanarFaces& faces, const PlanarFaces::Loop& loop, std::span<const CmPoint> nodes,
              std::span<const PlanarEdge> edges, const CmPoint& p) {
  bool odd = false;
  for (const std::uint32_t half : faces.of(loop)) {
    const CmPoint &a = nodes[start_of(edges, half)], &b = nodes[end_of(edges, half)];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    const std::int64_t side = a.y < b.y ? cross(a, b, p) : cross(b, a, p);
    if (side > 0) odd = !odd;
  }
  return odd;
}

struct LoopBox {
  CmPoint low{greatest_cm, greatest_cm}, high{-greatest_cm, -greatest_cm};
  bool contains(const CmPoint& p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
  }
};

LoopBox box_of(const PlanarFaces& faces, const PlanarFaces::Loop& loop, std::span<const CmPoint> nodes,
               std::span<const PlanarEdge> edges) {
  LoopBox box;
  for (const std::uint32_t half : faces.of(loop)) {
    const CmPoint& p = nodes[start_of(edges, half)];
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

/// Connected nodes as sets.
DisjointSets components_of(std::size_t nodes, std::span<const PlanarEdge> edges) {
  DisjointSets sets(nodes);
  for (const PlanarEdge& edge : edges) {
    if (!edge.is_removed()) sets.join(edge.from, edge.to);
  }
  return sets;
}

/// Puts the outer walk of each component into the smallest face around it. A point of the component's own
/// outline is inside no loop of the component itself, apart from those that pass through the point.
void nest(PlanarFaces& faces, std::span<const CmPoint> nodes, std::span<const PlanarEdge> edges,
          const Job& job) {
  DisjointSets components = components_of(nodes.size(), edges);
  std::vector<LoopBox> boxes;
  for (const PlanarFaces::Loop& loop : faces.loops) boxes.push_back(box_of(faces, loop, nodes, edges));
  const auto component_of = [&](const PlanarFaces::Loop& loop) {
    return components.of(start_of(edges, faces.half_edges[loop.first]));
  };
  for (std::uint32_t i = 0; i < faces.loops.size(); ++i) {
    PlanarFaces::Loop& loop = faces.loops[i];
    if (loop.doubled_area > 0) continue;
    job.check();
    const CmPoint& p = nodes[start_of(edges, faces.half_edges[loop.first])];
    std::uint32_t owner = PlanarFaces::none;
    for (std::uint32_t k = 0; k < faces.loops.size(); ++k) {
      const PlanarFaces::Loop& other = faces.loops[k];
      if (other.doubled_area <= 0 || !boxes[k].contains(p) || component_of(other) == component_of(loop))
        continue;
      if (!contains(faces, other, nodes, edges, p)) continue;
      if (owner == PlanarFaces::none || other.doubled_area < faces.loops[owner].doubled_area) owner = k;
    }
    if (owner == PlanarFaces::none) continue;
    loop.face = faces.loops[owner].face;
    faces.faces[loop.face].holes.push_back(i);
  }
}

}  // namespace

PlanarArms arms_of(std::span<const CmPoint> nodes, std::span<const PlanarEdge> edges) {
  PlanarArms arms;
  arms.first.assign(nodes.size() + 1, 0);
  for (const PlanarEdge& edge : edges) {
    if (edge.is_removed()) continue;
    ++arms.first[edge.from + 1];
    ++arms.first[edge.to + 1];
  }
  for (std::size_t i = 1; i < arms.first.size(); ++i) arms.first[i] += arms.first[i - 1];
  arms.half_edges.resize(arms.first.back());
  std::vector<std::uint32_t> at(arms.first.begin(), arms.first.end() - 1);
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    if (edges[e].is_removed()) continue;
    arms.half_edges[at[edges[e].from]++] = 2 * e;
    arms.half_edges[at[edges[e].to]++] = 2 * e + 1;
  }
  for (std::uint32_t node = 0; node < nodes.size(); ++node) {
    std::sort(arms.half_edges.begin() + arms.first[node], arms.half_edges.begin() + arms.first[node + 1],
              [&](std::uint32_t i, std::uint32_t k) {
                const int order =
                    compare_angles(nodes[node], nodes[end_of(edges, i)], nodes[end_of(edges, k)]);
                return order != 0 ? order < 0 : i < k;
              });
  }
  return arms;
}

PlanarFaces faces_of(std::span<const CmPoint> nodes, std::span<const PlanarEdge> edges, const Job& job) {
  const PlanarArms arms = arms_of(nodes, edges);
  const std::vector<std::uint32_t> next = next_half_edges(nodes, edges, arms);
  PlanarFaces faces;
  std::vector<std::uint8_t> is_seen(next.size(), 0);
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (start % 4096 == 0) job.check();
    if (is_seen[start] != 0 || next[start] == PlanarFaces::none) continue;
    PlanarFaces::Loop loop;
    loop.first = static_cast<std::uint32_t>(faces.half_edges.size());
    const CmPoint& origin = nodes[start_of(edges, start)];
    for (std::uint32_t half = start; is_seen[half] == 0; half = next[half]) {
      is_seen[half] = 1;
      faces.half_edges.push_back(half);
      loop.doubled_area += cross(origin, nodes[start_of(edges, half)], nodes[end_of(edges, half)]);
    }
    loop.count = static_cast<std::uint32_t>(faces.half_edges.size()) - loop.first;
    if (loop.doubled_area > 0) {
      loop.face = static_cast<std::uint32_t>(faces.faces.size());
      faces.faces.push_back({static_cast<std::uint32_t>(faces.loops.size()), {}});
    }
    faces.loops.push_back(loop);
  }
  nest(faces, nodes, edges, job);
  return faces;
}

}  // namespace seedmesh
