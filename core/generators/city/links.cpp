// Streets between separate networks, which given streets, water and steep ground can leave behind.
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>

#include "core/generators/city/growth.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double shortest = 1200, longest = 60'000;  // of a link, cm
constexpr double beside = 700;                       // least distance from nodes that it does not join, cm
constexpr double least_rest = 330;                   // of a street that it splits, cm
constexpr double least_cosine = 0.86;                // of the angle to other streets
constexpr std::size_t most_starts = 64;              // nodes of a network that are tried
constexpr std::size_t most_tried = 200;              // links of a network that are tried
constexpr std::uint32_t minor_tag = static_cast<std::uint32_t>(EdgeClass::minor);

/// A link from a node to a point of an edge of another network.
struct Candidate {
  double length = 0;
  std::uint32_t from = 0, edge = 0;
  std::uint32_t node = no_index;  ///< node of the point; none within the edge
  CmPoint to{};
  bool operator<(const Candidate& other) const {
    if (length != other.length) return length < other.length;
    return from != other.from ? from < other.from : edge < other.edge;
  }
};

/// The networks of streets of all levels, by union of their nodes.
class Networks {
 public:
  explicit Networks(const StreetGraph& graph) : other_(graph.nodes.size()) {
    std::iota(other_.begin(), other_.end(), 0U);
    for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
      if (graph.is_street(e)) join(graph.edges[e].from, graph.edges[e].to);
    }
    for (const SeparatedStreet& each : graph.separated) join(each.from, each.to);
  }

  /// Returns the node that represents the network of a node.
  std::uint32_t find(std::uint32_t node) {
    while (other_[node] != node) node = other_[node] = other_[other_[node]];
    return node;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = find(a), second = find(b);
    other_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::vector<std::uint32_t> other_;  ///< another node of the same network, indexed by node
};

class Links {
 public:
  Links(const GrowthInput& input, const StreetGraph& graph)
      : input_(input), graph_(graph), networks_(graph) {}

  std::vector<StreetPiece> build(const Job& job) {
    std::vector<std::uint32_t> stuck;
    while (const auto network = shortest_network(stuck)) {
      job.check();
      const std::optional<Candidate> link = best_link(*network);
      if (!link) {
        stuck.push_back(*network);
        continue;
      }
      links_.push_back({graph_.nodes[link->from], link->to, minor_tag});
      networks_.join(link->from, graph_.edges[link->edge].from);
      stuck.clear();
    }
    return std::move(links_);
  }

