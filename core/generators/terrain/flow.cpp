#include "core/generators/terrain/flow.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "core/base/math.h"
#include "core/base/wide.h"
#include "core/generators/terrain/filters.h"

namespace seedmesh::terrain {
namespace {

struct Neighbour {
  std::int32_t dx, dz;
  float distance;
};
constexpr float root2 = 1.41421356F;
constexpr std::array<Neighbour, 8> neighbours{{{-1, -1, root2},
                                               {0, -1, 1},
                                               {1, -1, root2},
                                               {-1, 0, 1},
                                               {1, 0, 1},
                                               {-1, 1, root2},
                                               {0, 1, 1},
                                               {1, 1, root2}}};
constexpr std::uint32_t none = 0xFFFFFFFFU;
// Number of samples between two checks of the clock.
constexpr std::size_t look = 4096, rows_a_look = 16;

/// The numbers of all samples in ascending order of height, and of number where heights are equal: a radix sort of three
/// digits. Heights are finite.
Array<std::uint32_t> ascending(const Field& field, const Job& job) {
  constexpr std::uint32_t digit = 11, values = 1U << digit, sign = 1U << 31U;
  const std::size_t count = field.heights.size();
  Array<std::uint64_t> items(job, count), sorted(job, count);
  std::array<std::array<std::uint32_t, values>, 3> starts{};
  for (std::size_t i = 0; i < count; ++i) {
    // Bits of floats compare as their values do once the sign is turned, and all bits of negative ones.
    const auto bits = std::bit_cast<std::uint32_t>(field.heights[i] + 0.0F);
    const std::uint32_t key = (bits & sign) != 0 ? ~bits : bits | sign;
    items[i] = std::uint64_t{key} << 32U | i;
    for (std::uint32_t pass = 0; pass < 3; ++pass) ++starts[pass][key >> (digit * pass) & (values - 1)];
  }
  for (std::uint32_t pass = 0; pass < 3; ++pass) {
    job.check();
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts[pass]) start = std::exchange(sum, sum + start);
    for (const std::uint64_t item : items)
      sorted[starts[pass][item >> (32 + digit * pass) & (values - 1)]++] = item;
    std::swap(items, sorted);
  }
  Array<std::uint32_t> order(job, count);
  for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<std::uint32_t>(items[i]);
  return order;
}

/// Samples that wait, in the order of their levels, which are ranks of heights. A sample enters at the level of the
/// last one that left, or above it.
class LevelQueue {
 public:
  LevelQueue(std::size_t count, const Job& job)
      : first_(job, count, none), last_(job, count), next_(job, count) {}

  void push(std::uint32_t level, std::uint32_t sample) {
    next_[sample] = none;
    if (first_[level] == none) {
      first_[level] = sample;
    } else {
      next_[last_[level]] = sample;
    }
    last_[level] = sample;
  }
  /// The first sample of the lowest level, or none.
  std::uint32_t pop() {
    while (level_ < first_.size() && first_[level_] == none) ++level_;
    if (level_ == first_.size()) return none;
    const std::uint32_t sample = first_[level_];
    first_[level_] = next_[sample];
    return sample;
  }
  /// Of the last sample that left.
  std::uint32_t level() const { return static_cast<std::uint32_t>(level_); }

 private:
  Array<std::uint32_t> first_, last_, next_;
  std::size_t level_ = 0;
};

template <class Body>
void each_neighbour(const Field& field, std::uint32_t sample, const Body& body) {
  const auto x = static_cast<std::int32_t>(sample % static_cast<std::uint32_t>(field.width));
  const auto z = static_cast<std::int32_t>(sample / static_cast<std::uint32_t>(field.width));
  for (const Neighbour& each : neighbours) {
    const std::int32_t nx = x + each.dx, nz = z + each.dz;
    if (nx < 0 || nz < 0 || nx >= field.width || nz >= field.depth) continue;
    body(static_cast<std::uint32_t>(nz * field.width + nx), each.distance);
  }
}

/// For samples that are not on the border.
template <class Body>
void each_inner_neighbour(const Field& field, std::uint32_t sample, const Body& body) {
  for (const Neighbour& each : neighbours) {
    const std::int32_t apart = each.dz * field.width + each.dx;
    body(static_cast<std::uint32_t>(static_cast<std::int32_t>(sample) + apart), each.distance);
  }
}

/// Sets the receivers of a row of samples to their steepest neighbours. It leaves out samples below water and on flat
/// ground. `number` is that of the first sample.
SEEDMESH_WIDE void follow_slopes(const float* __restrict heights, const float* filled, std::size_t width,
                                 std::size_t count, std::uint32_t number,
                                 std::uint32_t* __restrict receiver) {
  const float *const above = filled - width, *const below = filled + width;
  constexpr float across = 1 / root2;
  for (std::size_t x = 0; x < count; ++x) {
    const float here = filled[x];
    const std::uint32_t own = number + static_cast<std::uint32_t>(x),
                        north = own - static_cast<std::uint32_t>(width),
                        south = own + static_cast<std::uint32_t>(width);
    float steepest = 0;
    std::uint32_t to = receiver[x];
    const auto compare = [&](float there, float by_distance, std::uint32_t sample) {
      const float slope = (here - there) * by_distance;
      to = slope > steepest ? sample : to;
      steepest = slope > steepest ? slope : steepest;
    };
    compare(above[x - 1], across, north - 1);
    compare(above[x], 1, north);
    compare(above[x + 1], across, north + 1);
    compare(filled[x - 1], 1, own - 1);
    compare(filled[x + 1], 1, own + 1);
    compare(below[x - 1], across, south - 1);
    compare(below[x], 1, south);
    compare(below[x + 1], across, south + 1);
    receiver[x] = here > heights[x] ? receiver[x] : to;
  }
}

}  // namespace

