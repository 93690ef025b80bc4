#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/terrain/rtin_errors.h"
#include "core/generators/terrain/rtin_names.h"
#include "core/generators/terrain/rtin_triangles.h"
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t triangles_a_chunk = 4096;
constexpr int depth_of_parts = 7;  // level of the hierarchy whose subtrees are distributed over threads
/// For each level, the greatest error of a sample inside a triangle, in multiples of the error of its midpoint.
/// The sample differs from the line between two earlier samples by at most one error: the apex of the level
/// before last, and an end of an older long side.
constexpr std::size_t most_levels = 32;
constexpr std::array<float, most_levels> farthest_by_level() {
  std::array<float, most_levels> all{};
  for (std::size_t i = 1; i < most_levels; ++i)
    all[i] = 1 + ((i > 2 ? all[i - 2] : 0) + (i > 3 ? all[i - 3] : 0)) / 2;
  return all;
}
constexpr std::array<float, most_levels> farthest = farthest_by_level();
static_assert(farthest[1] == farthest[2]);

/// Decides which triangles stay whole, so that no sample exceeds the bound. Samples that exceed it are added to
/// the mesh, and the new triangles are tested again.
class Refinement {
 public:
  Refinement(const Field& field, RtinErrors& errors, double max_error, Job& job)
      : field_(field),
        errors_(errors),
        max_error_(max_error),
        threshold_(static_cast<float>(max_error)),
        rounding_(rounding_of(range_of(field, job), threshold_)),
        job_(job),
        meter_(job, Resource::triangles) {
    for (std::size_t level = 0; level < most_levels; ++level)
      least_[level] = level == 0 ? RtinErrors::needed : threshold_ / farthest[level] - 2 * rounding_;
  }

  void run(std::span<const RtinTriangle> parts) {
    test_all(parts);
    for (;;) {
      fresh_.clear();
      for (const std::vector<GridPoint>& positions : off_) {
        for (const GridPoint at : positions)
          errors_.need(at, threshold_, fresh_);  // a corner has only rounding errors
      }
      if (fresh_.empty()) return;
      test_fresh();
    }
  }

 private:
  static constexpr std::size_t rows_a_chunk = 16, fresh_a_chunk = 1024;

  /// Returns an upper bound of the rounding errors of heights and errors.
  static float rounding_of(const Range& range, float threshold) {
    return (std::max(std::abs(range.low), std::abs(range.high)) * 2 + threshold) * 0x1p-21F;
  }

  /// A triangle need not be searched where the bound on the errors inside it is small enough.
  bool doubtful(int level, float error) const {
    return level > 0 && farthest[static_cast<std::size_t>(level)] * (error + rounding_) >= threshold_;
  }

  /// Tests the triangles around each doubtful midpoint that is not in the mesh. These triangles exist where
  /// their apexes are in the mesh. A pass over all samples is faster than a walk down the hierarchy.
  void test_all(std::span<const RtinTriangle> parts) {
    const auto side = static_cast<std::size_t>(field_.width);
    std::vector<std::size_t> counts(parts.size());
    off_.assign(chunk_count(side, rows_a_chunk), {});
    parallel_for(job_, off_.size() + parts.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
      job_.check();
      if (i >= off_.size()) {
        counts[i - off_.size()] = count_triangles(errors_, threshold_, parts[i - off_.size()]);
        return;
      }
      const std::size_t end = std::min(side, (i + 1) * rows_a_chunk);
      for (std::size_t z = i * rows_a_chunk; z < end; ++z) test_row(static_cast<std::int32_t>(z), off_[i]);
    });
    meter_.spend(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  }

  void test_row(std::int32_t z, std::vector<GridPoint>& off) const {
    const float* row = errors_.row(z);
    const auto is_close = [&](float error, int level) {
      return (error >= least_[static_cast<std::size_t>(level)]) & (error <= threshold_);
    };
    for (std::int32_t x = 0; z % 2 == 0 && x < field_.width; x += 2) {
      const int level = errors_.level({x, z});
      if (is_close(row[x], level)) test_around({x, z}, level, off);
    }
    // Samples of the lowest levels are rarely close to the bound. Their bounds are equal.
    std::int32_t any = 0;
    for (std::int32_t x = 0; x < field_.width; ++x) any |= is_close(row[x], 1) ? 1 : 0;
    for (std::int32_t x = z % 2 == 0 ? 1 : 0; any != 0 && x < field_.width; x += z % 2 == 0 ? 2 : 1) {
      if (is_close(row[x], 1)) test_around({x, z}, errors_.level({x, z}), off);
    }
  }

  /// Tests the triangles that a sample would split.
  void test_around(GridPoint middle, int level, std::vector<GridPoint>& off) const {
    if (!doubtful(level, errors_.at(middle))) return;
    errors_.each_apex(middle, [&](GridPoint apex) {
      if (errors_.at(apex) > threshold_ || errors_.is_corner(apex)) test(halved(middle, apex, level), off);
    });
  }

