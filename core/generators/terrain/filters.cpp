#include "core/generators/terrain/filters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/noise.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 32;
// Number of columns that are smoothed together, so that whole cache lines are used.
constexpr std::size_t columns_a_chunk = 256;
// Number of rows that are smoothed together, because each step of a row waits for the previous one.
constexpr std::size_t rows_at_once = 8;

/// Calls body(row of heights, z) for every row, in parallel, including rows and columns of the margin.
template <class Body>
void each_row(Field& field, const Job& job, const Body& body) {
  parallel_for(job, static_cast<std::size_t>(field.rows()), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (std::size_t row = begin; row < end; ++row) {
                   const std::int32_t z = static_cast<std::int32_t>(row) - field.margin;
                   body(field.row(z) - field.margin, z);
                 }
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

/// Returns the part of a difference beyond the talus, with its sign.
float excess(float difference, float talus) {
  const float over = std::abs(difference) - talus;
  return over > 0 ? (difference > 0 ? over : -over) : 0.0F;
}

/// Computes one row of one round of erode_thermally(). `rows` are the rows before, at and after it.
void slip_row(const float* const rows[3], float* out, std::int32_t width, const ThermalPlan& plan,
              float cell) {
  const auto straight = static_cast<float>(plan.talus) * cell;
  const float diagonal = straight * 1.41421356F;
  // Eight neighbours together receive at most half of the excess.
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

double rim_height(const Field& field, const IslandPlan& plan, const Job& job) {
  if (plan.floor) return *plan.floor;
  const Range range = range_of(field, job);
  return range.low - plan.depth.value_or((static_cast<double>(range.high) - range.low) / 4);
}

/// The recursion h[i] = k h[i-1] + (1 - k) h[i], started `reach` samples before i. Its weights decrease by k
/// from sample to sample; the last one has the rest.
class Tail {
 public:
  explicit Tail(double percent) {
    const double k = percent / 100;
    const std::int32_t reach = smooth_reach(percent);
    double weight = 1 - k;
    for (std::int32_t i = 0; i < reach; ++i, weight *= k) weights_.push_back(static_cast<float>(weight));
    weights_.push_back(static_cast<float>(weight / (1 - k)));
  }

  /// Smooths a line, from the samples before each (way -1) or after it (way 1). Beyond the ends, heights are
  /// constant.
  void gather_line(const float* from, std::size_t count, int way, float* padded, float* out) const {
    const std::size_t reach = weights_.size() - 1;
    std::fill(padded, padded + reach, from[0]);
    std::copy(from, from + count, padded + reach);
    std::fill(padded + reach + count, padded + 2 * reach + count, from[count - 1]);
    std::fill(out, out + count, 0.0F);
    for (std::size_t i = 0; i <= reach; ++i) {
      const float* start = way < 0 ? padded + (reach - i) : padded + (reach + i);
      const float weight = weights_[i];
      for (std::size_t x = 0; x < count; ++x) out[x] += weight * start[x];
    }
  }

  /// Smooths row z of the whole array, from the rows before or after it.
  void gather_row(const Field& field, std::size_t z, int way, float* out) const {
    const auto wide = static_cast<std::size_t>(field.stride()), deep = static_cast<std::size_t>(field.rows());
    std::fill(out, out + wide, 0.0F);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const std::size_t at = way < 0 ? (z > i ? z - i : 0) : std::min(z + i, deep - 1);
      const float* row = field.heights.data() + at * wide;
      const float weight = weights_[i];
      for (std::size_t x = 0; x < wide; ++x) out[x] += weight * row[x];
    }
  }

  std::size_t reach() const { return weights_.size() - 1; }

 private:
  std::vector<float> weights_;
};

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

std::int32_t smooth_reach(double percent) {
  if (percent <= 0) return 0;
  if (percent >= 100) return std::numeric_limits<std::int32_t>::max();
  return math::to_int32(std::ceil(24 * math::log(2) / -math::log(percent / 100)));
}

void smooth_by_position(Field& field, double percent, const Job& job) {
  if (percent <= 0) return;
  const Tail tail(percent);
  const auto wide = static_cast<std::size_t>(field.stride()), deep = static_cast<std::size_t>(field.rows());
  parallel_for(job, deep, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    std::vector<float> padded(wide + 2 * tail.reach()), line(wide);
    for (std::size_t z = begin; z < end; ++z) {
      job.check();
      float* row = field.heights.data() + z * wide;
      for (const int way : {-1, 1}) {
        tail.gather_line(row, wide, way, padded.data(), line.data());
        std::copy(line.begin(), line.end(), row);
      }
    }
  });
  Array<float> next(job, field.heights.size());
  for (const int way : {-1, 1}) {
    parallel_for(job, deep, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t z = begin; z < end; ++z) {
        job.check();
        tail.gather_row(field, z, way, next.data() + z * wide);
      }
    });
    std::swap(field.heights, next);
  }
}

