#include "core/generators/terrain/filters.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/noise.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 32;
// Columns that are smoothed side by side, so that a line of the cache is used whole.
constexpr std::size_t columns_a_chunk = 256;
// Rows that are smoothed side by side: each step of a row waits for the one before.
constexpr std::size_t rows_at_once = 8;

/// body(row of heights, z) for every row, in parallel.
template <class Body>
void each_row(Field& field, const Job& job, const Body& body) {
  parallel_for(job, static_cast<std::size_t>(field.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (auto z = static_cast<std::int32_t>(begin); z < static_cast<std::int32_t>(end); ++z)
                   body(field.row(z), z);
               });
}

void smooth_rows(Field& field, float k, std::size_t begin, std::size_t end) {
  const auto width = static_cast<std::size_t>(field.width), stride = static_cast<std::size_t>(field.stride());
  const float rest = 1 - k;
  for (std::size_t first = begin; first < end; first += rows_at_once) {
    float* rows = field.row(static_cast<std::int32_t>(first));
    const std::size_t count = std::min(rows_at_once, end - first);
    for (std::size_t x = 1; x < width; ++x) {
      for (std::size_t i = 0; i < count; ++i) {
        float* at = rows + i * stride + x;
        *at = k * at[-1] + rest * *at;
      }
    }
    for (std::size_t x = width - 1; x-- > 0;) {
      for (std::size_t i = 0; i < count; ++i) {
        float* at = rows + i * stride + x;
        *at = k * at[1] + rest * *at;
      }
    }
  }
}

void smooth_columns(Field& field, float k, std::size_t begin, std::size_t end) {
  const float rest = 1 - k;
  const auto blend = [&](std::int32_t from, std::int32_t to) {
    const float* before = field.row(from);
    float* here = field.row(to);
    for (std::size_t x = begin; x < end; ++x) here[x] = k * before[x] + rest * here[x];
  };
  for (std::int32_t z = 1; z < field.depth; ++z) blend(z - 1, z);
  for (std::int32_t z = field.depth - 1; z-- > 0;) blend(z + 1, z);
}

/// What of a difference exceeds the talus, with its sign.
float excess(float difference, float talus) {
  const float over = std::abs(difference) - talus;
  return over > 0 ? (difference > 0 ? over : -over) : 0.0F;
}

/// One row of one round of slip(): `rows` are those before, at and after it.
void slip_row(const float* const rows[3], float* out, std::int32_t width, const ThermalPlan& plan,
              float cell) {
  const auto straight = static_cast<float>(plan.talus) * cell;
  const float diagonal = straight * 1.41421356F;
  // Eight neighbours together may take at most half of what is too much.
  const float share = static_cast<float>(plan.rate) * 0.125F;
  const auto total = [&](std::int32_t x, std::int32_t west, std::int32_t east) {
    const float h = rows[1][x];
    const float sides = (excess(rows[1][west] - h, straight) + excess(rows[1][east] - h, straight)) +
                        (excess(rows[0][x] - h, straight) + excess(rows[2][x] - h, straight));
    const float corners = (excess(rows[0][west] - h, diagonal) + excess(rows[0][east] - h, diagonal)) +
                          (excess(rows[2][west] - h, diagonal) + excess(rows[2][east] - h, diagonal));
    return h + share * (sides + 0.70710678F * corners);
  };
  const std::int32_t last = width - 1;
  out[0] = total(0, 0, 1);
  for (std::int32_t x = 1; x < last; ++x) out[x] = total(x, x - 1, x + 1);
  out[last] = total(last, last - 1, last);
}

}  // namespace

void smooth(Field& field, double percent, const Job& job) {
  if (percent <= 0) return;
  const auto k = static_cast<float>(percent / 100);
  parallel_for(job, static_cast<std::size_t>(field.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 smooth_rows(field, k, begin, end);
               });
  parallel_for(job, static_cast<std::size_t>(field.width), columns_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 smooth_columns(field, k, begin, end);
               });
}