  /// Tests the triangles that the new samples have split.
  void test_fresh() {
    off_.assign(chunk_count(fresh_.size(), fresh_a_chunk), {});
    std::vector<std::size_t> counts(off_.size());
    parallel_for(job_, fresh_.size(), fresh_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   job_.check();
                   for (std::size_t i = begin; i < end; ++i) {
                     errors_.each_apex(fresh_[i], [&](GridPoint apex) {
                       ++counts[chunk];
                       test_halves(fresh_[i], apex, off_[chunk]);
                     });
                   }
                 });
    meter_.spend(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  }

  /// Returns the triangle with this apex that `middle` splits.
  static RtinTriangleCorners halved(GridPoint middle, GridPoint apex, int level) {
    const std::int32_t x = apex.x - middle.x, z = apex.z - middle.z;
    return {{middle.x + z, middle.z - x}, {middle.x - z, middle.z + x}, apex, level};
  }

  void test_halves(GridPoint middle, GridPoint apex, std::vector<GridPoint>& off) const {
    const RtinTriangleCorners whole = halved(middle, apex, errors_.level(middle));
    for (const RtinTriangleCorners& half : {RtinTriangleCorners{apex, whole.a, middle, whole.level - 1},
                                            RtinTriangleCorners{whole.b, apex, middle, whole.level - 1}}) {
      if (half.level == 0) continue;
      const float error = errors_.at({(half.a.x + half.b.x) / 2, (half.a.z + half.b.z) / 2});
      if (!(error > threshold_) && doubtful(half.level, error)) test(half, off);
    }
  }

  void test(const RtinTriangleCorners& half, std::vector<GridPoint>& off) const {
    const auto height = [&](GridPoint at) { return static_cast<double>(field_.at(at.x, at.z)); };
    const double ha = height(half.a), hb = height(half.b);
    if (half.level == 1) {  // one sample that is not a corner
      const GridPoint middle{(half.a.x + half.b.x) / 2, (half.a.z + half.b.z) / 2};
      if (std::abs((ha + hb) / 2 - height(middle)) > max_error_) off.push_back(middle);
      return;
    }
    const Plane plane = plane_of(half, ha, hb, height(half.c));
    each_row_inside(half, [&](std::int32_t z, std::int32_t first, std::int32_t last) {
      const float* row = field_.row(z);
      const double start = plane.base + plane.south * z;
      if (worst_of_row(row, start, plane.east, first, last) <= max_error_) return;
      for (std::int32_t x = first; x <= last; ++x) {
        if (std::abs(static_cast<double>(row[x]) - (start + plane.east * x)) > max_error_)
          off.push_back({x, z});
      }
    });
  }

  const Field& field_;
  RtinErrors& errors_;
  double max_error_;
  float threshold_, rounding_;
  std::array<float, most_levels> least_;  ///< least doubtful error of each level; rounded downward
  Job& job_;
  Meter meter_;
  std::vector<std::vector<GridPoint>> off_;  ///< of each part or chunk
  std::vector<GridPoint> fresh_;             ///< added to the mesh since the last test
};

}  // namespace

bool fits_rtin(std::int32_t width, std::int32_t depth) {
  return width == depth && width >= 2 && ((width - 1) & (width - 2)) == 0;
}

Triangulation rtin(const Field& field, double max_error, Border border, Job& job) {
  RtinErrors errors(field, job);
  const auto threshold = static_cast<float>(max_error);
  if (border == Border::whole) {
    const std::int32_t last = field.width - 1;
    std::vector<GridPoint> all;
    for (std::int32_t i = 0; i <= last; ++i) {
      for (const GridPoint at : {GridPoint{i, 0}, GridPoint{i, last}, GridPoint{0, i}, GridPoint{last, i}})
        errors.need(at, threshold, all);
    }
  }
  const std::vector<RtinTriangle> parts = parts_of(errors, threshold, depth_of_parts);
  Refinement(field, errors, max_error, job).run(parts);
  return named(parts, errors, threshold, job);
}

double measured_error(const Field& field, const Triangulation& mesh, const Job& job) {
  std::vector<double> worst(chunk_count(mesh.index.size() / 3, triangles_a_chunk), 0.0);
  parallel_for(job, mesh.index.size() / 3, triangles_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                 job.check();
                 for (std::size_t t = begin; t < end; ++t) {
                   const auto corner = [&](std::size_t k) {
                     return grid_point_of(mesh.samples[mesh.index[3 * t + k]], field.width);
                   };
                   const auto height = [&](GridPoint at) {
                     return static_cast<double>(field.at(at.x, at.z));
                   };
                   const GridPoint a = corner(0), b = corner(1), c = corner(2);
                   if (doubled_area(a, b, c) <= 1) continue;  // no samples except the corners
                   const Plane plane = Plane::through(a, b, c, height(a), height(b), height(c));
                   each_row_inside(a, b, c, [&](std::int32_t z, std::int32_t first, std::int32_t last) {
                     const double off =
                         worst_of_row(field.row(z), plane.base + plane.south * z, plane.east, first, last);
                     worst[chunk] = std::max(worst[chunk], off);
                   });
                 }
               });
  return worst.empty() ? 0 : *std::max_element(worst.begin(), worst.end());
}

}  // namespace seedmesh::terrain
