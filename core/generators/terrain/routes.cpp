/// Basins and their passes after Cordonnier, Bovy and Braun, "A versatile, linear complexity algorithm for flow routing
/// in topographies with depressions", 2019. Barnes, Lehman and Mulla, "Priority-flood", 2014, define the receivers.
#include "core/generators/terrain/routes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/wide.h"
#include "core/generators/terrain/flow.h"

namespace seedmesh::terrain {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU, outside = 0;
constexpr float by_root2 = 1 / 1.41421356F;
constexpr std::array<float, 8> by_distance = {by_root2, 1, by_root2, 1, 1, by_root2, 1, by_root2};
constexpr std::size_t look = 65'536;  ///< samples between two checks of the clock

/// The distances of the eight neighbours in the array of samples, in the order of flow.cpp.
std::array<std::int32_t, 8> neighbours_of(const Field& field) {
  const std::int32_t w = field.width;
  return {-w - 1, -w, -w + 1, -1, 1, w - 1, w, w + 1};
}

/// The steepest of eight neighbours for the inner samples of a row, or the sample itself without a lower one.
SEEDMESH_WIDE void find_steepest(const float* __restrict row, const std::array<std::int32_t, 8>& apart,
                                 std::int32_t first, std::int32_t count, std::uint32_t* __restrict out) {
  const float* const rows[8] = {row + apart[0], row + apart[1], row + apart[2], row + apart[3],
                                row + apart[4], row + apart[5], row + apart[6], row + apart[7]};
  for (std::int32_t x = 0; x < count; ++x) {
    const float height = row[x];
    float steepest = 0;
    std::int32_t to = 0;
#pragma GCC unroll 8
    for (std::size_t k = 0; k < 8; ++k) {
      const float slope = (height - rows[k][x]) * by_distance[k];
      to = slope > steepest ? apart[k] : to;
      steepest = slope > steepest ? slope : steepest;
    }
    out[x] = static_cast<std::uint32_t>(first + x + to);
  }
}

/// A pass between two basins. Levels and heights are compared as keys: the bits of a height, then the sample.
struct Pass {
  std::uint64_t level;
  std::uint32_t a, b;
  bool operator<(const Pass& other) const { return level < other.level; }
};

class RouteSearch {
 public:
  RouteSearch(const Field& field, const Job& job)
      : field_(field),
        job_(job),
        apart_(neighbours_of(field)),
        count_(field.heights.size()),
        receiver_(job, count_),
        basin_(job) {}

  Routes run() {
    descend();
    if (pits_.size() > 1 && !fill()) return flooded();
    for (const std::uint32_t sample : flats_) {
      if (receiver_[sample] == sample) receiver_[sample] = first_neighbour(sample);
    }
    return sorted();
  }

 private:
  std::uint64_t key(std::uint32_t sample) const {
    constexpr std::uint32_t sign = 1U << 31U;
    const auto bits = std::bit_cast<std::uint32_t>(field_.heights[sample] + 0.0F);
    return std::uint64_t{(bits & sign) != 0 ? ~bits : bits | sign} << 32U | sample;
  }

  std::uint32_t beside(std::uint32_t sample, std::size_t k) const {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(sample) + apart_[k]);
  }

  bool is_border(std::uint32_t sample) const {
    const auto width = static_cast<std::uint32_t>(field_.width);
    const std::uint32_t x = sample % width, z = sample / width;
    return x == 0 || z == 0 || x + 1 == width || z + 1 == static_cast<std::uint32_t>(field_.depth);
  }

  /// Sets all receivers as if there were no depressions, and collects the samples without a lower neighbour.
  void descend() {
    const std::int32_t width = field_.width, last = field_.depth - 1;
    for (std::int32_t z = 0; z <= last; ++z) {
      if (z % 64 == 0) job_.check();
      const std::int32_t first = z * width;
      std::uint32_t* const out = receiver_.data() + first;
      if (z == 0 || z == last || width < 3) {
        std::iota(out, out + width, static_cast<std::uint32_t>(first));
        continue;
      }
      out[0] = static_cast<std::uint32_t>(first);
      out[width - 1] = static_cast<std::uint32_t>(first + width - 1);
      find_steepest(field_.row(z) + 1, apart_, first + 1, width - 2, out + 1);
      for (std::int32_t x = 1; x + 1 < width; ++x) {
        const auto sample = static_cast<std::uint32_t>(first + x);
        if (out[x] == sample) flats_.push_back(sample);
      }
    }
    // Samples of equal height are ordered by their numbers.
    pits_ = {none};
    for (const std::uint32_t sample : flats_) {
      if (lowest_neighbour(sample) == none) pits_.push_back(sample);
    }
  }

