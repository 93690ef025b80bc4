// Insertion of segments by snap rounding; see planar_graph.h.
#include "core/geom/polygon/planar_graph.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

/// A segment that passes this near to a node, in centimetres, runs through it: half the diagonal of a square
/// of one centimetre, so that every rounded crossing is caught.
constexpr double pixel = 0.7072;

std::uint64_t cell_key(std::int32_t x, std::int32_t y) {
  return (std::uint64_t{static_cast<std::uint32_t>(x)} << 32U) | static_cast<std::uint32_t>(y);
}

std::int32_t floor_divide(std::int32_t value, std::int32_t by) {
  const std::int32_t quotient = value / by;
  return quotient * by > value ? quotient - 1 : quotient;
}

/// The share of a b at which `p` projects.
double share_along(const CmPoint& p, const CmPoint& a, const CmPoint& b) {
  const glm::dvec2 along = in_cm(b) - in_cm(a), from = in_cm(p) - in_cm(a);
  return (along.x * from.x + along.y * from.y) / (along.x * along.x + along.y * along.y);
}

/// Whether the segment a b passes within a pixel of `p`, which is none of its ends.
bool passes(const CmPoint& p, const CmPoint& a, const CmPoint& b) {
  if (p == a || p == b) return false;
  const double share = share_along(p, a, b);
  if (!(share > 0 && share < 1)) return false;
  const double off = static_cast<double>(cross(a, b, p)) / distance(a, b);
  return std::abs(off) < pixel;
}

CmPoint crossing_of(const CmPoint& a, const CmPoint& b, const CmPoint& c, const CmPoint& d) {
  const auto left = static_cast<double>(cross(c, d, a)), right = static_cast<double>(cross(c, d, b));
  return rounded_cm(in_cm(a) + (in_cm(b) - in_cm(a)) * (left / (left - right)));
}

}  // namespace

template <class Visit>
void PlanarGraph::visit_cells(const CmPoint& a, const CmPoint& b, const Visit& visit) const {
  const std::int32_t west = floor_divide(std::min(a.x, b.x) - 1, cell_);
  const std::int32_t east = floor_divide(std::max(a.x, b.x) + 1, cell_);
  for (std::int32_t x = west; x <= east; ++x) {
    // Only the part of the segment within this column counts.
    double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
    if (west != east && a.x != b.x) {
      const double slope = (static_cast<double>(b.y) - a.y) / (static_cast<double>(b.x) - a.x);
      const double start = a.y + slope * (static_cast<double>(x) * cell_ - 1 - a.x);
      const double end = a.y + slope * ((static_cast<double>(x) + 1) * cell_ + 1 - a.x);
      low = std::max(low, std::min(start, end));
      high = std::min(high, std::max(start, end));
    }
    const std::int32_t south = floor_divide(math::to_int32(std::floor(low)) - 1, cell_);
    const std::int32_t north = floor_divide(math::to_int32(std::ceil(high)) + 1, cell_);
    for (std::int32_t y = south; y <= north; ++y) visit(cell_key(x, y));
  }
}

void PlanarGraph::add(const CmPoint& a, const CmPoint& b, std::uint32_t tag) {
  pending_.push_back({a, b, tag});
  run();
}

std::uint32_t PlanarGraph::node_at(const CmPoint& p) {
  const std::uint32_t node = add_node(p);
  run();
  return node;
}

void PlanarGraph::run() {
  while (!pending_.empty()) {
    const Piece piece = pending_.back();
    pending_.pop_back();
    insert(piece);
  }
}

void PlanarGraph::insert(const Piece& piece) {
  if (piece.a == piece.b) return;
  add_node(piece.a);
  add_node(piece.b);
  if (route_through_node(piece) || split_at_crossing(piece)) return;
  add_edge(piece);
}

std::uint32_t PlanarGraph::add_node(const CmPoint& p) {
  const std::uint64_t key = cell_key(floor_divide(p.x, cell_), floor_divide(p.y, cell_));
  for (const std::uint32_t node : cells_[key].nodes) {
    if (nodes_[node] == p) return node;
  }
  const auto node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(p);
  cells_[key].nodes.push_back(node);
  split_edges_at(p);
  return node;
}

void PlanarGraph::split_edges_at(const CmPoint& p) {
  std::vector<std::uint32_t> through;
  visit_cells(p, p, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const std::uint32_t edge : cell->second.edges) {
      const PlanarEdge& each = edges_[edge];
      if (!each.is_removed() && passes(p, nodes_[each.from], nodes_[each.to])) through.push_back(edge);
    }
  });
  for (const std::uint32_t edge : through) {
    if (!edges_[edge].is_removed()) split(edge, p);
  }
}

void PlanarGraph::split(std::uint32_t edge, const CmPoint& p) {
  const PlanarEdge each = edges_[edge];
  remove(edge);
  pending_.push_back({nodes_[each.from], p, each.tag});
  pending_.push_back({p, nodes_[each.to], each.tag});
}

bool PlanarGraph::route_through_node(const Piece& piece) {
  const CmPoint* nearest = nullptr;
  double share = 2;
  visit_cells(piece.a, piece.b, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const std::uint32_t node : cell->second.nodes) {
      const CmPoint& p = nodes_[node];
      if (!passes(p, piece.a, piece.b)) continue;
      const double here = share_along(p, piece.a, piece.b);
      if (here < share || (here == share && p < *nearest)) {
        share = here;
        nearest = &p;
      }
    }
  });
  if (!nearest) return false;
  const CmPoint at = *nearest;
  pending_.push_back({at, piece.b, piece.tag});
  pending_.push_back({piece.a, at, piece.tag});
  return true;
}

bool PlanarGraph::split_at_crossing(const Piece& piece) {
  std::uint32_t crossed = PlanarEdge::removed;
  visit_cells(piece.a, piece.b, [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const std::uint32_t edge : cell->second.edges) {
      const PlanarEdge& each = edges_[edge];
      if (!each.is_removed() && edge < crossed &&
          cross_properly(piece.a, piece.b, nodes_[each.from], nodes_[each.to]))
        crossed = edge;
    }
  });
  if (crossed == PlanarEdge::removed) return false;
  const PlanarEdge other = edges_[crossed];
  const CmPoint at = crossing_of(piece.a, piece.b, nodes_[other.from], nodes_[other.to]);
  pending_.push_back({piece.a, at, piece.tag});
  pending_.push_back({at, piece.b, piece.tag});
  if (at != nodes_[other.from] && at != nodes_[other.to]) split(crossed, at);
  add_node(at);
  return true;
}

void PlanarGraph::add_edge(const Piece& piece) {
  const std::uint32_t from = add_node(piece.a), to = add_node(piece.b);
  const std::uint64_t home = cell_key(floor_divide(piece.a.x, cell_), floor_divide(piece.a.y, cell_));
  for (const std::uint32_t edge : cells_[home].edges) {
    const PlanarEdge& each = edges_[edge];
    if ((each.from == from && each.to == to) || (each.from == to && each.to == from)) return;
  }
  const auto edge = static_cast<std::uint32_t>(edges_.size());
  edges_.push_back({from, to, piece.tag});
  visit_cells(piece.a, piece.b, [&](std::uint64_t key) { cells_[key].edges.push_back(edge); });
}

void PlanarGraph::remove(std::uint32_t edge) {
  PlanarEdge& each = edges_[edge];
  visit_cells(nodes_[each.from], nodes_[each.to], [&](std::uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell != cells_.end()) std::erase(cell->second.edges, edge);
  });
  each.from = each.to = PlanarEdge::removed;
}

}  // namespace seedmesh
