// Minor streets that become lanes.
#include <algorithm>
#include <vector>

#include "core/generators/city/growth.h"

namespace seedmesh::city {
namespace {

constexpr auto minor_tag = static_cast<std::uint32_t>(EdgeClass::minor);
constexpr auto lane_tag = static_cast<std::uint32_t>(EdgeClass::lane);

/// Follows minor streets from one edge to the ends of its street.
class Follower {
 public:
  explicit Follower(const StreetGraph& graph) : graph_(graph), is_seen_(graph.edges.size(), 0) {}

  bool is_seen(std::uint32_t edge) const { return is_seen_[edge] != 0; }

  /// Appends the edges of the street from the end of a half-edge on, and returns its last node.
  std::uint32_t follow(std::uint32_t half, std::vector<std::uint32_t>& edges) {
    for (;;) {
      const std::uint32_t node = end_of(graph_.edges, half);
      const std::uint32_t next = next_of(node, half);
      if (next == no_index || is_seen(next / 2)) return node;
      is_seen_[next / 2] = 1;
      edges.push_back(next / 2);
      half = next;
    }
  }
  void see(std::uint32_t edge) { is_seen_[edge] = 1; }

 private:
  /// The half-edge on which a street continues beyond a node; none at its end.
  std::uint32_t next_of(std::uint32_t node, std::uint32_t half) const {
    if (graph_.is_border[node] != 0 || graph_.street_ends(node) != 2) return no_index;
    for (const std::uint32_t other : graph_.arms.of(node)) {
      if (other / 2 != half / 2 && graph_.edges[other / 2].tag == minor_tag) return other;
    }
    return no_index;
  }

  const StreetGraph& graph_;
  std::vector<std::uint8_t> is_seen_;  ///< 1 for edges that were visited
};

}  // namespace

void choose_lanes(StreetGraph& graph, double share, const Rng& rng) {
  if (share <= 0) return;
  Follower follower(graph);
  std::vector<std::uint32_t> lanes, edges;
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    if (graph.edges[edge].tag != minor_tag || follower.is_seen(edge)) continue;
    follower.see(edge);
    edges = {edge};
    const std::uint64_t a = graph.node_key[follower.follow(2 * edge, edges)],
                        b = graph.node_key[follower.follow(2 * edge + 1, edges)];
    Rng draw = rng.at(std::min(a, b)).at(std::max(a, b));
    if (draw.unit() < share) lanes.insert(lanes.end(), edges.begin(), edges.end());
  }
  for (const std::uint32_t edge : lanes) graph.edges[edge].tag = lane_tag;
}

}  // namespace seedmesh::city
