#include "core/generators/terrain/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/generators/terrain/image.h"
#include "core/generators/terrain/plan.h"
#include "core/geom/mesh/finish.h"
#include "core/texture/png.h"
#include "generated/params/terrain.h"
#include "tests/core/terrain/support.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::terrain {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const TerrainAlgorithm all[] = {TerrainAlgorithm::fault_formation, TerrainAlgorithm::poisson_faulting,
                                TerrainAlgorithm::triangular_edge, TerrainAlgorithm::diamond_square,
                                TerrainAlgorithm::square_square,   TerrainAlgorithm::fbm};

Model model_of(const TerrainParams& params, int threads = 1) {
  Job job = any_job(threads);
  Result<Model> model = generate(params, context_of(job));
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

TEST(Terrain, ReportsParametersWithoutEffect) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::fracture;
  params.shape = TerrainShape::sphere;
  params.resolution = 17;
  params.fracture.emplace();
  params.fracture->tilt = 30;
  const auto warned = [&] {
    std::string all_pointers;
    for (const Warning& each : model_of(params).warnings) all_pointers += each.pointer;
    return all_pointers;
  };
  EXPECT_EQ(warned(), "/fracture/tilt");
  params.fracture->strata = 0.05;
  EXPECT_EQ(warned(), "");
  params.heightmap.flip = true;
  EXPECT_EQ(warned(), "/heightmap");
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
      if (is_made) {
        (void)generate(params, context_of(job));
      } else {
        (void)appraise(params, context_of(job));
      }
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
    {"cut by rivers",
     [](TerrainParams& params) {
       params.hydraulic.emplace();
       params.hydraulic->method = TerrainMethod::stream_power;
       params.smooth = 20;
       params.tile->across = 8;
     }},
    {"eroded by drops",
     [](TerrainParams& params) {
       params.hydraulic.emplace();
       params.hydraulic->droplets = 2'000;
       params.tile->across = 8;
     }},
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

TEST(Tiles, OfRiversHaveTheHeightsOfTheWholeField) {
  constexpr int across = 4, step = 32;
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.amplitude = 40;
  params.wavelength = 120;
  params.hydraulic.emplace();
  params.hydraulic->method = TerrainMethod::stream_power;
  params.tile.emplace();
  const auto field = [&](int tiles, int x, int z) {
    params.tile->across = tiles;
    params.tile->x = x;
    params.tile->z = z;
    params.resolution = across / tiles * step + 1;
    params.size = 100.0 * across / tiles;
    return heights_of(params);
  };
  const Field whole = field(1, 0, 0);
  ASSERT_EQ(whole.width, across * step + 1);
  for (int tz = 0; tz < across; ++tz) {
    for (int tx = 0; tx < across; ++tx) {
      const Field tile = field(across, tx, tz);
      ASSERT_EQ(tile.width, step + 1);
      ASSERT_EQ(tile.margin, 1);
      for (int z = 0; z <= step; ++z) {
        for (int x = 0; x <= step; ++x) ASSERT_EQ(tile.at(x, z), whole.at(tx * step + x, tz * step + z));
      }
    }
  }
  const Field corner = field(across, 0, 0);
  EXPECT_EQ(corner.at(-1, 3), 2 * corner.at(0, 3) - corner.at(1, 3))
      << "the slope continues beyond the world";
  params.hydraulic.reset();
  params.tile->across.reset();
  EXPECT_NE(heights_of(params).at(16, 16), corner.at(16, 16)) << "the rivers cut";
}

TEST(Tiles, OfAnIslandAreSeaOutsideIt) {
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

TEST(Checks, RefuseOptionsThatTheAlgorithmDoesNotHave) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::fault_formation;
  params.amplitude = 3;
  params.corners = {{0, 0, 0, 0}};
  params.edge = TerrainEdge::wrap;
  params.warp = 1;
  EXPECT_THAT(pointers(params), ElementsAre("/amplitude", "/corners", "/edge", "/warp"));
  EXPECT_THAT(check(params, Limits{}).front().message,
              HasSubstr("only these algorithms have it: triangular_edge, diamond_square"));
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

TEST(Checks, RefuseRtinUnlessTheSideIsAPowerOfTwoPlusOne) {
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
  EXPECT_THAT(pointers(params),
              ElementsAre("/tile/across", "/edge", "/corners", "/smooth", "/normalise", "/terraces"));
  params = small(TerrainAlgorithm::diamond_square);
  params.tile.emplace();
  params.island.emplace();
  EXPECT_THAT(pointers(params), ElementsAre("/island", "/tile"));
}

TEST(Checks, RefuseTilesOverWhichNoKnownWaterRuns) {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  params.tile.emplace();
  params.hydraulic.emplace();
  EXPECT_THAT(pointers(params), ElementsAre("/tile"));
  params.tile->across = 1'000;
  EXPECT_THAT(pointers(params), ElementsAre("/tile/across"));
  params.tile->across = 128;
  EXPECT_THAT(pointers(params), IsEmpty());
  params.tile->x = 128;
  EXPECT_THAT(pointers(params), ElementsAre("/tile/x"));
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

TEST(Checks, RefuseOptionsOfThePlaneOnASphere) {
  TerrainParams params = small(TerrainAlgorithm::fbm);
  params.shape = TerrainShape::sphere;
  params.base = 3;
  params.mesh = TerrainMesh::greedy;
  EXPECT_THAT(pointers(params), ElementsAre("/mesh", "/base"));
  params = small(TerrainAlgorithm::diamond_square);
  params.shape = TerrainShape::sphere;
  EXPECT_THAT(pointers(params), ElementsAre("/shape"));
}

TEST(Images, AreRefusedWithAReasonWhereTheyCannotBeRead) {
  const auto refusal = [](const std::string& data, TerrainEncoding encoding) {
    TerrainParams params;
    params.algorithm = TerrainAlgorithm::image;
    params.image.emplace();
    params.image->data = data;
    params.image->encoding = encoding;
    Job job = any_job();
    const Result<Model> model = generate(params, context_of(job));
    EXPECT_FALSE(model);
    return model ? "" : model.error().issues.front().pointer + ": " + model.error().issues.front().message;
  };
  EXPECT_THAT(refusal("AAAA!AAA", TerrainEncoding::r16), HasSubstr("/image/data: character 5 is not base64"));
  EXPECT_THAT(refusal("AAAAA", TerrainEncoding::r16), HasSubstr("one character of four"));
  EXPECT_THAT(refusal("AAAA", TerrainEncoding::r16), HasSubstr("3 bytes"));
  EXPECT_THAT(refusal("AAAAAAAAAAAAAAAA", TerrainEncoding::r16),
              HasSubstr("6 samples, which are not a square"));
  EXPECT_THAT(refusal("AAAAAAAAAAAA", TerrainEncoding::grey), HasSubstr("without the signature of a PNG"));
  EXPECT_THAT(refusal("data:image/png,AAAA", TerrainEncoding::grey), HasSubstr("base64"));
  std::vector<std::uint8_t> pixels(12, 7);
  pixels[4] = 8;
  const Array<std::uint8_t> rgb = texture::encode_png({2, 2, 3, 8, std::as_bytes(std::span(pixels))},
                                                      texture::PngEffort::streamed, any_job());
  EXPECT_THAT(refusal(base64(rgb.span()), TerrainEncoding::grey),
              HasSubstr("the pixel in column 1 of row 0 is not grey"));
  EXPECT_THAT(refusal(base64(rgb.span()), TerrainEncoding::rgba32), HasSubstr("rgba32 is 4 channels"));
}

TEST(Images, HaveAWidthOnlyWhereTheyAreRaw) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::image;
  params.image.emplace();
  params.image->width = 64;
  EXPECT_THAT(pointers(params), ElementsAre("/image/width"));
  params.image->encoding = TerrainEncoding::r16;
  EXPECT_THAT(pointers(params), IsEmpty());
}

TEST(Derive, ListsHeightsOfSmallFieldsAndStatisticsOfAll) {
  TerrainParams params = small(TerrainAlgorithm::diamond_square);
  Job job = any_job();
  Result<Json> derived = derive(params, context_of(job));
  ASSERT_TRUE(derived);
  EXPECT_EQ((*derived)["width"], 33);
  EXPECT_EQ((*derived)["heights"].size(), 33U * 33);
  params.iterations = 9;
  derived = derive(params, context_of(job));
  ASSERT_TRUE(derived);
  EXPECT_TRUE((*derived)["heights"].is_null());
  EXPECT_LT((*derived)["min"].get<double>(), (*derived)["max"].get<double>());
}

TEST(Appraisal, CountsTheTrianglesOfAGrid) {
  for (const TerrainAlgorithm algorithm : all) {
    TerrainParams params = small(algorithm);
    params.base = 4;
    Job job = any_job();
    const Result<Appraisal> appraisal = appraise(params, context_of(job));
    ASSERT_TRUE(appraisal && appraisal->estimate);
    EXPECT_EQ(appraisal->estimate->triangles, count(model_of(params)).triangles) << text_of(algorithm);
  }
}

}  // namespace
}  // namespace seedmesh::terrain
