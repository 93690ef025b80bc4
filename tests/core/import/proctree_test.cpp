#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

TEST(ProctreeFile, BecomesATreeOfTheSameParameters) {
  const auto result = imported("proctree", R"({"mSeed": 262, "mLevels": 4, "mTwistRate": 3.019})");
  EXPECT_EQ(parameters_of(result),
            nlohmann::json::parse(
                R"({"model": "proctree", "mLevels": 4, "mTwistRate": 3.019, "leaf": {"size": 0.6}})"))
      << "leaves as large as those of the presets";
  EXPECT_EQ(result->warnings.size(), 1U);
}

TEST(ProctreeFile, IsRefusedWithEveryFaultAtItsPlace) {
  const auto result = imported("proctree", R"({"mSegments": 7, "mLevels": 99, "leaves": 3})");
  ASSERT_FALSE(result);
  std::vector<std::string> pointers;
  for (const Issue& issue : result.error().issues) pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, testing::UnorderedElementsAre("/mSegments", "/mLevels", "/leaves"));
}

TEST(ProctreeFile, MayHaveTheNamesOfProctreeJs) {
  const auto result =
      imported("proctree", R"({"seed": 152, "segments": 8, "levels": 4, "initalBranchLength": 0.6,
    "vMultiplier": 1.16, "maxRadius": 0.105, "trunkMaterial": "TrunkType1", "twigMaterial": "BranchType2"})");
  ASSERT_TRUE(result) << told(result)[0];
  EXPECT_EQ(parameters_of(result),
            nlohmann::json::parse(R"({"model": "proctree", "mSeed": 152, "mSegments": 8,
    "mLevels": 4, "mInitialBranchLength": 0.6, "mVMultiplier": 1.16, "mMaxRadius": 0.105,
    "leaf": {"size": 0.6}})"));
  EXPECT_EQ(result->warnings.size(), 3U) << "two pictures, and chance";
}

TEST(ProctreeFile, TellsTheFaultsOfProctreeJsOnceAndByItsNames) {
  const auto result =
      imported("proctree", R"({"maxRadius": 9, "clumpmax": 1, "levels": 3, "mLevels": 4, "twistRat": 1})");
  ASSERT_FALSE(result);
  std::vector<std::string> told_of;
  for (const Issue& issue : result.error().issues) told_of.push_back(issue.pointer + " " + issue.message);
  EXPECT_THAT(told_of,
              testing::UnorderedElementsAre(
                  testing::StartsWith("/maxRadius found 9"),
                  "/clumpmax \"clumpmax\" is no parameter of proctree; did you mean \"clumpMax\"?",
                  testing::StartsWith("/mLevels found a second value"),
                  "/twistRat \"twistRat\" is no parameter of proctree; did you mean \"twistRate\"?"));
}

TEST(ProctreeFile, IsNoListAndNotEmpty) {
  EXPECT_FALSE(imported("proctree", "[1]"));
  EXPECT_FALSE(imported("proctree", "{}"));
  EXPECT_FALSE(imported("proctree", "{\"mSeed\": "));
}

}  // namespace
}  // namespace seedmesh
