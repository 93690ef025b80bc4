// The search for the next events; see wavefront.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geom/polygon/wavefront.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// With fewer edges, and fewer pairs of an edge and a corner, all are compared.
constexpr std::size_t few_edges = 512, few_pairs = 4096;
// The greatest number, for each edge and corner, of entries of the grid, and of pairs of an edge and a corner that share
// a cell. Where the regions up to the horizon would need more, the horizon is nearer.
constexpr std::size_t entries_each = 128;
// With more, thin spikes of rough stars need far too many pairs once they move.
constexpr double most_effort = 9;
constexpr double pairs_each = 32;
// Comparisons after events, for each edge and corner, after which the grid is made anew with a nearer horizon.
constexpr std::size_t nearby_each = 512;
// Cells of the grid for each edge, at most.
constexpr double cells_each = 4;
// The farthest horizon, in diagonals of the plan that the fastest edge could cross.
constexpr double farthest = 1e6;
// The first horizon in median lives of edges, and each later one in lengths of the previous one, if the grid allows it.
constexpr double first_horizon = 8, next_horizon = 8;
constexpr std::size_t comparisons_a_check = 20'000;

}  // namespace

/// Checks the deadline from time to time.
void Wavefront::count_comparisons(std::size_t count) {
  comparisons_ += count;
  if (comparisons_ < comparisons_a_check) return;
  comparisons_ = 0;
  job_.check();
}

void Wavefront::expect_collapse(std::uint32_t edge) {
  Edge& e = edges_[edge];
  e.since = now_;
  e.until = std::numeric_limits<double>::infinity();
  const dvec2 along = source(edge).direction;
  const double rate = glm::dot(along, corners_[e.end].velocity - corners_[e.start].velocity);
  lines_.resize(edges_.size());
  const Source& line = source(edge);
  lines_[edge] = {line.normal, line.offset, line.speed, e.until};
  if (!(rate < 0)) return;
  const double span = glm::dot(along, position_of(e.end) - position_of(e.start));
  lines_[edge].until = e.until = now_ + std::max(span, 0.0) / -rate;
  if (e.until <= end_time_ + soon_) events_.push({e.until, edge, e.version, none});
}

/// All is computed as of the time when the two came to be, so that it does not matter when they are compared.
void Wavefront::expect_hit(std::uint32_t corner, std::uint32_t edge) {
  const Corner& c = corners_[corner];
  const Edge& e = edges_[edge];
  if (c.in == edge || c.out == edge) return;
  const Source& line = source(edge);
  const double closing = line.speed - glm::dot(line.normal, c.velocity);
  if (!(closing > 1e-12 * fastest_)) return;
  const double since = std::max(c.time, e.since);
  const double ahead = glm::dot(line.normal, position_at(corner, since)) - line.offset - line.speed * since;
  if (ahead < -2 * near_) return;
  const double time = since + std::max(ahead, 0.0) / closing;
  if (time > std::min(horizon_, end_time_ + soon_) || time > e.until + soon_ || time <= horizon_before_)
    return;
  if (uses_grid_) {
    // Later the corner has ended. Where both end before one of them moves by the tolerance, the hit adds nothing.
    const double last = std::min(edges_[c.in].until, edges_[c.out].until);
    const double fastest = std::max({c.speed, corners_[e.start].speed, corners_[e.end].speed});
    const double still = std::min(0.5 * soon_, 0.1 * near_ / fastest);
    if (time > last + soon_ || time + still >= std::max(last, e.until)) return;
  }
  // Elements that have just separated here do not meet.
  if (time <= since + 2 * soon_ && (corners_[e.start].node == c.node || corners_[e.end].node == c.node)) {
    return;
  }
  const double at = glm::dot(line.direction, position_at(corner, time));
  if (at < glm::dot(line.direction, position_at(e.start, time)) - near_) return;
  if (at > glm::dot(line.direction, position_at(e.end, time)) + near_) return;
  events_.push({time, edge, e.version, corner});
}

