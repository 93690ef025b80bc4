#pragma once
/// A hash table of directed edges by both of their ends. Both directions of an edge share a slot, since most
/// edges have a part on either side. It serves only lookups, so that its order never affects the output.
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/rng.h"
#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

class EdgeTable {
 public:
  static constexpr std::uint32_t absent = 0xFFFFFFFFU;

  EdgeTable() = default;
  /// Reserves memory for this number of edges, without regard to their direction; grows for more.
  explicit EdgeTable(std::size_t edges) : slots_(edges + edges / 4 + 1) {}

  /// Adds an edge with a value other than `absent`. Of edges with the same ends the first one is found.
  void add(const CmPoint& a, const CmPoint& b, std::uint32_t value) {
    if (used_ + used_ / 4 + 2 > slots_.size()) grow();
    const bool is_falling = b < a;
    Slot& slot = slots_[is_falling ? slot_of(b, a) : slot_of(a, b)];
    used_ += slot.is_empty() ? 1 : 0;
    slot.low = is_falling ? b : a;
    slot.high = is_falling ? a : b;
    std::uint32_t& own = slot.values[is_falling ? 1 : 0];
    if (own == absent) own = value;
  }

  /// Returns the value of the edge from a to b; `absent` if there is no such edge.
  std::uint32_t value_of(const CmPoint& a, const CmPoint& b) const {
    const bool is_falling = b < a;
    return slots_[is_falling ? slot_of(b, a) : slot_of(a, b)].values[is_falling ? 1 : 0];
  }

 private:
  struct Slot {
    CmPoint low, high;
    std::array<std::uint32_t, 2> values = {absent, absent};  ///< rising, falling
    bool is_empty() const { return values[0] == absent && values[1] == absent; }
  };

  /// Returns the slot of an edge, or the empty slot that it would take.
  std::size_t slot_of(const CmPoint& low, const CmPoint& high) const {
    const auto word = [](const CmPoint& p) {
      return std::uint64_t{static_cast<std::uint32_t>(p.x)} << 32U | static_cast<std::uint32_t>(p.y);
    };
    auto at = static_cast<std::size_t>((key_at(word(low), word(high)) >> 32U) * slots_.size() >> 32U);
    while (!slots_[at].is_empty() && (slots_[at].low != low || slots_[at].high != high))
      at = at + 1 < slots_.size() ? at + 1 : 0;
    return at;
  }

  void grow() {
    std::vector<Slot> before(slots_.size() * 2);
    before.swap(slots_);
    for (const Slot& slot : before) {
      if (!slot.is_empty()) slots_[slot_of(slot.low, slot.high)] = slot;
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1);
  std::size_t used_ = 0;
};

}  // namespace seedmesh::city
