/// Heights from pictures and measured elevation data: every encoding, voids, and which way is north.
#include "core/generators/terrain/image.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/generators/terrain/terrain.h"
#include "core/generators/terrain/voids.h"
#include "core/texture/png.h"
#include "tests/core/terrain/support.h"
#include "tests/core/texture/picture_files.h"
#include "tests/support/context.h"

namespace seedmesh::terrain {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TerrainImage image_of(std::span<const std::uint8_t> file, TerrainEncoding encoding) {
  TerrainImage image;
  image.data = base64(file);
  image.encoding = encoding;
  return image;
}

std::vector<double> heights(const TerrainImage& image) {
  const Job job = any_job();
  const Result<Field> field = field_of_image(image, job);
  EXPECT_TRUE(field) << (field ? "" : field.error().issues.front().message);
  return field ? values(*field) : std::vector<double>();
}

std::string refusal(const TerrainImage& image) {
  const Job job = any_job();
  const Result<Field> field = field_of_image(image, job);
  return field ? "accepted"
               : field.error().issues.front().pointer + ": " + field.error().issues.front().message;
}

FileBytes png_file(const FileBytes& bytes, std::uint32_t width, int channels) {
  const auto height = static_cast<std::uint32_t>(bytes.size()) / width / static_cast<std::uint32_t>(channels);
  const Job job = any_job();
  const Array<std::uint8_t> file =
      texture::encode_png({width, height, channels, 8, bytes_of(bytes)}, texture::PngEffort::small, job);
  return {file.begin(), file.end()};
}

/// Samples of 16 bits, high byte first.
FileBytes big_endian(const std::vector<int>& samples) {
  FileBytes file;
  for (const int sample : samples) {
    file.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(sample) >> 8U & 255U));
    file.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(sample) & 255U));
  }
  return file;
}

TEST(TerrainImage, ReadsTerrainRgbAndTerrarium) {
  // Mapbox: -10000 + 0.1 * (65536 R + 256 G + B); (1, 134, 160) is sea level and (1, 226, 62) 2,345.4 m.
  const FileBytes mapbox{1, 134, 160, 1, 226, 62, 0, 0, 0, 255, 255, 255};
  for (const FileBytes& file : {png_file(mapbox, 2, 3), webp_file(mapbox, 2)}) {
    const std::vector<double> made = heights(image_of(file, TerrainEncoding::terrain_rgb));
    ASSERT_EQ(made.size(), 4U);
    EXPECT_NEAR(made[0], 0, 1e-3);
    EXPECT_NEAR(made[1], 2345.4, 1e-3);
    EXPECT_NEAR(made[2], -10000, 1e-3);
    EXPECT_NEAR(made[3], 1667721.5, 0.2);
  }
  // Mapzen: 256 R + G + B / 256 - 32768.
  const FileBytes mapzen{128, 0, 0, 137, 41, 102, 127, 255, 128, 0, 0, 0};
  EXPECT_THAT(heights(image_of(png_file(mapzen, 2, 3), TerrainEncoding::terrarium)),
              ElementsAre(0, 2345.3984375, -0.5, -32768));
}

TEST(TerrainImage, ReadsGreyThatIsSavedInColour) {
  TerrainImage image =
      image_of(png_file({0, 0, 0, 51, 51, 51, 102, 102, 102, 255, 255, 255}, 2, 3), TerrainEncoding::grey);
  EXPECT_THAT(heights(image), ElementsAre(0, 20, 40, 100));
  image = image_of(png_file({0, 0, 0, 255, 51, 51, 51, 255, 102, 102, 102, 255, 255, 255, 255, 255}, 2, 4),
                   TerrainEncoding::grey);
  EXPECT_THAT(heights(image), ElementsAre(0, 20, 40, 100));
  image =
      image_of(png_file({0, 0, 0, 51, 51, 51, 102, 103, 102, 255, 255, 255}, 2, 3), TerrainEncoding::grey);
  EXPECT_THAT(refusal(image), HasSubstr("/image/data: the pixel in column 0 of row 1 is not grey"));
}

