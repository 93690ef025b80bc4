#pragma once
/// The errors that decide which triangles of a right-triangulated network are halved; for rtin.cpp.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/terrain/scan.h"

namespace seedmesh::terrain {

/// For every sample how far off the mesh may be where the triangles that it halves are left whole: of the
/// sample itself and of all below it.
class RtinErrors {
 public:
  static constexpr float needed = std::numeric_limits<float>::infinity();  ///< of what every mesh has

  RtinErrors(const Field& field, const Job& job)
      : field_(field),
        job_(job),
        side_(field.width),
        errors_(job, field.heights.size(), 0.0F),
        cells_(static_cast<std::size_t>(side_ >> cell_bits) + 1),
        touched_(cells_ * cells_, 0) {
    for (std::int32_t step = 1; step < side_ - 1; step *= 2) {
      sides(step);
      centres(step);
    }
  }

  float at(std::int32_t x, std::int32_t z) const { return errors_[place(x, z)]; }

  /// Puts a sample into every mesh, and with it all whose triangles must be halved before.
  void need(Place sample) {
    left_.assign(1, sample);
    while (!left_.empty()) {
      const Place at = left_.back();
      left_.pop_back();
      if (errors_[place(at.x, at.z)] == needed) continue;
      errors_[place(at.x, at.z)] = needed;
      touched_[cell(at.x, at.z)] = 1;
      parents(at, left_);
    }
  }

  /// Was a sample near this one put in since forget_touched()? Tells without a look at the samples.
  bool touched(std::int32_t x, std::int32_t z) const { return touched_[cell(x, z)] != 0; }
  void forget_touched() { std::fill(touched_.begin(), touched_.end(), std::uint8_t{0}); }

 private:
  std::size_t place(std::int32_t x, std::int32_t z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
  }
  static constexpr int cell_bits = 4;
  std::size_t cell(std::int32_t x, std::int32_t z) const {
    return static_cast<std::size_t>(z >> cell_bits) * cells_ + static_cast<std::size_t>(x >> cell_bits);
  }

  static constexpr std::size_t rows_a_chunk = 64;

  /// Rows of a pass over the samples (first + i * step), in parallel where there are many.
  template <class Body>
  void each_step(const Job& job, std::int32_t first, std::int32_t last, std::int32_t step, const Body& body) {
    if (last < first) return;
    const auto count = static_cast<std::size_t>((last - first) / step) + 1;
    parallel_for(job, count, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      job.check();
      for (std::size_t i = begin; i < end; ++i) body(first + static_cast<std::int32_t>(i) * step);
    });
  }

  /// Midpoints of the sides of squares of 2 * step: below them are the centres of squares of `step`.
  void sides(std::int32_t step) {
    each_step(job_, 0, side_ - 1, step, [&](std::int32_t z) {
      const bool along = z / step % 2 == 0;  // a side from west to east
      const std::int32_t half = step / 2;
      float* row = errors_.data() + place(0, z);
      const float* here = field_.row(z);
      const auto worst = [&](std::int32_t x, float own) {
        if (half == 0) return own;
        if (z > 0) {
          const float* above = errors_.data() + place(0, z - half);
          if (x > 0) own = std::max(own, above[x - half]);
          if (x < side_ - 1) own = std::max(own, above[x + half]);
        }
        if (z < side_ - 1) {
          const float* below = errors_.data() + place(0, z + half);
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

  /// Is the long side of the square around (x, z) that from north-west to south-east?
  static bool runs_south_east(std::int32_t x, std::int32_t z, std::int32_t step) {
    return (x / step / 2 + z / step / 2) % 2 == 0;
  }

  void centres(std::int32_t step) {
    each_step(job_, step, side_ - 1, 2 * step, [&](std::int32_t z) {
      float* row = errors_.data() + place(0, z);
      const float* above = errors_.data() + place(0, z - step);
      const float* below = errors_.data() + place(0, z + step);
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

  /// The samples that must be in the mesh before this one can be.
  void parents(Place at, std::vector<Place>& out) const {
    std::int32_t step = 1;
    while (((at.x | at.z) & step) == 0 && step < side_) step *= 2;
    if (step >= side_ - 1) return;  // a corner, which every mesh has
    const auto add = [&](std::int32_t x, std::int32_t z) {
      if (x >= 0 && z >= 0 && x < side_ && z < side_) out.push_back({x, z});
    };
    const bool odd_x = (at.x & step) != 0, odd_z = (at.z & step) != 0;
    if (odd_x && odd_z) {
      // A centre: the corners off its long side, themselves midpoints of sides of squares twice as large.
      if (2 * step >= side_ - 1) return;
      if (runs_south_east(at.x, at.z, step)) {
        add(at.x + step, at.z - step);
        add(at.x - step, at.z + step);
      } else {
        add(at.x - step, at.z - step);
        add(at.x + step, at.z + step);
      }
    } else if (odd_x) {
      add(at.x, at.z - step);
      add(at.x, at.z + step);
    } else {
      add(at.x - step, at.z);
      add(at.x + step, at.z);
    }
  }

  const Field& field_;
  const Job& job_;
  std::int32_t side_;
  Array<float> errors_;
  std::size_t cells_;
  std::vector<std::uint8_t> touched_;  ///< of each square of 16 samples
  std::vector<Place> left_;            ///< of need(), kept for the next
};

}  // namespace seedmesh::terrain
