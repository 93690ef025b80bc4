#include "core/generators/tree/weber_penn_brood.h"

#include <algorithm>
#include <cmath>

#include "core/base/wide.h"
#include "core/generators/tree/wide_chance.h"

namespace seedmesh::tree {
namespace {

// Lanes of the widest vectors of doubles; a few children too many are reckoned rather than one by one.
constexpr std::size_t lanes = 8;
// Of a limb's first split: uniform in -0.5 .. 0.5.
constexpr double split_range = 0.5;

constexpr std::size_t most = WeberPennBrood::most;

/// The same of all children. Passed by value, so that nothing that is read can be what is written.
struct Turning {
  double rotate, odd, rotate_v, down_v;  ///< `odd`: more degrees for those of odd numbers
  double step;                           ///< degrees from one number to the next
};

SEEDMESH_WIDE void draw_all(const Rng chance, std::size_t count, const std::int32_t* __restrict number,
                            std::uint64_t* __restrict key, double* __restrict splits) {
  for (std::size_t i = 0; i < count; ++i) {
    key[i] = chance.at(static_cast<std::uint64_t>(number[i])).key();
    splits[i] = drawn_at(key[i], place_of("splits"), split_range);
  }
}

SEEDMESH_WIDE void turn_all(const Turning how, std::size_t count, const std::int32_t* __restrict numbers,
                            const std::uint64_t* __restrict key, const double* __restrict down,
                            const double (*__restrict stems)[most], double (*__restrict axis)[most]) {
  for (std::size_t i = 0; i < count; ++i) {
    const Frame stem = frame_in(stems, i);
    const std::int32_t number = numbers[i];
    const double base = number * how.step + (number & 1) * how.odd + how.rotate;
    const double about = base + drawn_at(key[i], place_of("rotate"), how.rotate_v);
    const double from = down[i] + drawn_at(key[i], place_of("down"), how.down_v);
    put_frame(axis, i,
              pitch(roll(stem, math::quick_sincos_degrees(about)), math::quick_sincos_degrees(from)));
  }
}

/// For one whole tree.
struct Envelope {
  double scale, depth, peak, width, high, low;
};

/// As is_in_envelope() begins.
SEEDMESH_WIDE void find_all_inside(const Envelope by, std::size_t count,
                                   const double (*__restrict axis)[most],
                                   const double (*__restrict position)[most], const double* __restrict length,
                                   std::uint64_t* __restrict inside) {
  for (std::size_t i = 0; i < count; ++i) {
    const double x = position[0][i] + axis[0][i] * length[i], y = position[1][i] + axis[1][i] * length[i],
                 z = position[2][i] + axis[2][i] * length[i];
    const double ratio = (by.scale - y) / by.depth;
    const bool is_above = ratio < by.peak;
    const double base = (is_above ? ratio : 1 - ratio) / (is_above ? by.peak : 1 - by.peak);
    const double exponent = is_above ? by.high : by.low;
    const double least = least_power(base, exponent);
    const bool is_known = (ratio > 0) & (ratio < 1) & (base > 0) & (exponent <= 1);
    const bool is_near = std::sqrt(x * x + z * z) / by.scale < by.width * least;
    inside[i] = (is_known & is_near) ? 1U : 0U;
  }
}

}  // namespace

void WeberPennBrood::find_inside(const TreeParams& params, double scale) {
  const Envelope envelope{scale,
                          scale * (1 - params.BaseSize),
                          1 - params.PruneWidthPeak,
                          params.PruneWidth,
                          params.PrunePowerHigh,
                          params.PrunePowerLow};
  find_all_inside(envelope, (size_ + lanes - 1) / lanes * lanes, axis_, position_, length_, inside_);
}

void WeberPennBrood::reckon(const WeberPennLevel& level, const Rng& chance) {
  const std::size_t count = (size_ + lanes - 1) / lanes * lanes;
  // As about_stem() has it: sums with 0 change nothing.
  const bool goes_round = level.rotate >= 0;
  const Turning how{goes_round ? 0 : level.rotate, goes_round ? 0 : 180.0, level.rotate_v,
                    std::max(0.0, level.down_angle_v), goes_round ? level.rotate : 0};
  draw_all(chance, count, number_, key_, splits_);
  turn_all(how, count, number_, key_, down_, stem_, axis_);
}

}  // namespace seedmesh::tree
