#pragma once
/// The offsets of leaves on twigs that are straight and have no bark, computed for several twigs at once. A
/// weeping willow has 50,000 of these twigs. Without batches, the request for a weeping willow takes 40 %
/// longer. About 20 ns for a twig of ten leaves.
#include <cstddef>
#include <cstdint>

#include "core/base/rng.h"

namespace seedmesh::tree {

/// A batch of twigs.
class WeberPennTwigs {
 public:
  static constexpr std::size_t most = 32, most_leaves = 60;

  std::size_t size() const { return size_; }
  bool is_full() const { return size_ == most; }
  void clear() { size_ = 0; }
  /// `share`: the offset on its parent as a share of the length of the parent; `key`: of its random numbers.
  void add(double length, double share, std::uint64_t key) {
    length_[size_] = length;
    share_[size_] = share;
    key_[size_++] = key;
  }

  /// Finds up to `leaves` leaves on each twig, at most most_leaves, as child_count() and find_offsets() do
  /// for one stem. Those with a draw_number() below `drawn_below` are drawn. `random`: the random numbers of
  /// all leaves of the tree.
  void find_leaves(const Rng& random, double leaves, std::int64_t drawn_below);

  /// The number of leaves of twig `i`, drawn or not.
  std::size_t count(std::size_t i) const { return count_[i]; }
  /// Returns a bit for each leaf that is drawn.
  std::uint64_t drawn(std::size_t i) const { return drawn_[i]; }
  double offset(std::size_t i, std::size_t leaf) const { return offset_[leaf][i]; }
  std::uint64_t leaf_key(std::size_t i, std::size_t leaf) const { return key_at(leaves_[i], leaf); }

 private:
  std::size_t size_ = 0;
  double length_[most] = {}, share_[most] = {}, spacing_[most], end_[most];
  std::uint64_t key_[most] = {}, leaves_[most], drawn_[most], count_[most];
  double offset_[most_leaves][most];
};

}  // namespace seedmesh::tree
