// Events at one time; see wavefront.h.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/disjoint_sets.h"
#include "core/geom/polygon/near_groups.h"
#include "core/geom/polygon/wavefront.h"

namespace seedmesh {
namespace {

using glm::dvec2;

double distance(const dvec2& a, const dvec2& b) {
  const dvec2 d = a - b;
  return std::sqrt(d.x * d.x + d.y * d.y);
}

}  // namespace

/// All corners and positions on edges that take part in the events. `first` groups those at the same
/// position: those that an event joins, and those nearer than the tolerance.
std::vector<Wavefront::Touch> Wavefront::touches_of(const std::vector<Event>& batch) const {
  std::vector<Touch> touches;
  std::map<std::uint32_t, std::uint32_t> number;
  DisjointSets sets;
  const auto add = [&](const Touch& touch) {
    touches.push_back(touch);
    return sets.add();
  };
  const auto add_corner = [&](std::uint32_t corner) {
    const auto [found, is_new] = number.try_emplace(corner, static_cast<std::uint32_t>(touches.size()));
    if (is_new) add({position_of(corner), corner, none, 0});
    return found->second;
  };
  for (const Event& event : batch) {
    const Edge& edge = edges_[event.edge];
    if (event.corner == none) {
      sets.join(add_corner(edge.start), add_corner(edge.end));
      continue;
    }
    const std::uint32_t hit = add_corner(event.corner);
    const dvec2 position = touches[hit].position;
    bool is_at_end = false;
    for (const std::uint32_t end : {edge.start, edge.end}) {
      if (distance(position, position_of(end)) > near_) continue;
      sets.join(hit, add_corner(end));
      is_at_end = true;
    }
    if (!is_at_end) sets.join(hit, add({position, none, event.edge, 0}));
  }
  // Shrinking edges shorter than the tolerance beside an event end with it. Otherwise a front that shrinks to one
  // point would take thousands of events there, whose times differ by rounding errors alone.
  const std::size_t seeds = touches.size();
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    if (touches[seed].corner == none) continue;
    const dvec2 position = touches[seed].position;
    for (const bool forward : {true, false}) {
      for (std::uint32_t at = touches[seed].corner;;) {
        const Edge& edge = edges_[forward ? corners_[at].out : corners_[at].in];
        at = forward ? edge.end : edge.start;
        if (!std::isfinite(edge.until) || distance(position, position_of(at)) > near_ || number.contains(at))
          break;
        sets.join(seed, add_corner(at));
      }
    }
  }
  std::vector<glm::dvec3> positions;
  for (const Touch& touch : touches) positions.emplace_back(touch.position, 0.0);
  const std::vector<std::uint32_t> group = near_groups(positions, near_, job_);
  for (std::uint32_t i = 0; i < touches.size(); ++i) sets.join(i, group[i]);
  for (std::uint32_t i = 0; i < touches.size(); ++i) touches[i].first = sets.of(i);
  return touches;
}

/// Adds a node for each group, at the mean of its positions; `first` becomes its number.
void Wavefront::name_nodes(std::vector<Touch>& touches) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> positions;
  for (std::uint32_t i = 0; i < touches.size(); ++i) positions[touches[i].first].push_back(i);
  for (const auto& [first, members] : positions) {
    dvec2 middle{0};
    for (const std::uint32_t i : members) middle += touches[i].position;
    const std::uint32_t node = add_node(middle / static_cast<double>(members.size()));
    for (const std::uint32_t i : members) touches[i].first = node;
  }
}

void Wavefront::resolve(const std::vector<Event>& batch) {
  std::vector<Touch> touches = touches_of(batch);
  name_nodes(touches);
  std::map<std::uint32_t, std::vector<std::uint32_t>> cuts;
  for (const Touch& touch : touches) {
    if (touch.corner != none) {
      end_corner(touch.corner, touch.first);
    } else {
      cuts[touch.edge].push_back(touch.first);
    }
  }
  for (auto& [edge, at] : cuts) split(edge, at);
}

void Wavefront::end_corner(std::uint32_t corner, std::uint32_t node) {
  Corner& c = corners_[corner];
  if (!c.is_alive) return;
  c.is_alive = false;
  borders.push_back({edges_[c.in].source, c.node, node});
  borders.push_back({edges_[c.out].source, node, c.node});
  open_end(c.in, false, node);
  open_end(c.out, true, node);
}

void Wavefront::open_end(std::uint32_t edge, bool at_start, std::uint32_t node) {
  Edge& e = edges_[edge];
  (at_start ? e.start : e.end) = none;
  (at_start ? e.start_node : e.end_node) = node;
  ++e.version;
  if (!e.is_open) open_.push_back(edge);
  e.is_open = true;
  touch(edge);
}

void Wavefront::touch(std::uint32_t edge) {
  if (!edges_[edge].is_touched) touched_.push_back(edge);
  edges_[edge].is_touched = true;
}

/// Cuts an edge at nodes. The edge becomes the first of the pieces.
void Wavefront::split(std::uint32_t edge, const std::vector<std::uint32_t>& at) {
  const dvec2 along = source(edge).direction;
  std::vector<std::uint32_t> order = at;
  std::sort(order.begin(), order.end());
  order.erase(std::unique(order.begin(), order.end()), order.end());
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return glm::dot(along, dvec2(nodes[a])) < glm::dot(along, dvec2(nodes[b]));
  });
  for (auto node = order.rbegin(); node != order.rend(); ++node) {
    const auto rest = static_cast<std::uint32_t>(edges_.size());
    Edge piece;
    piece.source = edges_[edge].source;
    piece.start_node = *node;
    piece.end = edges_[edge].end;
    piece.end_node = edges_[edge].end_node;
    piece.is_open = true;
    edges_.push_back(piece);
    open_.push_back(rest);
    front_.push_back(rest);
    touch(rest);
    if (piece.end != none) corners_[piece.end].in = rest;
    open_end(edge, false, *node);
  }
}

}  // namespace seedmesh
