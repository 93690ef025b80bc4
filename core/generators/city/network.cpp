// Local constraints after Parish and Mueller, "Procedural modeling of cities", 2001, section 3.3: crossings end
// a road at a new node, near nodes and roads are joined, and what fits nowhere fails.
#include "core/generators/city/network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/math.h"

namespace seedmesh::city {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
/// The box of a removed edge, which meets no other one.
constexpr EdgeBox nowhere = {0x7FFFFFFF, 0x7FFFFFFF, -0x7FFFFFFF, -0x7FFFFFFF};

double dot(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.x + a.y * b.y; }
double turn(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
double length_of(const glm::dvec2& v) { return std::sqrt(dot(v, v)); }

/// The cosine of the angle at `o` between two points.
double cosine(const CmPoint& o, const CmPoint& a, const CmPoint& b) {
  const glm::dvec2 u = in_cm(a) - in_cm(o), v = in_cm(b) - in_cm(o);
  return dot(u, v) / (length_of(u) * length_of(v));
}

}  // namespace

std::uint32_t Network::add_node(const CmPoint& p) {
  nodes_.push_back(p);
  arms_.emplace_back();
  return static_cast<std::uint32_t>(nodes_.size()) - 1;
}

/// Calls `visit` with each edge whose box meets the box around a segment, grown by a distance, until it returns false.
/// What lies outside is farther than that from the segment. Returns whether all calls returned true.
template <class Visit>
bool Network::each_near(const glm::dvec2& a, const glm::dvec2& b, double distance, const Visit& visit) const {
  const glm::dvec2 low = glm::ceil(glm::min(a, b) - glm::dvec2(distance)),
                   high = glm::floor(glm::max(a, b) + glm::dvec2(distance));
  const EdgeBox reach = {math::to_int32(low.x), math::to_int32(low.y), math::to_int32(high.x),
                         math::to_int32(high.y)};
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  for (std::uint32_t e = 0; e < count; ++e) {
    const EdgeBox& box = boxes_[e];
    if (box.high_x < reach.low_x || box.low_x > reach.high_x || box.high_y < reach.low_y ||
        box.low_y > reach.high_y)
      continue;
    if (!visit(e)) return false;
  }
  return true;
}

std::uint32_t Network::add_edge(std::uint32_t from, std::uint32_t to, EdgeClass kind, bool is_fixed) {
  const auto edge = static_cast<std::uint32_t>(edges_.size());
  edges_.push_back({from, to, kind, is_fixed, false});
  const CmPoint &a = nodes_[from], &b = nodes_[to];
  boxes_.push_back({std::min(a.x, b.x), std::min(a.y, b.y), std::max(a.x, b.x), std::max(a.y, b.y)});
  arms_[from].push_back(edge);
  arms_[to].push_back(edge);
  return edge;
}

void Network::remove_edge(std::uint32_t edge) {
  NetworkEdge& each = edges_[edge];
  each.is_removed = true;
  boxes_[edge] = nowhere;
  std::erase(arms_[each.from], edge);
  std::erase(arms_[each.to], edge);
}

std::optional<Network::Hit> Network::first_hit(std::uint32_t from, const glm::dvec2& end) const {
  const glm::dvec2 start = in_cm(nodes_[from]), along = end - start;
  std::optional<Hit> best;
  each_near(start, end, 0, [&](std::uint32_t e) {
    const NetworkEdge& edge = edges_[e];
    if (edge.from == from || edge.to == from) return true;
    const glm::dvec2 a = in_cm(nodes_[edge.from]), b = in_cm(nodes_[edge.to]);
    const glm::dvec2 across = b - a;
    const double scale = turn(along, across);
    if (scale == 0) return true;
    const double share = turn(a - start, across) / scale, at = turn(a - start, along) / scale;
    if (share <= 0 || share > 1 || at < 0 || at > 1) return true;
    if (!best || share < best->share) best = Hit{e, share, start + along * share};
    return true;
  });
  return best;
}

std::optional<std::uint32_t> Network::nearest_node(std::uint32_t from, const glm::dvec2& end) const {
  std::optional<std::uint32_t> best;
  double least = limits_.snap * limits_.snap;
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    if (n == from || arms_[n].empty()) continue;
    const glm::dvec2 off = in_cm(nodes_[n]) - end;
    const double d = dot(off, off);
    if (d < least) {
      least = d;
      best = n;
    }
  }
  return best;
}

bool Network::keeps_angles(std::uint32_t node, const CmPoint& towards) const {
  for (const std::uint32_t arm : arms_[node]) {
    const NetworkEdge& edge = edges_[arm];
    const double most = !is_street_class(edge.kind) ? limits_.cos_border_angle : limits_.cos_minimal_angle;
    const CmPoint& other = nodes_[edge.from == node ? edge.to : edge.from];
    const double between = cosine(nodes_[node], other, towards);
    if (other == towards || between > most) return false;
    // A kerb has to reach the border beside the street.
    if (!is_street_class(edge.kind) && between < -0.87) return false;
  }
  return true;
}

