#pragma once
/// Square cells over a part of the plane with lists of numbers, for the search of neighbours among edges and
/// moving corners.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <span>
#include <vector>

namespace seedmesh {

/// Cells at the border of the grid extend to infinity, so that every point lies in a cell.
class CellGrid {
 public:
  /// Empties the grid and covers the box with about `cells` cells, or fewer of the side `least`.
  void reset(const glm::dvec2& low, const glm::dvec2& high, std::size_t cells, double least = 0) {
    low_ = low;
    const glm::dvec2 extent = glm::max(high - low, glm::dvec2(1e-300));
    const double count = static_cast<double>(std::max<std::size_t>(cells, 1));
    const double side =
        std::max(std::sqrt(extent.x * extent.y / count), std::max(extent.x, extent.y) / count);
    size_ = std::max({side, least, 1e-300});
    columns_ = clamped(extent.x / size_, static_cast<std::uint32_t>(2 * cells) + 1) + 1;
    rows_ = clamped(extent.y / size_, static_cast<std::uint32_t>(2 * cells) + 1) + 1;
    head_.assign(static_cast<std::size_t>(columns_) * rows_, none);
    count_.assign(head_.size(), 0);
    entries_.clear();
    packed_.clear();
    first_.assign(head_.size() + 1, 0);
  }

  /// Moves all entries so that those of a cell are next to each other, for many calls of `each`.
  void pack() {
    std::vector<std::uint32_t> packed;
    packed.reserve(entries());
    std::vector<std::uint32_t> first;
    first.reserve(head_.size() + 1);
    for (std::size_t cell = 0; cell < head_.size(); ++cell) {
      first.push_back(static_cast<std::uint32_t>(packed.size()));
      each(cell, [&](std::uint32_t number) { packed.push_back(number); });
    }
    first.push_back(static_cast<std::uint32_t>(packed.size()));
    packed_ = std::move(packed);
    first_ = std::move(first);
    head_.assign(head_.size(), none);
    entries_.clear();
  }

  std::size_t cells() const { return head_.size(); }
  std::size_t entries() const { return entries_.size() + packed_.size(); }
  /// Returns the number of entries in a cell since the last `reset`.
  std::size_t count(std::size_t cell) const { return count_[cell]; }

  /// Adds a number to a cell, unless it is the number that was added there last.
  void add(std::size_t cell, std::uint32_t number) {
    if (head_[cell] != none && entries_[head_[cell]].number == number) return;
    entries_.push_back({number, head_[cell]});
    head_[cell] = static_cast<std::uint32_t>(entries_.size() - 1);
    ++count_[cell];
  }

  /// Calls visit(number) for all numbers in a cell.
  template <class Visit>
  void each(std::size_t cell, const Visit& visit) const {
    for (std::uint32_t at = first_[cell]; at < first_[cell + 1]; ++at) visit(packed_[at]);
    for (std::uint32_t at = head_[cell]; at != none; at = entries_[at].next) visit(entries_[at].number);
  }

  /// Calls visit(cell) for each cell that contains a point within `reach` of the convex hull of a few points,
  /// and perhaps for cells beside them.
  template <class Visit>
  void each_cell(std::span<const glm::dvec2> hull, double reach, const Visit& visit) const {
    double least = hull[0].y, most = hull[0].y;
    for (const glm::dvec2& p : hull) {
      least = std::min(least, p.y);
      most = std::max(most, p.y);
    }
    const std::uint32_t last = row_of(most + reach);
    for (std::uint32_t row = row_of(least - reach); row <= last; ++row) {
      const double below = row == 0 ? -infinite : low_.y + (row - 0.0) * size_ - reach - slack();
      const double above = row + 1 == rows_ ? infinite : low_.y + (row + 1.0) * size_ + reach + slack();
      const auto [from, to] = width_between(hull, below, above);
      if (!(from <= to)) continue;
      const std::uint32_t end = column_of(to + reach + slack());
      for (std::uint32_t column = column_of(from - reach - slack()); column <= end; ++column)
        visit(static_cast<std::size_t>(row) * columns_ + column);
    }
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  struct Entry {
    std::uint32_t number, next;
  };

  /// Against rounding at the borders of cells.
  double slack() const { return 1e-6 * size_; }

  static std::uint32_t clamped(double value, std::uint32_t most) {
    if (!(value > 0)) return 0;
    return value >= most ? most : static_cast<std::uint32_t>(value);
  }
  std::uint32_t column_of(double x) const { return clamped((x - low_.x) / size_, columns_ - 1); }
  std::uint32_t row_of(double y) const { return clamped((y - low_.y) / size_, rows_ - 1); }

  /// Returns the extent in x of the part of the hull between two heights.
  static std::pair<double, double> width_between(std::span<const glm::dvec2> hull, double below,
                                                 double above) {
    double from = infinite, to = -infinite;
    const auto take = [&](double x) {
      from = std::min(from, x);
      to = std::max(to, x);
    };
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const glm::dvec2& p = hull[i];
      if (p.y >= below && p.y <= above) take(p.x);
      for (std::size_t k = i + 1; k < hull.size(); ++k) {
        const glm::dvec2& q = hull[k];
        if ((p.y < below && q.y < below) || (p.y > above && q.y > above)) continue;
        for (const double height : {below, above}) {
          if ((p.y < height) == (q.y < height)) continue;
          take(p.x + (q.x - p.x) * ((height - p.y) / (q.y - p.y)));
        }
      }
    }
    return {from, to};
  }

  glm::dvec2 low_{0};
  double size_ = 1;
  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> head_, count_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> first_, packed_;  ///< packed entries by cell
};

}  // namespace seedmesh
