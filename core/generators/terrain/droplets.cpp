/// Hydraulic erosion by drops; see filters.h.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/array.h"
#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/filters.h"

namespace seedmesh::terrain {
namespace {

// Number of drops that share a list of changes.
constexpr std::size_t drops_a_chunk = 64;
// A batch has one drop for this number of samples, so that drops of a batch seldom meet.
constexpr std::size_t samples_a_drop = 256;
constexpr std::size_t least_batch = 64, most_batch = 8192;
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

/// Ground that is eroded (negative) or deposited at a position, in units of a sample's width.
struct Change {
  float x, z, amount;
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

/// Height and slope at a position between samples.
struct Ground {
  float height, east, south;
};

class Drops {
 public:
  Drops(const Field& field, const DropletPlan& plan, Rng rng)
      : field_(field),
        plan_(plan),
        rng_(rng),
        scale_(static_cast<float>(1 / field.cell)),
        steps_(static_cast<int>(std::min(plan.lifetime, most_rounds * (field.width + field.depth)))) {}

  void run(std::size_t drop, Array<Change>& changes) const {
    Rng rng = rng_.at(drop);
    const auto wide = static_cast<float>(field_.width - 1), deep = static_cast<float>(field_.depth - 1);
    float x = static_cast<float>(rng.unit()) * wide, z = static_cast<float>(rng.unit()) * deep;
    x = std::min(x, wide - 1e-3F);
    z = std::min(z, deep - 1e-3F);
    float dx = 0, dz = 0, speed = 1, water = 1, load = 0;
    const auto inertia = static_cast<float>(plan_.inertia);
    Ground here = ground(x, z);
    for (int step = 0; step < steps_; ++step) {
      dx = dx * inertia - here.east * (1 - inertia);
      dz = dz * inertia - here.south * (1 - inertia);
      const float length = std::sqrt(dx * dx + dz * dz);
      if (!(length > 1e-9F)) return;
      dx /= length;
      dz /= length;
      const float to_x = x + dx, to_z = z + dz;
      if (!(to_x >= 0 && to_x < wide && to_z >= 0 && to_z < deep)) return;
      const Ground there = ground(to_x, to_z);
      const float rise = there.height - here.height;
      const float bearable =
          std::max(-rise, least_slope) * speed * water * static_cast<float>(plan_.capacity);
      if (rise > 0 || load > bearable) {
        const float laid =
            rise > 0 ? std::min(rise, load) : (load - bearable) * static_cast<float>(plan_.deposition);
        load -= laid;
        changes.push_back({x, z, laid});
      } else {
        const float taken = std::min((bearable - load) * static_cast<float>(plan_.erosion), -rise);
        load += taken;
        changes.push_back({x, z, -taken});
      }
      speed = std::min(std::sqrt(std::max(0.0F, speed * speed - rise * gravity)), greatest_speed);
      water *= 1 - static_cast<float>(plan_.evaporation);
      x = to_x;
      z = to_z;
      here = there;
    }
  }

 private:
  Ground ground(float x, float z) const {
    const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(z);
    const float u = x - static_cast<float>(i), v = z - static_cast<float>(j);
    const float* north = field_.row(j) + i;
    const float* south = field_.row(j + 1) + i;
    const float nw = north[0] * scale_, ne = north[1] * scale_, sw = south[0] * scale_,
                se = south[1] * scale_;
    const float west = nw + (sw - nw) * v, east = ne + (se - ne) * v;
    return {west + (east - west) * u, east - west, (sw - nw) + ((se - ne) - (sw - nw)) * u};
  }

  const Field& field_;
  const DropletPlan& plan_;
  Rng rng_;
  float scale_;
  int steps_;
};

/// Adds changes to the rows [begin, end), in their order.
class Spread {
 public:
  /// Heights stay within the range before the batch: where many drops of a batch meet, the sum of their changes
  /// can be larger than each of them assumed.
  Spread(Field& field, const Range& range, const Brush& brush)
      : field_(field), range_(range), brush_(brush), scale_(static_cast<float>(field.cell)) {}

  void add(const Change& change, std::int32_t begin, std::int32_t end) const {
    const auto i = static_cast<std::int32_t>(change.x + 0.5F), j = static_cast<std::int32_t>(change.z + 0.5F);
    const std::int32_t top = j - brush_.reach;
    const std::int32_t first = std::max(begin, top), last = std::min(end, j + brush_.reach + 1);
    const float amount = change.amount * scale_;
    for (std::int32_t z = first; z < last; ++z) {
      const Brush::Row& row = brush_.rows[static_cast<std::size_t>(z - top)];
      const std::int32_t west = std::max(0, i - row.half), east = std::min(field_.width - 1, i + row.half);
      float* heights = field_.row(z);
      const float* weights = brush_.weights.data() + row.first;
      for (std::int32_t x = west; x <= east; ++x)
        heights[x] = std::clamp(heights[x] + amount * weights[x - (i - row.half)], range_.low, range_.high);
    }
  }

 private:
  Field& field_;
  Range range_;
  const Brush& brush_;
  float scale_;
};

}  // namespace

void erode(Field& field, const DropletPlan& plan, Rng rng, const Job& job) {
  const double radius = std::clamp(plan.radius, 1.0, 8.0);
  const Brush brush = brush_of(radius);
  const std::size_t samples = static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth);
  const std::size_t batch = std::clamp(samples / samples_a_drop, least_batch, most_batch);
  const auto total = static_cast<std::size_t>(plan.droplets);
  const std::int32_t band = (field.depth + bands - 1) / bands;
  const Range range = range_of(field, job);
  std::vector<Array<Change>> changes;
  for (std::size_t i = 0; i < chunk_count(batch, drops_a_chunk); ++i) changes.emplace_back(job);
  for (std::size_t first = 0; first < total; first += batch) {
    job.check();
    const std::size_t count = std::min(batch, total - first);
    for (Array<Change>& list : changes) list.clear();
    const Drops drops(field, plan, rng.at("drops"));
    parallel_for(job, count, drops_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
      for (std::size_t drop = begin; drop < end; ++drop) {
        job.check();
        drops.run(first + drop, changes[index]);
      }
    });
    const Spread spread(field, range, brush);
    parallel_for(job, static_cast<std::size_t>(bands), 1, [&](std::size_t begin, std::size_t, std::size_t) {
      const std::int32_t top = static_cast<std::int32_t>(begin) * band;
      for (const Array<Change>& list : changes) {
        job.check();
        for (const Change& change : list.span()) spread.add(change, top, std::min(field.depth, top + band));
      }
    });
  }
}

}  // namespace seedmesh::terrain