/// The cells that an edge passes over between two times.
template <class Visit>
void Wavefront::each_cell_of_edge(std::uint32_t edge, double from, double until, const Visit& visit) const {
  const Edge& e = edges_[edge];
  const double end = std::max(from, std::min(until, e.until + soon_));
  const std::array<dvec2, 4> hull{position_at(e.start, from), position_at(e.end, from),
                                  position_at(e.start, end), position_at(e.end, end)};
  edge_grid_.each_cell(hull, 4 * near_, visit);
}

/// The cells on the way of a corner between two times.
template <class Visit>
void Wavefront::each_cell_of_corner(std::uint32_t corner, double from, double until,
                                    const Visit& visit) const {
  const Corner& c = corners_[corner];
  const double last = std::min(edges_[c.in].until, edges_[c.out].until) + soon_;
  const double end = std::max(from, std::min(until, last));
  const std::array<dvec2, 2> hull{position_at(corner, from), position_at(corner, end)};
  edge_grid_.each_cell(hull, 4 * near_, visit);
}

/// Chooses the next horizon and makes the grid anew. Hits up to the last horizon are in the queue.
void Wavefront::move_horizon() {
  double from = now_;
  if (uses_grid_ && horizon_ > from)
    from = events_.empty() ? horizon_ : std::min(horizon_, events_.top().time);
  horizon_before_ = horizon_;
  drop_ended();
  uses_grid_ = !hitting_corners_.empty() &&
               (front_.size() > few_edges || front_.size() * hitting_corners_.size() > few_pairs);
  if (uses_grid_) {
    place_grid(from);
    // Less would not be a step where times are large.
    const double least = least_ahead_ = std::max(16 * soon_, 1e-9 * from);
    const double whole = std::min(farthest * scale / fastest_, std::max(end_time_ + 4 * soon_ - from, least));
    ahead_ = std::min(ahead_ > 0 ? next_horizon * ahead_ : first_horizon * median_life(from), whole);
    // Where little has changed up to the last horizon, a farther one is cheaper.
    effort_ = 4 * changes_ < front_.size() ? std::min(most_effort, 3 * effort_) : 1;
    changes_ = 0;
    const double cheap = effort_ * pairs_each * static_cast<double>(front_.size() + hitting_corners_.size());
    const auto pairs_until = [&](double ahead) {
      return fill_grid(from, ahead) ? pairs_in_grid() : std::numeric_limits<double>::infinity();
    };
    if (ahead_ > least && pairs_until(ahead_) > cheap) {
      // A grid of edges at rest shows what cannot be avoided.
      const double most = cheap + 4 * effort_ * pairs_until(0);
      do ahead_ /= 4;
      while (ahead_ > least && pairs_until(ahead_) > most);
    }
    if (ahead_ <= least) {
      ahead_ = least;
      fill_grid(from, ahead_);
    }
    horizon_ = from + ahead_;
    most_entries_ = 2 * (edge_grid_.entries() + corner_grid_.entries()) + 16 * front_.size();
    edge_grid_.pack();
    corner_grid_.pack();
    for (const std::uint32_t corner : hitting_corners_) find_hits_of_corner(corner, from);
    comparisons_nearby_ = 0;
    most_nearby_ = nearby_each * (front_.size() + hitting_corners_.size());
  } else {
    horizon_ = std::numeric_limits<double>::infinity();
    for (const std::uint32_t edge : front_) {
      for (const std::uint32_t corner : hitting_corners_) expect_hit(corner, edge);
      count_comparisons(hitting_corners_.size() + 1);
    }
  }
  horizon_before_ = -1;
}

/// The median time until an edge shrinks to length 0. Infinite, if most edges never do.
double Wavefront::median_life(double from) const {
  std::vector<double> lives;
  lives.reserve(front_.size());
  for (const std::uint32_t edge : front_) lives.push_back(std::max(edges_[edge].until - from, 0.0));
  const auto middle = lives.begin() + static_cast<std::ptrdiff_t>(lives.size() / 2);
  std::nth_element(lives.begin(), middle, lives.end());
  return *middle;
}

