#pragma once
/// Points by place: a hash table from small cells of space to numbers, for finding what lies on top of what.
/// Two points that should be one but were reached along different paths differ by rounding, about 1e-7 of the
/// model's size.
#include <bit>
#include <cstdint>

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

/// From 64-bit keys to 32-bit numbers; 16 bytes a slot, at most two thirds full. A key, once in, stays. Fixed
/// capacity.
class NumberTable {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct Slot {
    std::uint64_t key;
    std::uint32_t number;
    std::uint32_t spare;
  };

  NumberTable(const Job& job, std::size_t expected)
      : slots_(job, std::bit_ceil(expected + expected / 2 + 16), Slot{0, none, 0}),
        last_(slots_.size() - 1) {}

  /// The slot of `key`, empty (number == none) where the key is new: the caller then fills both members.
  Slot& find(std::uint64_t key) {
    std::size_t at = mix(key) & last_;
    while (slots_[at].number != none && slots_[at].key != key) at = (at + 1) & last_;
    return slots_[at];
  }

  /// Asks the memory for a slot that will be looked at soon.
  void expect(std::uint64_t key) const { __builtin_prefetch(slots_.data() + (mix(key) & last_), 1); }

 private:
  Array<Slot> slots_;
  std::size_t last_;
};

}  // namespace seedmesh
