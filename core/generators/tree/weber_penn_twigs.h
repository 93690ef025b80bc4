#pragma once
/// Where leaves stand on twigs that are straight and that nobody draws, many twigs at once: those of a willow
/// are 50,000. About 20 ns a twig of ten leaves.
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/rng.h"

namespace seedmesh::tree {

/// Twigs that wait for their leaves, by numbers.
class WeberPennTwigs {
 public:
  static constexpr std::size_t most = 32, most_leaves = 60;

  std::size_t size() const { return size_; }
  bool is_full() const { return size_ == most; }
  void clear() { size_ = 0; }
  /// `share`: of its parent's length, where it stands; `key`: of its chance.
  void add(double length, double share, std::uint64_t key) {
    length_[size_] = length;
    share_[size_] = share;
    key_[size_++] = key;
  }

  /// Up to `leaves` on each, at most most_leaves. Those are drawn whose hash at drawn_place is below
  /// `drawn_below`. `chance`: of all leaves.
  void find_leaves(const Rng& chance, double leaves, std::int64_t drawn_below);

  /// Of the twig `i`, drawn or not.
  std::size_t count(std::size_t i) const { return count_[i]; }
  /// A bit for each leaf.
  std::uint64_t drawn(std::size_t i) const { return drawn_[i]; }
  /// Metres of the twig.
  double place(std::size_t i, std::size_t leaf) const { return place_[leaf][i]; }
  std::uint64_t leaf_key(std::size_t i, std::size_t leaf) const { return key_at(leaves_[i], leaf); }

 private:
  std::size_t size_ = 0;
  double length_[most] = {}, share_[most] = {}, spacing_[most], end_[most];
  std::uint64_t key_[most] = {}, leaves_[most], drawn_[most], count_[most];
  double place_[most_leaves][most];
};

}  // namespace seedmesh::tree
