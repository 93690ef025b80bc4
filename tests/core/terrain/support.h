#pragma once
/// Fields for tests, and what is measured of them.
#include <cmath>
#include <functional>
#include <vector>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

inline Job any_job(int threads = 1, std::uint64_t seed = 1) {
  Job::Options options;
  options.threads = threads;
  return Job(seed, options);
}

inline Field field_from(std::int32_t width, std::int32_t depth,
                        const std::function<double(int, int)>& height) {
  Field field(any_job(), width, depth, 0);
  for (std::int32_t z = 0; z < depth; ++z) {
    for (std::int32_t x = 0; x < width; ++x) field.at(x, z) = static_cast<float>(height(x, z));
  }
  return field;
}

inline std::vector<double> values(const Field& field) { return {field.heights.begin(), field.heights.end()}; }

/// Half the slope of the logarithm of the mean squared difference over the logarithm of the distance, for
/// distances of 2 to 32 samples: the Hurst exponent that a field really has.
inline double measured_hurst(const Field& field) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0, n = 0;
  for (int lag = 2; lag <= 32; lag *= 2) {
    double sum = 0, count = 0;
    for (int z = 0; z < field.depth; ++z) {
      for (int x = 0; x < field.width; ++x) {
        for (const auto& [dx, dz] : {std::pair{lag, 0}, std::pair{0, lag}}) {
          if (x + dx >= field.width || z + dz >= field.depth) continue;
          const double d =
              static_cast<double>(field.at(x + dx, z + dz)) - static_cast<double>(field.at(x, z));
          sum += d * d;
          count += 1;
        }
      }
    }
    const double lx = std::log(lag), ly = std::log(sum / count);
    sx += lx;
    sy += ly;
    sxx += lx * lx;
    sxy += lx * ly;
    n += 1;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx) / 2;
}

/// Mean squared second difference across columns 0 modulo 32 over that across all others: 1 where no column
/// is a crease.
inline double crease_index(const Field& field) {
  double crease = 0, creases = 0, rest = 0, rests = 0;
  for (int z = 0; z < field.depth; ++z) {
    for (int x = 1; x + 1 < field.width; ++x) {
      const double d = static_cast<double>(field.at(x - 1, z)) - 2.0 * static_cast<double>(field.at(x, z)) +
                       static_cast<double>(field.at(x + 1, z));
      (x % 32 == 0 ? crease : rest) += d * d;
      (x % 32 == 0 ? creases : rests) += 1;
    }
  }
  return crease / creases / (rest / rests);
}

}  // namespace seedmesh::terrain
