#pragma once
/// The children on a straight piece of a stem, many reckoned at once. About 10 ns a child.
#include <cstddef>
#include <span>

#include "core/generators/tree/weber_penn_shape.h"

namespace seedmesh::tree {

/// A straight part of a stem, between two shares of its length.
struct WeberPennPiece {
  Frame frame;
  glm::dvec3 from{0};
  double along = 0, end = 0;  ///< metres of the stem, where the piece begins and ends
  glm::dvec3 at(double offset) const { return from + frame.heading * (offset - along); }
};

/// Degrees about the stem of its child or leaf `number`, by chance apart.
inline double about_stem(const WeberPennLevel& level, int number) {
  return level.rotate >= 0 ? number * level.rotate : (number & 1) * 180.0 + level.rotate;
}

class WeberPennBrood {
 public:
  static constexpr std::size_t most = 32;

  /// Up to `most` children from number `first` on, whose chance is chance.at(number), of a level that is
  /// `level`; `down`: how many degrees each leaves the stem, by chance apart.
  void reckon(const WeberPennPiece& piece, const WeberPennLevel& level, const Rng& chance, int first,
              std::span<const double> down);

  Rng chance(std::size_t i) const { return Rng(key_[i]); }
  Frame frame(std::size_t i) const {
    return {{axis_[0][i], axis_[1][i], axis_[2][i]},
            {axis_[3][i], axis_[4][i], axis_[5][i]},
            {axis_[6][i], axis_[7][i], axis_[8][i]}};
  }
  /// Of what its parent had for splits.
  double carried_splits(std::size_t i) const { return splits_[i]; }

 private:
  std::uint64_t key_[most];
  double down_[most] = {}, axis_[9][most], splits_[most];
};

}  // namespace seedmesh::tree
