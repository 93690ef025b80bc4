#pragma once
/// A hash table of directed edges by both of their ends. Both directions of an edge share a slot, since most
/// edges have a part on either side. It serves only lookups, so that its order never affects the output.
///
/// Most lookups are for edges that are absent. A Bloom filter with one bit for each edge finds most of them without a
/// search (Bloom, "Space/time trade-offs in hash coding with allowable errors", 1970).
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
  explicit EdgeTable(std::size_t edges) : slots_(edges + edges / 4 + 1), bits_(bit_words(slots_.size())) {}

  /// Adds an edge with a value other than `absent`. Of edges with the same ends the first one is found.
  void add(const CmPoint& a, const CmPoint& b, std::uint32_t value) {
    if (used_ + used_ / 4 + 2 > slots_.size()) grow();
    const bool is_falling = b < a;
    const CmPoint &low = is_falling ? b : a, &high = is_falling ? a : b;
    const std::uint64_t key = key_of(low, high);
    Slot& slot = slots_[slot_of(key, low, high)];
    if (slot.is_empty()) {
      ++used_;
      mark(key);
    }
    slot.low = low;
    slot.high = high;
    std::uint32_t& own = slot.values[is_falling ? 1 : 0];
    if (own == absent) own = value;
  }

  /// Returns the value of the edge from a to b; `absent` if there is no such edge.
  std::uint32_t value_of(const CmPoint& a, const CmPoint& b) const {
    const bool is_falling = b < a;
    const CmPoint &low = is_falling ? b : a, &high = is_falling ? a : b;
    const std::uint64_t key = key_of(low, high);
    const std::size_t bit = bit_of(key);
    if ((bits_[bit / 64] >> bit % 64 & 1U) == 0) return absent;
    return slots_[slot_of(key, low, high)].values[is_falling ? 1 : 0];
  }

 private:
  struct Slot {
    CmPoint low, high;
    std::array<std::uint32_t, 2> values = {absent, absent};  ///< rising, falling
    bool is_empty() const { return values[0] == absent && values[1] == absent; }
  };

  static constexpr std::size_t bits_a_slot = 8;
  static std::size_t bit_words(std::size_t slots) { return slots * bits_a_slot / 64 + 1; }

  static std::uint64_t key_of(const CmPoint& low, const CmPoint& high) {
    const auto word = [](const CmPoint& p) {
      return std::uint64_t{static_cast<std::uint32_t>(p.x)} << 32U | static_cast<std::uint32_t>(p.y);
    };
    return key_at(word(low), word(high));
  }

  /// Returns the bit of an edge in the filter. Its slot depends on the other half of the key.
  std::size_t bit_of(std::uint64_t key) const {
    return static_cast<std::size_t>((key & 0xFFFFFFFFU) * (slots_.size() * bits_a_slot) >> 32U);
  }
  void mark(std::uint64_t key) {
    const std::size_t bit = bit_of(key);
    bits_[bit / 64] |= std::uint64_t{1} << bit % 64;
  }

  /// Returns the slot of an edge, or the empty slot that it would take.
  std::size_t slot_of(std::uint64_t key, const CmPoint& low, const CmPoint& high) const {
    auto at = static_cast<std::size_t>((key >> 32U) * slots_.size() >> 32U);
    while (!slots_[at].is_empty() && (slots_[at].low != low || slots_[at].high != high))
      at = at + 1 < slots_.size() ? at + 1 : 0;
    return at;
  }

  void grow() {
    std::vector<Slot> before(slots_.size() * 2);
    before.swap(slots_);
    bits_.assign(bit_words(slots_.size()), 0);
    for (const Slot& slot : before) {
      if (slot.is_empty()) continue;
      const std::uint64_t key = key_of(slot.low, slot.high);
      slots_[slot_of(key, slot.low, slot.high)] = slot;
      mark(key);
    }
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1);
  std::vector<std::uint64_t> bits_ = std::vector<std::uint64_t>(1);  ///< of the filter
  std::size_t used_ = 0;
};

}  // namespace seedmesh::city
