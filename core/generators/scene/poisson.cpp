/// Poisson disk sampling: Wei, "Parallel Poisson disk sampling", ACM Transactions on Graphics 27 (2008).
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/scene/candidate_positions.h"

namespace seedmesh::scene {
namespace {

// After this number of darts a cell gets no more. Of cells that are still open, only one in several thousand
// would accept another.
constexpr int rounds = 24;
constexpr std::size_t cells_a_chunk = 8192;
// A dart affects cells at a distance of at most three.
constexpr std::uint32_t apart = 3;
constexpr std::uint32_t rim = 2;
// Lower bound of positions of a saturated pattern in a square of the distance.
constexpr double thinnest = 0.5;
// Loss of distance between two positions by rounding to 32 bits, as a share of the largest coordinate.
constexpr double rounding = 2.5e-7;

// Position for an empty cell: so far away that it is never near.
constexpr float open_cell = 1e18F;
constexpr float closed_cell = 2e18F;
constexpr float nowhere = 1e17F;

struct Offset {
  int x, z;
};
/// Cells whose points can be too near to a point of the centre cell, nearest first.
constexpr std::array<Offset, 20> around{{{-1, 0}, {1, 0},  {0, -1},  {0, 1},  {-1, -1}, {1, -1},  {-1, 1},
                                         {1, 1},  {-2, 0}, {2, 0},   {0, -2}, {0, 2},   {-2, -1}, {-2, 1},
                                         {2, -1}, {2, 1},  {-1, -2}, {1, -2}, {-1, 2},  {1, 2}}};

/// Returns the distance before rounding that guarantees `distance` after rounding.
double reach_of(const Extent& whole, double distance) {
  const glm::dvec2 corner = glm::max(glm::abs(whole.min), glm::abs(whole.max));
  return distance + rounding * std::max(corner.x, corner.y);
}

/// The grid over `part`, with indices from the corner of `whole` and a border of empty cells.
class Darts {
 public:
  Darts(const Extent& whole, const Extent& part, double distance, Rng rng, const Job& job)
      : whole_(whole), part_(part), rng_(rng), job_(job), point_(job) {
    refuse_poisson_disk(whole, part, distance, job);
    reach_ = reach_of(whole, distance);
    cell_ = reach_ / std::sqrt(2.0);
    const glm::dvec2 first = (part.min - whole.min) / cell_, last = (part.max - whole.min) / cell_;
    first_x_ = math::to_int64(std::floor(first.x));
    first_z_ = math::to_int64(std::floor(first.y));
    wide_ = math::to_uint32(std::floor(last.x)) - static_cast<std::uint32_t>(first_x_) + 1;
    deep_ = math::to_uint32(std::floor(last.y)) - static_cast<std::uint32_t>(first_z_) + 1;
    stride_ = wide_ + 2 * rim;
    point_.resize(std::size_t{stride_} * (deep_ + 2 * rim));
    std::fill(point_.begin(), point_.end(), glm::vec2(open_cell));
    for (std::uint32_t phase = 0; phase < 9; ++phase) list_phase(phase);
  }

  Array<Placement> throw_all() {
    for (int round = 0; round < rounds; ++round) {
      Rng order = rng_.at("order").at(static_cast<std::uint64_t>(round));
      constexpr std::array<std::uint32_t, 6> steps{1, 2, 4, 5, 7, 8};
      const std::uint32_t start = order.below(9), step = steps[order.below(6)];
      for (std::uint32_t k = 0; k < 9; ++k) throw_phase((start + k * step) % 9, round);
    }
    return gathered();
  }

 private:
  /// Index of a cell by column and row. Divisions would take a third of the time.
  struct Spot {
    std::uint32_t x, z;
  };
  std::size_t cell_of(const Spot& spot) const { return std::size_t{spot.z + rim} * stride_ + spot.x + rim; }

  void list_phase(std::uint32_t phase) {
    Array<Spot>& list = open_[phase];
    list = Array<Spot>(job_);
    list.reserve(std::size_t{(wide_ + 2) / apart} * ((deep_ + 2) / apart));
    for (std::uint32_t z = phase / apart; z < deep_; z += apart) {
      for (std::uint32_t x = phase % apart; x < wide_; x += apart) list.push_back({x, z});
    }
  }