 private:
  /// The network of least length, unless it is the only one.
  std::optional<std::uint32_t> shortest_network(const std::vector<std::uint32_t>& stuck) {
    std::vector<double> length(graph_.nodes.size(), 0);
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
      const PlanarEdge& edge = graph_.edges[e];
      if (graph_.is_street(e))
        length[networks_.find(edge.from)] += distance(graph_.nodes[edge.from], graph_.nodes[edge.to]);
    }
    std::optional<std::uint32_t> least;
    std::size_t count = 0;
    for (std::uint32_t n = 0; n < length.size(); ++n) {
      if (length[n] == 0) continue;
      ++count;
      if (std::find(stuck.begin(), stuck.end(), n) != stuck.end()) continue;
      if (!least || length[n] < length[*least]) least = n;
    }
    return count > 1 ? least : std::nullopt;
  }

  std::optional<Candidate> best_link(std::uint32_t network) {
    std::vector<std::uint32_t> starts;
    for (std::uint32_t n = 0; n < graph_.nodes.size(); ++n) {
      if (networks_.find(n) == network && graph_.degree(n) > 0 && graph_.is_border[n] == 0)
        starts.push_back(n);
    }
    std::vector<Candidate> all;
    const std::size_t step = starts.size() / most_starts + 1;
    for (std::size_t i = 0; i < starts.size(); i += step) add_candidates(starts[i], network, all);
    const std::size_t count = std::min(all.size(), most_tried);
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end());
    for (std::size_t i = 0; i < count; ++i) {
      if (may_build(all[i])) return all[i];
    }
    return std::nullopt;
  }

  void add_candidates(std::uint32_t from, std::uint32_t network, std::vector<Candidate>& all) {
    const dvec2 p = in_cm(graph_.nodes[from]);
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
      const PlanarEdge& edge = graph_.edges[e];
      if (!graph_.is_street(e) || networks_.find(edge.from) == network) continue;
      const dvec2 a = in_cm(graph_.nodes[edge.from]), along = in_cm(graph_.nodes[edge.to]) - a;
      const double length = glm::length(along), at = glm::dot(p - a, along) / length;
      Candidate link{0, from, e, no_index, {}};
      if (at > least_rest && at < length - least_rest) {
        link.to = rounded_cm(a + along * (at / length));
      } else {
        link.node = at < length / 2 ? edge.from : edge.to;
        link.to = graph_.nodes[link.node];
        if (graph_.is_border[link.node] != 0) continue;
      }
      link.length = distance(graph_.nodes[from], link.to);
      if (link.length >= shortest && link.length <= longest) all.push_back(link);
    }
  }

  /// Whether no street at a node leaves it in nearly the direction of a point.
  bool keeps_angles(std::uint32_t node, const CmPoint& towards) const {
    const dvec2 p = in_cm(graph_.nodes[node]),
                along = (in_cm(towards) - p) / distance(graph_.nodes[node], towards);
    for (const std::uint32_t half : graph_.arms.of(node)) {
      const dvec2 arm = in_cm(graph_.nodes[end_of(graph_.edges, half)]) - p;
      if (glm::dot(arm, along) > least_cosine * glm::length(arm)) return false;
    }
    return true;
  }

  bool may_build(const Candidate& link) const {
    const CmPoint& start = graph_.nodes[link.from];
    if (!keeps_angles(link.from, link.to)) return false;
    if (link.node != no_index && !keeps_angles(link.node, start)) return false;
    if (input_.is_blocked(in_cm(start), in_cm(link.to), input_.streets.classes.minor.grade)) return false;
    const dvec2 p = in_cm(start), q = in_cm(link.to);
    for (std::uint32_t e = 0; e < graph_.edges.size(); ++e) {
      const PlanarEdge& edge = graph_.edges[e];
      const CmPoint &a = graph_.nodes[edge.from], &b = graph_.nodes[edge.to];
      if (std::max(a.x, b.x) + beside < std::min(p.x, q.x) ||
          std::min(a.x, b.x) - beside > std::max(p.x, q.x) ||
          std::max(a.y, b.y) + beside < std::min(p.y, q.y) ||
          std::min(a.y, b.y) - beside > std::max(p.y, q.y))
        continue;
      const auto is_joined = [&](std::uint32_t n) { return n == link.from || n == link.node; };
      const bool is_met = e == link.edge || is_joined(edge.from) || is_joined(edge.to);
      if (!is_met && segments_meet(start, link.to, a, b)) return false;
      for (const std::uint32_t n : {edge.from, edge.to}) {
        const bool is_split = e == link.edge && link.node == no_index;
        if (!is_joined(n) && !is_split && distance_to_segment(in_cm(graph_.nodes[n]), p, q) < beside)
          return false;
      }
      if (!is_met && distance_to_segment(q, in_cm(a), in_cm(b)) < beside && link.node == no_index)
        return false;
    }
    return std::none_of(links_.begin(), links_.end(), [&](const StreetPiece& other) {
      return segments_meet(start, link.to, other.a, other.b) ||
             distance_to_segment(q, in_cm(other.a), in_cm(other.b)) < beside ||
             distance_to_segment(p, in_cm(other.a), in_cm(other.b)) < beside;
    });
  }

  const GrowthInput& input_;
  const StreetGraph& graph_;
  Networks networks_;
  std::vector<StreetPiece> links_;
};

}  // namespace

bool is_one_network(const StreetGraph& graph) {
  Networks networks(graph);
  std::uint32_t first = no_index;
  for (const PlanarEdge& edge : graph.edges) {
    if (!is_street_tag(edge.tag)) continue;
    const std::uint32_t network = networks.find(edge.from);
    if (first == no_index) first = network;
    if (network != first) return false;
  }
  return true;
}

std::vector<StreetPiece> links_between_networks(const GrowthInput& input, const StreetGraph& graph,
                                                const Job& job) {
  return Links(input, graph).build(job);
}

}  // namespace seedmesh::city
