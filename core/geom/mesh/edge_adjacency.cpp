#include "core/geom/mesh/edge_adjacency.h"

#include <algorithm>

namespace seedmesh {

std::uint64_t EdgeAdjacency::key(int layer, const Edge& edge) {
  const std::uint64_t both =
      std::uint64_t{std::min(edge.from, edge.to)} << 32U | std::max(edge.from, edge.to);
  return key_at(both, static_cast<std::uint64_t>(layer));
}

EdgeAdjacency::Leader EdgeAdjacency::find(std::uint32_t piece) {
  std::uint32_t top = piece;
  std::uint8_t parity = 0;
  for (; leader_[top] != top; top = leader_[top]) parity ^= parity_[top];
  // Path compression.
  for (std::uint8_t left = parity; leader_[piece] != piece;) {
    const std::uint32_t next = leader_[piece];
    const std::uint8_t own = parity_[piece];
    leader_[piece] = top;
    parity_[piece] = left;
    left ^= own;
    piece = next;
  }
  return {top, parity};
}

/// `edges` are sorted, so that the two directions of an inner edge of the piece are neighbours.
bool EdgeAdjacency::fits(int layer, std::span<const Edge> edges) {
  bound_.clear();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::uint32_t number = use_of_.peek(key(layer, edges[i]));
    if (number == NumberTable::none) continue;
    const Use& use = uses_[number];
    const bool is_inner =
        (i > 0 && edges[i - 1].from == edges[i].to && edges[i - 1].to == edges[i].from) ||
        (i + 1 < edges.size() && edges[i + 1].from == edges[i].to && edges[i + 1].to == edges[i].from);
    if (use.times == 2 || is_inner) return false;
    const bool same_way = use.upward == (edges[i].from < edges[i].to);
    Leader leader = find(use.piece);
    leader.parity ^= same_way;
    const auto known =
        std::find_if(bound_.begin(), bound_.end(), [&](const Leader& b) { return b.piece == leader.piece; });
    if (known == bound_.end()) {
      bound_.push_back(leader);
    } else if (known->parity != leader.parity) {
      return false;
    }
  }
  return true;
}

int EdgeAdjacency::add(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    const auto low = [](const Edge& e) { return std::min(e.from, e.to); };
    const auto high = [](const Edge& e) { return std::max(e.from, e.to); };
    if (low(a) != low(b)) return low(a) < low(b);
    return high(a) != high(b) ? high(a) < high(b) : a.from < b.from;
  });
  int layer = 0;
  while (!fits(layer, edges)) ++layer;

  const auto piece = static_cast<std::uint32_t>(leader_.size());
  leader_.push_back(piece);
  parity_.push_back(0);
  for (const Leader& group : bound_) {
    // The piece's own leader may be another group's by now.
    const Leader own = find(piece);
    if (own.piece == group.piece) continue;
    leader_[own.piece] = group.piece;
    parity_[own.piece] = own.parity ^ group.parity;
  }
  for (const Edge& edge : edges) {
    std::uint32_t& number = use_of_[key(layer, edge)];
    if (number == NumberTable::none) {
      number = static_cast<std::uint32_t>(uses_.size());
      uses_.push_back({piece, static_cast<std::uint8_t>(edge.from < edge.to), 0});
    }
    ++uses_[number].times;
  }
  return layer;
}

}  // namespace seedmesh
