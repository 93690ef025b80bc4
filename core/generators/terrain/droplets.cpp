/// Hydraulic erosion by drops; see filters.h.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/array.h"
#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/generators/terrain/filters.h"

namespace seedmesh::terrain {
namespace {

// Number of drops that share a list of changes.
constexpr std::size_t drops_a_chunk = 64;
// A batch has one drop for this number of samples, so that drops of a batch seldom meet.
constexpr std::size_t samples_a_drop = 256;
constexpr std::size_t least_batch = 64, most_batch = 65'536;
// Rows between two checks of the deadline.
constexpr std::int32_t rows_a_look = 16;
// Number of bands of rows to which changes are applied in parallel.
constexpr std::int32_t bands = 4;

// Gravity in samples per squared step; the least slope for the capacity of flat water; and the greatest speed.
// Without the last, a drop that falls down a cliff would erode all ground below it.
constexpr float gravity = 1;
constexpr float least_slope = 0.005F;
constexpr float greatest_speed = 2.5F;

// A drop ends when its path is this number of times as long as both sides of the field: it circles in a
// hollow.
constexpr double most_rounds = 4;

/// Ground that is eroded (negative) or deposited at a sample, in units of a sample's width.
struct Change {
  std::int32_t sample;  ///< position in Changes
  float amount;
};

/// Weights about a sample, in rows from -reach to reach. A row has those of -half .. half.
struct Brush {
  struct Row {
    std::int32_t half;
    std::size_t first;  ///< position in `weights`
  };
  std::int32_t reach = 0;
  std::vector<Row> rows;
  std::vector<float> weights;
};

/// Returns weights that decrease from the centre to `radius` and sum to 1.
Brush brush_of(double radius) {
  Brush brush;
  brush.reach = math::to_int32(std::ceil(radius));
  double sum = 0;
  for (std::int32_t dz = -brush.reach; dz <= brush.reach; ++dz) {
    Brush::Row row{-1, brush.weights.size()};
    for (std::int32_t dx = -brush.reach; dx <= brush.reach; ++dx) {
      const double weight = radius - std::sqrt(static_cast<double>(dx * dx + dz * dz));
      if (weight <= 0 && (dx != 0 || dz != 0)) continue;
      row.half = std::max(row.half, dx);
      brush.weights.push_back(static_cast<float>(std::max(weight, 1e-3)));
      sum += std::max(weight, 1e-3);
    }
    brush.rows.push_back(row);
  }
  for (float& weight : brush.weights) weight /= static_cast<float>(sum);
  return brush;
}

// Drops that a vector holds, for all processors, so that the order of their changes is the same.
constexpr std::size_t lanes = 16;

/// Drops that fall side by side.
struct Drops {
  alignas(64) float x[lanes], z[lanes];    ///< positions in samples
  alignas(64) float dx[lanes], dz[lanes];  ///< direction
  alignas(64) float speed[lanes], water[lanes], load[lanes];
  alignas(64) float height[lanes], east[lanes], south[lanes];  ///< height and slope of the ground
  alignas(64) std::int32_t is_falling[lanes];                  ///< 0 or 1
};

/// What a step changes: ground that is eroded (negative) or deposited at the samples next to the drops.
struct Step {
  alignas(64) std::int32_t sample[lanes];
  alignas(64) float amount[lanes];
  alignas(64) std::int32_t is_made[lanes];  ///< 0 or 1
};

/// The samples of a field, and the plan as numbers of one kind.
struct Basin {
  const float* heights;  ///< of the first sample
  std::int32_t stride;
  float wide, deep;  ///< the last column and row
  float scale;       ///< heights in samples by heights in metres
  float inertia, capacity, erosion, deposition, kept_water;
  std::int32_t change_stride;  ///< of Changes
};

/// Height and slope between the samples around the positions. Only the loop in the middle, which loads samples, is not
/// made of vectors.
inline void read_ground(const Basin basin, const float* __restrict x, const float* __restrict z,
                        float* __restrict height, float* __restrict east, float* __restrict south) {
  alignas(64) std::int32_t at[lanes];
  alignas(64) float u[lanes], v[lanes], nw[lanes], ne[lanes], sw[lanes], se[lanes];
  for (std::size_t k = 0; k < lanes; ++k) {
    const auto i = static_cast<std::int32_t>(x[k]), j = static_cast<std::int32_t>(z[k]);
    u[k] = x[k] - static_cast<float>(i);
    v[k] = z[k] - static_cast<float>(j);
    at[k] = j * basin.stride + i;
  }
  for (std::size_t k = 0; k < lanes; ++k) {
    const float *north = basin.heights + at[k], *south_of = north + basin.stride;
    nw[k] = north[0];
    ne[k] = north[1];
    sw[k] = south_of[0];
    se[k] = south_of[1];
  }
  for (std::size_t k = 0; k < lanes; ++k) {
    const float of_west = nw[k] + (sw[k] - nw[k]) * v[k], of_east = ne[k] + (se[k] - ne[k]) * v[k];
    const float of_north = ne[k] - nw[k], of_south = se[k] - sw[k];
    height[k] = (of_west + (of_east - of_west) * u[k]) * basin.scale;
    east[k] = (of_east - of_west) * basin.scale;
    south[k] = ((sw[k] - nw[k]) + (of_south - of_north) * u[k]) * basin.scale;
  }
}

/// Moves the drops by a sample. `basin` is a copy, because stores to numbers behind a reference would prevent vectors.
/// Those that stand on flat ground or leave the field stop, without a change.
SEEDMESH_WIDE void fall(const Basin basin, Drops& __restrict drops, Step& __restrict step) {
  alignas(64) float to_x[lanes], to_z[lanes], dx[lanes], dz[lanes], height[lanes], east[lanes], south[lanes];
  for (std::size_t k = 0; k < lanes; ++k) {
    const float turn_x = drops.dx[k] * basin.inertia - drops.east[k] * (1 - basin.inertia);
    const float turn_z = drops.dz[k] * basin.inertia - drops.south[k] * (1 - basin.inertia);
    const float length = std::sqrt(turn_x * turn_x + turn_z * turn_z);
    const float by_length = 1 / (length > 1e-9F ? length : 1.0F);
    dx[k] = turn_x * by_length;
    dz[k] = turn_z * by_length;
    const float there_x = drops.x[k] + dx[k], there_z = drops.z[k] + dz[k];
    const std::int32_t is_inside =
        static_cast<std::int32_t>(there_x >= 0) & static_cast<std::int32_t>(there_x < basin.wide) &
        static_cast<std::int32_t>(there_z >= 0) & static_cast<std::int32_t>(there_z < basin.deep);
    drops.is_falling[k] &= is_inside & static_cast<std::int32_t>(length > 1e-9F);
    to_x[k] = is_inside != 0 ? there_x : 0.0F;
    to_z[k] = is_inside != 0 ? there_z : 0.0F;
  }
  read_ground(basin, to_x, to_z, height, east, south);
  for (std::size_t k = 0; k < lanes; ++k) {
    const float rise = height[k] - drops.height[k], load = drops.load[k], speed = drops.speed[k];
    const float slope = -rise > least_slope ? -rise : least_slope;
    const float surplus = load - slope * speed * drops.water[k] * basin.capacity;
    const float filled = rise < load ? rise : load;
    const float wanted = -surplus * basin.erosion, taken = wanted < -rise ? wanted : -rise;
    const float laid = rise > 0 ? filled : surplus > 0 ? surplus * basin.deposition : -taken;
    // The nearest sample is the whole part.
    const auto column = static_cast<std::int32_t>(drops.x[k] + 0.5F),
               row = static_cast<std::int32_t>(drops.z[k] + 0.5F);
    step.sample[k] = row * basin.change_stride + column;
    step.amount[k] = laid;
    step.is_made[k] = drops.is_falling[k];
    drops.load[k] = load - laid;
    const float squared = speed * speed - rise * gravity;
    const float faster = std::sqrt(squared > 0 ? squared : 0.0F);
    drops.speed[k] = faster < greatest_speed ? faster : greatest_speed;
    drops.water[k] *= basin.kept_water;
    drops.x[k] = to_x[k];
    drops.z[k] = to_z[k];
    drops.dx[k] = dx[k];
    drops.dz[k] = dz[k];
    drops.height[k] = height[k];
    drops.east[k] = east[k];
    drops.south[k] = south[k];
  }
}

class Rain {
 public:
  Rain(const Field& field, const DropletPlan& plan, std::int32_t change_stride, Rng rng)
      : basin_{field.row(0),
               field.stride(),
               static_cast<float>(field.width - 1),
               static_cast<float>(field.depth - 1),
               static_cast<float>(1 / field.cell),
               static_cast<float>(plan.inertia),
               static_cast<float>(plan.capacity),
               static_cast<float>(plan.erosion),
               static_cast<float>(plan.deposition),
               1 - static_cast<float>(plan.evaporation),
               change_stride},
        rng_(rng),
        steps_(static_cast<int>(std::min(plan.lifetime, most_rounds * (field.width + field.depth)))) {}

