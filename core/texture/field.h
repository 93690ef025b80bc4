#pragma once
/// Square images of one number for each texel that tile in both directions, and the noise that textures are
/// made of.
///
/// Gradient noise after Perlin, "Improving Noise", 2002, on a periodic lattice. Cells after Worley, "A
/// Cellular Texture Basis Function", 1996, with one point in each lattice square. Random numbers are keyed by
/// position, so that a texture depends on its seed and its size only.
#include <glm/vec2.hpp>

#include "core/base/array.h"
#include "core/base/rng.h"

namespace seedmesh::texture {

class Field {
 public:
  /// `size` is a power of two.
  Field(const Job& job, int size, float value = 0);

  int size() const { return size_; }
  float* row(int y) { return values_.data() + index(0, y); }
  const float* row(int y) const { return values_.data() + index(0, y); }
  float& at(int x, int y) { return values_[index(x & (size_ - 1), y & (size_ - 1))]; }
  float at(int x, int y) const { return values_[index(x & (size_ - 1), y & (size_ - 1))]; }
  /// The interpolated value at a position in texels; positions wrap around.
  float sample(float x, float y) const;
  /// Replaces each value by body(value, x, y). Rows run in parallel.
  template <class Body>
  void each(const Job& job, Body&& body);

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
  }
  int size_;
  Array<float> values_;
};

/// The function of a noise value n in -1 .. 1 that is added.
enum class Fold {
  plain,  ///< n
  ridge,  ///< 1 - |n|: sharp crests
};

/// The number of lattice squares across and down the image. Features of the noise are about one square large.
struct Lattice {
  int columns = 4, rows = 4;
};

/// field += amplitude * fold(noise). A lattice finer than two texels adds nothing. Cost: about 1 ns a texel.
void add_noise(Field& field, Lattice lattice, float amplitude, Rng rng, const Job& job,
               Fold fold = Fold::plain);

/// The same over several lattices, each twice as fine and `gain` times as high as the one before.
struct Octaves {
  int count = 4;
  float gain = 0.5F;
};
void add_noise(Field& field, Lattice lattice, Octaves octaves, float amplitude, Rng rng, const Job& job);

/// For each texel the distance to the border of its cell in lattice squares (0 on the border, about 0.5 in
/// the middle), and the random number of its cell in 0 .. 1. `wobble` (in texels, may be null) displaces the
/// lookup. Cost: about 10 ns a texel.
struct Cells {
  Field border, shade;
};
Cells cells(int size, Lattice lattice, Rng rng, const Field* wobble, float strength, const Job& job);

/// A smooth step from 0 at `low` to 1 at `high`.
inline float step_between(float low, float high, float x) {
  const float t = (x - low) / (high - low);
  const float c = t < 0 ? 0 : t > 1 ? 1 : t;
  return c * c * (3 - 2 * c);
}

}  // namespace seedmesh::texture

#include "core/base/parallel.h"

namespace seedmesh::texture {

/// Rows of one parallel task.
constexpr std::size_t rows_a_chunk = 32;

template <class Body>
void Field::each(const Job& job, Body&& body) {
  parallel_for(job, static_cast<std::size_t>(size_), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (std::size_t y = begin; y < end; ++y) {
                   float* values = row(static_cast<int>(y));
                   for (int x = 0; x < size_; ++x) values[x] = body(values[x], x, static_cast<int>(y));
                 }
               });
}

}  // namespace seedmesh::texture
