#include "core/texture/noise.h"

#include <algorithm>
#include <cmath>

#include "core/base/wide.h"

namespace seedmesh::texture {
namespace {

// Gradients of Perlin's noise in the plane: sixteen directions, longer than 1 so that values reach about 1.
constexpr float reach = 1.4F, c1 = 0.92388F, s1 = 0.38268F, d1 = 0.70711F;
constexpr glm::vec2 gradients[16] = {{1, 0},    {c1, s1},  {d1, d1},  {s1, c1},   {0, 1},     {-s1, c1},
                                     {-d1, d1}, {-c1, s1}, {-1, 0},   {-c1, -s1}, {-d1, -d1}, {-s1, -c1},
                                     {0, -1},   {s1, -c1}, {d1, -d1}, {c1, -s1}};

/// Texels that are computed together. The last ones of a square may lie in the next square, which replaces them.
constexpr int lanes = 8;

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// The noise along a row of texels as slope * (distance to the right) + offset at each corner.
// NOLINTNEXTLINE(readability-function-size): with separate pointers, compilers use vector instructions
SEEDMESH_WIDE void blend_corners(const float* __restrict upper_x, const float* __restrict upper_y,
                                 const float* __restrict lower_x, const float* __restrict lower_y,
                                 float below, float weight, int count, float* __restrict slope,
                                 float* __restrict offset) {
  for (int i = 0; i < count; ++i) {
    const float upper = upper_y[i] * below, lower = lower_y[i] * (below - 1);
    slope[i] = upper_x[i] + (lower_x[i] - upper_x[i]) * weight;
    offset[i] = upper + (lower - upper) * weight;
  }
}

struct RowInput {
  const int* first;
  const float *across, *weight;
  const float *slope, *offset;
  int columns;
  float crest;  ///< of ridges: the value where the noise is 0
};

template <Fold fold>
inline void add_row(const RowInput& in, const float* __restrict before, float* __restrict out) {
  for (int i = 0; i < in.columns; ++i) {
    const float left_slope = in.slope[i], left_offset = in.offset[i];
    const float right_slope = in.slope[i + 1], right_offset = in.offset[i + 1] - in.slope[i + 1];
    for (int x = in.first[i]; x < in.first[i + 1]; x += lanes) {
      for (int k = x; k < x + lanes; ++k) {
        const float left = left_slope * in.across[k] + left_offset;
        const float right = right_slope * in.across[k] + right_offset;
        const float n = left + (right - left) * in.weight[k];
        out[k] = before[k] + (fold == Fold::ridge ? in.crest - std::abs(n) : n);
      }
    }
  }
}

SEEDMESH_WIDE void add_plain(const RowInput& in, const float* before, float* out) {
  add_row<Fold::plain>(in, before, out);
}

SEEDMESH_WIDE void add_ridge(const RowInput& in, const float* before, float* out) {
  add_row<Fold::ridge>(in, before, out);
}

}  // namespace

Noise::Octave Noise::octave_of(int size, Lattice lattice, float amplitude, Rng rng) {
  Octave octave{lattice, amplitude, {}, {}, {}, {}, {}};
  for (int row = 0; row <= lattice.rows; ++row) {
    const Rng of_row = rng.at(static_cast<std::uint64_t>(row % lattice.rows));
    for (int column = 0; column <= lattice.columns; ++column) {
      const Rng corner = of_row.at(static_cast<std::uint64_t>(column % lattice.columns));
      const glm::vec2 gradient = gradients[corner.key() >> 60U] * (reach * amplitude);
      octave.slope_x.push_back(gradient.x);
      octave.slope_y.push_back(gradient.y);
    }
  }
  for (int i = 0; i <= lattice.columns; ++i)
    octave.first.push_back((i * size + lattice.columns - 1) / lattice.columns);
  const float by_texel = static_cast<float>(lattice.columns) / static_cast<float>(size);
  octave.across.resize(static_cast<std::size_t>(size + lanes), 0.0F);
  octave.weight.resize(octave.across.size(), 0.0F);
  for (int i = 0; i < lattice.columns; ++i) {
    for (int x = octave.first[static_cast<std::size_t>(i)]; x < octave.first[static_cast<std::size_t>(i) + 1];
         ++x) {
      const float across = static_cast<float>(x) * by_texel - static_cast<float>(i);
      octave.across[static_cast<std::size_t>(x)] = across;
      octave.weight[static_cast<std::size_t>(x)] = fade(across);
    }
  }
  return octave;
}

Noise::Noise(int size, Lattice lattice, Octaves octaves, float amplitude, Rng rng, Fold fold)
    : size_(size), fold_(fold) {
  for (int i = 0; i < octaves.count; ++i) {
    if (std::max(lattice.columns, lattice.rows) > size / 2) return;
    octaves_.push_back(octave_of(size, lattice, amplitude, rng.at(static_cast<std::uint64_t>(i))));
    lattice = {2 * lattice.columns, 2 * lattice.rows};
    amplitude *= octaves.gain;
  }
}

NoiseRows::NoiseRows(const Noise& noise) : noise_(noise) {
  std::size_t corners = 0;
  for (const Noise::Octave& octave : noise.octaves_)
    corners = std::max(corners, static_cast<std::size_t>(octave.lattice.columns) + 1);
  slope_.resize(corners);
  offset_.resize(corners);
  for (std::vector<float>& values : values_) values.resize(static_cast<std::size_t>(noise.size_ + lanes));
}

const float* NoiseRows::row(int y) {
  std::fill(values_[0].begin(), values_[0].end(), 0.0F);
  std::size_t now = 0;
  for (const Noise::Octave& octave : noise_.octaves_) {
    const float v =
        static_cast<float>(y) * static_cast<float>(octave.lattice.rows) / static_cast<float>(noise_.size_);
    const int row = static_cast<int>(v), corners = octave.lattice.columns + 1;
    const float below = v - static_cast<float>(row);
    const std::size_t upper = static_cast<std::size_t>(row) * static_cast<std::size_t>(corners);
    const std::size_t lower = upper + static_cast<std::size_t>(corners);
    blend_corners(octave.slope_x.data() + upper, octave.slope_y.data() + upper, octave.slope_x.data() + lower,
                  octave.slope_y.data() + lower, below, fade(below), corners, slope_.data(), offset_.data());
    const RowInput in{octave.first.data(), octave.across.data(),   octave.weight.data(), slope_.data(),
                      offset_.data(),      octave.lattice.columns, octave.amplitude};
    const auto add = noise_.fold_ == Fold::ridge ? add_ridge : add_plain;
    add(in, values_[now].data(), values_[1 - now].data());
    now = 1 - now;
  }
  return values_[now].data();
}

Field field_of(const Noise& noise, int size, const Job& job) {
  Field field(job, size);
  for_rows(job, size, [&](int begin, int end) {
    NoiseRows rows(noise);
    for (int y = begin; y < end; ++y) std::copy_n(rows.row(y), size, field.row(y));
  });
  return field;
}

}  // namespace seedmesh::texture
