#pragma once
/// A hash table of directed edges by both of their ends. Lookups alone depend on it, never an order of output.
#include <cstdint>
#include <vector>

#include "core/base/rng.h"
#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

class EdgeTable {
 public:
  static constexpr std::uint32_t absent = 0xFFFFFFFFU;

  EdgeTable() = default;
  /// At most `most` edges can be added.
  explicit EdgeTable(std::size_t most) : slots_(most + most / 2 + 1) {}

  /// Adds an edge with a value other than `absent`. Of edges with the same ends the first one is found.
  void add(const CmPoint& a, const CmPoint& b, std::uint32_t value) {
    std::size_t at = start_of(a, b);
    while (slots_[at].value != absent) at = next(at);
    slots_[at] = {a, b, value};
  }

  /// Returns the value of the edge from a to b; `absent` if there is no such edge.
  std::uint32_t value_of(const CmPoint& a, const CmPoint& b) const {
    for (std::size_t at = start_of(a, b); slots_[at].value != absent; at = next(at)) {
      if (slots_[at].a == a && slots_[at].b == b) return slots_[at].value;
    }
    return absent;
  }

 private:
  struct Slot {
    CmPoint a, b;
    std::uint32_t value = absent;
  };

  std::size_t start_of(const CmPoint& a, const CmPoint& b) const {
    const auto word = [](const CmPoint& p) {
      return std::uint64_t{static_cast<std::uint32_t>(p.x)} << 32U | static_cast<std::uint32_t>(p.y);
    };
    return static_cast<std::size_t>((key_at(word(a), word(b)) >> 32U) * slots_.size() >> 32U);
  }
  std::size_t next(std::size_t at) const { return at + 1 < slots_.size() ? at + 1 : 0; }

  std::vector<Slot> slots_ = std::vector<Slot>(1);
};

}  // namespace seedmesh::city
