#include "core/generators/tree/weber_penn_twigs.h"

#include <algorithm>
#include <cmath>

#include "core/base/wide.h"
#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {
namespace {

// Doubles in the widest vectors. Loops run over a multiple of this, which is quicker than a remainder loop.
constexpr std::size_t lanes = 8;

/// Gives the distance between leaves and the key of their random numbers. Returns the largest number of
/// leaves.
// NOLINTNEXTLINE(readability-function-size): with separate pointers, compilers use vector instructions
SEEDMESH_WIDE double space_all(const Rng random, double leaves, std::size_t count,
                               const double* __restrict length, const double* __restrict share,
                               const std::uint64_t* __restrict key, double* __restrict spacing,
                               std::uint64_t* __restrict stream) {
  double most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double low = share[i] < 0 ? 0 : share[i], part = low > 1 ? 1 : low;
    const double wanted = std::floor(leaves * (0.5 + 0.5 * part) + 0.5);
    spacing[i] = wanted > 0 ? length[i] / wanted : 0;
    most = wanted > most ? wanted : most;
    stream[i] = key_at(random.key(), key[i]);
  }
  return most;
}

/// Finds the next leaf of each twig. Offsets are sums, as find_offsets() has them.
// NOLINTNEXTLINE(readability-function-size): with separate pointers, compilers use vector instructions
SEEDMESH_WIDE void step_all(double steps, std::size_t count, const double* __restrict length,
                            const double* __restrict spacing, double* __restrict end,
                            double* __restrict offset, std::uint64_t* __restrict found) {
  for (std::size_t i = 0; i < count; ++i) {
    const double next = end[i] + steps * spacing[i];
    const bool is_there = (spacing[i] > 0) & (next <= length[i]);
    offset[i] = next;
    end[i] = is_there ? next : end[i];
    found[i] += is_there ? 1U : 0U;
  }
}

/// Sets the bit of leaf `number` of each twig where it is drawn.
SEEDMESH_WIDE void draw_all(std::uint64_t number, std::int64_t below, std::size_t count,
                            const std::uint64_t* __restrict stream, const std::uint64_t* __restrict found,
                            std::uint64_t* __restrict drawn) {
  const std::uint64_t bit = std::uint64_t{1} << number;
  const auto before = static_cast<std::int64_t>(number);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t hash = draw_number(key_at(stream[i], number));
    const bool is_drawn =
        (static_cast<std::int64_t>(hash) < below) & (static_cast<std::int64_t>(found[i]) > before);
    drawn[i] |= is_drawn ? bit : 0U;
  }
}

}  // namespace

void WeberPennTwigs::find_leaves(const Rng& random, double leaves, std::int64_t drawn_below) {
  const std::size_t count = (size_ + lanes - 1) / lanes * lanes;
  std::fill_n(end_, count, 0.0);
  std::fill_n(count_, count, 0U);
  std::fill_n(drawn_, count, 0U);
  const double rounds = space_all(random, leaves, count, length_, share_, key_, spacing_, leaves_);
  for (std::size_t leaf = 0; static_cast<double>(leaf) < rounds; ++leaf) {
    // The first is half a step from the base.
    step_all(leaf == 0 ? 0.5 : 1, count, length_, spacing_, end_, offset_[leaf], count_);
    draw_all(leaf, drawn_below, count, leaves_, count_, drawn_);
  }
}

}  // namespace seedmesh::tree