TEST(TerrainImage, ReadsHeightsUpToTwoMillionMetres) {
  TerrainImage image = image_of(png_file({0, 255, 0, 255}, 2, 1), TerrainEncoding::grey);
  image.low = -2e6;
  image.high = 2e6;
  EXPECT_THAT(heights(image), ElementsAre(-2e6, 2e6, -2e6, 2e6));
}

TEST(TerrainImage, ReadsSignedSamplesAndHgt) {
  const std::vector<int> samples{-12, 300, 8848, -430};
  EXPECT_THAT(heights(image_of(big_endian(samples), TerrainEncoding::hgt)),
              ElementsAre(-12, 300, 8848, -430));
  EXPECT_THAT(heights(image_of(big_endian(samples), TerrainEncoding::s16_big)),
              ElementsAre(-12, 300, 8848, -430));
  FileBytes little = big_endian(samples);
  for (std::size_t i = 0; i < little.size(); i += 2) std::swap(little[i], little[i + 1]);
  EXPECT_THAT(heights(image_of(little, TerrainEncoding::s16)), ElementsAre(-12, 300, 8848, -430));
  EXPECT_THAT(refusal(image_of(big_endian({1, 2, 3, 4, 5, 6}), TerrainEncoding::hgt)),
              HasSubstr("6 samples, which are not a square; an .hgt file is square"));
}

TEST(TerrainImage, ReadsGeoTiffsInMetres) {
  EXPECT_THAT(heights(image_of(tiff_file<float>({2, 2, 32, 3, "", {}}, {-4.5F, 2, 3, 1e4F}),
                               TerrainEncoding::metres)),
              ElementsAre(-4.5, 2, 3, 1e4));
  EXPECT_THAT(heights(image_of(tiff_file<std::int16_t>({2, 2, 16, 2, "", {}}, {-4, 2, 3, 9000}),
                               TerrainEncoding::metres)),
              ElementsAre(-4, 2, 3, 9000));
  EXPECT_THAT(heights(image_of(tiff_file<std::uint16_t>({2, 2, 16, 1, "", {}}, {0, 2, 3, 9000}),
                               TerrainEncoding::metres)),
              ElementsAre(0, 2, 3, 9000));
  EXPECT_THAT(heights(image_of(tiff_file<std::uint16_t>({2, 2, 16, 1, "", {}}, {0, 13107, 26214, 65535}),
                               TerrainEncoding::grey)),
              ElementsAre(0, 20, 40, 100));
  EXPECT_THAT(refusal(image_of(tiff_file<float>({2, 2, 32, 3, "", {}}, {1, 2, 3, 4}), TerrainEncoding::grey)),
              "/image/encoding: found a TIFF of signed, 32-bit or floating-point samples; expected metres");
}

TEST(TerrainImage, ReadsJpegs) {
  const FileBytes flat(16 * 16, 51);
  EXPECT_THAT(heights(image_of(jpeg_file(flat, 16, 1), TerrainEncoding::grey)),
              Each(::testing::DoubleNear(20, 0.4)));
}

TEST(TerrainImage, ReadsGreyOfPicturesWithLossesButNoDigits) {
  FileBytes grey;
  for (int i = 0; i < 32 * 32; ++i)
    grey.insert(grey.end(), 3, static_cast<std::uint8_t>(4 * (i % 32) + i / 32));
  for (const FileBytes& file : {lossy_webp_file(grey, 32), jpeg_file(grey, 32, 3)}) {
    const std::vector<double> made = heights(image_of(file, TerrainEncoding::grey));
    ASSERT_EQ(made.size(), 1024U);
    for (std::size_t i = 0; i < made.size(); ++i) EXPECT_NEAR(made[i], grey[3 * i] / 2.55, 4);
    EXPECT_THAT(refusal(image_of(file, TerrainEncoding::terrain_rgb)),
                HasSubstr("changes the digits of heights"));
  }
}

