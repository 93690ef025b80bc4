#include "core/generators/city/region.h"

#include <algorithm>
#include <array>

#include "core/generators/city/rings.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr std::uint32_t border = 0, shore = 1;
constexpr double least_area = 100;  // square metres
enum class Ground : std::uint8_t { outside, land, water };

/// What the face to the left of each half-edge is.
std::vector<Ground> ground_of(const std::vector<CmPoint>& nodes, const std::vector<PlanarEdge>& edges,
                              const std::vector<CmRing>& area, const std::vector<Rings>& water,
                              const Job& job) {
  const PlanarFaces faces = faces_of(nodes, edges, job);
  std::vector<Ground> ground(edges.size() * 2, Ground::outside);
  for (const PlanarFaces::Face& face : faces.faces) {
    const PlanarFaces::Loop& outer = faces.loops[face.outer];
    const dvec2 p = position_in(nodes, edges, faces.of(outer));
    Ground here = !is_in(area, p) ? Ground::outside : is_in_any(water, p) ? Ground::water : Ground::land;
    const double square_metres = static_cast<double>(outer.doubled_area) / 2e4;
    if (here != Ground::outside && square_metres < least_area) {
      // Too small: part of what is around it.
      const bool has_border = std::any_of(faces.of(outer).begin(), faces.of(outer).end(),
                                          [&](std::uint32_t half) { return edges[half / 2].tag == border; });
      here = here == Ground::water || has_border ? Ground::land : Ground::water;
    }
    for (const std::uint32_t half : faces.of(outer)) ground[half] = here;
    for (const std::uint32_t hole : face.holes) {
      for (const std::uint32_t half : faces.of(faces.loops[hole])) ground[half] = here;
    }
  }
  return ground;
}

}  // namespace

dvec2 position_in(const std::vector<CmPoint>& nodes, const std::vector<PlanarEdge>& edges,
                  std::span<const std::uint32_t> loop) {
  dvec2 from{0}, to{1, 0};
  double longest = -1;
  for (const std::uint32_t half : loop) {
    const CmPoint &a = nodes[start_of(edges, half)], &b = nodes[end_of(edges, half)];
    if (distance(a, b) <= longest) continue;
    longest = distance(a, b);
    from = in_cm(a);
    to = in_cm(b);
  }
  const dvec2 along = to - from;
  return (from + to) / 2.0 + dvec2(-along.y, along.x) * (1.5 / longest);
}

Region region_of(const std::vector<CmRing>& area) {
  Region region;
  region.rings = area;
  for (const CmRing& ring : area) {
    region.is_shore.emplace_back(ring.size(), std::uint8_t{0});
    for (std::size_t i = 0; i < ring.size(); ++i)
      region.outline.push_back({ring[i], ring[(i + 1) % ring.size()], false});
  }
  return region;
}

Region region_of(const std::vector<CmRing>& area, const std::vector<Rings>& water, Job& job) {
  if (water.empty()) return region_of(area);
  PlanarGraph graph;
  const auto add = [&](const CmRing& ring, std::uint32_t tag) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (i % 1024 == 0) job.check();
      graph.add(ring[i], ring[(i + 1) % ring.size()], tag);
    }
  };
  for (const CmRing& ring : area) add(ring, border);
  for (const Rings& rings : water) {
    for (const CmRing& ring : rings) add(ring, shore);
  }
  std::vector<PlanarEdge> edges;
  for (const PlanarEdge& edge : graph.edges()) {
    if (!edge.is_removed()) edges.push_back(edge);
  }
  const std::vector<Ground> first = ground_of(graph.nodes(), edges, area, water, job);
  // What is left are the edges between different grounds.
  std::vector<PlanarEdge> kept;
  std::vector<std::array<Ground, 2>> sides;
  Region region;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (first[2 * e] == first[2 * e + 1]) continue;
    const bool is_shore = first[2 * e] != Ground::outside && first[2 * e + 1] != Ground::outside;
    region.outline.push_back({graph.nodes()[edges[e].from], graph.nodes()[edges[e].to], is_shore});
    kept.push_back({edges[e].from, edges[e].to, is_shore ? shore : border});
    sides.push_back({first[2 * e], first[2 * e + 1]});
  }
  const PlanarFaces faces = faces_of(graph.nodes(), kept, job);
  for (const PlanarFaces::Loop& loop : faces.loops) {
    const auto halves = faces.of(loop);
    if (sides[halves[0] / 2][halves[0] % 2] != Ground::land) continue;
    CmRing ring;
    std::vector<std::uint8_t> is_shore;
    for (const std::uint32_t half : halves) {
      ring.push_back(graph.nodes()[start_of(kept, half)]);
      is_shore.push_back(kept[half / 2].tag == shore ? 1 : 0);
    }
    region.rings.push_back(std::move(ring));
    region.is_shore.push_back(std::move(is_shore));
  }
  return region;
}

bool is_on_land(const Region& region, const glm::dvec2& cm) { return is_in(region.rings, cm); }

std::optional<std::size_t> part_of_land(const Region& region, const dvec2& cm) {
  if (!is_on_land(region, cm)) return std::nullopt;
  std::optional<std::size_t> part;
  std::int64_t least = 0;
  for (std::size_t r = 0; r < region.rings.size(); ++r) {
    const std::int64_t area = doubled_area(region.rings[r]);
    if (area <= 0 || (part && area >= least) || !is_inside(region.rings[r], cm)) continue;
    part = r;
    least = area;
  }
  return part;
}

}  // namespace seedmesh::city
