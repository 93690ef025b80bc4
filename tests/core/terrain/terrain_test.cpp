#include "core/generators/terrain/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/generators/terrain/engines.h"
#include "core/generators/terrain/image.h"
#include "core/generators/terrain/plan.h"
#include "core/geom/finish.h"
#include "core/texture/png.h"
#include "generated/params/terrain.h"
#include "tests/core/terrain/support.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::terrain {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TerrainParams small(TerrainAlgorithm algorithm) {
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

const TerrainAlgorithm all[] = {TerrainAlgorithm::fault_formation, TerrainAlgorithm::poisson_faulting,
                                TerrainAlgorithm::triangular_edge, TerrainAlgorithm::diamond_square,
                                TerrainAlgorithm::square_square,   TerrainAlgorithm::fbm};

Model model_of(const TerrainParams& params, int threads = 1) {
  Job job = any_job(threads);
  Result<Model> model = generate(params, job);
  EXPECT_TRUE(model) << (model ? ""
                               : model.error().issues.front().pointer + model.error().issues.front().message);
  if (!model) return {};
  finish(*model, job);
  return std::move(*model);
}

std::vector<std::string> pointers(const TerrainParams& params) {
  std::vector<std::string> all_of_them;
  for (const Issue& issue : check(params, Limits{})) all_of_them.push_back(issue.pointer);
  return all_of_them;
}