// Priority-Flood (Barnes, Lehman and Mulla, 2014) with ranks of heights instead of heights: a level of the water is
// always the height of a sample, so that the queue needs no comparisons.
Drainage drainage_of(const Field& field, const Job& job) {
  const std::size_t count = field.heights.size();
  Drainage drainage{Array<std::uint32_t>(job), Array<std::uint32_t>(job, count, none),
                    Array<float>(job, count)};
  drainage.order.reserve(count);
  const Array<std::uint32_t> by_rank = ascending(field, job);
  Array<std::uint32_t> rank(job, count);
  for (std::size_t i = 0; i < count; ++i) rank[by_rank[i]] = static_cast<std::uint32_t>(i);
  LevelQueue queue(count, job);
  const auto width = static_cast<std::uint32_t>(field.width), depth = static_cast<std::uint32_t>(field.depth);
  const auto is_inside = [&](std::uint32_t sample) { return drainage.receiver[sample] != sample; };
  for (std::uint32_t z = 0; z < depth; ++z) {
    const bool whole = z == 0 || z == depth - 1;
    for (std::uint32_t x = 0; x < width; x += whole ? 1 : width - 1) {
      const std::uint32_t sample = z * width + x;
      drainage.receiver[sample] = sample;
      queue.push(rank[sample], sample);
    }
  }
  for (std::uint32_t sample = queue.pop(); sample != none; sample = queue.pop()) {
    if (drainage.order.size() % look == 0) job.check();
    drainage.order.push_back(sample);
    drainage.filled[sample] = field.heights[by_rank[queue.level()]];
    const auto enter = [&](std::uint32_t next, float) {
      if (drainage.receiver[next] != none) return;
      drainage.receiver[next] = sample;
      queue.push(std::max(rank[next], queue.level()), next);
    };
    if (is_inside(sample)) {
      each_inner_neighbour(field, sample, enter);
    } else {
      each_neighbour(field, sample, enter);
    }
  }
  // Outside depressions, water follows the steepest slope, which always leads to an earlier sample.
  for (std::size_t z = 1; z + 1 < depth; ++z) {
    if (z % rows_a_look == 0) job.check();
    const std::size_t first = z * width + 1;
    follow_slopes(field.heights.data() + first, drainage.filled.data() + first, width, width - 2,
                  static_cast<std::uint32_t>(first), drainage.receiver.data() + first);
  }
  return drainage;
}

Array<float> gathered(const Field& field, const Drainage& drainage, const Job& job) {
  Array<float> area(job, field.heights.size(), 1.0F);
  for (std::size_t i = drainage.order.size(); i-- > 0;) {
    if (i % look == 0) job.check();
    const std::uint32_t sample = drainage.order[i];
    const float height = drainage.filled[sample];
    float total = 0;
    each_neighbour(field, sample, [&](std::uint32_t next, float distance) {
      const float slope = (height - drainage.filled[next]) / distance;
      if (slope > 0) total += slope;
    });
    if (total > 0) {
      each_neighbour(field, sample, [&](std::uint32_t next, float distance) {
        const float slope = (height - drainage.filled[next]) / distance;
        if (slope > 0) area[next] += area[sample] * (slope / total);
      });
    } else if (drainage.receiver[sample] != sample) {
      area[drainage.receiver[sample]] += area[sample];
    }
  }
  return area;
}

void erode_by_streams(Field& field, const StreamPlan& plan, const Job& job) {
  const std::size_t count = field.heights.size();
  const double reference = static_cast<double>(count) / 100;
  for (int step = 0; step < plan.iterations; ++step) {
    const Drainage drainage = drainage_of(field, job);
    Array<float> area(job, count, 1.0F);
    for (std::size_t i = count; i-- > 0;) {
      const std::uint32_t sample = drainage.order[i], to = drainage.receiver[sample];
      if (to != sample) area[to] += area[sample];
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (i % look == 0) job.check();
      const std::uint32_t sample = drainage.order[i], to = drainage.receiver[sample];
      if (to == sample || field.heights[sample] <= field.heights[to]) continue;
      const double share = static_cast<double>(area[sample]) / reference;
      const double power =
          plan.area_exponent == 0.5 ? std::sqrt(share) : math::pow(share, plan.area_exponent);
      const double factor = plan.strength * power;
      field.heights[sample] = static_cast<float>(
          (static_cast<double>(field.heights[sample]) + factor * static_cast<double>(field.heights[to])) /
          (1 + factor));
    }
  }
}

}  // namespace seedmesh::terrain