  /// Lets the drops [first, first + count) fall, at most one vector of them.
  void run(std::size_t first, std::size_t count, Array<Change>& changes) const {
    Drops drops = begin(first, count);
    Step step;
    for (int i = 0; i < steps_; ++i) {
      fall(basin_, drops, step);
      std::int32_t made = 0;
      for (std::size_t k = 0; k < lanes; ++k) {
        made |= step.is_made[k];
        if (step.is_made[k] != 0) changes.push_back({step.sample[k], step.amount[k]});
      }
      if (made == 0) return;
    }
  }

 private:
  Drops begin(std::size_t first, std::size_t count) const {
    Drops drops{};
    for (std::size_t k = 0; k < count; ++k) {
      Rng rng = rng_.at(first + k);
      drops.x[k] = std::min(static_cast<float>(rng.unit()) * basin_.wide, basin_.wide - 1e-3F);
      drops.z[k] = std::min(static_cast<float>(rng.unit()) * basin_.deep, basin_.deep - 1e-3F);
      drops.is_falling[k] = 1;
    }
    std::fill_n(drops.speed, lanes, 1.0F);
    std::fill_n(drops.water, lanes, 1.0F);
    read_ground(basin_, drops.x, drops.z, drops.height, drops.east, drops.south);
    return drops;
  }

