#pragma once
/// A sum for each key, in a hash table with open addressing. There is no iteration, so that no result depends on the
/// order of the keys.
#include <cstdint>
#include <utility>

#include "core/base/array.h"
#include "core/base/rng.h"

namespace seedmesh {

class KeySums {
 public:
  explicit KeySums(const Job& job) : entries_(job) {}

  /// Forgets all sums.
  void clear() {
    entries_.clear();
    count_ = 0;
  }
  /// Adds an amount, which is not negative, to the sum of a key.
  void add(std::uint64_t key, double amount) {
    if (!(amount > 0)) return;
    if (2 * (count_ + 1) > entries_.size()) grow();
    Entry& entry = entries_[slot_of(key)];
    if (entry.sum == 0) {
      entry.key = key;
      ++count_;
    }
    entry.sum += amount;
  }
  /// Returns the sum of a key, or 0.
  double at(std::uint64_t key) const { return entries_.empty() ? 0 : entries_[slot_of(key)].sum; }

 private:
  struct Entry {
    std::uint64_t key;
    double sum;  ///< 0: empty
  };

  std::size_t slot_of(std::uint64_t key) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t slot = mix(key) & mask;
    while (entries_[slot].sum != 0 && entries_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    constexpr std::size_t least = 1024;
    Array<Entry> before = entries_.empty_array_of<Entry>();
    std::swap(before, entries_);
    entries_ = before.empty_array_of<Entry>();
    entries_.resize(before.empty() ? least : 2 * before.size());
    for (Entry& entry : entries_) entry = {0, 0};
    for (const Entry& entry : before) {
      if (entry.sum != 0) entries_[slot_of(entry.key)] = entry;
    }
  }

  Array<Entry> entries_;
  std::size_t count_ = 0;
};

}  // namespace seedmesh
