// What happens at one time: see wavefront.h.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <tuple>

#include "core/geom/wavefront.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// Sums of normals below this are those of two edges that lie on each other.
constexpr double opposite_lines = 1e-9;
// Rays nearer than this, in quarters of a turn, point the same way.
constexpr double same_ray = 1e-9;

double distance(const dvec2& a, const dvec2& b) {
  const dvec2 d = a - b;
  return std::sqrt(d.x * d.x + d.y * d.y);
}

/// Rises with the angle of a direction, from 0 to 4; exact arithmetic but for one division.
double quarter_turns(const dvec2& d) {
  const double share = d.y / (std::abs(d.x) + std::abs(d.y));
  if (d.x < 0) return 2 - share;
  return d.y < 0 ? 4 + share : share;
}

std::uint32_t first_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void unite(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
  a = first_of(parent, a);
  b = first_of(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
}

}  // namespace

/// All corners and places on edges that the events bring together, with `first` naming those that are one
/// place: what an event joins, and what is as near as makes no difference.
std::vector<Wavefront::Touch> Wavefront::touches_of(const std::vector<Event>& batch) const {
  std::vector<Touch> touches;
  std::map<std::uint32_t, std::uint32_t> number;
  std::vector<std::uint32_t> parent;
  const auto add = [&](const Touch& touch) {
    touches.push_back(touch);
    parent.push_back(static_cast<std::uint32_t>(parent.size()));
    return parent.back();
  };
  const auto add_corner = [&](std::uint32_t corner) {
    const auto [found, is_new] = number.try_emplace(corner, static_cast<std::uint32_t>(touches.size()));
    if (is_new) add({place_of(corner), corner, none, 0});
    return found->second;
  };
  for (const Event& event : batch) {
    const Edge& edge = edges_[event.edge];
    if (event.corner == none) {
      unite(parent, add_corner(edge.start), add_corner(edge.end));
      continue;
    }
    const std::uint32_t hit = add_corner(event.corner);
    const dvec2 place = touches[hit].place;
    bool is_at_end = false;
    for (const std::uint32_t end : {edge.start, edge.end}) {
      if (distance(place, place_of(end)) > near_) continue;
      unite(parent, hit, add_corner(end));
      is_at_end = true;
    }
    if (!is_at_end) unite(parent, hit, add({place, none, event.edge, 0}));
  }
  std::vector<std::uint32_t> order(touches.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair{touches[a].place.x, a} < std::pair{touches[b].place.x, b};
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      if (touches[order[k]].place.x - touches[order[i]].place.x > near_) break;
      if (distance(touches[order[i]].place, touches[order[k]].place) <= near_)
        unite(parent, order[i], order[k]);
    }
  }
  for (std::uint32_t i = 0; i < touches.size(); ++i) touches[i].first = first_of(parent, i);
  return touches;
}

/// Makes a node of each place, in the middle of what meets there; `first` becomes its number.
void Wavefront::name_nodes(std::vector<Touch>& touches) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> places;
  for (std::uint32_t i = 0; i < touches.size(); ++i) places[touches[i].first].push_back(i);
  for (const auto& [first, members] : places) {
    dvec2 middle{0};
    for (const std::uint32_t i : members) middle += touches[i].place;
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
}

/// Cuts an edge at nodes; it stays the first of the pieces.
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
    if (piece.end != none) corners_[piece.end].in = rest;
    open_end(edge, false, *node);
  }
}

/// Joins all open ends. False where that does not come to an end.
bool Wavefront::settle() {
  const std::size_t most_rounds = 64 + 8 * open_.size();
  for (std::size_t round = 0; round < most_rounds; ++round) {
    drop_nothing();
    cancel_opposites();
    find_joints();
    const auto closing = std::find_if(joints_.begin(), joints_.end(),
                                      [&](const Joint& joint) { return is_closing(joint.in, joint.out); });
    if (closing == joints_.end()) {
      const std::vector<Joint> found = joints_;
      for (const Joint& joint : found) join(joint.in, joint.out, joint.node);
      return true;
    }
    zip(closing->in, closing->out, closing->node);
  }
  return false;
}

void Wavefront::drop_nothing() {
  for (const std::uint32_t edge : open_) {
    Edge& e = edges_[edge];
    if (e.start == none && e.end == none && e.start_node == e.end_node) e.is_alive = false;
  }
}

/// Two edges between the same nodes, one there and one back, have met along their whole length: a ridge.
void Wavefront::cancel_opposites() {
  struct Span {
    std::uint32_t low, high, edge;
    bool is_up;
  };
  std::vector<Span> spans;
  for (const std::uint32_t edge : open_) {
    const Edge& e = edges_[edge];
    if (!e.is_alive || e.start != none || e.end != none) continue;
    spans.push_back({std::min(e.start_node, e.end_node), std::max(e.start_node, e.end_node), edge,
                     e.start_node < e.end_node});
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
    return std::tie(a.low, a.high, a.edge) < std::tie(b.low, b.high, b.edge);
  });
  for (std::size_t i = 0; i < spans.size(); ++i) {
    if (!edges_[spans[i].edge].is_alive) continue;
    for (std::size_t k = i + 1; k < spans.size(); ++k) {
      if (spans[k].low != spans[i].low || spans[k].high != spans[i].high) break;
      if (spans[k].is_up == spans[i].is_up || !edges_[spans[k].edge].is_alive) continue;
      for (const Span& span : {spans[i], spans[k]}) {
        Edge& e = edges_[span.edge];
        e.is_alive = false;
        borders.push_back({e.source, e.end_node, e.start_node});
      }
      break;
    }
  }
}

