#include "core/geom/polygon/wavefront.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seedmesh {
namespace {

using glm::dvec2;

// Shares of the plan's diagonal.
constexpr double near_share = 1e-9;
// Corners with smaller angles (as a sine) can hit edges, like reflex corners.
constexpr double flat_turn = 1e-7;
// Edges whose normals differ by less are collinear.
constexpr double same_line = 1e-7;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }
double length(const dvec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

}  // namespace

bool Wavefront::Event::operator<(const Event& other) const {
  // The queue returns its greatest element first.
  if (time != other.time) return time > other.time;
  if (edge != other.edge) return edge > other.edge;
  return corner > other.corner;
}

Wavefront::Wavefront(const Plan& plan, const SkeletonOptions& options, const Job& job)
    : scale(std::max(diagonal_of(plan), 1e-30)), end_time_(options.end_time), job_(job) {
  std::uint32_t first = 0;
  for (const PlanRing& ring : plan.rings) {
    add_ring(ring, first);
    first += static_cast<std::uint32_t>(ring.size());
  }
  for (std::uint32_t i = 0; i < first; ++i) {
    if (!options.speed.empty()) sources[i].speed = options.speed[i];
    fastest_ = std::max(fastest_, sources[i].speed);
  }
  near_ = near_share * scale;
  soon_ = fastest_ > 0 ? 0.1 * near_ / fastest_ : 0;
}

void Wavefront::add_ring(const PlanRing& ring, std::uint32_t first) {
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    const dvec2 along = ring[next] - ring[i], direction = along / length(along);
    Source line{direction, {-direction.y, direction.x}, 0, 1, first + i, false};
    line.offset = glm::dot(line.normal, ring[i]);
    sources.push_back(line);
    nodes.emplace_back(ring[i], 0.0);
    borders.push_back({first + i, first + i, first + next});
    Edge edge;
    edge.source = first + i;
    edge.start_node = first + i;
    edge.end_node = first + next;
    edge.is_open = true;
    edges_.push_back(edge);
    open_.push_back(first + i);
    front_.push_back(first + i);
    touch(first + i);
  }
}

dvec2 Wavefront::position_at(std::uint32_t corner, double time) const {
  const Corner& c = corners_[corner];
  return c.position + c.velocity * (time - c.time);
}

dvec2 Wavefront::position_of(std::uint32_t corner) const { return position_at(corner, now_); }

dvec2 Wavefront::far_position(std::uint32_t edge, bool at_start) const {
  const Edge& e = edges_[edge];
  const std::uint32_t corner = at_start ? e.start : e.end, node = at_start ? e.start_node : e.end_node;
  return corner != none ? position_of(corner) : dvec2(nodes[node]);
}

std::uint32_t Wavefront::add_node(const dvec2& position) {
  nodes.emplace_back(position, now_);
  return static_cast<std::uint32_t>(nodes.size() - 1);
}

bool Wavefront::run() {
  if (!(fastest_ > 0)) {
    if (!std::isfinite(end_time_)) return false;
  }
  const std::uint64_t most_steps = 64 + 4 * static_cast<std::uint64_t>(sources.size());
  if (!settle()) return false;
  expect();
  std::vector<Event> batch;
  for (std::uint64_t step = 0;; ++step) {
    count_comparisons(64);
    while (is_at_horizon()) move_horizon();
    if (events_.empty()) break;
    const Event next = events_.top();
    if (next.time > end_time_ + soon_) break;
    if (step > most_steps) return false;
    batch.clear();
    now_ = std::min(std::max(now_, next.time), end_time_);
    while (!events_.empty() && events_.top().time <= next.time + soon_) {
      const Event& event = events_.top();
      const bool is_repeated =
          !batch.empty() && batch.back().edge == event.edge && batch.back().corner == event.corner;
      if (is_current(event) && !is_repeated) {
        if (!batch.empty() && !is_in_reach(event)) break;
        batch.push_back(event);
      }
      events_.pop();
    }
    if (batch.empty()) {
      --step;
      continue;
    }
    resolve(batch);
    if (!settle()) return false;
    expect();
  }
  const bool is_left = std::any_of(edges_.begin(), edges_.end(), [](const Edge& e) { return e.is_alive; });
  if (!is_left) return true;
  if (!std::isfinite(end_time_)) return false;
  close_fronts();
  return true;
}

/// Whether hits may come before the next event of the queue that are not in the queue yet.
bool Wavefront::is_at_horizon() const {
  if (!uses_grid_ || horizon_ > end_time_ + soon_) return false;
  return events_.empty() || events_.top().time + soon_ > horizon_;
}