std::string base64(std::span<const std::uint8_t> bytes) {
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

Field heights_of(const TerrainParams& params) {
  Job job = any_job();
  Result<Field> field = field_of(params, job);
  EXPECT_TRUE(field) << (field ? "" : field.error().issues.front().message);
  return field ? std::move(*field) : Field();
}

TEST(Terrain, IsSoundByEveryAlgorithm) {
  for (const TerrainAlgorithm algorithm : all) {
    for (const TerrainMesh mesh : {TerrainMesh::grid, TerrainMesh::greedy}) {
      TerrainParams params = small(algorithm);
      params.mesh = mesh;
      params.water_level = 0.001;
      Model model = model_of(params);
      EXPECT_THAT(faults(model), IsEmpty()) << text_of(algorithm);
    }
  }
}

TEST(Terrain, IsTheSameWithAnyNumberOfThreads) {
  for (const TerrainAlgorithm algorithm : all) {
    TerrainParams params = small(algorithm);
    params.thermal.emplace();
    params.hydraulic.emplace();
    params.hydraulic->droplets = 3000;
    const Model one = model_of(params, 1), eight = model_of(params, 8);
    ASSERT_FALSE(one.meshes.empty());
    const Mesh& a = one.meshes[0].primitives[0].mesh;
    const Mesh& b = eight.meshes[0].primitives[0].mesh;
    EXPECT_TRUE(std::ranges::equal(a.position, b.position)) << text_of(algorithm);
    EXPECT_TRUE(std::ranges::equal(a.color, b.color)) << text_of(algorithm);
  }
}

TEST(Terrain, RefusesAGridOfTooManyTrianglesBeforeTheFieldIsMade) {
  TerrainParams params;
  params.iterations = 14;
  Job job(0, Job::Options{});
  for (const bool is_made : {true, false}) {
    try {
      if (is_made)
        (void)generate(params, job);
      else
        (void)appraise(params, job);
      ADD_FAILURE() << "it was taken";
    } catch (const Stop& stop) {
      EXPECT_EQ(stop.issue().pointer, "/iterations");
      EXPECT_THAT(stop.issue().message, HasSubstr("536870912 triangles"));
    }
  }
}

TEST(Terrain, IsCutIntoPiecesOfNarrowIndicesWhereItIsLarge) {
  TerrainParams params;
  params.iterations = 9;
  const Model model = model_of(params);
  EXPECT_THAT(faults(model), IsEmpty());
  EXPECT_EQ(model.meshes.size(), 9U);
  for (const MeshGroup& group : model.meshes) EXPECT_TRUE(group.primitives[0].mesh.index.wide.empty());
  EXPECT_EQ(count(model).triangles, 2U * 512 * 512);
}

TEST(Terrain, IsAClosedSolidOnABase) {
  for (const TerrainMesh mesh : {TerrainMesh::grid, TerrainMesh::rtin, TerrainMesh::greedy}) {
    TerrainParams params = small(TerrainAlgorithm::diamond_square);
    params.mesh = mesh;
    params.base = 10;
    const Model model = model_of(params);
    EXPECT_THAT(faults(model), IsEmpty());
    ASSERT_EQ(model.meshes.size(), 1U);
    std::vector<const Mesh*> parts;
    for (const Primitive& primitive : model.meshes[0].primitives) parts.push_back(&primitive.mesh);
    EXPECT_EQ(measure(parts).open_edges, 0U);
    EXPECT_GT(measure(parts).volume, 0);
  }
}

TEST(Terrain, MakesPlanetoidsThatAreClosed) {
  for (const TerrainAlgorithm algorithm : {TerrainAlgorithm::poisson_faulting, TerrainAlgorithm::fbm}) {
    TerrainParams params = small(algorithm);
    params.shape = TerrainShape::sphere;
    const Model model = model_of(params);
    EXPECT_THAT(faults(model), IsEmpty());
    const MeshMeasures measures = measure({&model.meshes[0].primitives[0].mesh});
    EXPECT_EQ(measures.open_edges, 0U);
    EXPECT_NEAR(measures.volume, 4.0 / 3 * 3.14159 * 50 * 50 * 50, 0.35 * measures.volume);
  }
}

/// What a tile can bear beside nothing.
using Treatment = void (*)(TerrainParams& params);
const std::pair<const char*, Treatment> treatments[] = {
    {"bare", [](TerrainParams&) {}},
    {"worn",
     [](TerrainParams& params) {
       params.thermal.emplace();
       params.thermal->iterations = 9;
       params.thermal->talus = 5;
     }},
    {"smoothed", [](TerrainParams& params) { params.smooth = 70; }},
    {"all",
     [](TerrainParams& params) {
       params.smooth = 30;
       params.normalise.emplace();
       params.normalise->from = {{-10, 10}};
       params.normalise->low = 0;
       params.normalise->high = 40;
       params.island.emplace();
       params.island->floor = -5;
       params.tile->across = 8;
       params.terraces.emplace();
       params.terraces->from = {{0, 40}};
       params.thermal.emplace();
       params.thermal->iterations = 3;
     }},
};

TEST(Tiles, ShareHeightsAndNormalsAlongEveryBorder) {
  for (const TerrainAlgorithm algorithm : all) {
    for (const auto& treatment : treatments) {
      const char* name = treatment.first;
      const Treatment treat = treatment.second;
      const auto tile = [&](int x, int z) {
        TerrainParams params = small(algorithm);
        params.tile.emplace();
        params.tile->x = x;
        params.tile->z = z;
        if (algorithm == TerrainAlgorithm::fault_formation || algorithm == TerrainAlgorithm::poisson_faulting)
          params.tile->across = 8;
        treat(params);
        EXPECT_THAT(pointers(params), IsEmpty()) << name;
        return model_of(params);
      };
      const Model here = tile(3, 5), east = tile(4, 5), south = tile(3, 6);
      const Mesh& a = here.meshes[0].primitives[0].mesh;
      const Mesh& b = east.meshes[0].primitives[0].mesh;
      const Mesh& c = south.meshes[0].primitives[0].mesh;
      ASSERT_EQ(a.position.size(), 33U * 33);
      for (std::size_t i = 0; i < 33; ++i) {
        ASSERT_EQ(a.position[i * 33 + 32].y, b.position[i * 33].y) << text_of(algorithm) << name;
        ASSERT_EQ(a.normal[i * 33 + 32], b.normal[i * 33]) << text_of(algorithm) << name;
        ASSERT_EQ(a.position[32 * 33 + i].y, c.position[i].y) << text_of(algorithm) << name;
        ASSERT_EQ(a.normal[32 * 33 + i], c.normal[i]) << text_of(algorithm) << name;
      }
    }
  }
}

TEST(Tiles, OfAnIslandAreSeaBeyondIt) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.tile.emplace();
  params.tile->across = 4;
  params.island.emplace();
  params.island->floor = -7;
  params.tile->x = 4;
  for (const float height : heights_of(params).heights) ASSERT_EQ(height, -7);
  params.tile->x = params.tile->z = 2;
  const Field middle = heights_of(params);
  EXPECT_GT(range_of(middle, any_job()).high, -7);
}

