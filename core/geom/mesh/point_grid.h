#pragma once
/// Spatial hashing of points, for finding points at nearly the same position. Points that should coincide,
/// but are computed along different paths, differ by rounding: about 1e-7 of the model's size.
#include <cstdint>
#include <span>

#include "core/base/array.h"
#include "core/base/rng.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// A grid of cubic cells over a box, with at most 2^20 cells along an axis.
class PointGrid {
 public:
  PointGrid(const Box& box, float cell) : low_(box.min), per_cell_(cell > 0 ? 1 / cell : 0) {}

  /// Returns the key of the cell of `point`, which must lie inside the box. The corner of the box is the centre of a
  /// cell. Rounding errors about a coordinate that many points share therefore do not cross a border of cells.
  std::uint64_t key(const glm::vec3& point) const {
    const glm::vec3 cell = (point - low_) * per_cell_ + 0.5F;
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x)) |
           static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y)) << 21U |
           static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.z)) << 42U;
  }

  /// Calls visit(key) for the cells that contain all points within `reach` of `point`: at most 8 where
  /// `reach` is below half a cell.
  template <class Visit>
  void each_near(const glm::vec3& point, float reach, Visit visit) const {
    const glm::vec3 low = glm::max((point - reach - low_) * per_cell_ + 0.5F, glm::vec3(0));
    const glm::vec3 high = (point + reach - low_) * per_cell_ + 0.5F;
    for (auto z = static_cast<std::int64_t>(low.z); z <= static_cast<std::int64_t>(high.z); ++z) {
      for (auto y = static_cast<std::int64_t>(low.y); y <= static_cast<std::int64_t>(high.y); ++y) {
        for (auto x = static_cast<std::int64_t>(low.x); x <= static_cast<std::int64_t>(high.x); ++x) {
          visit(static_cast<std::uint64_t>(x) | static_cast<std::uint64_t>(y) << 21U |
                static_cast<std::uint64_t>(z) << 42U);
        }
      }
    }
  }

 private:
  glm::vec3 low_;
  float per_cell_;
};

/// A hash table from 64-bit keys to 32-bit numbers: open addressing, 12 bytes for each slot, at most two
/// thirds full. Keys cannot be removed.
class NumberTable {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  NumberTable(const Job& job, std::size_t expected)
      : job_(&job), slots_(empty(expected + expected / 2 + 16)) {}

  /// Returns the number of `key`, or `none`.
  std::uint32_t peek(std::uint64_t key) { return find(key).number; }

  /// Returns the number of `key`. It is `none` if the key is new; the caller then assigns a number. The reference is
  /// valid until the next call.
  std::uint32_t& operator[](std::uint64_t key) {
    if (used_ * 3 >= slots_.size() * 2) grow();
    Slot& slot = find(key);
    if (slot.number == none) {
      slot.low = static_cast<std::uint32_t>(key);
      slot.high = static_cast<std::uint32_t>(key >> 32U);
      ++used_;
    }
    return slot.number;
  }

  /// Prefetches the slot of a key that is needed soon.
  void expect(std::uint64_t key) const { __builtin_prefetch(slots_.data() + home(key), 1); }

 private:
  struct Slot {
    std::uint32_t low, high;  ///< halves of the key; a 64-bit member would make a slot 16 bytes
    std::uint32_t number;
    std::uint64_t key() const { return std::uint64_t{high} << 32U | low; }
  };

  Array<Slot> empty(std::size_t size) const { return Array<Slot>(*job_, size, Slot{0, 0, none}); }

  /// Returns the first slot to probe for a key (Lemire, "Fast random integer generation in an interval", 2019).
  std::size_t home(std::uint64_t key) const {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::size_t>(Wide{mix(key)} * slots_.size() >> 64U);
  }

  Slot& find(std::uint64_t key) {
    std::size_t at = home(key);
    while (slots_[at].number != none && slots_[at].key() != key) at = at + 1 < slots_.size() ? at + 1 : 0;
    return slots_[at];
  }

  void grow() {
    Array<Slot> old = std::exchange(slots_, empty(2 * slots_.size()));
    used_ = 0;
    for (const Slot& slot : old) {
      if (slot.number == none) continue;
      find(slot.key()) = slot;
      ++used_;
    }
  }

  const Job* job_;
  Array<Slot> slots_;
  std::size_t used_ = 0;
};

/// Numbers points so that a point within `reach` of an earlier one gets the same number. `points` is
/// borrowed.
class Weld {
 public:
  Weld(const Job& job, const Box& box, float reach, std::span<const glm::vec3> points)
      : points_(points),
        grid_(box, cell_width * reach),
        reach_squared_(reach * reach),
        reach_(reach),
        first_(job, points.size()),
        next_(job),
        point_(job) {
    next_.reserve(points.size());
    point_.reserve(points.size());
  }

  /// Returns the number of points[i].
  std::uint32_t number(std::uint32_t i) {
    const glm::vec3& point = points_[i];
    std::uint32_t found = NumberTable::none;
    grid_.each_near(point, reach_, [&](std::uint64_t key) {
      if (found != NumberTable::none) return;
      for (std::uint32_t k = first_.peek(key); k != NumberTable::none && found == NumberTable::none;
           k = next_[k]) {
        const glm::vec3 apart = points_[point_[k]] - point;
        if (glm::dot(apart, apart) <= reach_squared_) found = k;
      }
    });
    if (found != NumberTable::none) return found;
    const auto fresh = static_cast<std::uint32_t>(point_.size());
    std::uint32_t& first = first_[grid_.key(point)];
    next_.push_back(first);
    point_.push_back(i);
    first = fresh;
    return fresh;
  }
  std::size_t size() const { return point_.size(); }

  /// Prefetches what number(i) reads.
  void expect(std::uint32_t i) const { first_.expect(grid_.key(points_[i])); }

 private:
  /// Width of a cell in multiples of `reach`: few points lie near a border of cells, and few cells have several points.
  static constexpr float cell_width = 16;

  std::span<const glm::vec3> points_;
  PointGrid grid_;
  float reach_squared_, reach_;
  NumberTable first_;
  Array<std::uint32_t> next_;   ///< linked lists of the numbers of each cell
  Array<std::uint32_t> point_;  ///< first point with each number
};

}  // namespace seedmesh
