#pragma once
/// Square cells over a part of the plane with lists of numbers, for the search of neighbours among edges and
/// moving corners.
#include <algorithm>
#include <array>
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
  /// Empties the grid and covers the box with about `cells` cells, or with fewer, whose side is then `least`.
  void reset(const glm::dvec2& low, const glm::dvec2& high, std::size_t cells, double least = 0) {
    low_ = low;
    const glm::dvec2 extent = glm::max(high - low, glm::dvec2(1e-300));
    const double count = static_cast<double>(std::max<std::size_t>(cells, 1));
    const double side =
        std::max(std::sqrt(extent.x * extent.y / count), std::max(extent.x, extent.y) / count);
    size_ = std::max({side, least, 1e-300});
    by_size_ = 1 / size_;
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
  /// Returns the number of entries that were added to a cell since the last `reset`.
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

  /// Calls visit(cell) for each cell that contains a point within `reach` of the convex hull of two to four points,
  /// and perhaps for cells beside them.
  template <class Visit>
  void each_cell(std::span<const glm::dvec2> hull, double reach, const Visit& visit) const {
    Extent whole;
    double least = hull[0].y, most = hull[0].y;
    for (const glm::dvec2& p : hull) {
      least = std::min(least, p.y);
      most = std::max(most, p.y);
      whole.take(p.x);
    }
    const std::uint32_t first = row_of(least - reach), last = row_of(most + reach);
    if (first == last) return visit_columns(first, whole, reach, visit);
    const Sides sides(hull);
    for (std::uint32_t row = first; row <= last; ++row) {
      const double below = row == 0 ? -infinite : low_.y + (row - 0.0) * size_ - reach - slack();
      const double above = row + 1 == rows_ ? infinite : low_.y + (row + 1.0) * size_ + reach + slack();
      const Extent extent = sides.extent_between(below, above);
      if (extent.from <= extent.to) visit_columns(row, extent, reach, visit);
    }
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  struct Entry {
    std::uint32_t number, next;
  };

  /// A range of x.
  struct Extent {
    double from = infinite, to = -infinite;
    void take(double x) {
      from = std::min(from, x);
      to = std::max(to, x);
    }
  };

  /// The lines between all points of a hull, which contain its border.
  class Sides {
   public:
    explicit Sides(std::span<const glm::dvec2> hull) {
      for (std::size_t i = 0; i < hull.size(); ++i) {
        for (std::size_t k = i + 1; k < hull.size(); ++k) {
          const bool rises = hull[i].y <= hull[k].y;
          const glm::dvec2 &low = rises ? hull[i] : hull[k], &high = rises ? hull[k] : hull[i];
          sides_[count_++] = {low, high, (high.x - low.x) / (high.y - low.y)};
        }
      }
    }
    /// Returns the extent in x of the part of the hull between two heights.
    Extent extent_between(double below, double above) const {
      Extent extent;
      for (std::size_t i = 0; i < count_; ++i) {
        const auto& [low, high, slope] = sides_[i];
        if (high.y < below || low.y > above) continue;
        extent.take(low.y < below ? low.x + slope * (below - low.y) : low.x);
        extent.take(high.y > above ? low.x + slope * (above - low.y) : high.x);
      }
      return extent;
    }

   private:
    struct Side {
      glm::dvec2 low, high;
      double slope;  ///< of x by y; unused for a horizontal side
    };
    std::array<Side, 6> sides_;
    std::size_t count_ = 0;
  };

  /// Against rounding at the borders of cells.
  double slack() const { return 1e-6 * size_; }

  static std::uint32_t clamped(double value, std::uint32_t most) {
    if (!(value > 0)) return 0;
    return value >= most ? most : static_cast<std::uint32_t>(value);
  }
  std::uint32_t column_of(double x) const { return clamped((x - low_.x) * by_size_, columns_ - 1); }
  std::uint32_t row_of(double y) const { return clamped((y - low_.y) * by_size_, rows_ - 1); }

  template <class Visit>
  void visit_columns(std::uint32_t row, const Extent& extent, double reach, const Visit& visit) const {
    const std::size_t begin = static_cast<std::size_t>(row) * columns_;
    const std::uint32_t end = column_of(extent.to + reach + slack());
    for (std::uint32_t column = column_of(extent.from - reach - slack()); column <= end; ++column)
      visit(begin + column);
  }

  glm::dvec2 low_{0};
  double size_ = 1, by_size_ = 1;
  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> head_, count_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> first_, packed_;  ///< packed entries by cell
};

}  // namespace seedmesh
