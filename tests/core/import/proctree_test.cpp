#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

/// The parameters of a file that is `{}` in all but what `given` has: the values of `new Tree({})` of proctree.js.
nlohmann::json with_defaults(const std::string& given) {
  nlohmann::json out =
      nlohmann::json::parse(R"({"model": "proctree", "sequence": "original", "leaf": {"build": "twig"},
    "mSeed": 10, "mLevels": 3, "mVMultiplier": 0.2, "mTwigScale": 2, "mInitialBranchLength": 0.85,
    "mLengthFalloffPower": 1, "mClumpMax": 0.8, "mClumpMin": 0.5, "mBranchFactor": 2, "mDropAmount": 0,
    "mGrowAmount": 0, "mSweepAmount": 0, "mMaxRadius": 0.25, "mClimbRate": 1.5, "mTrunkKink": 0, "mTreeSteps": 2,
    "mTaperRate": 0.95, "mRadiusFalloffRate": 0.6, "mTwistRate": 13, "mTrunkLength": 2.5})");
  out.update(nlohmann::json::parse(given));
  return out;
}

TEST(ProctreeFile, BecomesATreeOfTheSameParameters) {
  const auto result = imported("proctree", R"({"mSeed": 262, "mLevels": 4, "mTwistRate": 3.019})");
  ASSERT_TRUE(result) << reports(result)[0];
  nlohmann::json wanted = with_defaults(R"({"mLevels": 4, "mTwistRate": 3.019})");
  wanted.erase("mSeed");  // 262 is the value of the schema
  EXPECT_EQ(parameters_of(result), wanted);
  EXPECT_EQ(result->warnings.size(), 0U);
}

TEST(ProctreeFile, HasTheValuesOfProctreeJsWhereItLacksThem) {
  // From the formulas of proctree.js, in node: joints of the file {"seed": 152, "segments": 8, "levels": 4}.
  const auto result = imported("proctree", R"({"seed": 152, "segments": 8, "levels": 4})");
  ASSERT_TRUE(result) << reports(result)[0];
  const Result<std::string> answer = derive(result->request, {});
  ASSERT_TRUE(answer);
  const nlohmann::json tree = nlohmann::json::parse(*answer);
  EXPECT_EQ(tree["leaves"], 64);
  EXPECT_NEAR(tree["bounds"]["max"][1].get<double>(), 8.1474, 1e-4);
}

TEST(ProctreeFile, CanHaveColorsAndTheStateOfTheSequence) {
  const auto result = imported(
      "proctree", R"({"seed": 10, "rseed": 31, "levels": 3, "treeColor": 10318690, "twigColor": "#f16950"})");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result),
            with_defaults(R"({"bark_color": "#9d7362", "leaf": {"build": "twig", "color": "#f16950"}})"));
  EXPECT_EQ(result->warnings.size(), 0U);
  const auto wrong = imported("proctree", R"({"seed": 10, "treeColor": 16777216, "twigColor": "leaf"})");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().issues.size(), 2U);
}

// Listing 2.1 of Hutsko's thesis (2022).
constexpr const char* listing = R"({
  "mBranchFactor": 2.45, "mClimbRate": 0.37, "mClumpMax": 0.45, "mClumpMin": 0.40, "mDropAmount": -0.10,
  "mGrowAmount": 0.23, "mInitialBranchLength": 0.49, "mLengthFalloffFactor": 0.85, "mLengthFalloffPower": 0.99,
  "mLevels": 5, "mMaxRadius": 0.13, "mRadiusFalloffRate": 0.73, "mSeed": 262, "mSegments": 6, "mSweepAmount": 0.00,
  "mTaperRate": 0.94, "mTreeSteps": 5, "mTrunkKink": 0.09, "mTrunkLength": 2.40, "mTwigScale": 0.38,
  "mTwistRate": 3.019, "mVMultiplier": 0.36})";

TEST(ProctreeFile, HasTheSkeletonOfProctreeJs) {
  const auto result = imported("proctree", listing);
  ASSERT_TRUE(result) << reports(result)[0];
  const Result<std::string> answer = derive(result->request, {});
  ASSERT_TRUE(answer);
  const nlohmann::json tree = nlohmann::json::parse(*answer);
  // From proctree.js in node: bounds of the heads of all branches.
  const double min[] = {-1.308954, 0, -1.459524}, max[] = {1.340206, 5.511295, 1.870176};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(tree["bounds"]["min"][axis].get<double>(), min[axis], 2e-6);
    EXPECT_NEAR(tree["bounds"]["max"][axis].get<double>(), max[axis], 2e-6);
  }
  EXPECT_EQ(tree["leaves"], 224);
  EXPECT_EQ(parameters_of(result)["mTwigScale"], 0.38);
}

TEST(ProctreeFile, ReportsEveryErrorAtItsPointer) {
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
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(
      parameters_of(result),
      with_defaults(
          R"({"mSeed": 152, "mSegments": 8, "mLevels": 4, "mInitialBranchLength": 0.6, "mVMultiplier": 1.16,
    "mMaxRadius": 0.105})"));
  EXPECT_EQ(result->warnings.size(), 2U) << "two images";
}

TEST(ProctreeFile, ReportsTheErrorsOfProctreeJsOnceAndByItsNames) {
  const auto result =
      imported("proctree", R"({"maxRadius": 9, "clumpmax": 1, "levels": 3, "mLevels": 4, "twistRat": 1})");
  ASSERT_FALSE(result);
  std::vector<std::string> reports_of;
  for (const Issue& issue : result.error().issues) reports_of.push_back(issue.pointer + " " + issue.message);
  EXPECT_THAT(reports_of,
              testing::UnorderedElementsAre(
                  testing::StartsWith("/maxRadius found 9"),
                  "/clumpmax \"clumpmax\" is not a parameter of proctree; did you mean \"clumpMax\"?",
                  testing::StartsWith("/mLevels found a second value"),
                  "/twistRat \"twistRat\" is not a parameter of proctree; did you mean \"twistRate\"?"));
}

TEST(ProctreeFile, IsNoListAndNotEmpty) {
  EXPECT_FALSE(imported("proctree", "[1]"));
  EXPECT_FALSE(imported("proctree", "{}"));
  EXPECT_FALSE(imported("proctree", "{\"mSeed\": "));
}

}  // namespace
}  // namespace seedmesh
