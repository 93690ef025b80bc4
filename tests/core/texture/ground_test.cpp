#include "core/texture/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/model/model.h"
#include "core/texture/paint.h"
#include "core/texture/png.h"
#include "core/texture/wall.h"

namespace seedmesh::texture {
namespace {

constexpr int size = 512;

class Grounds : public testing::TestWithParam<std::string_view> {
 protected:
  static Picture decoded(const Image& image) {
    const Job job(1, Job::Options{});
    Result<Picture> picture = decode_png(std::as_bytes(std::span(image.bytes)), {}, job);
    EXPECT_TRUE(picture);
    return *std::move(picture);
  }
  static Maps maps(std::uint64_t seed) {
    const Job job(1, Job::Options{});
    const Painting painting = paint_kind(GetParam(), size, seed, {}, job);
    return make_maps(painting.relief, painting.finish, "ground", {}, job);
  }
  /// Linear, by texel.
  static std::vector<double> luminance(std::uint64_t seed) {
    const Picture picture = decoded(*maps(seed).color);
    EXPECT_EQ(picture.channels, 1);
    std::vector<double> values;
    for (const std::uint8_t byte : picture.bytes) values.push_back(static_cast<double>(linear_of_srgb(byte)));
    return values;
  }
};

/// 256 texels a metre at the usual size.
TEST(Ground, ShowsItsTextureAtTheDensityOfLand) { EXPECT_GE(size / ground_tile, 256); }

TEST_P(Grounds, HaveTheMeanOfTheirGrey) {
  const std::vector<double> values = luminance(3);
  double sum = 0;
  for (const double value : values) sum += value;
  const double grey = static_cast<double>(grey_of(GetParam()));
  EXPECT_NEAR(sum / static_cast<double>(values.size()), grey, 0.08 * grey);
}

/// Slopes of pictures in engines: 4 to 12 degrees for smooth grounds, 15 to 35 for rough ones, few above 65.
TEST_P(Grounds, HaveNormalsThatAreNeitherFlatNorSpiky) {
  const Picture normals = decoded(*maps(3).normal);
  std::vector<double> degrees;
  for (std::size_t i = 0; i < normals.bytes.size(); i += 3) {
    double n[3];
    for (std::size_t c = 0; c < 3; ++c) n[c] = normals.bytes[i + c] / 127.5 - 1;
    const double up = n[2] / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    degrees.push_back(std::acos(std::clamp(up, -1.0, 1.0)) * 180 / std::numbers::pi);
  }
  double sum = 0;
  for (const double each : degrees) sum += each;
  std::nth_element(degrees.begin(), degrees.begin() + degrees.size() * 95 / 100, degrees.end());
  const bool is_smooth = GetParam() == "snow_ground" || GetParam() == "sand_ground";
  EXPECT_GE(sum / static_cast<double>(degrees.size()), is_smooth ? 6 : 12);
  EXPECT_LE(sum / static_cast<double>(degrees.size()), is_smooth ? 16 : 36);
  EXPECT_LE(degrees[degrees.size() * 95 / 100], 66);
}

/// The share of the variance at up to four waves a side, by a discrete Fourier transform of the rows and columns
/// that have them.
TEST_P(Grounds, ShowNoRepeatsFromAfar) {
  const std::vector<double> values = luminance(5);
  constexpr int most = 4;
  double mean = 0, variance = 0;
  for (const double value : values) mean += value;
  mean /= static_cast<double>(values.size());
  for (const double value : values) variance += (value - mean) * (value - mean);
  variance /= static_cast<double>(values.size());
  // Along rows first, then down the columns of what is left.
  std::vector<std::complex<double>> along((2 * most + 1) * size);
  for (int y = 0; y < size; ++y) {
    for (int k = -most; k <= most; ++k) {
      std::complex<double> sum = 0;
      for (int x = 0; x < size; ++x) {
        sum += (values[static_cast<std::size_t>(y * size + x)] - mean) *
               std::polar(1.0, -2 * std::numbers::pi * k * x / size);
      }
      along[static_cast<std::size_t>((k + most) * size + y)] = sum;
    }
  }
  double low = 0;
  for (int k = -most; k <= most; ++k) {
    for (int l = -most; l <= most; ++l) {
      std::complex<double> sum = 0;
      for (int y = 0; y < size; ++y) {
        sum += along[static_cast<std::size_t>((k + most) * size + y)] *
               std::polar(1.0, -2 * std::numbers::pi * l * y / size);
      }
      low += std::norm(sum / static_cast<double>(size * size));
    }
  }
  EXPECT_LE(low / variance, 0.1);
}

TEST_P(Grounds, DifferInRoughness) {
  const Picture surface = decoded(*maps(3).surface);
  std::vector<int> roughness;
  for (std::size_t i = 1; i < surface.bytes.size(); i += 3) roughness.push_back(surface.bytes[i]);
  std::sort(roughness.begin(), roughness.end());
  EXPECT_GE((roughness[roughness.size() * 98 / 100] - roughness[roughness.size() * 2 / 100]) / 255.0, 0.06);
}

INSTANTIATE_TEST_SUITE_P(All, Grounds,
                         testing::Values("grass_ground", "soil_ground", "rock_ground", "scree_ground",
                                         "sand_ground", "snow_ground", "litter_ground"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace seedmesh::texture
