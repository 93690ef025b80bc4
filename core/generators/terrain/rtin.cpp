#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/terrain/rtin_errors.h"
#include "core/generators/terrain/rtin_halves.h"
#include "core/generators/terrain/rtin_names.h"
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t triangles_a_chunk = 4096;
constexpr int depth_of_parts = 7;  // of the hierarchy; its subtrees there are shared out
/// How far a sample that comes with a halving of this level inside a triangle can be off the triangle, in
/// errors of its middle. It is off the line between two earlier samples by one error at most: the apex of
/// the level before last, and an end of a long side that is older still.
constexpr std::size_t most_levels = 32;
constexpr std::array<float, most_levels> farthest_by_level() {
  std::array<float, most_levels> all{};
  for (std::size_t i = 1; i < most_levels; ++i)
    all[i] = 1 + ((i > 2 ? all[i - 2] : 0) + (i > 3 ? all[i - 3] : 0)) / 2;
  return all;
}
constexpr std::array<float, most_levels> farthest = farthest_by_level();
static_assert(farthest[1] == farthest[2]);

/// Which triangles are left whole, so that no sample is off by more than the bound: what is off is put into
/// the mesh, and the triangles that come of it are looked at anew.
class Settling {
 public:
  Settling(const Field& field, RtinErrors& errors, double max_error, Job& job)
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

  void run(std::span<const Half> parts) {
    look_at_all(parts);
    for (;;) {
      fresh_.clear();
      for (const std::vector<Place>& places : off_) {
        for (const Place at : places)
          errors_.need(at, threshold_, fresh_);  // a corner: off by rounding alone
      }
      if (fresh_.empty()) return;
      look_at_fresh();
    }
  }

 private:
  static constexpr std::size_t rows_a_chunk = 16, fresh_a_chunk = 1024;

  /// How far the rounding of heights and errors may carry an error, generously.
  static float rounding_of(const Range& range, float threshold) {
    return (std::max(std::abs(range.low), std::abs(range.high)) * 2 + threshold) * 0x1p-21F;
  }

  /// Where the bound on what lies inside a triangle is small enough nobody has to look.
  bool doubtful(int level, float error) const {
    return level > 0 && farthest[static_cast<std::size_t>(level)] * (error + rounding_) >= threshold_;
  }

  /// Looks where a middle that is not in the mesh is doubtful: the triangles that it would halve are there if
  /// their apexes are. Walking down to them would take longer than a look at all samples.
  void look_at_all(std::span<const Half> parts) {
    const auto side = static_cast<std::size_t>(field_.width);
    std::vector<std::size_t> counts(parts.size());
    off_.assign(chunk_count(side, rows_a_chunk), {});
    parallel_for(job_, off_.size() + parts.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
      job_.check();
      if (i >= off_.size()) {
        counts[i - off_.size()] = count_whole(errors_, threshold_, parts[i - off_.size()]);
        return;
      }
      const std::size_t end = std::min(side, (i + 1) * rows_a_chunk);
      for (std::size_t z = i * rows_a_chunk; z < end; ++z) look_at_row(static_cast<std::int32_t>(z), off_[i]);
    });
    meter_.spend(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  }

  void look_at_row(std::int32_t z, std::vector<Place>& off) const {
    const float* row = errors_.row(z);
    const auto is_close = [&](float error, int level) {
      return (error >= least_[static_cast<std::size_t>(level)]) & (error <= threshold_);
    };
    for (std::int32_t x = 0; z % 2 == 0 && x < field_.width; x += 2) {
      const int level = errors_.level({x, z});
      if (is_close(row[x], level)) look_around({x, z}, level, off);
    }
    // Of the lowest levels hardly any is close. Their bound is the same.
    std::int32_t any = 0;
    for (std::int32_t x = 0; x < field_.width; ++x) any |= is_close(row[x], 1) ? 1 : 0;
    for (std::int32_t x = z % 2 == 0 ? 1 : 0; any != 0 && x < field_.width; x += z % 2 == 0 ? 2 : 1) {
      if (is_close(row[x], 1)) look_around({x, z}, errors_.level({x, z}), off);
    }
  }

