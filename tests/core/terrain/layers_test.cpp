/// Heights by expressions, and layers.
#include "core/generators/terrain/layers.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "core/base/math.h"
#include "core/generators/terrain/terrain.h"
#include "tests/core/terrain/support.h"
#include "tests/support/context.h"

namespace seedmesh::terrain {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TerrainParams expressed(std::string text, int side = 5, double size = 4) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::expression;
  params.expression = std::move(text);
  params.resolution = side;
  params.size = size;
  return params;
}

TerrainLayer layer(std::string text, TerrainCombine combine = TerrainCombine::add) {
  TerrainLayer made;
  made.expression = std::move(text);
  made.combine = combine;
  return made;
}

Field made(const TerrainParams& params, int threads = 1, std::uint64_t seed = 1) {
  Job job = any_job(threads, seed);
  Result<Field> field = field_of(params, job);
  EXPECT_TRUE(field) << field.error().issues.front().message;
  return std::move(*field);
}

/// "pointer line:column message" of every error.
std::vector<std::string> errors_of(const TerrainParams& params) {
  std::vector<std::string> texts;
  for (const Issue& issue : check(params, Limits{})) {
    texts.push_back(issue.pointer + " " + std::to_string(issue.line) + ":" + std::to_string(issue.column) +
                    " " + issue.message);
  }
  return texts;
}

TEST(HeightExpressions, AreEvaluatedAtMetresFromTheCentre) {
  const Field field = made(expressed("100 * x + y + size / 8"));
  for (int z = 0; z < 5; ++z) {
    for (int x = 0; x < 5; ++x)
      EXPECT_EQ(field.at(x, z), 100.0F * static_cast<float>(x - 2) + static_cast<float>(2 - z) + 0.5F);
  }
}

TEST(HeightExpressions, HaveTheirErrorsAtTheColumn) {
  EXPECT_THAT(errors_of(expressed("x + hieght")), ElementsAre(HasSubstr("/expression 1:5 ")));
  EXPECT_THAT(errors_of(expressed("x +\n  (y")), ElementsAre(HasSubstr("/expression 2:5 ")));
  EXPECT_THAT(errors_of(expressed("1 + noise(x)")),
              ElementsAre(HasSubstr("/expression 1:5 `noise` takes 2 or 3 arguments, found 1")));
  EXPECT_THAT(errors_of(expressed("2 * fbm(x, y, x)")),
              ElementsAre(HasSubstr("1:5 the last argument of `fbm`")));
  EXPECT_THAT(errors_of(expressed("noise(x, noise(y, q))")), ElementsAre(HasSubstr("1:19 ")));
  EXPECT_THAT(errors_of(expressed("latitude")),
              ElementsAre(HasSubstr("1:1 unknown name `latitude`; only the shape sphere has it")));
  EXPECT_THAT(errors_of(expressed("x + z")),
              ElementsAre(HasSubstr("1:5 unknown name `z`; a plane has x, to the east, and y")));
  EXPECT_THAT(errors_of(expressed("x y")), ElementsAre(HasSubstr("1:3 found `y`")));
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::expression;
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("\"expression\" is missing")));
  params = expressed("1");
  params.algorithm = TerrainAlgorithm::fbm;
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("/expression")));
  params = expressed("slope");
  params.layers = {layer("b"), layer("height + slope")};
  params.layers[1].name = "b";
  params.layers[1].mask = "1 +";
  params.layers[1].amplitude = 3;
  EXPECT_THAT(errors_of(params),
              ElementsAre(HasSubstr("/expression 1:1"), HasSubstr("/layers/0/expression 1:1"),
                          HasSubstr("/layers/1/amplitude"), HasSubstr("/layers/1/mask 1:4")));
}

TEST(HeightExpressions, RefuseValuesThatAreNotFinite) {
  Job job = any_job();
  try {
    field_of(expressed("1 / x"), job).error();
    FAIL();
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.issue().pointer, "/expression");
    EXPECT_EQ(stop.issue().line, 1);
    EXPECT_EQ(stop.issue().column, 1);
  }
}

/// "pointer line:column" of the refusal of a check without a model, or "none".
std::string appraisal_of(const TerrainParams& params) {
  Job job = any_job();
  try {
    const Result<Appraisal> appraisal = appraise(params, context_of(job));
    return appraisal ? "none" : "error";
  } catch (const Stop& stop) {
    const Issue& issue = stop.issue();
    return issue.pointer + " " + std::to_string(issue.line) + ":" + std::to_string(issue.column);
  }
}