void Wavefront::drop_ended() {
  std::erase_if(front_, [&](std::uint32_t edge) { return !edges_[edge].is_alive; });
  std::erase_if(hitting_corners_, [&](std::uint32_t corner) { return !corners_[corner].is_alive; });
  count_comparisons(front_.size() + hitting_corners_.size());
}

/// Lays the grid over the outline at a time, with cells about as large as an edge is long.
void Wavefront::place_grid(double time) {
  low_ = dvec2(std::numeric_limits<double>::infinity());
  high_ = -low_;
  double length = 0;
  for (const std::uint32_t edge : front_) {
    const dvec2 p = position_at(edges_[edge].start, time), q = position_at(edges_[edge].end, time);
    low_ = glm::min(low_, p);
    high_ = glm::max(high_, p);
    length += std::abs(p.x - q.x) + std::abs(p.y - q.y);
  }
  const double count = static_cast<double>(front_.size());
  const double side = length / count;
  const double wanted = (high_.x - low_.x) * (high_.y - low_.y) / std::max(side * side, 1e-300);
  cells_ = static_cast<std::size_t>(std::clamp(wanted, count, cells_each * count));
  edge_mark_.assign(edges_.size(), mark_);
  corner_mark_.assign(corners_.size(), mark_);
}

/// Puts all edges and corners into the grid with what they pass over until `from` + `ahead`. False: that is too
/// much.
bool Wavefront::fill_grid(double from, double ahead) {
  edge_grid_.reset(low_, high_, cells_, 16 * near_);
  corner_grid_.reset(low_, high_, cells_, 16 * near_);
  const std::size_t most = entries_each * (front_.size() + hitting_corners_.size());
  for (const std::uint32_t edge : front_) {
    each_cell_of_edge(edge, from, from + ahead, [&](std::size_t cell) { edge_grid_.add(cell, edge); });
    count_comparisons(16);
    if (ahead > least_ahead_ && edge_grid_.entries() > most) return false;
  }
  for (const std::uint32_t corner : hitting_corners_) {
    each_cell_of_corner(corner, from, from + ahead,
                        [&](std::size_t cell) { corner_grid_.add(cell, corner); });
    count_comparisons(16);
    if (ahead > least_ahead_ && corner_grid_.entries() > most) return false;
  }
  return true;
}

/// The number of pairs of an edge and a corner that share a cell.
double Wavefront::pairs_in_grid() {
  double pairs = 0;
  for (std::size_t cell = 0; cell < edge_grid_.cells(); ++cell)
    pairs += static_cast<double>(edge_grid_.count(cell)) * static_cast<double>(corner_grid_.count(cell));
  count_comparisons(edge_grid_.cells());
  return pairs;
}

/// Compares a corner with the edges near its way from a time on.
void Wavefront::find_hits_of_corner(std::uint32_t corner, double from) {
  ++mark_;
  seen_.clear();
  std::size_t comparisons = 8;
  const Corner& c = corners_[corner];
  const double last = std::min(edges_[c.in].until, edges_[c.out].until);
  const double most = std::min({horizon_, end_time_, last}) + 2 * soon_;
  const dvec2 velocity = c.velocity, origin = c.position - velocity * c.time;
  each_cell_of_corner(corner, from, horizon_, [&](std::size_t cell) {
    edge_grid_.each(cell, [&](std::uint32_t edge) {
      ++comparisons;
      if (edge_mark_[edge] == mark_) return;
      edge_mark_[edge] = mark_;
      // Most edges are out of reach, which needs no exact time; the rest as in expect_hit.
      const Line& line = lines_[edge];
      const double closing = line.speed - glm::dot(line.normal, velocity);
      const double latest = std::min(most, std::max(last, line.until) - 0.005 * soon_);
      if (!(closing > 0) || glm::dot(line.normal, origin) - line.offset > latest * closing) return;
      if (edges_[edge].is_alive) seen_.push_back(edge);
    });
  });
  for (const std::uint32_t edge : seen_) expect_hit(corner, edge);
  comparisons += 4 * seen_.size();
  comparisons_nearby_ += comparisons;
  count_comparisons(comparisons);
}