void normalise(Field& field, double low, double high, const Job& job) {
  const Range range = range_of(field, job);
  const double span = static_cast<double>(range.high) - range.low;
  const double scale = span > 0 ? (high - low) / span : 0;
  each_row(field, job, [&](float* row, std::int32_t) {
    for (std::int32_t x = 0; x < field.width; ++x)
      row[x] = static_cast<float>(low + (static_cast<double>(row[x]) - range.low) * scale);
  });
}

void terrace(Field& field, int count, double sharpness, const Job& job) {
  const Range range = range_of(field, job);
  const float step = (range.high - range.low) / static_cast<float>(count);
  if (!(step > 0)) return;
  // Within a step the height rises as t^p: p = 1 leaves it, a large p keeps it low until the cliff.
  const double power = 1 / std::max(1e-3, 1 - sharpness);
  const bool cliffs = sharpness >= 1;
  each_row(field, job, [&](float* row, std::int32_t) {
    for (std::int32_t x = 0; x < field.width; ++x) {
      const float place = (row[x] - range.low) / step;
      const float whole = std::min(std::floor(place), static_cast<float>(count - 1));
      const double t = static_cast<double>(place - whole);
      const double raised = cliffs ? (t >= 1 ? 1 : 0) : math::pow(std::clamp(t, 0.0, 1.0), power);
      row[x] = range.low + step * (whole + static_cast<float>(raised));
    }
  });
}

void sink_rim(Field& field, const IslandPlan& plan, Rng rng, const Job& job) {
  const Range range = range_of(field, job);
  const double depth = plan.depth.value_or((static_cast<double>(range.high) - range.low) / 4);
  const auto floor_height = static_cast<float>(range.low - depth);
  const double middle_x = (field.width - 1) / 2.0, middle_z = (field.depth - 1) / 2.0;
  const double half = std::min(middle_x, middle_z);
  const Window window{0, 0, field.width, field.depth};
  NoisePlan coast;
  coast.octaves = 5;
  coast.amplitude = plan.roughness * 0.6;
  coast.wavelength = half * 0.9;
  const Field ragged = noisy(coast, window, 1, rng.at("coast"), job);
  each_row(field, job, [&](float* row, std::int32_t z) {
    for (std::int32_t x = 0; x < field.width; ++x) {
      const double dx = (x - middle_x) / half, dz = (z - middle_z) / half;
      // The coast is where the share is one half; a third of the reach lies on either side of it.
      const double away = std::sqrt(dx * dx + dz * dz) / plan.reach + static_cast<double>(ragged.at(x, z));
      const double t = std::clamp((1.35 - away) / 0.7, 0.0, 1.0);
      const double rim = std::clamp((1.0 - std::max(std::abs(dx), std::abs(dz))) / 0.12, 0.0, 1.0);
      const double share = t * t * (3 - 2 * t) * (rim * rim * (3 - 2 * rim));
      row[x] = floor_height + (row[x] - floor_height) * static_cast<float>(share);
    }
  });
}

void slip(Field& field, const ThermalPlan& plan, const Job& job) {
  Array<float> next(job, field.heights.size());
  const std::int32_t stride = field.stride(), rows = field.rows();
  for (int round = 0; round < plan.iterations; ++round) {
    parallel_for(job, static_cast<std::size_t>(rows), rows_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   job.check();
                   for (auto z = static_cast<std::int32_t>(begin); z < static_cast<std::int32_t>(end); ++z) {
                     const auto row = [&](std::int32_t i) {
                       return field.heights.data() + static_cast<std::size_t>(std::clamp(i, 0, rows - 1)) *
                                                         static_cast<std::size_t>(stride);
                     };
                     const float* const around[3] = {row(z - 1), row(z), row(z + 1)};
                     slip_row(around,
                              next.data() + static_cast<std::size_t>(z) * static_cast<std::size_t>(stride),
                              stride, plan, static_cast<float>(field.cell));
                   }
                 });
    std::swap(field.heights, next);
  }
}

}  // namespace seedmesh::terrain
