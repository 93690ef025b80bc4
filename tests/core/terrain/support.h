#pragma once
/// Fields for tests, and what is measured of them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/generators/terrain/field.h"
#include "core/generators/terrain/plan.h"
#include "generated/params/terrain.h"

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

/// A terrain of 33 by 33 samples over 100 m.
inline TerrainParams small(TerrainAlgorithm algorithm) {
  TerrainParams params;
  params.algorithm = algorithm;
  params.size = 100;
  const bool subdivides = algorithm == TerrainAlgorithm::triangular_edge ||
                          algorithm == TerrainAlgorithm::diamond_square ||
                          algorithm == TerrainAlgorithm::square_square;
  if (subdivides) {
    params.iterations = 5;
  } else {
    params.resolution = 33;
  }
  return params;
}

inline std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (i + k < bytes.size() ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63U];
  }
  return text;
}

inline Field heights_of(const TerrainParams& params) {
  Job job = any_job();
  Result<Field> field = field_of(params, job);
  EXPECT_TRUE(field) << (field ? "" : field.error().issues.front().message);
  return field ? std::move(*field) : Field();
}

}  // namespace seedmesh::terrain