bool Wavefront::is_current(const Event& event) const {
  const Edge& edge = edges_[event.edge];
  return edge.is_alive && edge.version == event.version &&
         (event.corner == none || corners_[event.corner].is_alive);
}

/// Whether the corners of an event move by less than the tolerance until its time.
bool Wavefront::is_in_reach(const Event& event) const {
  const Edge& edge = edges_[event.edge];
  double fastest = 0;
  for (const std::uint32_t corner :
       {edge.start, edge.end, event.corner == none ? edge.start : event.corner}) {
    fastest = std::max(fastest, corners_[corner].speed);
  }
  return fastest * (event.time - now_) <= 0.5 * near_;
}

/// Adds the corner between two edges that meet at a node.
void Wavefront::add_corner(std::uint32_t in, std::uint32_t out, std::uint32_t node) {
  const Source &a = source(in), &b = source(out);
  const dvec2 sum = a.normal + b.normal, apart = b.normal - a.normal;
  const double mean = 0.5 * (a.speed + b.speed), half = 0.5 * (b.speed - a.speed);
  Corner corner;
  corner.position = dvec2(nodes[node]);
  corner.time = now_;
  corner.node = node;
  corner.in = in;
  corner.out = out;
  // Solves a.normal . v = a.speed and b.normal . v = b.speed along the bisector and across it.
  const double squared = glm::dot(sum, sum);
  corner.velocity = squared > 0 ? sum * (2 * mean / squared) : dvec2(0);
  if (half != 0 && glm::dot(apart, apart) > same_line * same_line)
    corner.velocity += apart * (2 * half / glm::dot(apart, apart));
  corner.speed = length(corner.velocity);
  corner.can_hit = cross(a.direction, b.direction) < flat_turn;
  const auto number = static_cast<std::uint32_t>(corners_.size());
  corners_.push_back(corner);
  fresh_.push_back(number);
  edges_[in].end = number;
  edges_[in].end_node = none;
  edges_[out].start = number;
  edges_[out].start_node = none;
}

/// Adds a corner, or two with a step between them if two collinear edges have different speeds.
void Wavefront::join(std::uint32_t in, std::uint32_t out, std::uint32_t node) {
  const Source a = source(in), b = source(out);
  const dvec2 apart = b.normal - a.normal;
  const bool is_one_line = glm::dot(apart, apart) < same_line * same_line;
  if (!is_one_line || std::abs(a.speed - b.speed) <= 1e-9 * fastest_) {
    add_corner(in, out, node);
    return;
  }
  const bool is_down = a.speed > b.speed;
  Source step;
  step.direction = is_down ? -a.normal : a.normal;
  step.normal = {-step.direction.y, step.direction.x};
  step.offset = glm::dot(step.normal, dvec2(nodes[node]));
  step.speed = 0;
  step.edge = is_down ? a.edge : b.edge;
  step.is_step = true;
  const auto number = static_cast<std::uint32_t>(edges_.size());
  Edge edge;
  edge.source = static_cast<std::uint32_t>(sources.size());
  sources.push_back(step);
  edge.is_open = true;
  edges_.push_back(edge);
  open_.push_back(number);
  front_.push_back(number);
  add_corner(in, number, node);
  add_corner(number, out, node);
}

/// Makes closed fronts of the edges that are left at the end time.
void Wavefront::close_fronts() {
  now_ = end_time_;
  std::vector<std::uint32_t> node_of(corners_.size(), none);
  for (std::uint32_t i = 0; i < corners_.size(); ++i) {
    if (!corners_[i].is_alive) continue;
    node_of[i] = now_ > corners_[i].time ? add_node(position_of(i)) : corners_[i].node;
    if (node_of[i] == corners_[i].node) continue;
    borders.push_back({edges_[corners_[i].in].source, corners_[i].node, node_of[i]});
    borders.push_back({edges_[corners_[i].out].source, node_of[i], corners_[i].node});
  }
  std::vector<bool> is_done(edges_.size(), false);
  for (std::uint32_t first = 0; first < edges_.size(); ++first) {
    if (!edges_[first].is_alive || is_done[first]) continue;
    SkeletonFront front;
    for (std::uint32_t at = first; !is_done[at]; at = corners_[edges_[at].end].out) {
      is_done[at] = true;
      const Edge& edge = edges_[at];
      borders.push_back({edge.source, node_of[edge.end], node_of[edge.start]});
      front.node.push_back(node_of[edge.start]);
      front.edge.push_back(source(at).edge);
    }
    fronts.push_back(std::move(front));
  }
}

}  // namespace seedmesh
