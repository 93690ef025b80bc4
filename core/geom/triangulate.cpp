#include "core/geom/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/math.h"

namespace seedmesh {
namespace {

/// Twice the signed area of a triangle.
double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Points in square cells, about one a cell.
class PointGrid {
 public:
  PointGrid(std::span<const glm::dvec2> points, const std::vector<std::uint32_t>& chosen) : points_(points) {
    low_ = high_ = points[0];
    for (const glm::dvec2& p : points) {
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
    }
    side_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(chosen.size()))),
                                    1, 1024);
    first_.assign(side_ * side_ + 1, 0);
    for (std::uint32_t point : chosen) ++first_[cell_of(points[point]) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    members_.resize(chosen.size());
    for (std::uint32_t point : chosen) members_[next[cell_of(points[point])]++] = point;
  }

  /// True if `test` says so of any point in the cells that meet the box.
  template <class Test>
  bool any(const glm::dvec2& low, const glm::dvec2& high, Test test) const {
    for (std::size_t y = along(low.y, 1); y <= along(high.y, 1); ++y) {
      for (std::size_t x = along(low.x, 0); x <= along(high.x, 0); ++x) {
        for (std::size_t i = first_[y * side_ + x]; i < first_[y * side_ + x + 1]; ++i) {
          if (test(members_[i])) return true;
        }
      }
    }
    return false;
  }

 private:
  std::size_t along(double value, int axis) const {
    const double extent = high_[axis] - low_[axis];
    const double share = extent > 0 ? (value - low_[axis]) / extent : 0;
    return std::min(side_ - 1, static_cast<std::size_t>(std::max<std::int64_t>(
                                   0, math::to_int64(share * static_cast<double>(side_)))));
  }
  std::size_t cell_of(const glm::dvec2& p) const { return along(p.y, 1) * side_ + along(p.x, 0); }

  std::span<const glm::dvec2> points_;
  glm::dvec2 low_{0}, high_{0};
  std::size_t side_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> members_;
};

class EarCutter {
 public:
  EarCutter(std::span<const glm::dvec2> points, double least_area)
      : points_(points),
        least_(2 * least_area),
        left_(points.size()),
        next_(points.size()),
        before_(points.size()),
        is_cut_(points.size()),
        grid_(points, link()) {}

  std::vector<std::uint32_t> run() {
    std::uint32_t at = 0;
    std::size_t since_ear = 0;
    while (left_ > 3) {
      if (is_ear(at)) {
        cut(at);
        at = next_[next_[at]];  // skipping one makes triangles that are less like a fan
        since_ear = 0;
      } else if (++since_ear > left_) {
        at = unblock(at);
        since_ear = 0;
        if (left_ < 3) break;
      } else {
        at = next_[at];
      }
    }
    if (left_ == 3) keep(at);
    return std::move(triangles_);
  }

 private:
  /// Closes the ring of points; returns those that may stand in the way of an ear.
  std::vector<std::uint32_t> link() {
    const auto count = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      next_[i] = (i + 1) % count;
      before_[i] = (i + count - 1) % count;
    }
    std::vector<std::uint32_t> reflex;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (corner(i) <= least_) reflex.push_back(i);
    }
    return reflex;
  }

  double corner(std::uint32_t i) const { return cross(points_[before_[i]], points_[i], points_[next_[i]]); }

  bool is_ear(std::uint32_t i) const {
    if (corner(i) <= least_) return false;
    const glm::dvec2 a = points_[before_[i]], b = points_[i], c = points_[next_[i]];
    return !grid_.any(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), [&](std::uint32_t other) {
      if (is_cut_[other] || corner(other) > least_) return false;
      const glm::dvec2 p = points_[other];
      // A corner at the same place is the outline touching itself, which bars no ear.
      if (p == a || p == b || p == c) return false;
      return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
    });
  }

  void keep(std::uint32_t i) {
    if (corner(i) <= least_) return;
    for (std::uint32_t point : {before_[i], i, next_[i]}) triangles_.push_back(point);
  }

  void drop(std::uint32_t i) {
    next_[before_[i]] = next_[i];
    before_[next_[i]] = before_[i];
    is_cut_[i] = true;
    --left_;
  }

  void cut(std::uint32_t i) {
    keep(i);
    drop(i);
  }

  /// No ear is left: takes away all corners without area, or else the best convex one, where the outline
  /// crosses itself.
  std::uint32_t unblock(std::uint32_t start) {
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
      cut(best);
      return next_[best];
    }
    return is_cut_[i] ? next_[i] : i;
  }

  std::span<const glm::dvec2> points_;
  double least_;
  std::size_t left_;
  std::vector<std::uint32_t> next_, before_;
  std::vector<bool> is_cut_;
  PointGrid grid_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

std::vector<std::uint32_t> triangulate(std::span<const glm::dvec2> outline, double least_area) {
  if (outline.size() < 3) return {};
  return EarCutter(outline, least_area).run();
}

}  // namespace seedmesh
