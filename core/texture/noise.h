#pragma once
/// Noise that tiles in both directions, row by row, for textures.
///
/// Gradient noise after Perlin, "Improving Noise", 2002, on a periodic lattice. Random numbers are keyed by position
/// in the lattice, so that a texture depends on its seed and its size only.
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/rng.h"
#include "core/texture/field.h"

namespace seedmesh::texture {

/// The number of lattice squares across and down the image. Features of the noise are about one square large.
struct Lattice {
  int columns = 4, rows = 4;
};

/// Several lattices, each twice as fine and `gain` times as high as the one before.
struct Octaves {
  int count = 4;
  float gain = 0.5F;
};

/// The function of a noise value n in -1 .. 1 that is added.
enum class Fold {
  plain,  ///< n
  ridge,  ///< 1 - |n|: sharp crests
};

/// The value at a texel is amplitude * fold(noise), summed over the octaves. A lattice finer than two texels adds
/// nothing.
class Noise {
 public:
  Noise(int size, Lattice lattice, Octaves octaves, float amplitude, Rng rng, Fold fold = Fold::plain);

 private:
  friend class NoiseRows;
  /// The gradients of all corners, `columns + 1` in each of `rows + 1` lines, times the amplitude; and, for each texel
  /// of a row, its distance from the left corners and the weight of the right ones.
  struct Octave {
    Lattice lattice;
    float amplitude = 1;
    std::vector<float> slope_x, slope_y, across, weight;
    std::vector<int> first;  ///< texel where each square begins
  };
  static Octave octave_of(int size, Lattice lattice, float amplitude, Rng rng);

  int size_;
  Fold fold_;
  std::vector<Octave> octaves_;
};

/// Rows of a noise, made one at a time. Keeps a reference to the noise. Cost: about 0.4 ns a texel and octave.
class NoiseRows {
 public:
  explicit NoiseRows(const Noise& noise);
  /// Returns the values of a row, until the next call.
  const float* row(int y);

 private:
  const Noise& noise_;
  std::vector<float> slope_, offset_;  ///< slopes and offsets of the corners of a row
  std::vector<float> values_[2];
};

/// Returns all rows of a noise as one field.
Field field_of(const Noise& noise, int size, const Job& job);

}  // namespace seedmesh::texture
