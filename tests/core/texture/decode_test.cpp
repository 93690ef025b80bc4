#include "core/texture/decode.h"

#include <gmock/gmock.h>

#include "core/base/rng.h"
#include "tests/core/texture/picture_files.h"

namespace seedmesh::texture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Job job_of() { return Job(1, Job::Options{}); }

FileBytes ramp(std::size_t count) {
  FileBytes values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<std::uint8_t>(i * 7 % 251));
  return values;
}

std::string refusal_of(const FileBytes& file, std::uint32_t longest = 16'385) {
  const Result<Decoded> decoded = decode_picture(bytes_of(file), {.longest_side = longest}, job_of());
  return decoded ? "accepted" : decoded.error().issues.front().message;
}

TEST(Decode, ReadsJpegsOfGreyAndColour) {
  for (const bool is_progressive : {false, true}) {
    const FileBytes grey = ramp(32 * 24);
    const Result<Decoded> one =
        decode_picture(bytes_of(jpeg_file(grey, 32, 1, is_progressive)), {}, job_of());
    ASSERT_TRUE(one);
    ASSERT_EQ(one->picture->channels, 1);
    EXPECT_EQ(one->picture->height, 24U);
    // A JPEG of quality 100 is off by rounding alone.
    for (std::size_t i = 0; i < grey.size(); ++i) EXPECT_NEAR(one->picture->bytes[i], grey[i], 2);
  }
  const FileBytes flat(3 * 16 * 16, 120);
  const Result<Decoded> three = decode_picture(bytes_of(jpeg_file(flat, 16, 3)), {}, job_of());
  ASSERT_TRUE(three);
  EXPECT_EQ(three->picture->channels, 3);
  EXPECT_NEAR(three->picture->bytes[5], 120, 1);
}

TEST(Decode, ReadsWebpWithoutLoss) {
  const FileBytes pixels = ramp(3 * 20 * 10);
  const Result<Decoded> decoded = decode_picture(bytes_of(webp_file(pixels, 20)), {}, job_of());
  ASSERT_TRUE(decoded);
  EXPECT_TRUE(std::ranges::equal(decoded->picture->bytes, pixels));
}

TEST(Decode, ReadsTiffsOfAllNumbers) {
  const auto values_of = [](const FileBytes& file) {
    const Result<Decoded> decoded = decode_picture(bytes_of(file), {}, job_of());
    std::vector<double> values;
    if (!decoded) return values;
    if (decoded->samples)
      for (const float value : decoded->samples->values) values.push_back(static_cast<double>(value));
    else
      for (std::size_t i = 0; i < 4; ++i) values.push_back(decoded->picture->channel(i));
    return values;
  };
  EXPECT_THAT(values_of(tiff_file<std::uint8_t>({2, 2, 8, 1, "", {}}, {1, 2, 3, 255})),
              ElementsAre(1, 2, 3, 255));
  EXPECT_THAT(values_of(tiff_file<std::uint16_t>({2, 2, 16, 1, "", {}}, {1, 2, 3, 65535})),
              ElementsAre(1, 2, 3, 65535));
  EXPECT_THAT(values_of(tiff_file<std::int16_t>({2, 2, 16, 2, "", {}}, {-4, 2, 3, -32768})),
              ElementsAre(-4, 2, 3, -32768));
  EXPECT_THAT(values_of(tiff_file<std::int32_t>({2, 2, 32, 2, "", {}}, {-4, 2, 3, 70000})),
              ElementsAre(-4, 2, 3, 70000));
  EXPECT_THAT(values_of(tiff_file<float>({2, 2, 32, 3, "", {}}, {-4.5F, 2, 3, 1e4F})),
              ElementsAre(-4.5, 2, 3, 1e4));
  EXPECT_THAT(values_of(tiff_file<double>({2, 2, 64, 3, "", {}}, {-4.5, 2, 3, 1e4})),
              ElementsAre(-4.5, 2, 3, 1e4));
}

TEST(Decode, ReadsTiledTiffs) {
  std::vector<float> values;
  for (int i = 0; i < 37 * 21; ++i) values.push_back(static_cast<float>(i) / 2);
  const Result<Decoded> decoded = decode_picture(bytes_of(tiled_tiff_file(values, 37)), {}, job_of());
  ASSERT_TRUE(decoded) << decoded.error().issues.front().message;
  EXPECT_EQ(decoded->samples->width, 37U);
  EXPECT_TRUE(std::ranges::equal(decoded->samples->values, values));
}

