#pragma once
/// Points by place: a hash table from small cells of space to numbers, for finding what lies on top of what.
/// Two points that should be one but were reached along different paths differ by rounding, about 1e-7 of the
/// model's size.
#include <cstdint>
#include <span>

#include "core/base/array.h"
#include "core/base/rng.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// Cuts the box of a model into cells of a side that is a share of its diagonal, at most 2^20 along an axis.
class PlaceGrid {
 public:
  PlaceGrid(const Box& box, float cell) : low_(box.min), per_cell_(cell > 0 ? 1 / cell : 0) {}

  /// The cell's number. `point` lies inside the box. Cells are centred on the box's corner, so that noise
  /// about a coordinate that all paths share (0 more than any other) falls into one cell.
  std::uint64_t key(const glm::vec3& point) const {
    const glm::vec3 cell = (point - low_) * per_cell_ + 0.5F;
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.x)) |
           static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.y)) << 21U |
           static_cast<std::uint64_t>(static_cast<std::int64_t>(cell.z)) << 42U;
  }

  /// The cells that hold everything within `reach` of `point`, at most 8 where reach is below half a cell.
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

/// From 64-bit keys to 32-bit numbers; 12 bytes a slot, at most two thirds full. A key, once in, stays.
class NumberTable {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  NumberTable(const Job& job, std::size_t expected)
      : job_(&job), slots_(empty(expected + expected / 2 + 16)) {}

  /// The number of `key`, or none.
  std::uint32_t peek(std::uint64_t key) { return find(key).number; }

  /// The number of `key`, none where it is new: the caller then writes one. Valid until the next call.
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

  /// Asks the memory for a slot that will be looked at soon.
  void expect(std::uint64_t key) const { __builtin_prefetch(slots_.data() + home(key), 1); }

 private:
  struct Slot {
    std::uint32_t low, high;  ///< halves of the key: a whole one would make it 16 bytes
    std::uint32_t number;
    std::uint64_t key() const { return std::uint64_t{high} << 32U | low; }
  };

  Array<Slot> empty(std::size_t size) const { return Array<Slot>(*job_, size, Slot{0, 0, none}); }

  /// Where a key is looked for first: its hash as a share of the table (Lemire, "Fast random integer
  /// generation in an interval", 2019).
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

/// Numbers points so that those nearer than `reach` to an earlier one share its number. Does not own the
/// points.
class Weld {
 public:
  Weld(const Job& job, const Box& box, float reach, std::span<const glm::vec3> points)
      : points_(points),
        grid_(box, cell_reaches * reach),
        reach_squared_(reach * reach),
        reach_(reach),
        first_(job, points.size()),
        next_(job),
        point_(job) {
    next_.reserve(points.size());
    point_.reserve(points.size());
  }

  /// The number of points[i].
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

  /// Asks the memory for what the number of points[i] will need soon.
  void expect(std::uint32_t i) const { first_.expect(grid_.key(points_[i])); }

 private:
  /// So wide that few points lie near a wall between cells, so narrow that few have company.
  static constexpr float cell_reaches = 16;

  std::span<const glm::vec3> points_;
  PlaceGrid grid_;
  float reach_squared_, reach_;
  NumberTable first_;
  Array<std::uint32_t> next_;   ///< a list of the numbers of each cell
  Array<std::uint32_t> point_;  ///< of each number: the first point that has it
};

}  // namespace seedmesh