TEST(HeightExpressions, AreRefusedByValidationWhereTheyAreNotFinite) {
  EXPECT_EQ(appraisal_of(expressed("x + y")), "none");
  for (const char* text : {"x / 0", "1 / x", "log(x - 100)", "sqrt(-1 - x * x)", "10 ^ 9"})
    EXPECT_EQ(appraisal_of(expressed(text)), "/expression 1:1") << text;
  TerrainParams layered = expressed("x");
  layered.layers = {layer("height / (x - x)")};
  EXPECT_EQ(appraisal_of(layered), "/layers/0/expression 1:1");
  layered.layers = {layer("1")};
  layered.layers[0].mask = "0 / 0";
  EXPECT_EQ(appraisal_of(layered), "/layers/0/mask 1:1");
  TerrainParams sphere = expressed("1 / z");
  sphere.shape = TerrainShape::sphere;
  EXPECT_EQ(appraisal_of(sphere), "/expression 1:1");
}

/// Gradient noise is 0 at all whole numbers, and one octave of fbm is noise.
TEST(HeightExpressions, HaveGradientNoise) {
  EXPECT_THAT(values(made(expressed("noise(x, y)"))), Each(0.0));
  EXPECT_THAT(values(made(expressed("noise(x, y, x)"))), Each(0.0));
  EXPECT_EQ(values(made(expressed("noise(x / 3, y / 3 + 0.2)"))),
            values(made(expressed("fbm(x / 3, y / 3 + 0.2, 1)"))));
  const std::vector<double> sum =
      values(made(expressed("noise(x / 3, y / 3) + noise(2 * x / 3, 2 * y / 3) / 2", 65, 64)));
  const std::vector<double> fine = values(made(expressed("fbm(x / 3, y / 3, 2)", 65, 64)));
  EXPECT_NE(sum, fine) << "each octave has its own lattice";
  const auto [low, high] = std::minmax_element(fine.begin(), fine.end());
  EXPECT_LT(*low, -0.3);
  EXPECT_GT(*high, 0.3);
  EXPECT_LE(*high, 1.5);
  EXPECT_NE(values(made(expressed("noise(noise(x / 7, y / 7), y / 3)"))),
            values(made(expressed("noise(x / 7, y / 3)"))));
}

TEST(HeightExpressions, DrawAnewAtEachSample) {
  const Field field = made(expressed("ran(2, 4)", 257, 256));
  double sum = 0;
  for (const float height : field.heights) {
    EXPECT_GE(height, 2.0F);
    EXPECT_LT(height, 4.0F);
    sum += double{height};
  }
  EXPECT_NEAR(sum / static_cast<double>(field.heights.size()), 3, 0.01);
  EXPECT_EQ(values(field), values(made(expressed("ran(2, 4)", 257, 256), 8)));
  EXPECT_NE(values(field), values(made(expressed("ran(2, 4)", 257, 256), 1, 2)));
}

TEST(HeightExpressions, AgreeAlongTheBorderOfTiles) {
  TerrainParams west = expressed("30 * fbm(x / 40, y / 40, 5) + ran(1)", 33, 32);
  west.layers = {layer("5 * noise(x / 9, y / 9)")};
  west.layers[0].mask = "slope > 20";
  west.tile.emplace();
  TerrainParams east = west;
  east.tile->x = 1;
  const Field a = made(west), b = made(east);
  for (int z = 0; z < 33; ++z) EXPECT_EQ(a.at(32, z), b.at(0, z));
}

/// A layer is the same ground as the terrain of its algorithm with random corners, on any samples.
TEST(Layers, CanBeSubdivisions) {
  for (const TerrainLayerAlgorithm algorithm :
       {TerrainLayerAlgorithm::diamond_square, TerrainLayerAlgorithm::square_square,
        TerrainLayerAlgorithm::triangular_edge}) {
    TerrainParams params = expressed("0", 34, 33);
    params.layers.resize(1);
    params.layers[0].layer_algorithm = algorithm;
    params.layers[0].amplitude = 10;
    const std::vector<double> heights = values(made(params));
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    EXPECT_LT(*low, *high);
    EXPECT_LT(*high, 60);
    params.layers[0].iterations = 2;
    EXPECT_NE(values(made(params)), heights);
    params.tile.emplace();
    TerrainParams east = params;
    east.tile->x = 1;
    const Field a = made(params), b = made(east);
    for (int z = 0; z < 34; ++z) EXPECT_EQ(a.at(33, z), b.at(0, z));
    params.layers[0].iterations = 15;
    params.layers[0].fault_max = 1;
    EXPECT_THAT(errors_of(params),
                ElementsAre(HasSubstr("/layers/0/fault_max"),
                            HasSubstr("/layers/0/iterations 0:0 found 15; expected at most 14")));
    params = expressed("0");
    params.shape = TerrainShape::sphere;
    params.layers.resize(1);
    params.layers[0].layer_algorithm = algorithm;
    EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("/layers/0/algorithm")));
  }
}