  /// The triangles that a sample would halve.
  void look_around(Place middle, int level, std::vector<Place>& off) const {
    if (!doubtful(level, errors_.at(middle))) return;
    errors_.each_apex(middle, [&](Place apex) {
      if (errors_.at(apex) > threshold_ || errors_.is_corner(apex)) look(halved(middle, apex, level), off);
    });
  }

  /// The triangles that samples new in the mesh have halved.
  void look_at_fresh() {
    off_.assign(chunk_count(fresh_.size(), fresh_a_chunk), {});
    std::vector<std::size_t> counts(off_.size());
    parallel_for(job_, fresh_.size(), fresh_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   job_.check();
                   for (std::size_t i = begin; i < end; ++i) {
                     errors_.each_apex(fresh_[i], [&](Place apex) {
                       ++counts[chunk];
                       look_at_halves(fresh_[i], apex, off_[chunk]);
                     });
                   }
                 });
    meter_.spend(std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
  }

  /// The triangle with this apex that `middle` halves.
  static HalfPlaces halved(Place middle, Place apex, int level) {
    const std::int32_t x = apex.x - middle.x, z = apex.z - middle.z;
    return {{middle.x + z, middle.z - x}, {middle.x - z, middle.z + x}, apex, level};
  }

  void look_at_halves(Place middle, Place apex, std::vector<Place>& off) const {
    const HalfPlaces whole = halved(middle, apex, errors_.level(middle));
    for (const HalfPlaces& half : {HalfPlaces{apex, whole.a, middle, whole.level - 1},
                                   HalfPlaces{whole.b, apex, middle, whole.level - 1}}) {
      if (half.level == 0) continue;
      const float error = errors_.at({(half.a.x + half.b.x) / 2, (half.a.z + half.b.z) / 2});
      if (!(error > threshold_) && doubtful(half.level, error)) look(half, off);
    }
  }

  void look(const HalfPlaces& half, std::vector<Place>& off) const {
    const auto height = [&](Place at) { return static_cast<double>(field_.at(at.x, at.z)); };
    const double ha = height(half.a), hb = height(half.b);
    if (half.level == 1) {  // one sample that is no corner
      const Place middle{(half.a.x + half.b.x) / 2, (half.a.z + half.b.z) / 2};
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
  std::array<float, most_levels> least_;  ///< errors that may be doubtful, by level; rounded downward
  Job& job_;
  Meter meter_;
  std::vector<std::vector<Place>> off_;  ///< by part or chunk
  std::vector<Place> fresh_;             ///< new in the mesh since the last look
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
    std::vector<Place> all;
    for (std::int32_t i = 0; i <= last; ++i) {
      for (const Place at : {Place{i, 0}, Place{i, last}, Place{0, i}, Place{last, i}})
        errors.need(at, threshold, all);
    }
  }
  const std::vector<Half> parts = parts_of(errors, threshold, depth_of_parts);
  Settling(field, errors, max_error, job).run(parts);
  return named(parts, errors, threshold, job);
}

double measured_error(const Field& field, const Triangulation& mesh, const Job& job) {
  std::vector<double> worst(chunk_count(mesh.index.size() / 3, triangles_a_chunk), 0.0);
  parallel_for(job, mesh.index.size() / 3, triangles_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                 job.check();
                 for (std::size_t t = begin; t < end; ++t) {
                   const auto corner = [&](std::size_t k) {
                     return place_of(mesh.samples[mesh.index[3 * t + k]], field.width);
                   };
                   const auto height = [&](Place at) { return static_cast<double>(field.at(at.x, at.z)); };
                   const Place a = corner(0), b = corner(1), c = corner(2);
                   if (turn(a, b, c) <= 1) continue;  // corners alone
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
