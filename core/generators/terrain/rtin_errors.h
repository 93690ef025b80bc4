#pragma once
/// Errors that decide which triangles of a right-triangulated network are split; internal to rtin.cpp.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/terrain/scan.h"

namespace seedmesh::terrain {

/// Row stride of arrays of samples, in floats: whole cache lines. For sides of 2^n + 1 from 33 on, their
/// number is odd, so that consecutive rows do not share cache sets.
constexpr std::int32_t stride_of(std::int32_t side) {
  constexpr std::int32_t line = 16;
  return (side + line - 1) / line * line;
}
static_assert(stride_of(1025) / 16 % 2 == 1);

/// For every sample, the largest error of the mesh if the triangles that the sample splits are not split. It
/// is the maximum over the sample itself and all samples of finer levels inside these triangles.
class RtinErrors {
 public:
  /// error of samples that are in every mesh
  static constexpr float needed = std::numeric_limits<float>::infinity();

  RtinErrors(const Field& field, const Job& job)
      : field_(field),
        job_(job),
        side_(field.width),
        stride_(stride_of(side_)),
        errors_(job, static_cast<std::size_t>(stride_) * static_cast<std::size_t>(side_), 0.0F) {
    for (std::int32_t step = 1; step < side_ - 1; step *= 2) {
      sides(step);
      centres(step);
    }
  }

  std::int32_t side() const { return side_; }
  std::int32_t stride() const { return stride_; }
  const float* data() const { return errors_.data(); }
  const float* row(std::int32_t z) const { return errors_.data() + index_of(0, z); }
  float at(GridPoint sample) const { return errors_[index_of(sample.x, sample.z)]; }

  /// Adds a sample to the mesh. Also adds all samples that must be in the mesh before it can split its
  /// triangles. Samples that a mesh of the bound `threshold` contains are skipped, because all their
  /// ancestors are in it too. New samples are appended to `fresh`.
  void need(GridPoint sample, float threshold, std::vector<GridPoint>& fresh) {
    left_.assign(1, sample);
    while (!left_.empty()) {
      const GridPoint at = left_.back();
      left_.pop_back();
      float& error = errors_[index_of(at.x, at.z)];
      if (error > threshold) continue;
      error = needed;
      fresh.push_back(at);
      each_apex(at, [&](GridPoint apex) { left_.push_back(apex); });
    }
  }

  bool is_corner(GridPoint at) const { return step_of(at) == side_ - 1; }

  /// Returns the number of splits from the triangles that a sample splits down to half a cell; 0 for a corner
  /// of the field.
  int level(GridPoint at) const {
    const std::int32_t step = step_of(at);
    if (step == side_ - 1) return 0;
    return 2 * std::countr_zero(static_cast<std::uint32_t>(step)) + ((at.x & at.z & step) != 0 ? 2 : 1);
  }

  /// Returns the apexes of the triangles that a sample splits; they must be in the mesh before it. A corner
  /// of the field splits none.
  template <class Visit>
  void each_apex(GridPoint at, const Visit& visit) const {
    const std::int32_t step = step_of(at);
    if (step == side_ - 1) return;
    const auto visit_inside = [&](std::int32_t x, std::int32_t z) {
      if (x >= 0 && z >= 0 && x < side_ && z < side_) visit(GridPoint{x, z});
    };
    const bool odd_x = (at.x & step) != 0, odd_z = (at.z & step) != 0;
    if (odd_x && odd_z) {
      // For a centre, these are the two corners that are not on the long side. They are midpoints of sides of
      // squares of twice the size.
      const std::int32_t south = runs_south_east(at.x, at.z, step) ? -step : step;
      visit_inside(at.x + step, at.z + south);
      visit_inside(at.x - step, at.z - south);
    } else if (odd_x) {
      visit_inside(at.x, at.z - step);
      visit_inside(at.x, at.z + step);
    } else {
      visit_inside(at.x - step, at.z);
      visit_inside(at.x + step, at.z);
    }
  }

