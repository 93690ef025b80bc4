#include "core/geom/polygon/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "core/base/math.h"
#include "core/geom/polygon/bridge.h"
#include "core/geom/polygon/orientation.h"

namespace seedmesh {
namespace {

// With fewer reflex corners, testing all of them is faster than a grid.
constexpr std::size_t least_in_grid = 24;
constexpr std::size_t most_cells_along = 1024;
// A look takes about 10 ns.
constexpr std::uint32_t check_interval = 16'384;

}  // namespace

std::span<const std::uint32_t> Triangulator::run(std::span<const glm::dvec2> outline, double least_area) {
  points_ = outline;
  least_ = 2 * least_area;
  uses_all_points_ = false;
  slack_ = -1;
  triangles_.clear();
  if (outline.size() < 3 || fan()) return triangles_;
  link();
  fill_grid();
  cut_ears();
  return triangles_;
}

std::span<const std::uint32_t> Triangulator::run(std::span<const glm::dvec2> points,
                                                 std::span<const std::uint32_t> ring_sizes,
                                                 double least_area) {
  least_ = 2 * least_area;
  uses_all_points_ = true;
  slack_ = least_;
  triangles_.clear();
  std::vector<std::uint32_t> joined;
  points_ = points;
  if (ring_sizes.size() != 1) {
    joined = join_holes(points, ring_sizes, job_);
    outline_.clear();
    for (const std::uint32_t point : joined) outline_.push_back(points[point]);
    points_ = outline_;
  }
  if (points_.size() >= 3 && !fan()) {
    link();
    fill_grid();
    cut_ears();
  }
  if (ring_sizes.size() == 1) return triangles_;
  for (std::uint32_t& corner : triangles_) corner = joined[corner];
  return triangles_;
}

/// Fills convex outlines without straight corners. False: the outline is another one.
bool Triangulator::fan() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    if (doubled_area(points_[i], points_[next], points_[(i + 2) % count]) <= least_) return false;
    if (i == 0 || next == 0) continue;
    // A star has convex corners too, but turns back as seen from its first point.
    if (doubled_area(points_[0], points_[i], points_[next]) <= least_) return false;
  }
  for (std::uint32_t i = 1; i + 1 < count; ++i) triangles_.insert(triangles_.end(), {0, i, i + 1});
  return true;
}

void Triangulator::link() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  left_ = count;
  next_.resize(count);
  before_.resize(count);
  is_cut_.assign(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    count_step();
    next_[i] = (i + 1) % count;
    before_[i] = (i + count - 1) % count;
  }
  reflex_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    count_step();
    if (corner(i) <= least_) reflex_.push_back(i);
  }
}

