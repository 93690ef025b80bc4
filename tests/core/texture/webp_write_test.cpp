/// WebP files: alpha without loss, colours with little, and the same bytes whatever the processor offers.
#include "core/texture/webp_write.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/rng.h"
#include "core/texture/decode.h"
#include "core/texture/webp_alpha.h"

// A global of libwebp: which instructions its functions may use.
extern "C" {
using CpuInfo = int (*)(int feature);
extern CpuInfo VP8GetCPUInfo;  // NOLINT: the name is libwebp's
}

namespace seedmesh::texture {
namespace {

Job job_of() { return Job(1, Job::Options{}); }

/// A picture of smooth colours, with noise, and an alpha of discs and gradients.
Picture sample(std::uint32_t width, std::uint32_t height, int channels, std::uint64_t seed, const Job& job) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.channels = channels;
  picture.bytes = Array<std::uint8_t>(job);
  const Rng rng = Rng::of_seed(seed);
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const double noise = rng.at(y).at(x).unit();
      for (int c = 0; c < channels; ++c) {
        double value = 128 + 90 * std::sin(0.05 * x + c) * std::cos(0.04 * y) + 12 * noise;
        const bool is_alpha = c == channels - 1 && channels % 2 == 0;
        if (is_alpha) value = (x / 9 + y / 7) % 3 == 0 ? 0 : noise < 0.8 ? 255 : 255 * noise;
        picture.bytes.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)));
      }
    }
  }
  return picture;
}

Picture read_back(const Array<std::uint8_t>& file, const Job& job) {
  Result<Decoded> decoded = decode_webp(std::as_bytes(file.span()), {}, job);
  EXPECT_TRUE(decoded && decoded->picture);
  return decoded && decoded->picture ? *std::move(decoded->picture) : Picture{};
}

TEST(WebpWrite, KeepsAlphaToTheBitInFilesOfEverySize) {
  const Job job = job_of();
  for (std::uint64_t i = 0; i < 60; ++i) {
    const Rng rng = Rng::of_seed(i);
    const auto width = 1 + static_cast<std::uint32_t>(rng.at(1).unit() * 90);
    const auto height = 1 + static_cast<std::uint32_t>(rng.at(2).unit() * 90);
    const Picture given = sample(width, height, 4, i, job);
    const Picture read = read_back(encode_webp(given.view(), WebpQuality::usual, job), job);
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, height);
    bool has_alpha = false;
    for (std::size_t p = 3; p < given.bytes.size(); p += 4) has_alpha = has_alpha || given.bytes[p] != 255;
    if (!has_alpha) continue;
    ASSERT_EQ(read.channels, 4);
    for (std::size_t p = 3; p < given.bytes.size(); p += 4)
      ASSERT_EQ(read.bytes[p], given.bytes[p]) << width << " x " << height << " at " << p / 4;
  }
}

TEST(WebpWrite, KeepsAlphaOfRunsThatAreLongerThanOneCode) {
  const Job job = job_of();
  for (const std::uint32_t side : {64U, 300U}) {
    Picture given = sample(side, side, 4, 3, job);
    for (std::size_t p = 3; p < given.bytes.size(); p += 4)
      given.bytes[p] = p < given.bytes.size() / 2 ? 0 : 255;
    const Picture read = read_back(encode_webp(given.view(), WebpQuality::usual, job), job);
    for (std::size_t p = 3; p < given.bytes.size(); p += 4) ASSERT_EQ(read.bytes[p], given.bytes[p]);
  }
}

TEST(WebpWrite, LosesLittleOfSmoothColours) {
  const Job job = job_of();
  for (const int channels : {1, 3, 4}) {
    const Picture given = sample(256, 256, channels, 7, job);
    const Picture read = read_back(encode_webp(given.view(), WebpQuality::fine, job), job);
    double sum = 0;
    for (std::size_t i = 0; i < std::size_t{256} * 256; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t from = channels == 1 ? 0 : c;
        const double off = given.bytes[i * static_cast<std::size_t>(channels) + from] -
                           static_cast<double>(read.bytes[i * static_cast<std::size_t>(read.channels) + c]);
        sum += off * off;
      }
    }
    const double psnr = 10 * std::log10(255.0 * 255.0 / (sum / (3.0 * 256 * 256)));
    EXPECT_GT(psnr, 34) << channels;
  }
}

TEST(WebpWrite, GivesTheSameBytesWithAndWithoutInstructionsForVectors) {
  const Job job = job_of();
  const CpuInfo usual = VP8GetCPUInfo;
  for (std::uint64_t i = 0; i < 12; ++i) {
    const Picture given =
        sample(97 + 31 * static_cast<std::uint32_t>(i % 5), 128, i % 2 == 0 ? 3 : 4, i, job);
    const WebpQuality quality = i % 3 == 0 ? WebpQuality::fine : WebpQuality::usual;
    VP8GetCPUInfo = usual;
    const Array<std::uint8_t> with = encode_webp(given.view(), quality, job);
    VP8GetCPUInfo = [](int) { return 0; };
    const Array<std::uint8_t> without = encode_webp(given.view(), quality, job);
    VP8GetCPUInfo = usual;
    ASSERT_EQ(with.size(), without.size()) << i;
    EXPECT_TRUE(std::equal(with.begin(), with.end(), without.begin())) << i;
  }
}

TEST(WebpWrite, EndsWhereTheRequestHasEnded) {
  std::stop_source stop;
  const Job job(1, Job::Options{.stop = stop.get_token()});
  const Picture given = sample(256, 256, 3, 1, job);
  stop.request_stop();
  EXPECT_THROW(encode_webp(given.view(), WebpQuality::usual, job), Stop);
}

}  // namespace
}  // namespace seedmesh::texture
