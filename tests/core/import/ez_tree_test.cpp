#include <gmock/gmock.h>

#include "core/pipeline.h"
#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

// As the page of ez-tree saves a tree.
constexpr const char* oak = R"({
  "seed": 23399, "type": "deciduous",
  "bark": {"type": "oak", "tint": 13552830, "flatShading": false, "textured": true, "textureScale": {"x": 0.5, "y": 5}},
  "branch": {
    "levels": 3, "angle": {"1": 49, "2": 61, "3": 54}, "children": {"0": 8, "1": 5, "2": 4},
    "force": {"direction": {"x": 0, "y": 1, "z": 0}, "strength": 0.0123},
    "gnarliness": {"0": -0.05, "1": 0.2, "2": 0.16, "3": 0.05},
    "length": {"0": 45.5, "1": 29.4, "2": 15.1, "3": 7.2},
    "radius": {"0": 2.3, "1": 0.58, "2": 0.69, "3": 0.8},
    "sections": {"0": 10, "1": 10, "2": 8, "3": 6}, "segments": {"0": 8, "1": 5, "2": 3, "3": 3},
    "start": {"1": 0.31, "2": 0.2, "3": 0}, "taper": {"0": 0.64, "1": 0.55, "2": 0.6, "3": 0},
    "twist": {"0": 0, "1": 0, "2": 0, "3": 0}},
  "leaves": {"type": "oak", "billboard": "double", "angle": 44, "count": 12, "start": 0.1, "size": 3.1,
             "sizeVariance": 0.5, "tint": 16777215, "alphaTest": 0.5}})";

TEST(EzTreeFile, BecomesATreeOfItsLevelsAndLengths) {
  const auto result = imported("ez_tree", oak);
  const nlohmann::json parameters = parameters_of(result);
  EXPECT_FALSE(parameters.contains("model")) << "weber_penn goes without saying";
  EXPECT_EQ(parameters["Levels"], 4);
  EXPECT_EQ(parameters["1Branches"], 8);
  EXPECT_EQ(parameters["2DownAngle"], 61);
  EXPECT_EQ(parameters["Leaves"], 12);
  EXPECT_NEAR(parameters["Scale"].get<double>(), 45.5 * 0.2, 1e-9);
  EXPECT_NEAR(parameters["1Length"].get<double>(), 29.4 / 45.5, 1e-4);
  EXPECT_EQ(parameters["leaf"]["shape"], "lobed");
  EXPECT_EQ(parameters["leaf"]["build"], "cross");
  EXPECT_EQ(parameters["bark_color"], "#ceccbe");
  EXPECT_EQ(result->request.seed(), 23399U);
}

TEST(EzTreeFile, BecomesARequestThatMakesATreeOfLikeSize) {
  const auto result = imported("ez_tree", oak);
  ASSERT_TRUE(result);
  Job job(result->request.seed(), Job::Options{});
  const Result<Product> product = produce(result->request, job);
  ASSERT_TRUE(product);
  EXPECT_GT(product->statistics.triangles, 5'000U);
  EXPECT_LT(product->statistics.triangles, 100'000U);
}

TEST(EzTreeFile, IsRefusedWithEveryFaultAtItsPlace) {
  const auto result = imported(
      "ez_tree",
      R"({"sed": 3, "branch": {"angle": {"1": 400}, "length": {"0": "long"}, "taper": 3}, "leaves": {"type": "fig"}})");
  ASSERT_FALSE(result);
  std::vector<std::string> pointers;
  for (const Issue& issue : result.error().issues) pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, testing::UnorderedElementsAre("/sed", "/branch/angle/1", "/branch/length/0",
                                                      "/branch/taper", "/leaves/type"));
}

TEST(EzTreeFile, TellsWhatHasNoCounterpart) {
  const auto result = imported("ez_tree", oak);
  ASSERT_TRUE(result);
  std::vector<std::string> pointers;
  for (const Warning& warning : result->warnings) pointers.push_back(warning.pointer);
  EXPECT_THAT(pointers, testing::IsSupersetOf({"/leaves/sizeVariance", "/leaves/start", "/branch/start"}));
  EXPECT_THAT(pointers, testing::Not(testing::Contains("/parameters/LobeDepth"))) << "the reader's own word";
  EXPECT_THAT(pointers, testing::Not(testing::Contains("/parameters/Lobes")));
  for (const Warning& warning : result->warnings) EXPECT_EQ(warning.message.find('/'), std::string::npos);
  EXPECT_FALSE(imported("ez_tree", "[]"));
  EXPECT_FALSE(imported("ez_tree", "{}"));
}

}  // namespace
}  // namespace seedmesh