void Triangulator::fill_grid() {
  side_ = 1;
  if (reflex_.size() < least_in_grid) return;
  side_ =
      std::min(most_cells_along, static_cast<std::size_t>(std::sqrt(static_cast<double>(reflex_.size()))));
  glm::dvec2 high = low_ = points_[0];
  for (const glm::dvec2& p : points_) {
    low_ = glm::min(low_, p);
    high = glm::max(high, p);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double extent = high[axis] - low_[axis];
    cells_by_extent_[axis] = extent > 0 ? static_cast<double>(side_) / extent : 0;
  }
  first_.assign(side_ * side_ + 1, 0);
  for (std::uint32_t point : reflex_) {
    count_step();
    ++first_[cell_of(points_[point]) + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  members_.resize(reflex_.size());
  // Backwards, so that the counter of each cell ends at its beginning.
  for (std::size_t i = reflex_.size(); i-- > 0;) {
    count_step();
    members_[--first_[cell_of(points_[reflex_[i]]) + 1]] = reflex_[i];
  }
  first_.erase(first_.begin());
  first_.push_back(members_.size());
}

std::size_t Triangulator::along(double value, int axis) const {
  const std::int64_t cell = math::to_int64((value - low_[axis]) * cells_by_extent_[axis]);
  return static_cast<std::size_t>(std::clamp<std::int64_t>(cell, 0, static_cast<std::int64_t>(side_) - 1));
}

void Triangulator::count_step() const {
  if (++steps_ < check_interval) return;
  steps_ = 0;
  if (job_) job_->check();
}

void Triangulator::cut_ears() {
  std::uint32_t at = 0;
  std::size_t since_ear = 0;
  while (left_ > 3) {
    count_step();
    if (corner(at) > least_ && is_ear(at)) {
      keep(at);
      drop(at);
      at = next_[next_[at]];  // skipping one makes triangles that are less like a fan
      since_ear = 0;
    } else if (++since_ear > left_) {
      at = unblock(at);
      since_ear = 0;
    } else {
      at = next_[at];
    }
  }
  if (left_ == 3) keep(at);
}

double Triangulator::corner(std::uint32_t i) const {
  return doubled_area(points_[before_[i]], points_[i], points_[next_[i]]);
}

bool Triangulator::is_convex(std::uint32_t i) const {
  return orientation(points_[before_[i]], points_[i], points_[next_[i]]) > 0;
}

/// Whether a reflex corner lies in the triangle a, b, c of an ear. Others need no test: of all corners in the
/// triangle the one nearest to b is reflex.
bool Triangulator::blocks(std::uint32_t other, const glm::dvec2& a, const glm::dvec2& b,
                          const glm::dvec2& c) const {
  count_step();
  if (is_cut_[other]) return false;
  const glm::dvec2 p = points_[other];
  // A corner at the same position is the outline touching itself, which blocks no ear; nor does a corner that
  // has become convex. Exact tests of points on a line are slow, so they come last.
  if (p == a || p == b || p == c) return false;
  const double size = corner(other);
  if (size > least_ || orientation(a, b, p) < 0 || orientation(b, c, p) < 0) return false;
  // A corner that rounding alone keeps off the new edge blocks the ear too: no triangle could use it later.
  const bool is_on_edge = std::abs(size) <= slack_ && doubled_area(c, a, p) >= -slack_;
  return is_on_edge || orientation(c, a, p) >= 0;
}

bool Triangulator::is_ear(std::uint32_t i) const {
  const glm::dvec2 a = points_[before_[i]], b = points_[i], c = points_[next_[i]];
  if (side_ == 1)
    return std::ranges::none_of(reflex_, [&](std::uint32_t other) { return blocks(other, a, b, c); });
  const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
  const std::size_t left = along(low.x, 0), right = along(high.x, 0), top = along(high.y, 1);
  for (std::size_t y = along(low.y, 1); y <= top; ++y) {
    for (std::size_t k = first_[y * side_ + left]; k < first_[y * side_ + right + 1]; ++k) {
      if (blocks(members_[k], a, b, c)) return false;
    }
  }
  return true;
}

void Triangulator::keep(std::uint32_t i) {
  if (corner(i) > least_ || (uses_all_points_ && is_convex(i)))
    triangles_.insert(triangles_.end(), {before_[i], i, next_[i]});
}

void Triangulator::drop(std::uint32_t i) {
  next_[before_[i]] = next_[i];
  before_[next_[i]] = before_[i];
  is_cut_[i] = 1;
  --left_;
}

/// Cuts off an ear whose area is `least_` or less, or a spike without an area. False: there is none.
bool Triangulator::cut_thin_ear(std::uint32_t start) {
  const double slack = std::exchange(slack_, -1);
  std::uint32_t i = start;
  bool is_found = false;
  for (std::size_t seen = 0; seen < left_ && !is_found; ++seen, i = next_[i]) {
    count_step();
    const glm::dvec2 &a = points_[before_[i]], &b = points_[i], &c = points_[next_[i]];
    const bool is_spike = a == b || b == c || a == c;
    is_found = is_spike || (is_convex(i) && is_ear(i));
    if (!is_found) continue;
    keep(i);
    drop(i);
  }
  slack_ = slack;
  return is_found;
}

/// Continues when no ear is left: drops all corners without an area, or else, as the outline crosses itself,
/// cuts off the largest convex corner.
std::uint32_t Triangulator::unblock(std::uint32_t start) {
  if (uses_all_points_ && cut_thin_ear(start)) {
    while (is_cut_[start]) start = next_[start];
    return start;
  }
  std::uint32_t best = start, i = start;
  const std::size_t before = left_;
  for (std::size_t seen = 0; seen < before && left_ > 2; ++seen, i = next_[i]) {
    count_step();
    if (std::abs(corner(i)) <= least_) {
      drop(i);
    } else if (is_cut_[best] || corner(i) > corner(best)) {
      best = i;
    }
  }
  if (left_ == before) {
    keep(best);
    drop(best);
    return next_[best];
  }
  return is_cut_[i] ? next_[i] : i;
}

}  // namespace seedmesh
