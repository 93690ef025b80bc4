/// Poisson disk sampling: Wei, "Parallel Poisson disk sampling", ACM Transactions on Graphics 27 (2008).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/scene/candidate_positions.h"
#include "core/generators/scene/covered_parts.h"

namespace seedmesh::scene {
namespace {

// Darts for each open cell, by round. Later rounds would add few positions: a cell that is still open then has
// only slivers left.
constexpr std::array<int, 3> darts_of_round{1, 1, 3};
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
    for (std::size_t round = 0; round < darts_of_round.size(); ++round) {
      Rng order = rng_.at("order").at(round);
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

  void throw_phase(std::uint32_t phase, std::size_t round) {
    Array<Spot>& list = open_[phase];
    job_.check();
    parallel_for(job_, list.size(), cells_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) throw_darts(list[i], round);
    });
    std::size_t kept = 0;
    for (const Spot& spot : list) {
      if (point_[cell_of(spot)].x == open_cell) list[kept++] = spot;
    }
    list.resize(kept);
  }

  /// The positions near a cell, and the parts of the cell that none of them covers.
  struct Surroundings {
    std::array<glm::vec2, cells_around.size()> near;
    std::size_t count = 0;
    CellParts open = all_parts;
  };

  Surroundings surroundings_of(std::size_t cell, const glm::dvec2& corner) const {
    Surroundings found;
    const glm::vec2 from(corner);
    const auto scale = static_cast<float>(1 / cell_);
    for (std::size_t k = 0; k < cells_around.size(); ++k) {
      const CellOffset& offset = cells_around[k];
      const glm::vec2& near = point_[static_cast<std::size_t>(static_cast<std::int64_t>(cell) + offset.x +
                                                              std::int64_t{offset.z} * stride_)];
      if (!(near.x < nowhere)) continue;
      found.near[found.count++] = near;
      found.open &= ~covered_.of(k, (near - from) * scale - glm::vec2(offset.x, offset.z));
    }
    return found;
  }

  void throw_darts(const Spot& spot, std::size_t round) {
    const std::size_t cell = cell_of(spot);
    const glm::dvec2 corner(cell_ * (static_cast<double>(first_x_) + spot.x),
                            cell_ * (static_cast<double>(first_z_) + spot.z));
    const Surroundings around = surroundings_of(cell, corner);
    if (around.open == 0) {
      point_[cell] = glm::vec2(closed_cell);
      return;
    }
    Rng random(key_at(key_of(spot), round));
    for (int k = 0; k < darts_of_round[round]; ++k) {
      const glm::vec2 dart(corner + cell_ * random_point(around.open, random.next()));
      if (!part_.contains(whole_.min + glm::dvec2(dart)) || is_near(dart, around)) continue;
      point_[cell] = dart;
      return;
    }
  }

  /// A uniformly distributed point of the given parts of a cell with sides of 1.
  static glm::dvec2 random_point(CellParts parts, std::uint64_t bits) {
    const auto count = static_cast<std::uint64_t>(std::popcount(parts));
    for (std::uint64_t skip = (bits >> 44U) * count >> 20U; skip > 0; --skip) parts &= parts - 1;
    const int part = std::countr_zero(parts);
    const double x = static_cast<double>(bits & 0x3FFFFFU) * 0x1p-22;
    const double z = static_cast<double>((bits >> 22U) & 0x3FFFFFU) * 0x1p-22;
    return glm::dvec2(part % parts_a_side + x, part / parts_a_side + z) / double{parts_a_side};
  }

  bool is_near(const glm::vec2& dart, const Surroundings& around) const {
    for (std::size_t i = 0; i < around.count; ++i) {
      const glm::dvec2 between = glm::dvec2(around.near[i]) - glm::dvec2(dart);
      if (glm::dot(between, between) < reach_ * reach_) return true;
    }
    return false;
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
  const CoveredParts& covered_ = covered_parts();
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
