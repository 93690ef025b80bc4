#pragma once
/// Removes from a planar graph the edges that the rules of a street network forbid.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/generators/city/near_streets.h"
#include "core/generators/city/plan.h"

namespace seedmesh::city {

/// Returns the key of a position, for random numbers.
inline std::uint64_t key_of_point(const CmPoint& p) {
  return key_at(key_at(0xC17, static_cast<std::uint32_t>(p.x)), static_cast<std::uint32_t>(p.y));
}

inline bool is_boundary(const PlanarEdge& edge) { return !is_street_tag(edge.tag); }
inline bool is_given(const PlanarEdge& edge) { return edge.tag >= first_given; }
/// Returns the rank of a street. Of two streets that are too near to each other, the one with the lower rank stays.
inline std::uint32_t rank_of(const PlanarEdge& edge) { return is_given(edge) ? 0 : edge.tag + 1; }

inline bool is_street(const PlanarEdge& edge) { return is_street_tag(edge.tag); }

/// Working copy of a graph with the degrees of its nodes.
class PrunedGraph {
 public:
  PrunedGraph(const PlanarGraph& graph, const std::vector<SeparatedLine>& separated)
      : nodes_(graph.nodes()), degree_(nodes_.size(), 0) {
    for (const PlanarEdge& edge : graph.edges()) {
      if (!edge.is_removed()) edges_.push_back(edge);
    }
    is_border_.assign(nodes_.size(), 0);
    for (const PlanarEdge& edge : edges_) {
      if (is_boundary(edge)) is_border_[edge.from] = is_border_[edge.to] = 1;
    }
    count_degrees();
    if (separated.empty()) return;
    std::map<CmPoint, std::uint32_t> at;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) at.emplace(nodes_[n], n);
    for (const SeparatedLine& each : separated) {
      const auto from = at.find(each.line.front()), to = at.find(each.line.back());
      if (from == at.end() || to == at.end()) continue;
      separated_.push_back({from->second, to->second, each.kind, each.level, each.line, 0});
    }
    mark_separated_ends();
  }

  void drop_outside(const Region& region) {
    for (PlanarEdge& edge : edges_) {
      if (is_boundary(edge)) continue;
      const glm::dvec2 middle = (in_cm(nodes_[edge.from]) + in_cm(nodes_[edge.to])) / 2.0;
      if (!is_on_land(region, middle)) remove(edge);
    }
    compact();
  }

  /// Removes highways and major streets with a loose end, back to the last junction.
  void drop_loose_majors() {
    bool goes_on = true;
    while (goes_on) {
      goes_on = false;
      for (PlanarEdge& edge : edges_) {
        if (edge.is_removed() || edge.tag < static_cast<std::uint32_t>(EdgeClass::highway) ||
            edge.tag > static_cast<std::uint32_t>(EdgeClass::major))
          continue;
        if (!is_loose(edge.from) && !is_loose(edge.to)) continue;
        remove(edge);
        goes_on = true;
      }
    }
    compact();
  }

  /// Removes streets shorter than the least length (cm), which rounding and clipping can leave. Of given streets, removes
  /// only loose ends at the border.
  void drop_short(double least) {
    for (PlanarEdge& edge : edges_) {
      if (!is_street(edge) || distance(nodes_[edge.from], nodes_[edge.to]) >= least) continue;
      const bool is_loose_end = degree_[edge.from] == 1 || degree_[edge.to] == 1;
      const bool is_at_border = is_border_[edge.from] != 0 || is_border_[edge.to] != 0;
      if (!is_given(edge) || (is_loose_end && is_at_border)) remove(edge);
    }
    compact();
  }

