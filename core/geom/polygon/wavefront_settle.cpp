// Joining the open ends of the outline; see wavefront.h.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "core/geom/polygon/wavefront.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// If the sum of two normals is smaller, the edges lie on each other in opposite directions.
constexpr double opposite_lines = 1e-9;
// Rays with a smaller angle between them, in quarter turns, have the same direction.
constexpr double same_ray = 1e-9;

double distance(const dvec2& a, const dvec2& b) {
  const dvec2 d = a - b;
  return std::sqrt(d.x * d.x + d.y * d.y);
}

/// A monotonic function of the angle of a direction, from 0 to 4.
double quarter_turns(const dvec2& d) {
  const double share = d.y / (std::abs(d.x) + std::abs(d.y));
  if (d.x < 0) return 2 - share;
  return d.y < 0 ? 4 + share : share;
}

}  // namespace

/// Joins all open ends. False: this does not terminate. Each round looks only at what the round before has
/// changed.
bool Wavefront::settle() {
  const std::size_t most_rounds = 64 + 8 * open_.size();
  bool is_closed = false;
  for (std::size_t round = 0; round < most_rounds && !is_closed; ++round) {
    take_touched();
    find_joints();
    if (closing_nodes_.empty()) {
      is_closed = true;
      continue;
    }
    const std::vector<Joint>& joints = joints_[*closing_nodes_.begin()];
    const Joint closing = *std::find_if(joints.begin(), joints.end(),
                                        [&](const Joint& joint) { return is_closing(joint.in, joint.out); });
    zip(closing.in, closing.out, closing.node);
  }
  for (const std::uint32_t edge : open_) edges_[edge].listed_start = edges_[edge].listed_end = none;
  ends_.clear();
  spans_.clear();
  const auto found = std::move(joints_);
  joints_.clear();
  if (!is_closed) return false;
  for (const auto& [node, joints] : found) {
    for (const Joint& joint : joints) join(joint.in, joint.out, joint.node);
  }
  return true;
}

/// Removes changed edges without a length, and lists the open ends of the others.
void Wavefront::take_touched() {
  std::set<std::pair<std::uint32_t, std::uint32_t>> changed_spans;
  for (const std::uint32_t edge : touched_) {
    Edge& e = edges_[edge];
    e.is_touched = false;
    unlist(edge);
    if (e.start == none && e.end == none && e.start_node == e.end_node) e.is_alive = false;
    if (!e.is_alive) continue;
    if (e.start == none) {
      e.listed_start = e.start_node;
      ends_[e.start_node].insert(2 * edge + 1);
      changed_nodes_.insert(e.start_node);
    }
    if (e.end == none) {
      e.listed_end = e.end_node;
      ends_[e.end_node].insert(2 * edge);
      changed_nodes_.insert(e.end_node);
    }
    if (e.start != none || e.end != none) continue;
    const std::pair<std::uint32_t, std::uint32_t> span = std::minmax(e.start_node, e.end_node);
    spans_[span].insert(edge);
    changed_spans.insert(span);
    count_comparisons(32);
  }
  touched_.clear();
  for (const auto& span : changed_spans) cancel_opposites(span);
}

void Wavefront::unlist(std::uint32_t edge) {
  Edge& e = edges_[edge];
  if (e.listed_start != none && e.listed_end != none) {
    const auto span = spans_.find(std::minmax(e.listed_start, e.listed_end));
    if (span != spans_.end()) span->second.erase(edge);
  }
  if (e.listed_start != none) {
    ends_[e.listed_start].erase(2 * edge + 1);
    changed_nodes_.insert(e.listed_start);
  }
  if (e.listed_end != none) {
    ends_[e.listed_end].erase(2 * edge);
    changed_nodes_.insert(e.listed_end);
  }
  e.listed_start = e.listed_end = none;
}

/// Removes pairs of edges between the same nodes in opposite directions: they have met as a ridge.
void Wavefront::cancel_opposites(const std::pair<std::uint32_t, std::uint32_t>& span) {
  const std::set<std::uint32_t>& found = spans_[span];
  const std::vector<std::uint32_t> edges(found.begin(), found.end());
  const auto is_up = [&](std::uint32_t edge) { return edges_[edge].start_node < edges_[edge].end_node; };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!edges_[edges[i]].is_alive) continue;
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (is_up(edges[k]) == is_up(edges[i]) || !edges_[edges[k]].is_alive) continue;
      for (const std::uint32_t edge : {edges[i], edges[k]}) {
        Edge& e = edges_[edge];
        e.is_alive = false;
        borders.push_back({e.source, e.end_node, e.start_node});
        unlist(edge);
      }
      break;
    }
  }
}

/// Pairs the open ends at nodes where they have changed.
void Wavefront::find_joints() {
  for (const std::uint32_t node : changed_nodes_) {
    joints_.erase(node);
    closing_nodes_.erase(node);
    const std::set<std::uint32_t>& rays = ends_[node];
    if (rays.empty()) continue;
    std::vector<Joint>& joints = joints_[node];
    match_rays_around(node, rays, joints);
    count_comparisons(32 * rays.size());
    if (std::any_of(joints.begin(), joints.end(),
                    [&](const Joint& joint) { return is_closing(joint.in, joint.out); }))
      closing_nodes_.insert(node);
  }
  changed_nodes_.clear();
}

/// Joins the ends at a node. Around it, the inside lies counter-clockwise from an edge that begins to one
/// that ends.
void Wavefront::match_rays_around(std::uint32_t node, const std::set<std::uint32_t>& rays,
                                  std::vector<Joint>& joints) const {
  struct Ray {
    double angle;
    std::uint32_t edge;
    bool begins;
  };
  std::vector<Ray> round;
  for (const std::uint32_t ray : rays) {
    const bool begins = ray % 2 == 1;
    const dvec2 direction = source(ray / 2).direction;
    round.push_back({quarter_turns(begins ? direction : -direction), ray / 2, begins});
  }
  if (round.size() == 2) {
    const bool is_first = round[0].begins;
    joints.push_back({round[is_first ? 1 : 0].edge, round[is_first ? 0 : 1].edge, node});
    return;
  }
  std::sort(round.begin(), round.end(), [](const Ray& a, const Ray& b) {
    return std::tie(a.angle, b.begins, a.edge) < std::tie(b.angle, a.begins, b.edge);
  });
  const std::size_t count = round.size();
  // Two edges on one ray enclose the inside with width 0, because the outside only grows.
  for (std::size_t i = 0; i < count; ++i) {
    Ray &a = round[i], &b = round[(i + 1) % count];
    const double gap = b.angle - a.angle + (i + 1 == count ? 4 : 0);
    if (!a.begins && b.begins && gap < same_ray) std::swap(a, b);
  }
  // Matched like brackets, from a start where no bracket closes too early.
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
      joints.push_back({ray.edge, begun.back(), node});
      begun.pop_back();
    }
  }
}

/// Whether there is no space between two joined edges.
bool Wavefront::is_closing(std::uint32_t in, std::uint32_t out) const {
  if (edges_[in].start != none && edges_[in].start == edges_[out].end) return true;
  const dvec2 sum = source(in).normal + source(out).normal;
  return glm::dot(sum, sum) < opposite_lines * opposite_lines;
}

/// Opens the nearer of the far ends of two edges that lie on each other, and cuts the other edge there.
void Wavefront::zip(std::uint32_t in, std::uint32_t out, std::uint32_t node) {
  const dvec2 position(nodes[node]), a = far_position(in, true), b = far_position(out, false);
  const double long_in = distance(a, position), long_out = distance(b, position);
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
