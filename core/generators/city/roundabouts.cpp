#include "core/generators/city/roundabouts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double least_arm = 900;    // from the ring to the next node, cm
constexpr double free_space = 2500;  // around the ring, cm
constexpr double longest_chord = math::radians(32);

class RingBuilder {
 public:
  RingBuilder(const StreetGraph& graph, double radius) : graph_(graph), radius_(radius) {}

  /// Whether a ring about a node reaches no other street, shore or border.
  bool has_space(std::uint32_t node) const {
    if (graph_.is_border[node] != 0 || graph_.degree(node) < 3 ||
        graph_.street_ends(node) != graph_.degree(node))
      return false;
    const dvec2 centre = in_cm(graph_.nodes[node]);
    for (std::uint32_t edge = 0; edge < graph_.edges.size(); ++edge) {
      const PlanarEdge& each = graph_.edges[edge];
      const CmPoint &a = graph_.nodes[each.from], &b = graph_.nodes[each.to];
      const bool is_arm = each.from == node || each.to == node;
      if (is_arm && (distance(a, b) < radius_ + least_arm || !is_major(each))) return false;
      if (!is_arm && distance_to_segment(centre, in_cm(a), in_cm(b)) < radius_ + least_arm) return false;
      if (!is_arm && !graph_.is_street(edge) &&
          distance_to_segment(centre, in_cm(a), in_cm(b)) < radius_ + free_space)
        return false;
    }
    return true;
  }

  void add_ring(std::uint32_t node, std::vector<StreetPiece>& pieces,
                std::vector<CmPoint>& ring_nodes) const {
    const dvec2 centre = in_cm(graph_.nodes[node]);
    std::vector<double> angles;
    for (const std::uint32_t half : graph_.arms.of(node)) {
      const CmPoint& other = graph_.nodes[end_of(graph_.edges, half)];
      const dvec2 off = in_cm(other) - centre;
      angles.push_back(math::atan2(off.y, off.x));
      pieces.push_back({point_at(centre, angles.back()), other, graph_.edges[half / 2].tag});
    }
    for (std::size_t i = 0; i < angles.size(); ++i) {
      double gap = angles[(i + 1) % angles.size()] - angles[i];
      if (gap <= 0) gap += 2 * math::pi;
      const int count = std::max(1, math::to_int32(std::ceil(gap / longest_chord)));
      for (int k = 0; k < count; ++k) {
        const bool is_last = k + 1 == count;
        const CmPoint from = point_at(centre, angles[i] + gap * k / count);
        const CmPoint to = is_last ? point_at(centre, angles[(i + 1) % angles.size()])
                                   : point_at(centre, angles[i] + gap * (k + 1) / count);
        pieces.push_back({from, to, static_cast<std::uint32_t>(EdgeClass::minor)});
        ring_nodes.push_back(from);
      }
    }
  }

 private:
  static bool is_major(const PlanarEdge& edge) {
    return edge.tag == static_cast<std::uint32_t>(EdgeClass::major) ||
           edge.tag == static_cast<std::uint32_t>(EdgeClass::highway);
  }
  CmPoint point_at(const dvec2& centre, double angle) const {
    const math::SinCos turn = math::sincos(angle);
    return rounded_cm(centre + dvec2(turn.cos, turn.sin) * radius_);
  }

  const StreetGraph& graph_;
  double radius_;
};

}  // namespace

std::vector<StreetPiece> with_roundabouts(const StreetGraph& majors, const CityStreets& streets,
                                          const Rng& rng, std::vector<CmPoint>& ring_nodes, const Job& job) {
  const RingBuilder builder(majors, streets.roundabout_radius * 100);
  std::vector<std::uint8_t> is_ring(majors.nodes.size(), 0);
  std::vector<StreetPiece> pieces;
  for (std::uint32_t node = 0; node < majors.nodes.size(); ++node) {
    if (majors.degree(node) < 3 || Rng(rng.at(majors.node_key[node])).unit() >= streets.roundabouts) continue;
    job.check();
    if (!builder.has_space(node)) continue;
    is_ring[node] = 1;
    builder.add_ring(node, pieces, ring_nodes);
  }
  for (const PlanarEdge& edge : majors.edges) {
    if (is_street_tag(edge.tag) && is_ring[edge.from] == 0 && is_ring[edge.to] == 0)
      pieces.push_back({majors.nodes[edge.from], majors.nodes[edge.to], edge.tag});
  }
  std::sort(ring_nodes.begin(), ring_nodes.end());
  return pieces;
}

}  // namespace seedmesh::city
