#include "core/generators/terrain/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 32;
// Octaves of the two fields of the domain warp.
constexpr int warp_octaves = 3;
constexpr double space_scale = 1.1547;
// Musgrave's constants of the ridged multifractal.
constexpr float ridge_gain = 2;

std::vector<Octave> octaves_of(const NoisePlan& plan, int count, Rng rng) {
  std::vector<Octave> octaves(static_cast<std::size_t>(count));
  double frequency = 1 / plan.wavelength;
  auto period = static_cast<double>(plan.repeat);
  for (std::size_t i = 0; i < octaves.size(); ++i) {
    octaves[i] = {rng.at(i).key(), frequency, math::to_int64(period)};
    frequency *= plan.lacunarity;
    period *= plan.lacunarity;
  }
  return octaves;
}

std::vector<OctavePath> paths_of(const std::vector<Octave>& octaves) {
  return {octaves.begin(), octaves.end()};
}

/// Evaluates one octave along rows. Fade and gradients of the lattice rows above and below a row are blended
/// once for each lattice column. The samples of a column are then a linear sum.
class OctaveRow {
 public:
  OctaveRow(const Octave& octave, const Window& window, double cell)
      : octave_(octave), step_(cell * octave.frequency) {
    const auto width = static_cast<std::size_t>(window.width);
    inside_.resize(width);
    faded_.resize(width);
    starts_.reserve(64);
    for (std::size_t i = 0; i < width; ++i) {
      const double position = static_cast<double>(window.x + static_cast<std::int64_t>(i)) * step_;
      const double whole = std::floor(position);
      const std::int64_t column = math::to_int64(whole);
      if (i == 0) first_ = column;
      while (starts_.size() <= static_cast<std::size_t>(column - first_)) starts_.push_back(i);
      inside_[i] = static_cast<float>(position - whole);
      faded_[i] = fade(inside_[i]);
    }
    starts_.push_back(width);
    north_.resize(starts_.size());
    south_.resize(starts_.size());
    slope_.resize(starts_.size());
    level_.resize(starts_.size());
  }

  /// False for lattices much finer than the samples, whose columns have too few samples.
  static bool fits(const Octave& octave, double cell) { return cell * octave.frequency <= 2; }

  void evaluate(std::int64_t row, float* out) {
    const double position = static_cast<double>(row) * step_;
    const double whole = std::floor(position);
    const std::int64_t line = math::to_int64(whole);
    if (!any_ || line != line_) take_lattice_rows(line);
    const auto fz = static_cast<float>(position - whole);
    const float v = fade(fz);
    for (std::size_t i = 0; i < slope_.size(); ++i) {
      const float n = north_[i].z * fz, s = south_[i].z * (fz - 1);
      level_[i] = (n + v * (s - n)) * plane_scale;
      slope_[i] = (north_[i].x + v * (south_[i].x - north_[i].x)) * plane_scale;
    }
    for (std::size_t column = 0; column + 1 < starts_.size(); ++column) {
      const float level = level_[column], slope = slope_[column];
      const float next_level = level_[column + 1], next_slope = slope_[column + 1];
      for (std::size_t i = starts_[column]; i < starts_[column + 1]; ++i) {
        const float west = level + slope * inside_[i];
        const float east = next_level + next_slope * (inside_[i] - 1);
        out[i] = west + faded_[i] * (east - west);
      }
    }
  }

 private:
  void take_lattice_rows(std::int64_t line) {
    const std::uint64_t north = octave_.row_key(line), south = octave_.row_key(line + 1);
    for (std::size_t i = 0; i < north_.size(); ++i) {
      const std::int64_t x = first_ + static_cast<std::int64_t>(i);
      north_[i] = octave_.at(north, x);
      south_[i] = octave_.at(south, x);
    }
    line_ = line;
    any_ = true;
  }

  const Octave& octave_;
  double step_;
  std::int64_t first_ = 0, line_ = 0;
  bool any_ = false;
  std::vector<float> inside_, faded_;
  std::vector<std::size_t> starts_;  ///< first sample of each lattice column
  std::vector<Gradient> north_, south_;
  std::vector<float> level_, slope_;
};

/// Adds octaves of one kind. `weight` is the factor that ridged noise passes from octave to octave.
struct Sum {
  NoiseKind kind;
  float amplitude;
  void add(const float* noise, std::size_t count, float* height, float* weight) const {
    switch (kind) {
      case NoiseKind::rolling:
        for (std::size_t i = 0; i < count; ++i) height[i] += noise[i] * amplitude;
        return;
      case NoiseKind::billow:
        for (std::size_t i = 0; i < count; ++i) height[i] += (std::abs(noise[i]) * 2 - 1) * amplitude;
        return;
      case NoiseKind::ridged:
        for (std::size_t i = 0; i < count; ++i) {
          const float ridge = 1 - std::abs(noise[i]);
          const float signal = ridge * ridge * weight[i];
          weight[i] = std::min(1.0F, signal * ridge_gain);
          height[i] += signal * amplitude;
        }
    }
  }
};