  std::uint64_t key_of(const Spot& spot) const {
    const auto x = static_cast<std::uint64_t>(first_x_) + spot.x;
    const auto z = static_cast<std::uint64_t>(first_z_) + spot.z;
    return key_at(rng_.key(), x << 32U | z);
  }

  void throw_phase(std::uint32_t phase, int round) {
    Array<Spot>& list = open_[phase];
    job_.check();
    parallel_for(job_, list.size(), cells_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) throw_dart(list[i], round);
    });
    std::size_t kept = 0;
    for (const Spot& spot : list) {
      if (point_[cell_of(spot)].x == open_cell) list[kept++] = spot;
    }
    list.resize(kept);
  }

  void throw_dart(const Spot& spot, int round) {
    const std::size_t cell = cell_of(spot);
    const std::uint64_t bits =
        mix(key_of(spot) + 0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(round + 1));
    const double u = static_cast<double>(bits >> 32U) * 0x1p-32;
    const double v = static_cast<double>(bits & 0xFFFFFFFFU) * 0x1p-32;
    const double west = cell_ * (static_cast<double>(first_x_) + spot.x);
    const double north = cell_ * (static_cast<double>(first_z_) + spot.z);
    const glm::vec2 dart(static_cast<float>(west + u * cell_), static_cast<float>(north + v * cell_));
    const glm::dvec2 at = whole_.min + glm::dvec2(dart);
    if (!part_.holds(at)) return;
    const double least = reach_ * reach_;
    for (const Offset& offset : around) {
      const auto other = static_cast<std::size_t>(static_cast<std::int64_t>(cell) + offset.x +
                                                  std::int64_t{offset.z} * stride_);
      const glm::vec2& near = point_[other];
      const double dx = static_cast<double>(near.x) - static_cast<double>(dart.x);
      const double dz = static_cast<double>(near.y) - static_cast<double>(dart.y);
      if (dx * dx + dz * dz >= least) continue;
      // A cell completely inside the exclusion disc of a point accepts no dart.
      const double far_x = std::max(std::abs(static_cast<double>(near.x) - west),
                                    std::abs(static_cast<double>(near.x) - west - cell_));
      const double far_z = std::max(std::abs(static_cast<double>(near.y) - north),
                                    std::abs(static_cast<double>(near.y) - north - cell_));
      if (far_x * far_x + far_z * far_z < least) point_[cell] = glm::vec2(closed_cell);
      return;
    }
    point_[cell] = dart;
  }

  Array<Placement> gathered() const {
    std::size_t count = 0;
    for (const glm::vec2& point : point_) count += point.x < nowhere ? 1U : 0U;
    Array<Placement> placements(job_);
    placements.reserve(count);
    for (std::uint32_t z = 0; z < deep_; ++z) {
      for (std::uint32_t x = 0; x < wide_; ++x) {
        const glm::vec2& point = point_[cell_of({x, z})];
        if (!(point.x < nowhere)) continue;
        Placement placement;
        placement.at = whole_.min + glm::dvec2(point);
        placement.key = key_of({x, z});
        placements.push_back(placement);
      }
    }
    return placements;
  }

  const Extent& whole_;
  const Extent& part_;
  Rng rng_;
  const Job& job_;
  double reach_ = 0, cell_ = 0;
  std::int64_t first_x_ = 0, first_z_ = 0;
  std::uint32_t wide_ = 0, deep_ = 0, stride_ = 0;
  Array<glm::vec2> point_;  ///< relative to the corner of `whole`, one for each cell
  std::array<Array<Spot>, 9> open_;
};

}  // namespace

void refuse_poisson_disk(const Extent& whole, const Extent& part, double distance, const Job& job) {
  const glm::dvec2 size = part.size();
  const double reach = reach_of(whole, distance);
  if (thinnest * size.x * size.y / (reach * reach) <= static_cast<double>(job.limits().shapes)) return;
  job.refuse(shapes_issue("a distance of " + std::to_string(distance) + " m on this ground gives",
                          thinnest * size.x * size.y / (reach * reach), job));
}

Array<Placement> poisson_disk(const Extent& whole, const Extent& part, double distance, Rng rng,
                              const Job& job) {
  return Darts(whole, part, distance, rng, job).throw_all();
}

}  // namespace seedmesh::scene
