#include "core/generators/terrain/field.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 64;

/// Weights of four samples for a position at the share t between the second and the third.
struct Spline {
  std::int32_t first = 0;  ///< the second sample
  float weights[4] = {};
};

/// Returns the weights for each new sample of a line of `count` that covers a line of `old` samples.
std::vector<Spline> splines(std::int32_t old, std::int32_t count) {
  std::vector<Spline> all(static_cast<std::size_t>(count));
  for (std::int32_t i = 0; i < count; ++i) {
    // The division comes last, so that the result is exact at old positions.
    const double position = static_cast<double>(i) * (old - 1) / (count - 1);
    const double whole = std::min(std::floor(position), static_cast<double>(old - 2));
    const double t = position - whole;
    Spline& spline = all[static_cast<std::size_t>(i)];
    spline.first = math::to_int32(whole);
    spline.weights[0] = static_cast<float>(0.5 * t * (-1 + t * (2 - t)));
    spline.weights[1] = static_cast<float>(0.5 * (2 + t * t * (-5 + 3 * t)));
    spline.weights[2] = static_cast<float>(0.5 * t * (1 + t * (4 - 3 * t)));
    spline.weights[3] = static_cast<float>(0.5 * t * t * (t - 1));
  }
  return all;
}

/// Returns the height at `index` of a line of `count`, extrapolated linearly beyond both ends.
float beyond(const float* line, std::size_t step, std::int32_t index, std::int32_t count) {
  const auto at = [&](std::int32_t i) { return line[static_cast<std::size_t>(i) * step]; };
  if (index < 0) return 2 * at(0) - at(1);
  if (index >= count) return 2 * at(count - 1) - at(count - 2);
  return at(index);
}

float along(const float* line, std::size_t step, std::int32_t count, const Spline& spline) {
  float sum = 0;
  for (int k = 0; k < 4; ++k) sum += spline.weights[k] * beyond(line, step, spline.first + k - 1, count);
  return sum;
}

}  // namespace

Range range_of(const Field& field, const Job& job) {
  const auto depth = static_cast<std::size_t>(field.depth);
  std::vector<Range> parts(chunk_count(depth, rows_a_chunk));
  parallel_for(job, depth, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
    Range range{field.at(0, static_cast<std::int32_t>(begin)), field.at(0, static_cast<std::int32_t>(begin))};
    for (std::size_t z = begin; z < end; ++z) {
      const float* row = field.row(static_cast<std::int32_t>(z));
      for (std::int32_t x = 0; x < field.width; ++x) {
        range.low = row[x] < range.low ? row[x] : range.low;
        range.high = row[x] > range.high ? row[x] : range.high;
      }
    }
    parts[index] = range;
  });
  Range range = parts.front();
  for (const Range& part : parts) range = {std::min(range.low, part.low), std::max(range.high, part.high)};
  return range;
}

Field cropped(Field field, std::int32_t margin, const Job& job) {
  if (margin == field.margin) return field;
  Field smaller(job, field.width, field.depth, margin);
  smaller.cell = field.cell;
  for (std::int32_t z = -margin; z < field.depth + margin; ++z) {
    const float* from = field.row(z) - margin;
    std::copy(from, from + smaller.stride(), smaller.row(z) - margin);
  }
  return smaller;
}

Field resampled(const Field& field, std::int32_t side, const Job& job) {
  const double aspect = static_cast<double>(field.depth - 1) / (field.width - 1);
  const std::int32_t deep = std::max(2, math::to_int32(std::floor((side - 1) * aspect + 0.5)) + 1);
  const std::vector<Spline> across = splines(field.width, side);
  const std::vector<Spline> down = splines(field.depth, deep);
  Field wide(job, side, field.depth, 0);
  parallel_for(job, static_cast<std::size_t>(field.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (auto z = static_cast<std::int32_t>(begin); z < static_cast<std::int32_t>(end); ++z) {
                   for (std::int32_t x = 0; x < side; ++x)
                     wide.at(x, z) = along(field.row(z), 1, field.width, across[static_cast<std::size_t>(x)]);
                 }
               });
  Field out(job, side, deep, 0);
  out.cell = field.cell * (field.width - 1) / (side - 1);
  const auto step = static_cast<std::size_t>(wide.stride());
  parallel_for(job, static_cast<std::size_t>(deep), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (auto z = static_cast<std::int32_t>(begin); z < static_cast<std::int32_t>(end); ++z) {
                   for (std::int32_t x = 0; x < side; ++x) {
                     out.at(x, z) =
                         along(wide.row(0) + x, step, field.depth, down[static_cast<std::size_t>(z)]);
                   }
                 }
               });
  return out;
}

}  // namespace seedmesh::terrain