  Basin basin_;
  Rng rng_;
  int steps_;
};

/// The sum of changes at each sample, with a margin of the brush's reach that stays zero or is ignored.
class Changes {
 public:
  Changes(const Field& field, const Brush& brush, const Job& job)
      : reach_(brush.reach),
        stride_(field.width + 2 * brush.reach),
        sums_(job,
              static_cast<std::size_t>(stride_) * static_cast<std::size_t>(field.depth + 2 * brush.reach),
              0) {}

  /// From one row to the next.
  std::int32_t stride() const { return stride_; }
  /// Adds those at the rows [begin, end).
  void add(const Array<Change>& list, std::int32_t begin, std::int32_t end) {
    float* const first = row(begin);
    const std::int32_t before = begin * stride_;
    const auto count = static_cast<std::uint32_t>((end - begin) * stride_);
    for (const Change& change : list.span()) {
      const auto at = static_cast<std::uint32_t>(change.sample - before);
      if (at < count) first[at] += change.amount;
    }
  }

  void clear(std::int32_t z, std::int32_t width) { std::fill_n(row(z), width, 0.0F); }
  /// Row z, from its first sample; rows and columns of the margin exist.
  float* row(std::int32_t z) {
    return sums_.data() + static_cast<std::size_t>(z + reach_) * static_cast<std::size_t>(stride_) + reach_;
  }
  const float* row(std::int32_t z) const {
    return sums_.data() + static_cast<std::size_t>(z + reach_) * static_cast<std::size_t>(stride_) + reach_;
  }