/// The same for an edge and the corners near it.
void Wavefront::find_hits_on_edge(std::uint32_t edge) {
  ++mark_;
  seen_.clear();
  std::size_t comparisons = 8;
  each_cell_of_edge(edge, now_, horizon_, [&](std::size_t cell) {
    edge_grid_.add(cell, edge);
    corner_grid_.each(cell, [&](std::uint32_t corner) {
      ++comparisons;
      if (corner_mark_[corner] == mark_ || !corners_[corner].is_alive) return;
      corner_mark_[corner] = mark_;
      seen_.push_back(corner);
    });
  });
  for (const std::uint32_t corner : seen_) expect_hit(corner, edge);
  comparisons += seen_.size();
  comparisons_nearby_ += comparisons;
  count_comparisons(comparisons);
}

/// Compares all changed edges and corners with all others.
void Wavefront::expect_all() {
  if (hitting_corners_.empty()) return;
  drop_ended();
  for (const std::uint32_t edge : open_) {
    if (!edges_[edge].is_alive) continue;
    for (const std::uint32_t corner : hitting_corners_) expect_hit(corner, edge);
    count_comparisons(hitting_corners_.size() + 1);
  }
  for (const std::uint32_t corner : fresh_) {
    if (!corners_[corner].can_hit) continue;
    for (const std::uint32_t edge : front_) {
      if (!edges_[edge].is_open) expect_hit(corner, edge);
    }
    count_comparisons(front_.size());
  }
}

/// Compares all changed edges and corners with their neighbours.
void Wavefront::expect_nearby() {
  edge_mark_.resize(edges_.size(), mark_);
  corner_mark_.resize(corners_.size(), mark_);
  for (const std::uint32_t edge : open_) {
    if (edges_[edge].is_alive) find_hits_on_edge(edge);
  }
  // The fresh corners, and the other ends of changed edges, which may last longer than before.
  std::vector<std::uint32_t> changed;
  for (const std::uint32_t edge : open_) {
    if (!edges_[edge].is_alive) continue;
    for (const std::uint32_t corner : {edges_[edge].start, edges_[edge].end}) {
      if (corners_[corner].can_hit) changed.push_back(corner);
    }
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const std::uint32_t corner : changed) {
    each_cell_of_corner(corner, now_, horizon_, [&](std::size_t cell) { corner_grid_.add(cell, corner); });
    find_hits_of_corner(corner, now_);
  }
  const bool is_crowded = comparisons_nearby_ > most_nearby_ && ahead_ > least_ahead_;
  if (is_crowded) {
    // Each event compares with too many; a nearer horizon needs fewer.
    ahead_ /= 32;
    effort_ = 1;
  }
  if (is_crowded || edge_grid_.entries() + corner_grid_.entries() > most_entries_) move_horizon();
}

/// Finds the next events of all changed edges and corners.
void Wavefront::expect() {
  changes_ += open_.size();
  for (const std::uint32_t corner : fresh_) {
    if (corners_[corner].can_hit) hitting_corners_.push_back(corner);
  }
  for (const std::uint32_t edge : open_) {
    if (edges_[edge].is_alive) expect_collapse(edge);
  }
  if (horizon_ < 0) {
    move_horizon();
  } else if (uses_grid_) {
    expect_nearby();
  } else if (!hitting_corners_.empty() &&
             (front_.size() > 2 * few_edges || front_.size() * hitting_corners_.size() > 2 * few_pairs)) {
    // Pairs with a changed element are compared again, which the queue does not mind.
    horizon_ = -1;
    move_horizon();
  } else {
    expect_all();
  }
  for (const std::uint32_t edge : open_) edges_[edge].is_open = false;
  open_.clear();
  fresh_.clear();
}

}  // namespace seedmesh