TEST(HeightMap, WrittenAndReadAgainGivesTheSameField) {
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
    const Result<Array<std::uint8_t>> file = encode(params, {each.format}, job);
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
    const Result<Array<std::uint8_t>> twice = encode(reading, {each.format}, job);
    ASSERT_TRUE(twice);
    EXPECT_TRUE(std::ranges::equal(*file, *twice)) << each.format;
  }
}

TEST(HeightMap, OfAnEngineReadAsTheEngineReadsItGivesTheSameField) {
  for (const auto& [profile, format] :
       {std::pair{"unreal", "r16"}, {"unreal", "png16"}, {"unity", "r16"}, {"core", "r16"}}) {
    TerrainParams params = small(TerrainAlgorithm::fbm);
    params.resolution = std::string_view(profile) == "unreal" ? 64 : 65;
    if (std::string_view(profile) == "unreal") params.resample = 61;  // 15 quads, 2 sections, 2 components
    const Field field = heights_of(params);
    Job job = any_job();
    const Result<Array<std::uint8_t>> file = encode(params, {format, profile}, job);
    ASSERT_TRUE(file) << profile;
    const Result<Json> told = derive(params, job);
    ASSERT_TRUE(told);
    const Json& unreal = (*told)["engines"]["unreal"];
    const Json& unity = (*told)["engines"]["unity"];
    EXPECT_TRUE((*told)["engines"][std::string_view(profile) == "unreal" ? "unreal" : "unity"]["fits"]);
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

TEST(HeightMap, IsRefusedInSizesAndFormsThatAnEngineDoesNotTake) {
  const auto refusals = [](const TerrainParams& params, const char* format, const char* profile) {
    std::vector<std::string> texts;
    for (const Issue& issue : check_form(params, {format, profile}))
      texts.push_back(issue.pointer + ": " + issue.message);
    return texts;
  };
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.resolution = 1025;
  EXPECT_THAT(refusals(params, "r16", "unity"), IsEmpty());
  EXPECT_THAT(refusals(params, "r16", "unreal"),
              ElementsAre(::testing::AllOf(HasSubstr("/output/profile: found 1025 samples; Unreal takes"),
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

TEST(Engines, TakeTheSidesThatTheirManualsName) {
  for (const int side : {127, 253, 505, 1009, 2017, 4033, 8129})
    EXPECT_TRUE(takes_side(Engine::unreal, side));
  for (const int side : {33, 65, 129, 257, 513, 1025, 2049, 4097}) {
    EXPECT_TRUE(takes_side(Engine::unity, side));
    EXPECT_FALSE(takes_side(Engine::unreal, side) && side > 1025);
  }
  EXPECT_THAT(nearest_sides(Engine::unity, 20), ElementsAre(33));
  EXPECT_THAT(nearest_sides(Engine::unity, 9000), ElementsAre(4097));
  EXPECT_THAT(nearest_sides(Engine::unreal, 1009), ElementsAre(1009));
}

TEST(Engines, AreToldUnrealsScaleOf600Metres) {
  const Json settings = engine_settings({1009, 1009, 2, 0, 600});
  EXPECT_NEAR(settings["unreal"]["scale"][2].get<double>(), 117.19, 0.01);
  EXPECT_EQ(settings["unreal"]["scale"][0], 200);
  EXPECT_EQ(settings["unity"]["size"][0], 2016);
}

TEST(HeightMap, TurnsItsRowsOverWhereItIsTold) {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  Job job = any_job();
  const Result<Array<std::uint8_t>> upright = encode(params, {"r16"}, job);
  params.heightmap.flip = true;
  const Result<Array<std::uint8_t>> turned = encode(params, {"r16"}, job);
  ASSERT_TRUE(upright && turned);
  for (std::size_t z = 0; z < 33; ++z) {
    for (std::size_t i = 0; i < 66; ++i) ASSERT_EQ((*upright)[z * 66 + i], (*turned)[(32 - z) * 66 + i]);
  }
}

TEST(HeightMap, HoldsMasksAndPicturesToo) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.water_level = 0.5;
  for (const TerrainMap map :
       {TerrainMap::slope, TerrainMap::curvature, TerrainMap::flow, TerrainMap::water, TerrainMap::normal,
        TerrainMap::color, TerrainMap::splat, TerrainMap::rock, TerrainMap::snow}) {
    params.heightmap.map = map;
    Job job = any_job();
    const Result<Array<std::uint8_t>> file = encode(params, {"png8"}, job);
    ASSERT_TRUE(file) << text_of(map);
    const Result<texture::Picture> picture = texture::decode_png(std::as_bytes(file->span()), {}, job);
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->channels, map == TerrainMap::splat ? 4 : map < TerrainMap::normal ? 1 : 3);
    if (map != TerrainMap::splat) continue;
    for (std::size_t i = 0; i < picture->bytes.size(); i += 4)
      ASSERT_EQ(picture->bytes[i] + picture->bytes[i + 1] + picture->bytes[i + 2] + picture->bytes[i + 3],
                255);
  }
}

TEST(HeightMap, OfATileAsksForARangeThatAllTilesShare) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.tile.emplace();
  Job job = any_job();
  const Result<Array<std::uint8_t>> file = encode(params, {"r16"}, job);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().issues.front().pointer, "/heightmap");
  params.heightmap.low = -50;
  params.heightmap.high = 50;
  EXPECT_TRUE(encode(params, {"r16"}, job));
}

TEST(Checks, RefuseWhatTheAlgorithmDoesNotHave) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::fault_formation;
  params.amplitude = 3;
  params.corners = {{0, 0, 0, 0}};
  params.edge = TerrainEdge::wrap;
  params.warp = 1;
  EXPECT_THAT(pointers(params), ElementsAre("/amplitude", "/corners", "/edge", "/warp"));
  EXPECT_THAT(check(params, Limits{}).front().message,
              HasSubstr("it belongs to triangular_edge, diamond_square"));
}

TEST(Checks, RefuseSizesBeyondTheLimits) {
  TerrainParams params;
  params.iterations = 14;
  params.extra_iterations = 1;
  EXPECT_THAT(pointers(params), ElementsAre("/iterations"));
  params = small(TerrainAlgorithm::fbm);
  params.iterations = 0;
  EXPECT_THAT(pointers(params), ElementsAre("/iterations"));
  params.iterations = 17;
  EXPECT_THAT(pointers(params), ElementsAre("/iterations"));
}

TEST(Checks, RefuseRtinOnAnySideButAPowerOfTwoAndOne) {
  TerrainParams params = small(TerrainAlgorithm::square_square);
  params.mesh = TerrainMesh::rtin;
  EXPECT_THAT(pointers(params), ElementsAre("/mesh"));
  params.resample = 33;
  EXPECT_THAT(pointers(params), IsEmpty());
}

TEST(Checks, RefuseFiltersThatWouldOpenTheBordersOfTiles) {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  params.tile.emplace();
  params.tile->across = 3;
  params.smooth = 94;
  params.corners = {{1, 2, 3, 4}};
  params.edge = TerrainEdge::avg3;
  params.normalise.emplace();
  params.terraces.emplace();
  params.hydraulic.emplace();
  EXPECT_THAT(pointers(params), ElementsAre("/tile/across", "/edge", "/corners", "/smooth", "/normalise",
                                            "/terraces", "/hydraulic"));
  params = small(TerrainAlgorithm::diamond_square);
  params.tile.emplace();
  params.island.emplace();
  EXPECT_THAT(pointers(params), ElementsAre("/island", "/tile"));
}

TEST(Checks, RefuseHeightsThatDoNotRise) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.normalise.emplace();
  params.normalise->from = {{3, 3}};
  params.terraces.emplace();
  params.terraces->from = {{5, 4}};
  params.island.emplace();
  params.island->floor = -2;
  params.island->depth = 2;
  EXPECT_THAT(pointers(params), ElementsAre("/normalise/from", "/terraces/from", "/island/depth"));
}

