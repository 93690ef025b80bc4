#pragma once
/// Disjoint sets of numbers (union-find with path halving). The least member represents its set.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace seedmesh {

class DisjointSets {
 public:
  /// Makes a set of each number below `size`.
  explicit DisjointSets(std::size_t size = 0) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(parent_.size()); }

  /// Adds a number in a set of its own, and returns it.
  std::uint32_t add() {
    parent_.push_back(size());
    return parent_.back();
  }

  /// Returns the least member of the set of `i`.
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Joins the sets of two numbers. Returns false if both are in one set already.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace seedmesh