 private:
  std::int32_t reach_, stride_;
  Array<float> sums_;
};

SEEDMESH_WIDE void add_weighted(const float* __restrict sums, float weight, std::int32_t width,
                                float* __restrict out) {
  for (std::int32_t x = 0; x < width; ++x) out[x] += weight * sums[x];
}

/// Heights stay within the range before the batch: where many drops of a batch meet, the sum of their changes can be
/// larger than each of them assumed.
SEEDMESH_WIDE void add_clamped(const float* __restrict change, float scale, const Range range,
                               std::int32_t width, float* __restrict heights) {
  for (std::int32_t x = 0; x < width; ++x) {
    const float height = heights[x] + scale * change[x];
    heights[x] = height < range.low ? range.low : height > range.high ? range.high : height;
  }
}

/// Spreads the changes over the samples of a row by the weights of the brush.
void spread(const Changes& changes, const Brush& brush, const Range& range, std::int32_t z,
            std::vector<float>& change, Field& field) {
  std::fill(change.begin(), change.end(), 0.0F);
  for (std::int32_t dz = -brush.reach; dz <= brush.reach; ++dz) {
    const Brush::Row& row = brush.rows[static_cast<std::size_t>(dz + brush.reach)];
    for (std::int32_t dx = -row.half; dx <= row.half; ++dx) {
      const float weight = brush.weights[row.first + static_cast<std::size_t>(dx + row.half)];
      add_weighted(changes.row(z + dz) + dx, weight, field.width, change.data());
    }
  }
  add_clamped(change.data(), static_cast<float>(field.cell), range, field.width, field.row(z));
}

}  // namespace

void erode_by_droplets(Field& field, const DropletPlan& plan, Rng rng, const Job& job) {
  const double radius = std::clamp(plan.radius, 1.0, 8.0);
  const Brush brush = brush_of(radius);
  const std::size_t samples = static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth);
  const std::size_t batch = std::clamp(samples / samples_a_drop, least_batch, most_batch);
  const auto total = static_cast<std::size_t>(plan.droplets);
  const std::int32_t band = (field.depth + bands - 1) / bands;
  const Range range = range_of(field, job);
  std::vector<Array<Change>> lists;
  for (std::size_t i = 0; i < chunk_count(batch, drops_a_chunk); ++i) lists.emplace_back(job);
  Changes changes(field, brush, job);
  const auto each_band = [&](const auto& body) {
    parallel_for(job, static_cast<std::size_t>(bands), 1, [&](std::size_t begin, std::size_t, std::size_t) {
      const std::int32_t top = static_cast<std::int32_t>(begin) * band;
      body(top, std::min(field.depth, top + band));
    });
  };
  for (std::size_t first = 0; first < total; first += batch) {
    job.check();
    const std::size_t count = std::min(batch, total - first);
    for (Array<Change>& list : lists) list.clear();
    const Rain rain(field, plan, changes.stride(), rng.at("drops"));
    parallel_for(job, count, drops_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
      for (std::size_t drop = begin; drop < end; drop += lanes) {
        job.check();
        rain.run(first + drop, std::min(lanes, end - drop), lists[index]);
      }
    });
    each_band([&](std::int32_t begin, std::int32_t end) {
      for (std::int32_t z = begin; z < end; ++z) changes.clear(z, field.width);
      for (const Array<Change>& list : lists) {
        job.check();
        changes.add(list, begin, end);
      }
    });
    each_band([&](std::int32_t begin, std::int32_t end) {
      std::vector<float> change(static_cast<std::size_t>(field.width));
      for (std::int32_t z = begin; z < end; ++z) {
        if (z % rows_a_look == 0) job.check();
        spread(changes, brush, range, z, change, field);
      }
    });
  }
}

}  // namespace seedmesh::terrain