struct Rows {
  std::size_t begin = 0, end = 0;
};

/// Computes heights one by one, because the domain warp moves each position differently.
void warped_rows(const NoisePlan& plan, const Window& window, double cell, Rng rng, Field& field, Rows rows) {
  std::vector<OctavePath> octaves = paths_of(octaves_of(plan, plan.octaves, rng));
  std::vector<OctavePath> east = paths_of(octaves_of(plan, warp_octaves, rng.at("east")));
  std::vector<OctavePath> south = paths_of(octaves_of(plan, warp_octaves, rng.at("south")));
  const auto shift = [&](std::vector<OctavePath>& field_octaves, double x, double z) {
    double sum = 0, weight = plan.warp;
    for (OctavePath& octave : field_octaves) {
      sum += static_cast<double>(octave.value(x * octave.frequency(), z * octave.frequency())) * weight;
      weight *= 0.5;
    }
    return sum;
  };
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    float* out = field.row(static_cast<std::int32_t>(row));
    const double z = static_cast<double>(window.z + static_cast<std::int64_t>(row)) * cell;
    for (std::int32_t i = 0; i < window.width; ++i) {
      const double x = static_cast<double>(window.x + i) * cell;
      const double wx = x + shift(east, x, z), wz = z + shift(south, x, z);
      float weight = 1;
      auto amplitude = static_cast<float>(plan.amplitude);
      out[i] = 0;
      for (OctavePath& octave : octaves) {
        const float noise = octave.value(wx * octave.frequency(), wz * octave.frequency());
        Sum{plan.kind, amplitude}.add(&noise, 1, out + i, &weight);
        amplitude *= static_cast<float>(plan.gain);
      }
    }
  }
}

void plain_rows(const NoisePlan& plan, const Window& window, double cell, Rng rng, Field& field, Rows all) {
  const std::vector<Octave> octaves = octaves_of(plan, plan.octaves, rng);
  std::vector<OctaveRow> rows;
  rows.reserve(octaves.size());
  for (const Octave& octave : octaves) {
    if (OctaveRow::fits(octave, cell)) rows.emplace_back(octave, window, cell);
  }
  const auto width = static_cast<std::size_t>(window.width);
  std::vector<float> noise(width), weight(width);
  for (std::size_t row = all.begin; row < all.end; ++row) {
    float* out = field.row(static_cast<std::int32_t>(row));
    std::fill(out, out + width, 0.0F);
    std::fill(weight.begin(), weight.end(), 1.0F);
    auto amplitude = static_cast<float>(plan.amplitude);
    const std::int64_t z = window.z + static_cast<std::int64_t>(row);
    for (std::size_t octave = 0; octave < octaves.size(); ++octave) {
      if (octave < rows.size()) {
        rows[octave].evaluate(z, noise.data());
      } else {
        const double step = cell * octaves[octave].frequency;
        OctavePath path(octaves[octave]);
        for (std::int32_t i = 0; i < window.width; ++i) {
          noise[static_cast<std::size_t>(i)] =
              path.value(static_cast<double>(window.x + i) * step, static_cast<double>(z) * step);
        }
      }
      Sum{plan.kind, amplitude}.add(noise.data(), width, out, weight.data());
      amplitude *= static_cast<float>(plan.gain);
    }
  }
}

/// Returns the gradient of a lattice point in space, uniform on the sphere.
glm::dvec3 direction(std::uint64_t bits) {
  const double z = static_cast<double>(bits >> 40U) * 0x1p-23 - 1;
  const double flat = std::sqrt(std::max(0.0, 1 - z * z));
  const Gradient turn = gradients()[bits % directions];
  return {flat * static_cast<double>(turn.x), flat * static_cast<double>(turn.z), z};
}

}  // namespace

Field noisy(const NoisePlan& plan, const Window& window, double cell, Rng rng, const Job& job) {
  Field field(job, window.width, window.depth, 0);
  parallel_for(job, static_cast<std::size_t>(window.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 for (std::size_t row = begin; row < end; row += 8) {
                   job.check();
                   if (plan.warp > 0)
                     warped_rows(plan, window, cell, rng, field, {row, std::min(end, row + 8)});
                 }
                 if (plan.warp <= 0) plain_rows(plan, window, cell, rng, field, {begin, end});
               });
  return field;
}

