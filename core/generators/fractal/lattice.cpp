#include "core/generators/fractal/lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <tuple>

#include "core/base/math.h"

namespace seedmesh::fractal {
namespace {

constexpr double tolerance = 1e-9;
constexpr int most_parts = 64;
constexpr std::int64_t longest_side = std::int64_t{1} << 20U;
constexpr std::int32_t farthest_cell = 4096;

/// The whole number by which all maps divide, or 0.
int parts_of(const std::vector<Affine>& maps) {
  const double scale = maps.front().linear[0][0];
  if (!(scale > 0) || scale > 0.5 + tolerance) return 0;
  const double parts = std::round(1 / scale);
  if (parts > most_parts || std::abs(parts * scale - 1) > tolerance) return 0;
  for (const Affine& map : maps) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (std::abs(map.linear[i][j] - (i == j ? scale : 0)) > tolerance) return 0;
      }
    }
  }
  return math::to_int32(parts);
}

bool is_whole(double number) { return std::abs(number - std::round(number)) <= 1e-6; }

struct Extent {
  glm::i64vec3 low, high;  ///< both inclusive
};

Extent extent_of(const Lattice& lattice, int rounds, const Job& job) {
  glm::ivec3 least = lattice.cells.front(), most = least;
  for (const glm::ivec3& cell : lattice.cells) {
    least = glm::min(least, cell);
    most = glm::max(most, cell);
  }
  Extent extent{glm::i64vec3(0), glm::i64vec3(lattice.block - 1)};
  std::int64_t side = 1;
  for (int round = 0; round < rounds; ++round) {
    extent = {extent.low + side * glm::i64vec3(least), extent.high + side * glm::i64vec3(most)};
    side *= lattice.parts;
    if (lattice.keeps) {
      extent.low = glm::min(extent.low, glm::i64vec3(0));
      extent.high = glm::max(extent.high, glm::i64vec3(side - 1));
    }
    const glm::i64vec3 size = extent.high - extent.low;
    if (std::max({side, size.x, size.y, size.z}) > longest_side) {
      job.refuse(limit_issue({Resource::steps, longest_side, longest_side + 1},
                             "the lattice has more than " + std::to_string(longest_side) +
                                 " cells a side after " + std::to_string(round + 1) +
                                 " rounds; expected fewer rounds (`derive` needs no lattice)",
                             "/iterations"));
    }
  }
  return extent;
}

glm::ivec3 along(const glm::ivec3& v, const Axes& axes) { return {v[axes[0]], v[axes[1]], v[axes[2]]}; }

BitGrid empty_grid(const Lattice& lattice, int rounds, const Axes& axes, const Job& job) {
  const Extent extent = extent_of(lattice, rounds, job);
  return {job, along(glm::ivec3(extent.low), axes), along(glm::ivec3(extent.high - extent.low) + 1, axes)};
}

void set_bits(std::uint64_t* row, std::size_t from, std::size_t count) {
  for (std::size_t i = from; i < from + count; ++i) row[i / 64] |= std::uint64_t{1} << (i % 64);
}

/// row |= source << shift. The result must fit into the row.
void or_shifted(std::uint64_t* row, const std::uint64_t* source, std::size_t words, std::size_t row_words,
                std::size_t shift) {
  const std::size_t skip = shift / 64, up = shift % 64;
  for (std::size_t w = 0; w < words; ++w) {
    const std::uint64_t bits = source[w];
    if (bits == 0) continue;
    row[w + skip] |= bits << up;
    if (up > 0 && w + skip + 1 < row_words) row[w + skip + 1] |= bits >> (64 - up);
  }
}

}  // namespace

bool Lattice::inside() const {
  if (keeps || block != glm::ivec3(1) || fraction != glm::dvec3(0)) return false;
  std::set<std::tuple<int, int, int>> seen;
  for (const glm::ivec3& cell : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= parts) return false;
    }
    if (!seen.insert({cell.x, cell.y, cell.z}).second) return false;
  }
  return true;
}

double Lattice::side(int rounds) const {
  double side = 1;
  for (int round = 0; round < rounds; ++round) side *= parts;
  return side;
}

