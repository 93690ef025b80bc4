#include "core/generators/terrain/flow.h"

#include <array>
#include <cmath>
#include <queue>
#include <vector>

#include "core/base/math.h"
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
constexpr std::size_t look = 4096;

struct Front {
  float height;
  std::uint32_t sample;
  /// Orders by height, then by sample number, so that the order is unique.
  bool operator<(const Front& other) const {
    return height != other.height ? height > other.height : sample > other.sample;
  }
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

}  // namespace

Drainage drainage_of(const Field& field, const Job& job) {
  const std::size_t count = field.heights.size();
  Drainage drainage{Array<std::uint32_t>(job), Array<std::uint32_t>(job, count, none),
                    Array<float>(job, count)};
  drainage.order.reserve(count);
  // The queue contains each sample at most once. An array of that size is charged for it.
  const Array<Front> charge(job, count / 4);
  std::priority_queue<Front> front;
  const auto enter = [&](std::uint32_t sample, float height, std::uint32_t from) {
    drainage.receiver[sample] = from;
    drainage.filled[sample] = height;
    front.push({height, sample});
  };
  const auto width = static_cast<std::uint32_t>(field.width), depth = static_cast<std::uint32_t>(field.depth);
  for (std::uint32_t z = 0; z < depth; ++z) {
    const bool whole = z == 0 || z == depth - 1;
    for (std::uint32_t x = 0; x < width; x += whole ? 1 : width - 1) {
      const std::uint32_t sample = z * width + x;
      enter(sample, field.heights[sample], sample);
    }
  }
  while (!front.empty()) {
    if (drainage.order.size() % look == 0) job.check();
    const Front lowest = front.top();
    front.pop();
    drainage.order.push_back(lowest.sample);
    each_neighbour(field, lowest.sample, [&](std::uint32_t next, float) {
      if (drainage.receiver[next] == none)
        enter(next, std::max(field.heights[next], lowest.height), lowest.sample);
    });
  }
  // Outside depressions, water follows the steepest slope, which always leads to an earlier sample.
  for (const std::uint32_t sample : drainage.order) {
    if (drainage.receiver[sample] == sample || drainage.filled[sample] > field.heights[sample]) continue;
    float steepest = 0;
    each_neighbour(field, sample, [&](std::uint32_t next, float distance) {
      const float slope = (drainage.filled[sample] - drainage.filled[next]) / distance;
      if (slope > steepest) {
        steepest = slope;
        drainage.receiver[sample] = next;
      }
    });
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

void cut_rivers(Field& field, const StreamPlan& plan, const Job& job) {
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