  /// Joins two pieces of a straight given street if one of them is shorter than `least` (cm) and no other street
  /// meets their common node.
  void join_short_given(double least) {
    const PlanarArms arms = arms_of(nodes_, edges_);
    for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
      const auto around = arms.of(node);
      if (around.size() != 2 || is_separated_end(node)) continue;
      PlanarEdge &first = edges_[around[0] / 2], &second = edges_[around[1] / 2];
      if (first.is_removed() || second.is_removed() || !is_given(first) || first.tag != second.tag) continue;
      const std::uint32_t a = first.from == node ? first.to : first.from,
                          b = second.from == node ? second.to : second.from;
      const double shorter = std::min(distance(nodes_[a], nodes_[node]), distance(nodes_[b], nodes_[node]));
      if (a == b || shorter >= least ||
          distance_to_segment(in_cm(nodes_[node]), in_cm(nodes_[a]), in_cm(nodes_[b])) > 1.5)
        continue;
      first.from = a;
      first.to = b;
      second.from = second.to = PlanarEdge::removed;
    }
    compact();
  }

  /// Removes an edge if its angle to a wider or earlier edge of a node is less than the least one. `cos_least` is the
  /// cosine of the least angle.
  void drop_sharp(double cos_least) {
    mark_paths_to_separated();
    for (int round = 0; round < 8; ++round) {
      const PlanarArms arms = arms_of(nodes_, edges_);
      bool goes_on = false;
      for (std::uint32_t node = 0; node < nodes_.size(); ++node)
        goes_on |= drop_sharp_at(node, arms, cos_least);
      compact();
      if (!goes_on) break;
    }
    drop_sharp_at_separated(cos_least);
  }

  /// Removes streets that grew if another street without a common node is nearer than half of both widths. Both stay if
  /// they are as far apart as arms of a junction at the same way from it. `widths` are those of the carriageways in
  /// centimetres, by tag. Cost: n log n.
  void drop_near(const std::vector<double>& widths, const Job& job) {
    PlanarArms arms;
    for (const NearPair& pair : near_pairs(nodes_, edges_, widths, job)) {
      PlanarEdge &first = edges_[pair.first], &second = edges_[pair.second];
      if (first.is_removed() || second.is_removed() || (is_given(first) && is_given(second))) continue;
      if (arms.first.empty()) arms = arms_of(nodes_, edges_);
      if (are_linked({nodes_, edges_, arms}, pair)) continue;
      const auto order = [&](const PlanarEdge& edge) {
        const bool is_dead_end = is_loose(edge.from) || is_loose(edge.to);
        return 2 * rank_of(edge) + (is_dead_end ? 1 : 0);
      };
      remove(order(first) <= order(second) ? second : first);
    }
    compact();
  }

  /// Keeps the main network of streets, and those with given streets.
  void keep_largest() { keep_large(2); }

  /// Keeps the main network of streets, those of at least this share of its length, and those with given streets. The
  /// main network has the greatest length of highways and major streets, which the density affects little, of those
  /// with more than half of the greatest length.
  void keep_large(double least_share) {
    drop_loose_separated();
    std::vector<std::uint32_t> root(nodes_.size());
    for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
    const auto find = [&root](std::uint32_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    const auto join = [&](std::uint32_t from, std::uint32_t to) {
      const std::uint32_t a = find(from), b = find(to);
      root[std::max(a, b)] = std::min(a, b);
    };
    for (const PlanarEdge& edge : edges_) {
      if (is_street(edge)) join(edge.from, edge.to);
    }
    for (const SeparatedStreet& bridge : separated_) join(bridge.from, bridge.to);
    std::vector<double> length(nodes_.size(), 0), major_length(nodes_.size(), 0);
    std::vector<std::uint8_t> has_given(nodes_.size(), 0);
    for (const PlanarEdge& edge : edges_) {
      if (!is_street(edge)) continue;
      const double own = distance(nodes_[edge.from], nodes_[edge.to]);
      length[find(edge.from)] += own;
      if (edge.tag <= static_cast<std::uint32_t>(EdgeClass::major)) major_length[find(edge.from)] += own;
      if (is_given(edge)) has_given[find(edge.from)] = 1;
    }
    // A network with less than half of the greatest length is not the main one.
    const double longest = length.empty() ? 0 : *std::max_element(length.begin(), length.end());
    std::uint32_t main = no_index;
    for (std::uint32_t i = 0; i < root.size(); ++i) {
      if (length[i] <= longest / 2) continue;
      const bool is_greater =
          main == no_index || (major_length[i] != major_length[main] ? major_length[i] > major_length[main]
                                                                     : length[i] > length[main]);
      if (is_greater) main = i;
    }
    const double least = main < length.size() ? least_share * length[main] : 0;
    for (PlanarEdge& edge : edges_) {
      if (!is_street(edge)) continue;
      const std::uint32_t network = find(edge.from);
      if (network != main && length[network] < least && has_given[network] == 0) remove(edge);
    }
    compact();
    drop_loose_separated();
  }

  std::vector<SeparatedLine> separated() const {
    std::vector<SeparatedLine> all;
    for (const SeparatedStreet& each : separated_) all.push_back({each.line, each.tag, each.level});
    return all;
  }

  StreetGraph finished() const {
    StreetGraph graph;
    std::vector<std::uint32_t> number(nodes_.size(), no_index);
    const auto node = [&](std::uint32_t old) {
      if (number[old] == no_index) {
        number[old] = static_cast<std::uint32_t>(graph.nodes.size());
        graph.nodes.push_back(nodes_[old]);
        graph.is_border.push_back(is_border_[old]);
        graph.node_key.push_back(key_of_point(nodes_[old]));
      }
      return number[old];
    };
    for (const PlanarEdge& edge : edges_) {
      const std::uint32_t from = node(edge.from), to = node(edge.to);
      graph.edges.push_back({from, to, edge.tag});
      const std::uint64_t a = graph.node_key[from], b = graph.node_key[to];
      graph.edge_key.push_back(key_at(std::min(a, b), std::max(a, b)));
    }
    graph.arms = arms_of(graph.nodes, graph.edges);
    if (separated_.empty()) return graph;
    graph.separated_ends.assign(graph.nodes.size(), 0);
    for (SeparatedStreet each : separated_) {
      each.from = number[each.from];
      each.to = number[each.to];
      const std::uint64_t a = graph.node_key[each.from], b = graph.node_key[each.to];
      each.key = key_at(key_at(std::min(a, b), std::max(a, b)), 0xB41D6E);
      ++graph.separated_ends[each.from];
      ++graph.separated_ends[each.to];
      graph.separated.push_back(std::move(each));
    }
    return graph;
  }

 private:
  /// Removes bridges without a street at one of their ends.
  void drop_loose_separated() {
    std::erase_if(separated_, [&](const SeparatedStreet& each) {
      return degree_[each.from] == 0 || degree_[each.to] == 0 || each.from == each.to;
    });
    mark_separated_ends();
  }

  void mark_separated_ends() {
    is_separated_end_.assign(nodes_.size(), 0);
    for (const SeparatedStreet& each : separated_)
      is_separated_end_[each.from] = is_separated_end_[each.to] = 1;
  }
  /// Marks the nodes from each end of a bridge or tunnel to the next junction, without the junction.
  void mark_paths_to_separated() {
    leads_to_separated_ = is_separated_end_;
    if (separated_.empty()) return;
    const PlanarArms arms = arms_of(nodes_, edges_);
    for (std::uint32_t end = 0; end < nodes_.size(); ++end) {
      if (is_separated_end_[end] == 0) continue;
      std::uint32_t before = end, at = next_of(end, end, arms);
      while (at != no_index && leads_to_separated_[at] == 0 && degree_[at] == 2) {
        leads_to_separated_[at] = 1;
        const std::uint32_t next = next_of(at, before, arms);
        before = at;
        at = next;
      }
    }
  }
  /// The node at the other end of a street that leaves `node` and does not lead back to `before`. None if there is none.
  std::uint32_t next_of(std::uint32_t node, std::uint32_t before, const PlanarArms& arms) const {
    for (const std::uint32_t half : arms.of(node)) {
      const std::uint32_t other = end_of(edges_, half);
      if (is_street(edges_[half / 2]) && other != before) return other;
    }
    return no_index;
  }
  /// The rank of a street; in the same class, streets that lead to a bridge or tunnel come first.
  std::uint32_t order_of(const PlanarEdge& edge) const {
    const bool leads =
        !leads_to_separated_.empty() && (leads_to_separated_[edge.from] | leads_to_separated_[edge.to]) != 0;
    return 2 * rank_of(edge) + (leads ? 0 : 1);
  }
  bool is_separated_end(std::uint32_t node) const {
    return !is_separated_end_.empty() && is_separated_end_[node] != 0;
  }
  bool is_loose(std::uint32_t node) const {
    return degree_[node] == 1 && is_border_[node] == 0 && !is_separated_end(node);
  }

  void remove(PlanarEdge& edge) {
    --degree_[edge.from];
    --degree_[edge.to];
    edge.from = edge.to = PlanarEdge::removed;
  }
  void compact() {
    std::erase_if(edges_, [](const PlanarEdge& edge) { return edge.is_removed(); });
    count_degrees();
  }
  void count_degrees() {
    std::fill(degree_.begin(), degree_.end(), 0);
    for (const PlanarEdge& edge : edges_) {
      if (is_boundary(edge)) continue;
      ++degree_[edge.from];
      ++degree_[edge.to];
    }
  }

  bool drop_sharp_at(std::uint32_t node, const PlanarArms& arms, double cos_least) {
    const auto around = arms.of(node);
    bool has_dropped = false;
    for (std::size_t i = 0; i < around.size() && around.size() > 1; ++i) {
      PlanarEdge& first = edges_[around[i] / 2];
      PlanarEdge& second = edges_[around[(i + 1) % around.size()] / 2];
      if (first.is_removed() || second.is_removed() || (is_boundary(first) && is_boundary(second)) ||
          (is_given(first) && is_given(second)))
        continue;
      const glm::dvec2 u = direction(first, node), v = direction(second, node);
      // On the side of an angle above 150 degrees the kerb of a street would pass the border.
      const bool is_wide = u.x * v.y - u.y * v.x < 0 || u.x * v.x + u.y * v.y < -0.87;
      if (is_boundary(first) != is_boundary(second) && is_wide) {
        PlanarEdge& street = is_boundary(first) ? second : first;
        if (is_given(street)) continue;
        remove(street);
        has_dropped = true;
        continue;
      }
      if (u.x * v.x + u.y * v.y <= cos_least) continue;
      // The border and given streets stay, then the lower class, then the street that leads to a bridge or tunnel, then the
      // earlier one of this round.
      const bool drops_second =
          is_boundary(first) || (is_street(second) && order_of(first) <= order_of(second));
      PlanarEdge& dropped = drops_second ? second : first;
      if (is_given(dropped)) continue;
      remove(dropped);
      has_dropped = true;
    }
    return has_dropped;
  }
  /// Removes streets that grew and leave the end of a bridge or tunnel in nearly its direction.
  void drop_sharp_at_separated(double cos_least) {
    if (separated_.empty()) return;
    const PlanarArms arms = arms_of(nodes_, edges_);
    const auto drop = [&](std::uint32_t node, const CmPoint& next) {
      const glm::dvec2 along = (in_cm(next) - in_cm(nodes_[node])) / distance(nodes_[node], next);
      for (const std::uint32_t half : arms.of(node)) {
        PlanarEdge& edge = edges_[half / 2];
        if (edge.is_removed() || is_boundary(edge) || is_given(edge)) continue;
        const glm::dvec2 other = direction(edge, node);
        if (other.x * along.x + other.y * along.y > cos_least) remove(edge);
      }
    };
    for (const SeparatedStreet& each : separated_) {
      drop(each.from, each.line[1]);
      drop(each.to, each.line[each.line.size() - 2]);
    }
    compact();
  }
  glm::dvec2 direction(const PlanarEdge& edge, std::uint32_t node) const {
    const glm::dvec2 along = in_cm(nodes_[edge.from == node ? edge.to : edge.from]) - in_cm(nodes_[node]);
    return along / std::sqrt(along.x * along.x + along.y * along.y);
  }

  std::vector<CmPoint> nodes_;
  std::vector<PlanarEdge> edges_;
  std::vector<std::uint32_t> degree_;
  std::vector<std::uint8_t> is_border_, is_separated_end_, leads_to_separated_;  ///< by node
  std::vector<SeparatedStreet> separated_;
};

}  // namespace seedmesh::city