/// Whether the edge from a node to `to` may be built. `target` is the node there, or none; `split` is the edge
/// on which a new node at `to` would lie, or none.
bool Network::may_link(std::uint32_t from, const CmPoint& to, std::uint32_t target,
                       std::uint32_t split) const {
  const CmPoint& start = nodes_[from];
  if (distance(start, to) < limits_.least_length || !keeps_angles(from, to)) return false;
  if (target != none && (is_closed(target) || !keeps_angles(target, start))) return false;
  if (split != none) {
    const NetworkEdge& edge = edges_[split];
    const CmPoint &a = nodes_[edge.from], &b = nodes_[edge.to];
    const double most = !is_street_class(edge.kind) ? limits_.cos_border_angle : limits_.cos_minimal_angle;
    if (distance(to, a) < limits_.least_length || distance(to, b) < limits_.least_length) return false;
    if (cosine(to, a, start) > most || cosine(to, b, start) > most) return false;
  }
  const glm::dvec2 p = in_cm(start), q = in_cm(to);
  return each_near(p, q, limits_.beside + 1, [&](std::uint32_t e) {
    if (e == split) return true;
    const NetworkEdge& edge = edges_[e];
    const CmPoint &a = nodes_[edge.from], &b = nodes_[edge.to];
    const bool at_start = edge.from == from || edge.to == from;
    const bool at_end = target != none && (edge.from == target || edge.to == target);
    if (!at_start && !at_end && segments_meet(start, to, a, b)) return false;
    for (const std::uint32_t n : {edge.from, edge.to}) {
      if (n != from && n != target && distance_to_segment(in_cm(nodes_[n]), p, q) < limits_.beside)
        return false;
    }
    // Neither end of the new edge may lie beside an edge that it does not join.
    return at_end || target != none || at_start ||
           distance_to_segment(q, in_cm(a), in_cm(b)) >= limits_.beside;
  });
}

void Network::split(std::uint32_t edge, std::uint32_t node) {
  const NetworkEdge old = edges_[edge];
  remove_edge(edge);
  add_edge(old.from, node, old.kind, false);
  add_edge(node, old.to, old.kind, false);
}

PieceResult Network::join_edge(std::uint32_t from, const Hit& hit, EdgeClass kind) {
  const NetworkEdge edge = edges_[hit.edge];
  if (edge.kind == EdgeClass::shore) return {};
  std::array<std::uint32_t, 2> ends = {edge.from, edge.to};
  const auto off = [&](std::uint32_t n) { return length_of(in_cm(nodes_[n]) - hit.at); };
  if (off(ends[1]) < off(ends[0])) std::swap(ends[0], ends[1]);
  for (const std::uint32_t end : ends) {
    if (!edge.is_fixed && off(end) > limits_.snap / 2) continue;
    if (end == from || !may_link(from, nodes_[end], end, none)) continue;
    add_edge(from, end, kind, false);
    return {PieceState::joined, end};
  }
  if (edge.is_fixed) return {};
  const CmPoint at = rounded_cm(hit.at);
  if (!may_link(from, at, none, hit.edge)) return {};
  const std::uint32_t node = add_node(at);
  split(hit.edge, node);
  add_edge(from, node, kind, false);
  return {PieceState::joined, node};
}

bool Network::is_free(std::uint32_t from, const glm::dvec2& end) const {
  return each_near(end, end, limits_.clearance + 1, [&](std::uint32_t e) {
    const NetworkEdge& edge = edges_[e];
    return edge.from == from || edge.to == from ||
           distance_to_segment(end, in_cm(nodes_[edge.from]), in_cm(nodes_[edge.to])) >= limits_.clearance;
  });
}

PieceResult Network::build_piece(std::uint32_t from, const glm::dvec2& end, EdgeClass kind) {
  const glm::dvec2 start = in_cm(nodes_[from]), along = end - start;
  const double length = length_of(along);
  const glm::dvec2 reach = end + along * (limits_.snap / length);
  if (const auto hit = first_hit(from, reach)) return join_edge(from, *hit, kind);
  if (const auto node = nearest_node(from, end)) {
    if (!may_link(from, nodes_[*node], *node, none)) return {};
    add_edge(from, *node, kind, false);
    return {PieceState::joined, *node};
  }
  const CmPoint at = rounded_cm(end);
  if (!is_free(from, in_cm(at)) || !may_link(from, at, none, none)) return {};
  const std::uint32_t node = add_node(at);
  add_edge(from, node, kind, false);
  return {PieceState::free, node};
}

PieceResult Network::build_to_road(std::uint32_t from, const glm::dvec2& direction, double reach,
                                   EdgeClass kind) {
  const auto hit = first_hit(from, in_cm(nodes_[from]) + direction * reach);
  return hit ? join_edge(from, *hit, kind) : PieceResult{};
}

}  // namespace seedmesh::city