TEST(Decode, PutsRowsOfAGeoTiffInOrder) {
  // Row 0 of the second file is the southern one: y grows with the row.
  const std::vector<double> north{30, 0, 0, 5e5, 0, -30, 0, 4e6, 0, 0, 0, 0, 0, 0, 0, 1};
  std::vector<double> south = north;
  south[5] = 30;
  const auto first = [](const std::vector<double>& transformation) {
    const Result<Decoded> decoded = decode_picture(
        bytes_of(tiff_file<float>({2, 2, 32, 3, "-9999", transformation}, {1, 2, 3, 4})), {}, job_of());
    EXPECT_TRUE(decoded && decoded->no_data == -9999);
    return decoded ? decoded->samples->values[0] : -1;
  };
  EXPECT_EQ(first(north), 1);
  EXPECT_EQ(first(south), 3);
}

TEST(Decode, RefusesWhatIsTooLargeBeforeItIsDecoded) {
  EXPECT_EQ(refusal_of(jpeg_file(ramp(32 * 24), 32, 1), 31),
            "the JPEG has 32 x 24 pixels; a side may have 31");
  EXPECT_EQ(refusal_of(webp_file(ramp(3 * 20 * 10), 20), 19),
            "the WebP has 20 x 10 pixels; a side may have 19");
  EXPECT_EQ(refusal_of(tiff_file<float>({2, 2, 32, 3, "", {}}, {1, 2, 3, 4}), 1),
            "the TIFF has 2 x 2 pixels; a side may have 1");
  EXPECT_THAT(refusal_of(tiff_file<float>({16000, 16000, 32, 3, "", {}}, {1, 2, 3, 4})),
              HasSubstr("truncated"));
}

TEST(Decode, SurvivesChangedFiles) {
  const FileBytes files[] = {
      jpeg_file(ramp(3 * 32 * 24), 32, 3), jpeg_file(ramp(32 * 24), 32, 1, true),
      webp_file(ramp(3 * 20 * 10), 20),
      tiff_file<float>({8, 8, 32, 3, "-1", {30, 0, 0, 0, 0, 30, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
                       std::vector<float>(64, 1)),
      tiled_tiff_file(std::vector<float>(std::size_t{20} * 20, 2), 20)};
  std::size_t refused = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    Rng rng = Rng::of_seed(seed).at("changed pictures");
    FileBytes file = files[seed % std::size(files)];
    for (std::uint32_t i = 0; i < 1 + seed % 4; ++i)
      file[rng.below(static_cast<std::uint32_t>(file.size()))] = static_cast<std::uint8_t>(rng.below(256));
    const Result<Decoded> decoded = decode_picture(bytes_of(file), {.longest_side = 600}, job_of());
    if (!decoded) {
      ++refused;
      ASSERT_FALSE(decoded.error().issues.front().message.empty());
      continue;
    }
    if (decoded->samples) {
      ASSERT_EQ(decoded->samples->values.size(),
                std::size_t{decoded->samples->width} * decoded->samples->height);
    }
  }
  EXPECT_GT(refused, 500U);
  EXPECT_LT(refused, 9'500U);
}

TEST(Decode, RefusesWhatIsCutAnywhere) {
  const FileBytes files[] = {jpeg_file(ramp(32 * 24), 32, 1), webp_file(ramp(3 * 20 * 10), 20),
                             tiff_file<float>({8, 8, 32, 3, "-1", {}}, std::vector<float>(64, 1))};
  for (const FileBytes& file : files) {
    for (std::size_t size = 0; size < file.size(); size += 3) {
      const FileBytes part(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
      // A JPEG without its end marker alone may have all of its pixels.
      if (size + 8 < file.size()) {
        EXPECT_NE(refusal_of(part), "accepted") << size << " of " << file.size();
      }
    }
  }
  EXPECT_THAT(refusal_of({'B', 'M', 1, 2}), HasSubstr("without the signature of a PNG, JPEG, WebP or TIFF"));
}

}  // namespace
}  // namespace seedmesh::texture