TEST(TerrainImage, FillsAndCountsVoids) {
  // A plane with holes: what fills them lies on the plane within a step of the grid.
  constexpr int side = 33;
  std::vector<int> samples;
  std::size_t voids = 0;
  for (int z = 0; z < side; ++z) {
    for (int x = 0; x < side; ++x) {
      const bool is_void = (x > 10 && x < 15 && z > 4 && z < 9) || (x == 30 && z == 30);
      voids += is_void ? 1 : 0;
      samples.push_back(is_void ? -32768 : 100 + 10 * x);
    }
  }
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::image;
  params.image = image_of(big_endian(samples), TerrainEncoding::hgt);
  Job job = any_job();
  const Result<Field> field = field_of(params, job);
  ASSERT_TRUE(field);
  EXPECT_EQ(field->voids, voids);
  for (int z = 0; z < side; ++z) {
    for (int x = 0; x < side; ++x) EXPECT_NEAR(field->at(x, z), 100 + 10 * x, 21) << x << " " << z;
  }
  const Result<Model> model = generate(params, context_of(job));
  ASSERT_TRUE(model);
  EXPECT_THAT(model->warnings,
              Contains(::testing::Field(&Warning::message, HasSubstr("filled 17 of 1089 samples"))));
  const Result<Json> derived = derive(params, context_of(job));
  ASSERT_TRUE(derived);
  EXPECT_EQ((*derived)["voids"], 17);
  EXPECT_THAT(refusal(image_of(big_endian({-32768, -32768, -32768, -32768}), TerrainEncoding::hgt)),
              "/image/data: no sample has a height");
}

TEST(TerrainImage, TakesTheNoDataValueOfAGeoTiffAsAVoid) {
  const TerrainImage image =
      image_of(tiff_file<float>({2, 2, 32, 3, "-9999", {}}, {5, 5, -9999, 5}), TerrainEncoding::metres);
  EXPECT_THAT(heights(image), ElementsAre(5, 5, 5, 5));
  const TerrainImage nan =
      image_of(tiff_file<float>({2, 2, 32, 3, "", {}}, {5, 5, std::nanf(""), 5}), TerrainEncoding::metres);
  EXPECT_THAT(heights(nan), ElementsAre(5, 5, 5, 5));
}

