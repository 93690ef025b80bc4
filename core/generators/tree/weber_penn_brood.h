#pragma once
/// The children of a stem, many reckoned at once. About 10 ns a child.
#include <cstddef>
#include <cstdint>

#include "core/generators/tree/frame_columns.h"
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
  static constexpr std::size_t most = 64;

  std::size_t size() const { return size_; }
  bool is_full() const { return size_ == most; }
  void clear() { size_ = 0; }
  /// Child `number` of a stem whose frame there is `stem`; `down`: how many degrees it leaves the stem, by
  /// chance apart.
  void add(const Frame& stem, int number, double down) {
    put_frame(stem_, size_, stem);
    number_[size_] = number;
    down_[size_++] = down;
  }
  /// All that were added, whose chance is chance.at(number), of a level that is `level`.
  void reckon(const WeberPennLevel& level, const Rng& chance);

  /// Which of them, straight and of such lengths, end within the envelope of a tree that is `scale` high, as
  /// far as its bounds tell at once. is_in_envelope() says the same of these.
  void find_inside(const TreeParams& params, double scale);
  void place(std::size_t i, const glm::dvec3& position, double length) {
    for (int axis = 0; axis < 3; ++axis) position_[axis][i] = position[axis];
    length_[i] = length;
  }
  bool is_inside(std::size_t i) const { return inside_[i] != 0; }

  Rng chance(std::size_t i) const { return Rng(key_[i]); }
  Frame frame(std::size_t i) const { return frame_in(axis_, i); }
  /// Of what its parent had for splits.
  double carried_splits(std::size_t i) const { return splits_[i]; }

 private:
  std::size_t size_ = 0;
  std::int32_t number_[most] = {};
  std::uint64_t key_[most], inside_[most];
  double position_[3][most] = {}, length_[most] = {};
  double stem_[9][most] = {}, down_[most] = {}, axis_[9][most], splits_[most];
};

}  // namespace seedmesh::tree
