#include "core/geom/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/math.h"

namespace seedmesh {
namespace {

// Below this many reflex corners a look at all of them is cheaper than a grid.
constexpr std::size_t least_in_grid = 24;
constexpr std::size_t most_cells_along = 1024;

/// Twice the signed area of a triangle.
double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

std::span<const std::uint32_t> Triangulator::run(std::span<const glm::dvec2> outline, double least_area) {
  points_ = outline;
  least_ = 2 * least_area;
  triangles_.clear();
  if (outline.size() < 3 || fan()) return triangles_;
  link();
  fill_grid();
  cut_ears();
  return triangles_;
}

/// True where the outline is convex and has no straight corner; then it is done.
bool Triangulator::fan() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    if (cross(points_[i], points_[next], points_[(i + 2) % count]) <= least_) return false;
    if (i == 0 || next == 0) continue;
    // A star has convex corners too; seen from its first point it turns back.
    if (cross(points_[0], points_[i], points_[next]) <= least_) return false;
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
    next_[i] = (i + 1) % count;
    before_[i] = (i + count - 1) % count;
  }
  reflex_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
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
  for (std::uint32_t point : reflex_) ++first_[cell_of(points_[point]) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  members_.resize(reflex_.size());
  // Backwards, so that each cell's count ends as its beginning.
  for (std::size_t i = reflex_.size(); i-- > 0;)
    members_[--first_[cell_of(points_[reflex_[i]]) + 1]] = reflex_[i];
  first_.erase(first_.begin());
  first_.push_back(members_.size());
}

std::size_t Triangulator::along(double value, int axis) const {
  const std::int64_t cell = math::to_int64((value - low_[axis]) * cells_by_extent_[axis]);
  return static_cast<std::size_t>(std::clamp<std::int64_t>(cell, 0, static_cast<std::int64_t>(side_) - 1));
}

void Triangulator::cut_ears() {
  std::uint32_t at = 0;
  std::size_t since_ear = 0;
  while (left_ > 3) {
    if (is_ear(at)) {
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
  return cross(points_[before_[i]], points_[i], points_[next_[i]]);
}

bool Triangulator::is_ear(std::uint32_t i) const {
  if (corner(i) <= least_) return false;
  const glm::dvec2 a = points_[before_[i]], b = points_[i], c = points_[next_[i]];
  const auto is_in_the_way = [&](std::uint32_t other) {
    if (is_cut_[other]) return false;
    const glm::dvec2 p = points_[other];
    if (!(cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0)) return false;
    // A corner at the same place is the outline touching itself, which bars no ear; nor does one that has
    // become convex.
    return p != a && p != b && p != c && corner(other) <= least_;
  };
  if (side_ == 1) return std::none_of(reflex_.begin(), reflex_.end(), is_in_the_way);
  const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
  const std::size_t left = along(low.x, 0), right = along(high.x, 0), top = along(high.y, 1);
  for (std::size_t y = along(low.y, 1); y <= top; ++y) {
    for (std::size_t k = first_[y * side_ + left]; k < first_[y * side_ + right + 1]; ++k) {
      if (is_in_the_way(members_[k])) return false;
    }
  }
  return true;
}

void Triangulator::keep(std::uint32_t i) {
  if (corner(i) > least_) triangles_.insert(triangles_.end(), {before_[i], i, next_[i]});
}

void Triangulator::drop(std::uint32_t i) {
  next_[before_[i]] = next_[i];
  before_[next_[i]] = before_[i];
  is_cut_[i] = 1;
  --left_;
}

/// No ear is left: takes away all corners without area, or else the best convex one, where the outline
/// crosses itself.
std::uint32_t Triangulator::unblock(std::uint32_t start) {
  std::uint32_t best = start, i = start;
  const std::size_t before = left_;
  for (std::size_t seen = 0; seen < before && left_ > 2; ++seen, i = next_[i]) {
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