void Wavefront::find_joints() {
  joints_.clear();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rays;  // node, and twice the edge, odd where it begins
  for (const std::uint32_t edge : open_) {
    const Edge& e = edges_[edge];
    if (!e.is_alive) continue;
    if (e.end == none) rays.emplace_back(e.end_node, 2 * edge);
    if (e.start == none) rays.emplace_back(e.start_node, 2 * edge + 1);
  }
  std::sort(rays.begin(), rays.end());
  for (std::size_t i = 0; i < rays.size();) {
    std::size_t next = i;
    while (next < rays.size() && rays[next].first == rays[i].first) ++next;
    pair_round(rays[i].first, std::span(rays).subspan(i, next - i));
    i = next;
  }
}

/// Round a place the inside lies counter-clockwise from an edge that begins to one that ends.
void Wavefront::pair_round(std::uint32_t node,
                           std::span<const std::pair<std::uint32_t, std::uint32_t>> rays) {
  struct Ray {
    double angle;
    std::uint32_t edge;
    bool begins;
  };
  std::vector<Ray> round;
  for (const auto& [at, ray] : rays) {
    const bool begins = ray % 2 == 1;
    const dvec2 direction = source(ray / 2).direction;
    round.push_back({quarter_turns(begins ? direction : -direction), ray / 2, begins});
  }
  if (round.size() == 2) {
    const bool is_first = round[0].begins;
    joints_.push_back({round[is_first ? 1 : 0].edge, round[is_first ? 0 : 1].edge, node});
    return;
  }
  std::sort(round.begin(), round.end(), [](const Ray& a, const Ray& b) {
    return std::tie(a.angle, b.begins, a.edge) < std::tie(b.angle, a.begins, b.edge);
  });
  const std::size_t count = round.size();
  // Edges on one ray enclose the inside, without width: outside grows and cannot be so narrow.
  for (std::size_t i = 0; i < count; ++i) {
    Ray &a = round[i], &b = round[(i + 1) % count];
    const double gap = b.angle - a.angle + (i + 1 == count ? 4 : 0);
    if (!a.begins && b.begins && gap < same_ray) std::swap(a, b);
  }
  // Matched like brackets, from where they never close too many.
  std::ptrdiff_t depth = 0, least = 0;
  std::size_t from = 0;
  for (std::size_t i = 0; i < count; ++i) {
    depth += round[i].begins ? 1 : -1;
    if (depth < least) {
      least = depth;
      from = i + 1;
    }
  }
  std::vector<std::uint32_t> begun;
  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = round[(from + i) % count];
    if (ray.begins) {
      begun.push_back(ray.edge);
    } else if (!begun.empty()) {
      joints_.push_back({ray.edge, begun.back(), node});
      begun.pop_back();
    }
  }
}

/// Whether nothing is left between two joined edges.
bool Wavefront::is_closing(std::uint32_t in, std::uint32_t out) const {
  if (edges_[in].start != none && edges_[in].start == edges_[out].end) return true;
  const dvec2 sum = source(in).normal + source(out).normal;
  return glm::dot(sum, sum) < opposite_lines * opposite_lines;
}

/// Opens the nearer one of the far ends of two edges that lie on each other, and cuts the other edge there.
void Wavefront::zip(std::uint32_t in, std::uint32_t out, std::uint32_t node) {
  const dvec2 place(nodes[node]), a = far_place(in, true), b = far_place(out, false);
  const double long_in = distance(a, place), long_out = distance(b, place);
  const std::uint32_t in_far = edges_[in].start, out_far = edges_[out].end;
  const bool are_equal = std::abs(long_in - long_out) <= near_ || (in_far != none && in_far == out_far);
  if (are_equal && (in_far != none || out_far != none)) {
    std::uint32_t far = in_far == none ? edges_[in].start_node : edges_[out].end_node;
    if (in_far != none && out_far != none) far = add_node(0.5 * (a + b));
    if (in_far != none) end_corner(in_far, far);
    if (out_far != none) end_corner(out_far, far);
  } else if (long_in < long_out) {
    const std::uint32_t far = in_far != none ? add_node(a) : edges_[in].start_node;
    if (in_far != none) end_corner(in_far, far);
    split(out, {far});
  } else {
    const std::uint32_t far = out_far != none ? add_node(b) : edges_[out].end_node;
    if (out_far != none) end_corner(out_far, far);
    split(in, {far});
  }
}

}  // namespace seedmesh