TEST(TerrainImage, HasItsFirstRowInTheNorth) {
  // The north-western sample alone is high: x < 0 (west) and z < 0 (north).
  const std::vector<double> north_up{30, 0, 0, 0, 0, -30, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  std::vector<double> south_up = north_up;
  south_up[5] = 30;
  const TerrainImage images[] = {
      image_of(png_file({255, 0, 0, 0, 0, 0, 0, 0, 0}, 3, 1), TerrainEncoding::grey),
      image_of(big_endian({99, 0, 0, 0, 0, 0, 0, 0, 0}), TerrainEncoding::hgt),
      image_of(tiff_file<float>({3, 3, 32, 3, "", north_up}, {99, 0, 0, 0, 0, 0, 0, 0, 0}),
               TerrainEncoding::metres),
      image_of(tiff_file<float>({3, 3, 32, 3, "", south_up}, {0, 0, 0, 0, 0, 0, 99, 0, 0}),
               TerrainEncoding::metres)};
  for (const TerrainImage& image : images) {
    TerrainParams params;
    params.algorithm = TerrainAlgorithm::image;
    params.size = 20;
    params.image = image;
    Job job = any_job();
    const Result<Model> model = generate(params, context_of(job));
    ASSERT_TRUE(model);
    int high = 0;
    for (const glm::vec3& p : model->meshes.at(0).primitives.at(0).mesh.position) {
      if (p.y < 50) continue;
      ++high;
      EXPECT_FLOAT_EQ(p.x, -10);
      EXPECT_FLOAT_EQ(p.z, -10);
    }
    EXPECT_EQ(high, 1);
  }
}

std::vector<std::string> notes(const TerrainImage& image) {
  const Job job = any_job();
  const Result<Field> field = field_of_image(image, job);
  EXPECT_TRUE(field) << (field ? "" : field.error().issues.front().message);
  std::vector<std::string> out;
  if (!field) return out;
  for (const Warning& each : field->notes) out.push_back(each.pointer + ": " + each.message);
  return out;
}

TEST(TerrainImage, WarnsOfTransparencyThatHasNoEffect) {
  const FileBytes masked{0, 0, 51, 255, 102, 128, 255, 255};
  EXPECT_THAT(notes(image_of(png_file(masked, 2, 2), TerrainEncoding::grey)),
              ElementsAre(HasSubstr("/image/data: the transparency of 2 of 4 pixels has no effect")));
  const FileBytes opaque{0, 255, 51, 255, 102, 255, 255, 255};
  EXPECT_THAT(notes(image_of(png_file(opaque, 2, 2), TerrainEncoding::grey)), testing::IsEmpty());
  const FileBytes digits{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  EXPECT_THAT(notes(image_of(png_file(digits, 2, 4), TerrainEncoding::rgba32)), testing::IsEmpty());
}

/// The Challenger Deep is at about -10,900 m, and Mount Everest at 8,849 m.
TEST(TerrainImage, WarnsOfHeightsThatTheEarthDoesNotHave) {
  const FileBytes earth{1, 134, 160, 1, 226, 62, 1, 134, 160, 1, 226, 62};
  EXPECT_THAT(notes(image_of(png_file(earth, 2, 3), TerrainEncoding::terrain_rgb)), testing::IsEmpty());
  const FileBytes colours{10, 20, 30, 200, 190, 180, 90, 80, 70, 0, 0, 0};
  EXPECT_THAT(notes(image_of(png_file(colours, 2, 3), TerrainEncoding::terrain_rgb)),
              ElementsAre(HasSubstr("/image/encoding: found heights from -10000 to 1305602 metres")));
}

TEST(TerrainImage, RefusesPicturesAsRawSamples) {
  const FileBytes file = png_file({0, 51, 102, 255}, 2, 1);
  for (const TerrainEncoding raw : {TerrainEncoding::r16, TerrainEncoding::s16_big, TerrainEncoding::hgt})
    EXPECT_EQ(refusal(image_of(file, raw)),
              "/image/encoding: found a PNG file, expected raw samples for this encoding");
}

/// `validate` reads the image, so that it reports what `generate` would.
TEST(TerrainImage, IsReadByTheCheckOfARequest) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::image;
  params.image = image_of(png_file({0, 51, 102, 255, 9, 8, 7, 6, 5}, 3, 1), TerrainEncoding::grey);
  Job job(0, Job::Options{});
  EXPECT_TRUE(appraise(params, context_of(job)));
  params.image->data.resize(40);
  const Result<Appraisal> damaged = appraise(params, context_of(job));
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().issues.front().pointer, "/image/data");
  params.image = image_of(big_endian({5, 7, -32768, 9}), TerrainEncoding::hgt);
  const Result<Appraisal> with_void = appraise(params, context_of(job));
  ASSERT_TRUE(with_void);
  EXPECT_THAT(with_void->warnings.at(0).message, HasSubstr("filled 1 of 4 samples"));
}

TEST(TerrainImage, RefusesOptionsWithoutEffect) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::image;
  params.image = image_of(big_endian({1, 2, 3, 4}), TerrainEncoding::hgt);
  params.image->high = 500;
  params.image->width = 2;
  std::vector<std::string> pointers;
  for (const Issue& issue : check(params, Limits{})) pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, ElementsAre("/image/width", "/image/high"));
}

}  // namespace
}  // namespace seedmesh::terrain