PlaneNoise::PlaneNoise(const NoisePlan& plan, Rng rng)
    : kind_(plan.kind),
      amplitude_(static_cast<float>(plan.amplitude)),
      gain_(static_cast<float>(plan.gain)),
      octaves_(paths_of(octaves_of(plan, plan.octaves, rng))) {}

float PlaneNoise::at(double x, double z) {
  float height = 0, weight = 1, amplitude = amplitude_;
  for (OctavePath& octave : octaves_) {
    const float noise = octave.value(x * octave.frequency(), z * octave.frequency());
    Sum{kind_, amplitude}.add(&noise, 1, &height, &weight);
    amplitude *= gain_;
  }
  return height;
}

void noise_in_plane(const NoisePlan& plan, std::span<const double> x, std::span<const double> z, Rng rng,
                    double* out) {
  PlaneNoise noise(plan, rng);
  for (std::size_t i = 0; i < x.size(); ++i) out[i] = static_cast<double>(noise.at(x[i], z[i]));
}

SpaceNoise::SpaceNoise(const NoisePlan& plan, Rng rng) : kind_(plan.kind) {
  double frequency = 1 / plan.wavelength;
  auto amplitude = static_cast<float>(plan.amplitude);
  for (int i = 0; i < plan.octaves; ++i) {
    octaves_.push_back({rng.at(static_cast<std::uint64_t>(i)).key(), frequency, amplitude, {}});
    frequency *= plan.lacunarity;
    amplitude *= static_cast<float>(plan.gain);
  }
  if (!(plan.warp > 0)) return;
  NoisePlan mild = plan;
  mild.kind = NoiseKind::rolling;
  mild.octaves = warp_octaves;
  mild.amplitude = plan.warp;
  mild.gain = 0.5;
  mild.warp = 0;
  for (const char* const direction_name : {"east", "up", "south"})
    warp_.emplace_back(mild, rng.at(direction_name));
}

const std::array<glm::dvec3, 8>& SpaceNoise::Octave::gradients_of(const std::array<std::int64_t, 3>& low) {
  const auto part = [&](std::size_t axis) { return static_cast<std::uint64_t>(low[axis]); };
  Cell& cell = cells[(part(0) + 3 * part(1) + 5 * part(2)) % cells.size()];
  if (cell.is_known && cell.low == low) return cell.gradients;
  cell.is_known = true;
  cell.low = low;
  for (unsigned x = 0; x < 2; ++x) {
    const std::uint64_t at_x = key_at(key, part(0) + x);
    for (unsigned y = 0; y < 2; ++y) {
      const std::uint64_t at_y = key_at(at_x, part(1) + y);
      for (unsigned z = 0; z < 2; ++z)
        cell.gradients[x + 2 * y + 4 * z] = direction(key_at(at_y, part(2) + z));
    }
  }
  return cell.gradients;
}

double SpaceNoise::Octave::value(const glm::dvec3& position) {
  const glm::dvec3 whole(std::floor(position.x), std::floor(position.y), std::floor(position.z));
  const glm::dvec3 in = position - whole;
  const auto ease = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const glm::dvec3 u(ease(in.x), ease(in.y), ease(in.z));
  const std::array<glm::dvec3, 8>& gradients =
      gradients_of({math::to_int64(whole.x), math::to_int64(whole.y), math::to_int64(whole.z)});
  double corners[8];
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec3 g = gradients[i], d = in - glm::dvec3(i & 1U, i >> 1U & 1U, i >> 2U);
    corners[i] = g.x * d.x + g.y * d.y + g.z * d.z;
  }
  for (unsigned axis = 0, left = 4; axis < 3; ++axis, left /= 2) {
    for (unsigned i = 0; i < left; ++i)
      corners[i] = corners[2 * i] + u[static_cast<int>(axis)] * (corners[2 * i + 1] - corners[2 * i]);
  }
  return corners[0] * space_scale;
}

double SpaceNoise::at(const glm::dvec3& position) {
  glm::dvec3 moved = position;
  for (std::size_t axis = 0; axis < warp_.size(); ++axis)
    moved[static_cast<int>(axis)] += warp_[axis].at(position);
  float height = 0, weight = 1;
  for (Octave& octave : octaves_) {
    const auto noise = static_cast<float>(octave.value(moved * octave.frequency));
    Sum{kind_, octave.amplitude}.add(&noise, 1, &height, &weight);
  }
  return static_cast<double>(height);
}

}  // namespace seedmesh::terrain