TEST(HeightExpressions, KnowLatitudeAndLongitudeOnASphere) {
  TerrainParams params = expressed("latitude", 17, 20);
  params.shape = TerrainShape::sphere;
  Job job = any_job();
  Planet planet = planet_of(params, 0, job);
  const Range range = range_of(planet);
  EXPECT_NEAR(range.low, -90, 1e-4);
  EXPECT_NEAR(range.high, 90, 1e-4);
  params.expression = "sqrt(x^2 + y^2 + z^2)";
  planet = planet_of(params, 0, job);
  for (const float height : planet.height) EXPECT_NEAR(height, 10, 1e-5);
  params.expression = "longitude";
  planet = planet_of(params, 0, job);
  for (std::size_t i = 0; i < planet.height.size(); ++i) {
    const glm::vec3& d = planet.direction[i];
    if (std::abs(d.y) > 0.99F) continue;
    EXPECT_NEAR(math::sincos_degrees(double{planet.height[i]}).sin * std::hypot(d.x, d.z), d.x, 1e-4);
  }
}

TEST(Layers, CombineWithTheHeightSoFar) {
  const auto combined = [](TerrainCombine combine) {
    TerrainParams params = expressed("10");
    params.layers = {layer("4", combine)};
    return values(made(params)).front();
  };
  EXPECT_EQ(combined(TerrainCombine::add), 14);
  EXPECT_EQ(combined(TerrainCombine::subtract), 6);
  EXPECT_EQ(combined(TerrainCombine::multiply), 40);
  EXPECT_EQ(combined(TerrainCombine::max), 10);
  EXPECT_EQ(combined(TerrainCombine::min), 4);
  EXPECT_EQ(combined(TerrainCombine::replace), 4);
  EXPECT_EQ(combined(TerrainCombine::none), 10);
}

TEST(Layers, AreMaskedBySlopeAndHeightAndUseEarlierOnes) {
  TerrainParams params = expressed("select(x > 0, x, 0)");  // flat in the west, 45 degrees in the east
  params.layers = {layer("100", TerrainCombine::replace)};
  params.layers[0].mask = "slope > 44";
  Field field = made(params);
  for (int z = 0; z < 5; ++z) {
    EXPECT_EQ(field.at(0, z), 0);
    EXPECT_EQ(field.at(2, z), 0) << "the slope at a bend is the mean of both sides";
    EXPECT_EQ(field.at(3, z), 100);
    EXPECT_EQ(field.at(4, z), 100);
  }
  params = expressed("x");
  params.layers = {layer("10", TerrainCombine::none), layer("a * 2")};
  params.layers[0].name = "a";
  params.layers[1].mask = "(height + 2) / 4";  // 0 in the west, 1 in the east
  field = made(params);
  for (int x = 0; x < 5; ++x) EXPECT_EQ(field.at(x, 0), static_cast<float>(x - 2 + 5 * x));
}

TEST(Layers, AreMadeByAlgorithmsToo) {
  TerrainParams params = expressed("0", 65, 64);
  params.layers.resize(1);
  params.layers[0].layer_algorithm = TerrainLayerAlgorithm::fault_formation;
  params.layers[0].iterations = 1;
  params.layers[0].fault_max = params.layers[0].fault_min = 3;
  std::vector<double> heights = values(made(params));
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  EXPECT_EQ(heights.size(), 2U) << "one fault has two heights";
  params.shape = TerrainShape::sphere;
  Job job = any_job();
  const Planet planet = planet_of(params, 0, job);
  EXPECT_EQ(range_of(planet).low, 0);
  EXPECT_GT(range_of(planet).high, 0);
  EXPECT_THAT(check(params, Limits{}), IsEmpty());
}

}  // namespace
}  // namespace seedmesh::terrain