void stretch(Field& field, const Heights& from, const Heights& to, const Job& job) {
  const double span = from.high - from.low;
  const double scale = span > 0 ? (to.high - to.low) / span : 0;
  const std::int32_t count = field.stride();
  each_row(field, job, [&](float* row, std::int32_t) {
    for (std::int32_t x = 0; x < count; ++x)
      row[x] = static_cast<float>(to.low + (static_cast<double>(row[x]) - from.low) * scale);
  });
}

void normalise(Field& field, double low, double high, const Job& job) {
  const Range range = range_of(field, job);
  stretch(field, {static_cast<double>(range.low), static_cast<double>(range.high)}, {low, high}, job);
}

void terrace(Field& field, const TerracePlan& plan, const Job& job) {
  const Range range = plan.from
                          ? Range{static_cast<float>(plan.from->low), static_cast<float>(plan.from->high)}
                          : range_of(field, job);
  const float step = (range.high - range.low) / static_cast<float>(plan.count);
  if (!(step > 0)) return;
  // Within a step the height rises as t^p: p = 1 changes nothing, and a large p is flat up to the cliff.
  const double power = 1 / std::max(1e-3, 1 - plan.sharpness);
  const bool cliffs = plan.sharpness >= 1;
  // The highest point of a whole field is at the end of the last step and does not start another.
  const float last = plan.from ? std::numeric_limits<float>::max() : static_cast<float>(plan.count - 1);
  const std::int32_t count = field.stride();
  each_row(field, job, [&](float* row, std::int32_t) {
    for (std::int32_t x = 0; x < count; ++x) {
      const float position = (row[x] - range.low) / step;
      const float whole = std::min(std::floor(position), last);
      const double t = static_cast<double>(position - whole);
      const double raised = cliffs ? (t >= 1 ? 1 : 0) : math::pow(std::clamp(t, 0.0, 1.0), power);
      row[x] = range.low + step * (whole + static_cast<float>(raised));
    }
  });
}

void sink_rim(Field& field, const IslandPlan& plan, Rng rng, const Job& job) {
  const auto floor_height = static_cast<float>(rim_height(field, plan, job));
  const bool alone = plan.side == 0;
  const double middle_x = static_cast<double>(alone ? field.width - 1 : plan.side - 1) / 2.0,
               middle_z = static_cast<double>(alone ? field.depth - 1 : plan.side - 1) / 2.0;
  const double half = std::min(middle_x, middle_z);
  const std::int32_t m = field.margin, count = field.stride();
  const Window window{plan.x - m, plan.z - m, count, field.rows()};
  NoisePlan coast;
  coast.octaves = 5;
  coast.amplitude = plan.roughness * 0.6;
  coast.wavelength = half * 0.9;
  const Field ragged = noisy(coast, window, 1, rng.at("coast"), job);
  each_row(field, job, [&](float* row, std::int32_t z) {
    for (std::int32_t i = 0; i < count; ++i) {
      const double dx = (static_cast<double>(plan.x + i - m) - middle_x) / half,
                   dz = (static_cast<double>(plan.z + z) - middle_z) / half;
      // At the coast the share is one half. The slope extends a third of the reach to each side.
      const double away =
          std::sqrt(dx * dx + dz * dz) / plan.reach + static_cast<double>(ragged.at(i, z + m));
      const double t = std::clamp((1.35 - away) / 0.7, 0.0, 1.0);
      const double rim = std::clamp((1.0 - std::max(std::abs(dx), std::abs(dz))) / 0.12, 0.0, 1.0);
      const double share = t * t * (3 - 2 * t) * (rim * rim * (3 - 2 * rim));
      row[i] = floor_height + (row[i] - floor_height) * static_cast<float>(share);
    }
  });
}

void erode_thermally(Field& field, const ThermalPlan& plan, const Job& job) {
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