TEST(Checks, RefuseOnASphereWhatBelongsToThePlane) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.shape = TerrainShape::sphere;
  params.base = 3;
  params.mesh = TerrainMesh::greedy;
  EXPECT_THAT(pointers(params), ElementsAre("/mesh", "/base"));
  params = small(TerrainAlgorithm::diamond_square);
  params.shape = TerrainShape::sphere;
  EXPECT_THAT(pointers(params), ElementsAre("/shape"));
}

TEST(Images, AreRefusedInWordsWhereTheyCannotBeRead) {
  const auto refusal = [](const std::string& data, TerrainEncoding encoding) {
    TerrainParams params;
    params.algorithm = TerrainAlgorithm::image;
    params.image.emplace();
    params.image->data = data;
    params.image->encoding = encoding;
    Job job = any_job();
    const Result<Model> model = generate(params, job);
    EXPECT_FALSE(model);
    return model ? "" : model.error().issues.front().pointer + ": " + model.error().issues.front().message;
  };
  EXPECT_THAT(refusal("AAAA!AAA", TerrainEncoding::r16), HasSubstr("/image/data: character 5 is no base64"));
  EXPECT_THAT(refusal("AAAAA", TerrainEncoding::r16), HasSubstr("one character of four"));
  EXPECT_THAT(refusal("AAAA", TerrainEncoding::r16), HasSubstr("3 bytes"));
  EXPECT_THAT(refusal("AAAAAAAAAAAAAAAA", TerrainEncoding::r16),
              HasSubstr("6 samples, which are not a square"));
  EXPECT_THAT(refusal("AAAAAAAAAAAA", TerrainEncoding::grey), HasSubstr("do not begin as a PNG"));
  EXPECT_THAT(refusal("data:image/png,AAAA", TerrainEncoding::grey), HasSubstr("base64"));
  const std::vector<std::uint8_t> pixels(12, 7);
  const Array<std::uint8_t> rgb = texture::encode_png({2, 2, 3, 8, std::as_bytes(std::span(pixels))},
                                                      texture::PngEffort::fast, any_job());
  EXPECT_THAT(refusal(base64(rgb.span()), TerrainEncoding::grey),
              HasSubstr("found 3 channels of 8 bits; grey is one channel"));
  EXPECT_THAT(refusal(base64(rgb.span()), TerrainEncoding::rgba32), HasSubstr("rgba32 is 4 channels"));
}

