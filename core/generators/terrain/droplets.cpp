/// Hydraulic erosion by drops; see filters.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
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
// Samples of a row of the brush that are computed together.
constexpr std::int32_t lanes = 8;
// Drops that run at once: each step of one waits for the step before.
constexpr std::size_t drops_at_once = 4;

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

/// Weights about a sample, in rows from -reach to reach. A row has those of -reach .. reach and then zeros, so that its
/// length is a multiple of `lanes`.
struct Brush {
  std::int32_t reach = 0, pitch = 0;
  std::vector<float> weights;
};

/// Returns weights that decrease from the centre to `radius` and sum to 1.
Brush brush_of(double radius) {
  Brush brush;
  brush.reach = math::to_int32(std::ceil(radius));
  double sum = 0;
  brush.pitch = (2 * brush.reach + lanes) / lanes * lanes;
  for (std::int32_t dz = -brush.reach; dz <= brush.reach; ++dz) {
    for (std::int32_t dx = -brush.reach; dx < brush.pitch - brush.reach; ++dx) {
      const double weight = dx > brush.reach ? 0 : radius - std::sqrt(static_cast<double>(dx * dx + dz * dz));
      const bool is_inside = weight > 0 || (dx == 0 && dz == 0);
      brush.weights.push_back(is_inside ? static_cast<float>(std::max(weight, 1e-3)) : 0);
      sum += is_inside ? std::max(weight, 1e-3) : 0;
    }
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

  /// A drop on its way.
  struct State {
    float x, z, dx = 0, dz = 0, speed = 1, water = 1, load = 0;
    Ground here{};
    bool runs = true;
  };

  State start(std::size_t drop) const {
    Rng rng = rng_.at(drop);
    const auto wide = static_cast<float>(field_.width - 1), deep = static_cast<float>(field_.depth - 1);
    State state{};
    state.x = std::min(static_cast<float>(rng.unit()) * wide, wide - 1e-3F);
    state.z = std::min(static_cast<float>(rng.unit()) * deep, deep - 1e-3F);
    state.here = ground(state.x, state.z);
    return state;
  }

  /// One step. Appends its change.
  void advance(State& s, std::vector<Change>& changes) const {
    const auto wide = static_cast<float>(field_.width - 1), deep = static_cast<float>(field_.depth - 1);
    const auto inertia = static_cast<float>(plan_.inertia);
    s.runs = false;
    s.dx = s.dx * inertia - s.here.east * (1 - inertia);
    s.dz = s.dz * inertia - s.here.south * (1 - inertia);
    const float length = std::sqrt(s.dx * s.dx + s.dz * s.dz);
    if (!(length > 1e-9F)) return;
    s.dx /= length;
    s.dz /= length;
    const float to_x = s.x + s.dx, to_z = s.z + s.dz;
    if (!(to_x >= 0 && to_x < wide && to_z >= 0 && to_z < deep)) return;
    const Ground there = ground(to_x, to_z);
    const float rise = there.height - s.here.height;
    const float bearable =
        std::max(-rise, least_slope) * s.speed * s.water * static_cast<float>(plan_.capacity);
    if (rise > 0 || s.load > bearable) {
      const float laid =
          rise > 0 ? std::min(rise, s.load) : (s.load - bearable) * static_cast<float>(plan_.deposition);
      s.load -= laid;
      changes.push_back({s.x, s.z, laid});
    } else {
      const float taken = std::min((bearable - s.load) * static_cast<float>(plan_.erosion), -rise);
      s.load += taken;
      changes.push_back({s.x, s.z, -taken});
    }
    s.speed = std::min(std::sqrt(std::max(0.0F, s.speed * s.speed - rise * gravity)), greatest_speed);
    s.water *= 1 - static_cast<float>(plan_.evaporation);
    s.x = to_x;
    s.z = to_z;
    s.here = there;
    s.runs = true;
  }

  /// Runs the drops [begin, end). Appends their changes, drop by drop.
  void run(std::size_t begin, std::size_t end, Array<Change>& changes, const Job& job) const {
    std::array<std::vector<Change>, drops_at_once> own;
    for (std::size_t first = begin; first < end; first += drops_at_once) {
      job.check();
      const std::size_t count = std::min(drops_at_once, end - first);
      std::array<State, drops_at_once> states{};
      for (std::size_t i = 0; i < count; ++i) {
        states[i] = start(first + i);
        own[i].clear();
      }
      bool runs = true;
      for (int step = 0; step < steps_ && runs; ++step) {
        runs = false;
        for (std::size_t i = 0; i < count; ++i) {
          if (states[i].runs) advance(states[i], own[i]);
          runs = runs || states[i].runs;
        }
      }
      for (std::size_t i = 0; i < count; ++i) changes.append(std::span<const Change>(own[i]));
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
    const std::int32_t top = j - brush_.reach, left = i - brush_.reach;
    const std::int32_t first = std::max(begin, top), last = std::min(end, j + brush_.reach + 1);
    const float amount = change.amount * scale_;
    const bool is_whole = left >= 0 && left + brush_.pitch <= field_.width;
    const std::int32_t west = std::max(0, left), east = std::min(field_.width, left + brush_.pitch);
    for (std::int32_t z = first; z < last; ++z) {
      float* const heights = field_.row(z);
      const float* const weights = brush_.weights.data() + (z - top) * brush_.pitch;
      if (is_whole) {
        for (std::int32_t k = 0; k < brush_.pitch; k += lanes)
          add_lanes(heights + left + k, weights + k, amount);
      } else {
        for (std::int32_t x = west; x < east; ++x)
          heights[x] = clamped(heights[x] + amount * weights[x - left]);
      }
    }
  }

 private:
  float clamped(float height) const {
    const float raised = height < range_.low ? range_.low : height;
    return range_.high < raised ? range_.high : raised;
  }

  void add_lanes(float* __restrict heights, const float* __restrict weights, float amount) const {
    for (std::int32_t k = 0; k < lanes; ++k) heights[k] = clamped(heights[k] + amount * weights[k]);
  }

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
      drops.run(first + begin, first + end, changes[index], job);
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
