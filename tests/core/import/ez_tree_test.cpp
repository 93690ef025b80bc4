#include <gmock/gmock.h>

#include <glm/glm.hpp>

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

constexpr const char* spruce = R"({
  "seed": 7001, "type": "evergreen",
  "branch": {
    "levels": 1, "angle": {"1": 110}, "children": {"0": 60},
    "force": {"direction": {"x": 0, "y": 1, "z": 0}, "strength": 0.004},
    "gnarliness": {"0": 0.04, "1": 0.1}, "length": {"0": 38, "1": 14}, "radius": {"0": 0.9, "1": 0.5},
    "sections": {"0": 11, "1": 9}, "start": {"1": 0.2}, "twist": {"0": 0.05, "1": -0.1}},
  "leaves": {"type": "pine", "billboard": "single", "angle": 33, "count": 17, "start": 0.1, "size": 1.4,
             "sizeVariance": 0.3}})";

constexpr const char* hedge = R"({
  "seed": 555, "type": "deciduous",
  "branch": {
    "levels": 2, "angle": {"1": 30, "2": 70}, "children": {"0": 6, "1": 4},
    "force": {"direction": {"x": 0.6, "y": 0.8, "z": 0}, "strength": -0.01},
    "gnarliness": {"0": 0.02, "1": 0.07, "2": -0.2}, "length": {"0": 6, "1": 14, "2": 9},
    "radius": {"0": 0.4, "1": 0.8, "2": 0.7}, "sections": {"0": 5, "1": 9, "2": 7},
    "start": {"1": 0.1, "2": 0.2}, "taper": {"0": 0.5, "1": 0.4, "2": 0.6}, "twist": {"0": 0.1, "1": -0.03, "2": 0.2}},
  "leaves": {"type": "ash", "billboard": "single", "count": 9, "size": 1.2},
  "trellis": {"enabled": true, "position": {"x": 0.5, "y": 0.2, "z": 1.5}, "width": 16, "height": 20, "spacing": 3,
              "force": {"strength": 0.012, "maxDistance": 9, "falloff": 1.4}}})";

TEST(EzTreeFile, ReadsColoursThatAreTexts) {
  nlohmann::json file = nlohmann::json::parse(oak);
  for (const char* text : {"0xfcffdc", "#fcffdc"}) {
    file["leaves"]["tint"] = text;
    const auto result = imported("ez_tree", file.dump());
    ASSERT_TRUE(result) << reports(result)[0];
    EXPECT_EQ(parameters_of(result)["leaf"]["color"], "#fcffdc");
  }
  file["leaves"]["tint"] = "0xfcff";
  EXPECT_FALSE(imported("ez_tree", file.dump()));
}

TEST(EzTreeFile, NamesTheVersionOfFilesWithATrunk) {
  const auto result = imported(
      "ez_tree",
      R"({"trunk": {"length": 47}, "branch": {"levels": 2, "children": 40}, "leaves": {"count": 29}})");
  EXPECT_THAT(reports(result), testing::ElementsAre(testing::HasSubstr("versions of ez-tree before 0.1")));
}

TEST(EzTreeFile, BecomesATreeOfItsLevelsAndLengths) {
  const auto result = imported("ez_tree", oak);
  const nlohmann::json parameters = parameters_of(result);
  EXPECT_EQ(parameters["model"], "ez_tree");
  EXPECT_EQ(parameters["ez_tree"]["level"][0]["children"], 8);
  EXPECT_EQ(parameters["ez_tree"]["level"][2]["angle"], 61);
  EXPECT_EQ(parameters["ez_tree"]["level"][1]["length"], 29.4);
  EXPECT_EQ(parameters["ez_tree"]["leaf_count"], 12);
  EXPECT_EQ(parameters["leaf"]["shape"], "lobed");
  EXPECT_EQ(parameters["leaf"]["build"], "cross");
  EXPECT_EQ(parameters["bark_color"], "#ceccbe");
  EXPECT_EQ(result->request.seed(), 23399U);
}

/// What ez-tree makes of a file, in metres.
struct Original {
  const char* file;
  int limbs, leaves;
  glm::dvec3 min, max;
};

TEST(EzTreeFile, HasTheLimbsAndLeavesOfTheOriginal) {
  // npm @dgreenheck/ez-tree 1.1.0 in node 20; the middles of its rings.
  const Original originals[] = {
      {oak, 334, 3510, {-7.77077, 0, -7.81663}, {6.80589, 18.14823, 6.98164}},
      {spruce, 61, 1020, {-1.77289, 0, -2.11221}, {2.12146, 7.57748, 1.53682}},
      {hedge, 43, 350, {-3.33505, -0.24968, -2.53018}, {2.46997, 5.26490, 3.78879}},
      {R"({"seed": 3, "branch": {}})", 457, 768, {-3.55768, 0, -4.88716}, {5.26768, 8.32006, 3.67018}},
  };
  for (const Original& original : originals) {
    const auto result = imported("ez_tree", original.file);
    ASSERT_TRUE(result) << reports(result)[0];
    const Result<std::string> answer = derive(result->request, {});
    ASSERT_TRUE(answer);
    const nlohmann::json tree = nlohmann::json::parse(*answer);
    EXPECT_EQ(tree["limbs"], original.limbs);
    EXPECT_EQ(tree["leaves"], original.leaves);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(tree["bounds"]["min"][static_cast<std::size_t>(axis)].get<double>(), original.min[axis],
                  2e-4);
      EXPECT_NEAR(tree["bounds"]["max"][static_cast<std::size_t>(axis)].get<double>(), original.max[axis],
                  2e-4);
    }
  }
}

TEST(EzTreeFile, BecomesARequestThatMakesATree) {
  for (const char* file : {oak, spruce, hedge}) {
    const auto result = imported("ez_tree", file);
    ASSERT_TRUE(result);
    const Result<Product> product = produce(result->request, {});
    ASSERT_TRUE(product);
    EXPECT_GT(product->statistics.triangles, 3'000U);
    EXPECT_LT(product->statistics.triangles, 100'000U);
  }
}

TEST(EzTreeFile, ReportsEveryErrorAtItsPointer) {
  const auto result = imported(
      "ez_tree",
      R"({"sed": 3, "branch": {"angle": {"1": 400}, "length": {"0": "long"}, "taper": 3}, "leaves": {"type": "fig"}})");
  ASSERT_FALSE(result);
  std::vector<std::string> pointers;
  for (const Issue& issue : result.error().issues) pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, testing::UnorderedElementsAre("/sed", "/branch/angle/1", "/branch/length/0",
                                                      "/branch/taper", "/leaves/type"));
}

TEST(EzTreeFile, WarnsOfOptionsWithoutACounterpart) {
  const auto result = imported("ez_tree", hedge);
  ASSERT_TRUE(result);
  std::vector<std::string> pointers;
  for (const Warning& warning : result->warnings) pointers.push_back(warning.pointer);
  EXPECT_THAT(pointers, testing::ElementsAre("/trellis", ""));
  EXPECT_FALSE(imported("ez_tree", "[]"));
  EXPECT_FALSE(imported("ez_tree", "{}"));
}

}  // namespace
}  // namespace seedmesh