std::optional<Lattice> lattice_of(const Instructions& instructions) {
  Lattice lattice;
  lattice.keeps = instructions.keeps;
  if (instructions.maps.empty() || !instructions.arrangement.empty()) return std::nullopt;
  lattice.parts = parts_of(instructions.maps);
  if (lattice.parts == 0) return std::nullopt;
  const auto cell_of = [&](const Affine& map) {
    return static_cast<double>(lattice.parts) * (map.offset + 0.5) - 0.5;
  };
  const glm::dvec3 first = cell_of(instructions.maps.front());
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> steps;  // from the first copy, in copies
    for (const Affine& map : instructions.maps) steps.push_back(cell_of(map)[axis] - first[axis]);
    lattice.block[axis] = std::ranges::all_of(steps, is_whole) ? 1 : 2;
    const double cells = first[axis] * lattice.block[axis];
    const double fraction = cells - std::round(cells);
    lattice.fraction[axis] = std::abs(fraction) < tolerance ? 0 : fraction;
  }
  if (lattice.keeps && (lattice.fraction != glm::dvec3(0) || lattice.block != glm::ivec3(1)))
    return std::nullopt;
  for (const Affine& map : instructions.maps) {
    const glm::dvec3 cell = cell_of(map) * glm::dvec3(lattice.block) - lattice.fraction;
    glm::ivec3 whole;
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_whole(cell[axis]) || std::abs(cell[axis]) > farthest_cell) return std::nullopt;
      whole[axis] = math::to_int32(std::round(cell[axis]));
    }
    lattice.cells.push_back(whole);
  }
  return lattice;
}

BitGrid::BitGrid(const Job& job, glm::ivec3 low, glm::ivec3 size)
    : low_(low), size_(size), words_((static_cast<std::size_t>(size.x) + 63) / 64) {
  const double words = static_cast<double>(words_) * size.y * size.z;
  if (words > 0x1p40) {
    job.refuse(limit_issue({Resource::memory_bytes, job.limits().memory_bytes, std::uint64_t{1} << 43U},
                           "the lattice has more than 2^46 cells; expected fewer rounds", "/iterations"));
  }
  bits_ = Array<std::uint64_t>(
      job, words_ * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z), 0);
}

std::uint64_t BitGrid::count() const {
  std::uint64_t count = 0;
  for (const std::uint64_t word : bits_) count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

void BitGrid::add(const BitGrid& other, glm::ivec3 move, const Job& job) {
  const glm::ivec3 shift = other.low_ + move - low_;
  for (int z = 0; z < other.size_.z; ++z) {
    job.check();
    for (int y = 0; y < other.size_.y; ++y) {
      or_shifted(row(y + shift.y, z + shift.z), other.row(y, z), other.words_, words_,
                 static_cast<std::size_t>(shift.x));
    }
  }
}

void BitGrid::fill_block(glm::ivec3 from, glm::ivec3 sides) {
  const glm::ivec3 at = from - low_;
  for (int z = at.z; z < at.z + sides.z; ++z) {
    for (int y = at.y; y < at.y + sides.y; ++y)
      set_bits(row(y, z), static_cast<std::size_t>(at.x), static_cast<std::size_t>(sides.x));
  }
}

BitGrid grid_of(const Lattice& lattice, int rounds, const Axes& axes, const Job& job) {
  extent_of(lattice, rounds, job);  // throws Stop before anything is made
  BitGrid grid = empty_grid(lattice, 0, axes, job);
  grid.fill_block(glm::ivec3(0), along(lattice.block, axes));
  int side = 1;
  for (int round = 1; round <= rounds; ++round) {
    BitGrid next = empty_grid(lattice, round, axes, job);
    for (const glm::ivec3& cell : lattice.cells) next.add(grid, along(cell, axes) * side, job);
    side *= lattice.parts;
    if (lattice.keeps) next.fill_block(glm::ivec3(0), glm::ivec3(side));
    grid = std::move(next);
  }
  return grid;
}

Placement placement_of(const Lattice& lattice, int rounds) {
  const double copy = 1 / lattice.side(rounds);
  const double series = (1 - copy) / (lattice.parts - 1);
  const glm::dvec3 block(lattice.block);
  const glm::dvec3 centre = (lattice.fraction / block + 0.5 - 0.5 * lattice.parts) * series;
  return {centre - 0.5 * copy, copy / block};
}

}  // namespace seedmesh::fractal
