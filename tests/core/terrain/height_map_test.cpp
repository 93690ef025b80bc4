/// Height maps as files, and what engines ask of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/generators/terrain/game_engines.h"
#include "core/generators/terrain/plan.h"
#include "core/generators/terrain/terrain.h"
#include "core/texture/png.h"
#include "generated/params/terrain.h"
#include "tests/core/terrain/support.h"
#include "tests/support/context.h"

namespace seedmesh::terrain {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(HeightMap, IsReadBackAsTheSameField) {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  const Field field = heights_of(params);
  const Range range = range_of(field, any_job());
  struct Case {
    const char* format;
    TerrainEncoding encoding;
    double steps;
  };
  for (const Case& each :
       {Case{"png16", TerrainEncoding::grey, 65535}, Case{"png8", TerrainEncoding::grey, 255},
        Case{"rgb24", TerrainEncoding::rgb24, 16777215},
        Case{"rgba32", TerrainEncoding::rgba32, 4294967295.0}, Case{"r16", TerrainEncoding::r16, 65535},
        Case{"r16", TerrainEncoding::r16_big, 65535}}) {
    Job job = any_job();
    params.heightmap.byte_order =
        each.encoding == TerrainEncoding::r16_big ? TerrainByteOrder::big : TerrainByteOrder::little;
    const Result<Array<std::uint8_t>> file = encode(params, {each.format}, context_of(job));
    ASSERT_TRUE(file);
    TerrainParams reading;
    reading.algorithm = TerrainAlgorithm::image;
    reading.size = params.size;
    reading.image.emplace();
    reading.image->data = base64(file->span());
    reading.image->encoding = each.encoding;
    reading.image->low = static_cast<double>(range.low);
    reading.image->high = static_cast<double>(range.high);
    const Field again = heights_of(reading);
    ASSERT_EQ(again.heights.size(), field.heights.size()) << each.format;
    const double half = static_cast<double>(range.high - range.low) / each.steps / 2 + 2e-6;
    for (std::size_t i = 0; i < field.heights.size(); ++i)
      ASSERT_NEAR(again.heights[i], field.heights[i], half) << each.format;
    // Written once more, it is the same file.
    reading.heightmap = params.heightmap;
    reading.heightmap.low = reading.image->low;
    reading.heightmap.high = reading.image->high;
    const Result<Array<std::uint8_t>> twice = encode(reading, {each.format}, context_of(job));
    ASSERT_TRUE(twice);
    EXPECT_TRUE(std::ranges::equal(*file, *twice)) << each.format;
  }
}

TEST(HeightMap, OfAnEngineIsTheSameFieldByTheRulesOfTheEngine) {
  for (const auto& [profile, format] :
       {std::pair{"unreal", "r16"}, {"unreal", "png16"}, {"unity", "r16"}, {"core", "r16"}}) {
    TerrainParams params = small(TerrainAlgorithm::fbm);
    params.resolution = std::string_view(profile) == "unreal" ? 64 : 65;
    if (std::string_view(profile) == "unreal") params.resample = 61;  // 15 quads, 2 sections, 2 components
    const Field field = heights_of(params);
    Job job = any_job();
    const Result<Array<std::uint8_t>> file = encode(params, {format, profile}, context_of(job));
    ASSERT_TRUE(file) << profile;
    const Result<Json> derived = derive(params, context_of(job));
    ASSERT_TRUE(derived);
    const Json& unreal = (*derived)["engines"]["unreal"];
    const Json& unity = (*derived)["engines"]["unity"];
    EXPECT_TRUE((*derived)["engines"][std::string_view(profile) == "unreal" ? "unreal" : "unity"]["fits"]);
    std::vector<std::uint16_t> values;
    if (std::string_view(format) == "png16") {
      const Result<texture::Picture> picture = texture::decode_png(std::as_bytes(file->span()), {}, job);
      ASSERT_TRUE(picture);
      for (std::size_t i = 0; i < field.heights.size(); ++i)
        values.push_back(static_cast<std::uint16_t>(picture->channel(i)));
    } else {
      for (std::size_t i = 0; i < file->size(); i += 2)
        values.push_back(static_cast<std::uint16_t>((*file)[i] | (*file)[i + 1] << 8U));
    }
    ASSERT_EQ(values.size(), field.heights.size());
    const double step = (range_of(field, job).high - range_of(field, job).low) / 65535.0;
    for (std::int32_t z = 0; z < field.depth; ++z) {
      for (std::int32_t x = 0; x < field.width; ++x) {
        const bool south_first = std::string_view(profile) == "unity";
        const std::int32_t row = south_first ? field.depth - 1 - z : z;
        const double value = values[static_cast<std::size_t>(row * field.width + x)];
        const double height =
            std::string_view(profile) == "unreal"
                ? unreal["location_z"].get<double>() / 100 +
                      (value - 32768) / 128 * unreal["scale"][2].get<double>() / 100
                : unity["position_y"].get<double>() + value / 65535 * unity["size"][1].get<double>();
        ASSERT_NEAR(height, static_cast<double>(field.at(x, z)), 0.51 * step + 1e-5) << profile << format;
      }
    }
  }
}

TEST(HeightMap, IsRefusedInSizesAndFormatsThatAnEngineDoesNotSupport) {
  const auto refusals = [](const TerrainParams& params, const char* format, const char* profile) {
    std::vector<std::string> texts;
    for (const Issue& issue : check_format(params, {format, profile}))
      texts.push_back(issue.pointer + ": " + issue.message);
    return texts;
  };
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.resolution = 1025;
  EXPECT_THAT(refusals(params, "r16", "unity"), IsEmpty());
  EXPECT_THAT(refusals(params, "r16", "unreal"),
              ElementsAre(::testing::AllOf(HasSubstr("/output/profile: found 1025 samples; Unreal needs"),
                                           HasSubstr("resample to 1021 or 1055"))));
  params.resample = 1009;
  EXPECT_THAT(refusals(params, "png16", "unreal"), IsEmpty());
  EXPECT_THAT(refusals(params, "r16", "unity"),
              ElementsAre(::testing::AllOf(HasSubstr("/resample: found 1009 samples"),
                                           HasSubstr("resample to 513 or 1025"))));
  EXPECT_THAT(refusals(params, "r16", "godot"), ElementsAre(HasSubstr("/output/profile: found godot")));
  params.resample = 1025;
  params.heightmap.flip = true;
  params.heightmap.byte_order = TerrainByteOrder::big;
  EXPECT_THAT(refusals(params, "png16", "unity"),
              ElementsAre(HasSubstr("/output/format: found png16"), HasSubstr("/heightmap/byte_order"),
                          HasSubstr("/heightmap/flip")));
  params = small(TerrainAlgorithm::fbm);
  params.heightmap.map = TerrainMap::normal;
  params.heightmap.flip = true;
  EXPECT_THAT(refusals(params, "png8", "core"), ElementsAre(HasSubstr("/heightmap/flip")));
}

TEST(Engines, SupportTheSizesOfTheirManuals) {
  for (const int side : {127, 253, 505, 1009, 2017, 4033, 8129})
    EXPECT_TRUE(supports_side(GameEngine::unreal, side));
  for (const int side : {33, 65, 129, 257, 513, 1025, 2049, 4097}) {
    EXPECT_TRUE(supports_side(GameEngine::unity, side));
    EXPECT_FALSE(supports_side(GameEngine::unreal, side) && side > 1025);
  }
  EXPECT_THAT(nearest_sides(GameEngine::unity, 20), ElementsAre(33));
  EXPECT_THAT(nearest_sides(GameEngine::unity, 9000), ElementsAre(4097));
  EXPECT_THAT(nearest_sides(GameEngine::unreal, 1009), ElementsAre(1009));
}

TEST(Engines, GetUnrealsScaleOf600Metres) {
  const Json settings = engine_settings({1009, 1009, 2, 0, 600});
  EXPECT_NEAR(settings["unreal"]["scale"][2].get<double>(), 117.19, 0.01);
  EXPECT_EQ(settings["unreal"]["scale"][0], 200);
  EXPECT_EQ(settings["unity"]["size"][0], 2016);
}

TEST(HeightMap, FlipsItsRowsOnRequest) {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  Job job = any_job();
  const Result<Array<std::uint8_t>> upright = encode(params, {"r16"}, context_of(job));
  params.heightmap.flip = true;
  const Result<Array<std::uint8_t>> turned = encode(params, {"r16"}, context_of(job));
  ASSERT_TRUE(upright && turned);
  for (std::size_t z = 0; z < 33; ++z) {
    for (std::size_t i = 0; i < 66; ++i) ASSERT_EQ((*upright)[z * 66 + i], (*turned)[(32 - z) * 66 + i]);
  }
}

TEST(HeightMap, IsAlsoWrittenOfMasksAndTextures) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.water_level = 0.5;
  for (const TerrainMap map :
       {TerrainMap::slope, TerrainMap::curvature, TerrainMap::flow, TerrainMap::water, TerrainMap::normal,
        TerrainMap::color, TerrainMap::splat, TerrainMap::rock, TerrainMap::snow}) {
    params.heightmap.map = map;
    Job job = any_job();
    const Result<Array<std::uint8_t>> file = encode(params, {"png8"}, context_of(job));
    ASSERT_TRUE(file) << text_of(map);
    const Result<texture::Picture> picture = texture::decode_png(std::as_bytes(file->span()), {}, job);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->channels, map == TerrainMap::splat ? 4 : map < TerrainMap::normal ? 1 : 3);
    if (map != TerrainMap::splat) continue;
    for (std::size_t i = 0; i < picture->bytes.size(); i += 4) {
      ASSERT_EQ(picture->bytes[i] + picture->bytes[i + 1] + picture->bytes[i + 2] + picture->bytes[i + 3],
                255);
    }
  }
}

TEST(HeightMap, OfATileNeedsARangeThatAllTilesShare) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.tile.emplace();
  Job job = any_job();
  const Result<Array<std::uint8_t>> file = encode(params, {"r16"}, context_of(job));
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().issues.front().pointer, "/heightmap");
  params.heightmap.low = -50;
  params.heightmap.high = 50;
  EXPECT_TRUE(encode(params, {"r16"}, context_of(job)));
}

}  // namespace
}  // namespace seedmesh::terrain