TEST(Images, AreTakenWithOrWithoutPaddingAndAsDataUrls) {
  const Job job = any_job();
  for (const char* text : {"TWE=", "TWE", "data:image/png;base64,TWE="}) {
    const Result<Array<std::uint8_t>> bytes = bytes_of_base64(text, job);
    ASSERT_TRUE(bytes) << text;
    EXPECT_EQ(std::string(bytes->begin(), bytes->end()), "Ma");
  }
}

TEST(Derive, TellsHeightsOfSmallFieldsAndMeasuresOfAll) {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  Job job = any_job();
  Result<Json> told = derive(params, job);
  ASSERT_TRUE(told);
  EXPECT_EQ((*told)["width"], 33);
  EXPECT_EQ((*told)["heights"].size(), 33U * 33);
  params.iterations = 9;
  told = derive(params, job);
  ASSERT_TRUE(told);
  EXPECT_TRUE((*told)["heights"].is_null());
  EXPECT_LT((*told)["min"].get<double>(), (*told)["max"].get<double>());
}

TEST(Appraisal, CountsTheTrianglesOfAGrid) {
  for (const TerrainAlgorithm algorithm : all) {
    TerrainParams params = small(algorithm);
    params.base = 4;
    const Job job = any_job();
    const Result<Appraisal> appraisal = appraise(params, job);
    ASSERT_TRUE(appraisal && appraisal->estimate);
    EXPECT_EQ(appraisal->estimate->triangles, count(model_of(params)).triangles) << text_of(algorithm);
  }
}

}  // namespace
}  // namespace seedmesh::terrain