  /// The neighbour with the least key, where it is less than that of the sample.
  std::uint32_t lowest_neighbour(std::uint32_t sample) const {
    std::uint64_t least = key(sample);
    std::uint32_t found = none;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint64_t own = key(beside(sample, k));
      if (own >= least) continue;
      least = own;
      found = beside(sample, k);
    }
    return found;
  }

  /// Numbers basins by their lowest samples: 0 drains over the border.
  void label() {
    basin_ = Array<std::uint32_t>(job_, count_, none);
    for (std::uint32_t i = 1; i < pits_.size(); ++i) basin_[pits_[i]] = i;
    std::vector<std::uint32_t> way;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (i % look == 0) job_.check();
      std::uint32_t at = i;
      while (basin_[at] == none) {
        way.push_back(at);
        const std::uint32_t to = receiver_[at];
        if (to != at) {
          at = to;
        } else if (is_border(at)) {
          basin_[at] = outside;
        } else {
          at = lowest_neighbour(at);
        }
      }
      for (const std::uint32_t each : way) basin_[each] = basin_[at];
      way.clear();
    }
  }

  /// Collects the passes between basins. Returns false where there are more than a search pays for.
  bool find_passes() {
    const std::size_t most = count_ / 2 + 64;
    const std::int32_t width = field_.width;
    for (std::int32_t z = 1; z < field_.depth; ++z) {
      if (z % 64 == 0) job_.check();
      const std::uint32_t* const row = basin_.data() + std::ptrdiff_t{z} * width;
      for (std::int32_t x = 0; x < width; ++x) {
        const std::uint32_t own = row[x];
        const std::int32_t first = x > 0 ? -1 : 0, last = x + 1 < width ? 1 : 0;
        const bool is_same = row[x + first] == own && row[x + first - width] == own &&
                             row[x - width] == own && row[x + last - width] == own;
        if (is_same) continue;
        const auto i = static_cast<std::uint32_t>(z * width + x);
        if (first != 0) add_pass(i, beside(i, 3));
        for (std::int32_t across = first; across <= last; ++across)
          add_pass(i, beside(i, static_cast<std::size_t>(across + 1)));
        if (passes_.size() > most) return false;
      }
    }
    std::sort(passes_.begin(), passes_.end());
    job_.check();
    return true;
  }

  void add_pass(std::uint32_t i, std::uint32_t other) {
    if (basin_[i] != basin_[other])
      passes_.push_back({std::max(key(i), key(other)), basin_[i], basin_[other]});
  }

  /// Finds the level of each basin: the highest pass on the lowest way to the outside. Lowest passes join basins
  /// first (Kruskal); those that are joined to the outside are full at that level.
  void find_levels() {
    const std::size_t basins = pits_.size();
    level_.assign(basins, 0);
    std::vector<std::uint32_t> root(basins), next(basins, none), last(basins);
    std::iota(root.begin(), root.end(), 0U);
    last = root;
    const auto root_of = [&](std::uint32_t at) {
      while (root[at] != at) at = root[at] = root[root[at]];
      return at;
    };
    for (const Pass& pass : passes_) {
      std::uint32_t a = root_of(pass.a), b = root_of(pass.b);
      if (a == b) continue;
      if (b == outside) std::swap(a, b);
      if (a == outside) {
        for (std::uint32_t each = b; each != none; each = next[each]) level_[each] = pass.level;
      } else {
        next[last[a]] = b;
        last[a] = last[b];
      }
      root[b] = a;
    }
  }

  bool is_filled(std::uint32_t sample) const { return key(sample) < level_[basin_[sample]]; }

  float filled(std::uint32_t sample) const {
    return field_.heights[is_filled(sample) ? static_cast<std::uint32_t>(level_[basin_[sample]]) : sample];
  }

  /// Makes depressions drain to their rims. Returns false where it would be slower than a flood.
  bool fill() {
    label();
    if (!find_passes()) return false;
    find_levels();
    turn_ = Array<std::uint32_t>(job_, count_, 0U);
    std::vector<std::uint64_t> levels(level_.begin() + 1, level_.end());
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    std::vector<std::uint32_t> wet;
    for (const std::uint64_t level : levels) {
      job_.check();
      spread(level, wet);
    }
    for (std::size_t i = 0; i < wet.size(); ++i) {
      if (i % look == 0) job_.check();
      if (turn_[wet[i]] == 0) steepen(wet[i]);
      for (std::size_t k = 0; k < 8; ++k) {
        const std::uint32_t next = beside(wet[i], k);
        if (turn_[wet[i]] != 0 && turn_[next] == 0 && !is_border(next)) steepen(next);
      }
    }
    return true;
  }

  /// Fills what is full at this level, from the lowest sample of the rim on. Its samples, and the rim, become wet.
  void spread(std::uint64_t level, std::vector<std::uint32_t>& wet) {
    const std::size_t begin = wet.size();
    wet.push_back(static_cast<std::uint32_t>(level));
    for (std::size_t i = begin; i < wet.size(); ++i) {
      const std::uint32_t sample = wet[i];
      if (i % look == 0) job_.check();
      if (is_border(sample)) {
        each_of_border(sample, [&](std::uint32_t next) { enter(next, sample, level, wet); });
        continue;
      }
      for (std::size_t k = 0; k < 8; ++k) enter(beside(sample, k), sample, level, wet);
    }
  }

  void enter(std::uint32_t next, std::uint32_t from, std::uint64_t level, std::vector<std::uint32_t>& wet) {
    if (turn_[next] != 0 || level_[basin_[next]] != level || key(next) >= level) return;
    turn_[next] = ++turns_;
    receiver_[next] = from;
    wet.push_back(next);
  }

  template <class Body>
  void each_of_border(std::uint32_t sample, const Body& body) const {
    const std::int32_t width = field_.width, x = static_cast<std::int32_t>(sample) % width,
                       z = static_cast<std::int32_t>(sample) / width;
    for (std::size_t k = 0; k < 9; ++k) {
      const std::int32_t nx = x + static_cast<std::int32_t>(k % 3) - 1,
                         nz = z + static_cast<std::int32_t>(k / 3) - 1;
      if (k == 4 || nx < 0 || nz < 0 || nx >= width || nz >= field_.depth) continue;
      body(static_cast<std::uint32_t>(nz * width + nx));
    }
  }

  /// Sets the receiver of a dry sample beside a depression, which is not as deep as it seems.
  void steepen(std::uint32_t sample) {
    if (is_border(sample)) return;
    float steepest = 0;
    std::uint32_t to = sample;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t next = beside(sample, k);
      const float slope = (field_.heights[sample] - filled(next)) * by_distance[k];
      to = slope > steepest ? next : to;
      steepest = slope > steepest ? slope : steepest;
    }
    receiver_[sample] = to == sample ? first_neighbour(sample) : to;
  }

  /// The neighbour that a flood from the border reaches first.
  std::uint32_t first_neighbour(std::uint32_t sample) const {
    std::pair<std::uint64_t, std::uint32_t> first{~std::uint64_t{0}, none};
    std::uint32_t found = sample;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::uint32_t next = beside(sample, k);
      const bool is_wet = !turn_.empty() && turn_[next] != 0;
      const std::pair<std::uint64_t, std::uint32_t> when{is_wet ? level_[basin_[next]] : key(next),
                                                         is_wet ? turn_[next] : 0};
      if (!(when < first)) continue;
      first = when;
      found = next;
    }
    return found;
  }

  /// Counts what drains to each sample, and visits a sample after all of those (Kahn 1962).
  Routes sorted() {
    Routes routes{Array<std::uint32_t>(job_), std::move(receiver_), Array<std::uint32_t>(job_, count_, 1U)};
    Array<std::uint8_t> waits(job_, count_, std::uint8_t{0});
    routes.order.reserve(count_);
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (i % look == 0) job_.check();
      if (routes.receiver[i] != i) ++waits[routes.receiver[i]];
    }
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (i % look == 0) job_.check();
      if (waits[i] != 0) continue;
      constexpr std::uint8_t done = 0xFF;
      for (std::uint32_t at = i;;) {
        routes.order.push_back(at);
        waits[at] = done;
        const std::uint32_t to = routes.receiver[at];
        if (to == at) break;
        routes.area[to] += routes.area[at];
        if (--waits[to] != 0) break;
        at = to;
      }
    }
    return routes;
  }

  Routes flooded() {
    receiver_ = drainage_of(field_, job_).receiver;
    return sorted();
  }

  const Field& field_;
  const Job& job_;
  std::array<std::int32_t, 8> apart_;
  std::size_t count_;
  Array<std::uint32_t> receiver_;
  Array<std::uint32_t> basin_;       ///< of each sample
  Array<std::uint32_t> turn_{job_};  ///< when a flood reaches the samples of depressions; 0: not in one
  std::uint32_t turns_ = 0;
  std::vector<std::uint32_t> flats_;  ///< samples without a lower neighbour
  std::vector<std::uint32_t> pits_;   ///< by basin: its lowest sample
  std::vector<std::uint64_t> level_;  ///< by basin
  std::vector<Pass> passes_;
};

}  // namespace

Routes routes_of(const Field& field, const Job& job) { return RouteSearch(field, job).run(); }

}  // namespace seedmesh::terrain
