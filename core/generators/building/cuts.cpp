#include "core/generators/building/cuts.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::building {
namespace {

/// A share of the length that is rounding error, far below any size of a building.
constexpr double slack = 1e-9;

/// The sums of sizes of a list of cells.
struct Sums {
  double fixed = 0, floating = 0;
  std::uint32_t groups = 0;
};

class Cutter {
 public:
  Cutter(std::span<const Cell> cells, double length, Rounding rounding, double most, std::vector<Cut>& out)
      : cells_(cells),
        length_(length),
        eps_(slack * std::max(length, 1e-9)),
        rounding_(rounding),
        most_(most),
        out_(out) {}

  /// Fills `length` from `at` on with the cells of one level.
  void level(std::uint32_t first, std::uint32_t count, double at, double length) {
    const double end = std::min(at + length, length_);
    const Sums sums = sums_of(first, count);
    Plan plan = plan_of(first, count, sums, length);
    for (std::uint32_t i = first; i < first + count && !is_full_ && wanted_ <= most_; ++i) {
      const Cell& cell = cells_[i];
      if (!cell.is_group) {
        const double size = cell.measure == Measure::floating ? cell.size * plan.stretch : fixed(cell);
        place(cell, at, size, end);
        at += std::max(0.0, size);
        continue;
      }
      const Sums cycle = sums_of(cell.first, cell.count);
      const double n = plan.copies[plan.next++];
      wanted_ += n * cell.count;
      if (wanted_ > most_) return;
      wanted_ -= n * cell.count;
      // A group inside a group counts as a floating cell of its size.
      const double span = cycle.fixed + (cycle.floating + nested(cell)) * plan.stretch;
      for (double k = 0; k < n && !is_full_ && wanted_ <= most_; ++k) {
        if (cycle.groups > 0) {
          level(cell.first, cell.count, at, span);
        } else {
          double p = at;
          for (std::uint32_t c = cell.first; c < cell.first + cell.count; ++c) {
            const double size =
                cells_[c].measure == Measure::floating ? cells_[c].size * plan.stretch : fixed(cells_[c]);
            place(cells_[c], p, size, end);
            p += std::max(0.0, size);
          }
        }
        at += span;
        if (!(span > 0)) break;
      }
    }
  }

  double wanted() const { return wanted_; }

 private:
  struct Plan {
    double stretch = 0;
    std::vector<double> copies;
    std::size_t next = 0;
  };

  double fixed(const Cell& cell) const {
    return std::max(0.0, cell.measure == Measure::relative ? cell.size * length_ : cell.size);
  }

  Sums sums_of(std::uint32_t first, std::uint32_t count) const {
    Sums sums;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Cell& cell = cells_[i];
      if (cell.is_group) {
        ++sums.groups;
      } else if (cell.measure == Measure::floating) {
        sums.floating += std::max(0.0, cell.size);
      } else {
        sums.fixed += fixed(cell);
      }
    }
    return sums;
  }

  /// The sum of the sizes of the groups inside a group, each counted once.
  double nested(const Cell& group) const {
    double sum = 0;
    for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
      if (!cells_[i].is_group) continue;
      const Sums inner = sums_of(cells_[i].first, cells_[i].count);
      sum += inner.fixed + inner.floating + nested(cells_[i]);
    }
    return sum;
  }

  Plan plan_of(std::uint32_t first, std::uint32_t count, const Sums& sums, double length) const {
    Plan plan;
    double fixed_all = sums.fixed, floating_all = sums.floating;
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (!cells_[i].is_group) continue;
      const Sums inner = sums_of(cells_[i].first, cells_[i].count);
      const double floating = inner.floating + nested(cells_[i]), cycle = inner.fixed + floating;
      const double share = std::max(0.0, length - sums.fixed - sums.floating) / sums.groups;
      double n = 0;
      if (cycle > 0) {
        const double x = share / cycle;
        const bool floats = floating > 0 || sums.floating > 0;
        if (!floats || rounding_ == Rounding::ceil) {
          n = std::ceil(x - slack);
        } else {
          n = std::floor(x + 0.5 + slack);
        }
        if (floats && inner.fixed > 0)
          n = std::min(n, std::floor((length - sums.fixed) / sums.groups / inner.fixed + slack));
        if (n < 1 && sums.floating <= 0 && floating > 0) n = 1;
        n = std::max(0.0, n);
      }
      plan.copies.push_back(n);
      fixed_all += n * inner.fixed;
      floating_all += n * floating;
    }
    plan.stretch = floating_all > 0 ? std::max(0.0, length - fixed_all) / floating_all : 0;
    return plan;
  }

  /// Adds a piece; it is cut off at `end`, where the cells of this level end.
  void place(const Cell& cell, double at, double size, double end) {
    if (!(size > eps_) || is_full_ || at >= end - eps_) {
      is_full_ |= at >= length_ - eps_;
      return;
    }
    if (++wanted_ > most_) return;
    out_.push_back({at, at + size > end - eps_ ? end - at : size, cell.part});
  }

  std::span<const Cell> cells_;
  double length_, eps_;
  Rounding rounding_;
  double most_, wanted_ = 0;
  std::vector<Cut>& out_;
  bool is_full_ = false;
};

}  // namespace

double copies_of(double length, double size, Rounding rounding) {
  const double x = length / size;
  return std::max(1.0, rounding == Rounding::ceil ? std::ceil(x - slack) : std::floor(x + 0.5 + slack));
}

bool cut(std::span<const Cell> cells, std::uint32_t count, double length, const CutOptions& options,
         std::vector<Cut>& out, double& wanted) {
  Cutter cutter(cells, length, options.rounding, options.most, out);
  cutter.level(0, count, 0, length);
  wanted = cutter.wanted();
  return wanted <= options.most;
}

}  // namespace seedmesh::building
