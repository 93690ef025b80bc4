#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

TEST(ProctreeFile, BecomesATreeOfTheSameParameters) {
  const auto result = imported("proctree", R"({"mSeed": 262, "mLevels": 4, "mTwistRate": 3.019})");
  EXPECT_EQ(parameters_of(result),
            nlohmann::json::parse(R"({"model": "proctree", "mLevels": 4, "mTwistRate": 3.019})"));
  EXPECT_EQ(result->warnings.size(), 1U);
}

TEST(ProctreeFile, IsRefusedWithEveryFaultAtItsPlace) {
  const auto result = imported("proctree", R"({"mSegments": 7, "mLevels": 99, "leaves": 3})");
  ASSERT_FALSE(result);
  std::vector<std::string> pointers;
  for (const Issue& issue : result.error().issues) pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, testing::UnorderedElementsAre("/mSegments", "/mLevels", "/leaves"));
}

TEST(ProctreeFile, IsNoListAndNotEmpty) {
  EXPECT_FALSE(imported("proctree", "[1]"));
  EXPECT_FALSE(imported("proctree", "{}"));
  EXPECT_FALSE(imported("proctree", "{\"mSeed\": "));
}

}  // namespace
}  // namespace seedmesh