 private:
  /// Returns half the side of the squares of which a sample is the centre or the midpoint of a side.
  std::int32_t step_of(GridPoint at) const {
    const std::int32_t bits = at.x | at.z | (side_ - 1);
    return bits & -bits;
  }

  std::size_t index_of(std::int32_t x, std::int32_t z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(stride_) + static_cast<std::size_t>(x);
  }

  static constexpr std::size_t rows_a_chunk = 64, shared_out = 512;

  /// Runs over the rows of samples (first + i * step), in parallel for long passes only: each level has a
  /// quarter of the work of the level below, and synchronisation costs time.
  template <class Body>
  void each_step(const Job& job, std::int32_t first, std::int32_t last, std::int32_t step, const Body& body) {
    if (last < first) return;
    const auto count = static_cast<std::size_t>((last - first) / step) + 1;
    parallel_for(job, count, count < shared_out ? count : rows_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   job.check();
                   for (std::size_t i = begin; i < end; ++i)
                     body(first + static_cast<std::int32_t>(i) * step);
                 });
  }

  /// Processes the midpoints of the sides of squares of 2 * step. The next finer samples are the centres of
  /// squares of `step`.
  void sides(std::int32_t step) {
    each_step(job_, 0, side_ - 1, step, [&](std::int32_t z) {
      const bool along = z / step % 2 == 0;  // a side from west to east
      const std::int32_t half = step / 2;
      float* row = errors_.data() + index_of(0, z);
      const float* here = field_.row(z);
      const auto worst = [&](std::int32_t x, float own) {
        if (half == 0) return own;
        if (z > 0) {
          const float* above = errors_.data() + index_of(0, z - half);
          if (x > 0) own = std::max(own, above[x - half]);
          if (x < side_ - 1) own = std::max(own, above[x + half]);
        }
        if (z < side_ - 1) {
          const float* below = errors_.data() + index_of(0, z + half);
          if (x > 0) own = std::max(own, below[x - half]);
          if (x < side_ - 1) own = std::max(own, below[x + half]);
        }
        return own;
      };
      if (along) {
        for (std::int32_t x = step; x < side_; x += 2 * step)
          row[x] = worst(x, std::abs((here[x - step] + here[x + step]) * 0.5F - here[x]));
      } else {
        const float* above = field_.row(z - step);
        const float* below = field_.row(z + step);
        for (std::int32_t x = 0; x < side_; x += 2 * step)
          row[x] = worst(x, std::abs((above[x] + below[x]) * 0.5F - here[x]));
      }
    });
  }

  /// Returns true where the long side of the square around (x, z) runs from north-west to south-east.
  static bool runs_south_east(std::int32_t x, std::int32_t z, std::int32_t step) {
    return (x / step / 2 + z / step / 2) % 2 == 0;
  }

  void centres(std::int32_t step) {
    each_step(job_, step, side_ - 1, 2 * step, [&](std::int32_t z) {
      float* row = errors_.data() + index_of(0, z);
      const float* above = errors_.data() + index_of(0, z - step);
      const float* below = errors_.data() + index_of(0, z + step);
      const float* north = field_.row(z - step);
      const float* here = field_.row(z);
      const float* south = field_.row(z + step);
      for (std::int32_t x = step; x < side_; x += 2 * step) {
        const float ends = runs_south_east(x, z, step) ? north[x - step] + south[x + step]
                                                       : north[x + step] + south[x - step];
        const float own = std::abs(ends * 0.5F - here[x]);
        row[x] =
            std::max(std::max(own, std::max(row[x - step], row[x + step])), std::max(above[x], below[x]));
      }
    });
  }

  const Field& field_;
  const Job& job_;
  std::int32_t side_, stride_;
  Array<float> errors_;
  std::vector<GridPoint> left_;  ///< buffer of need()
};

}  // namespace seedmesh::terrain
