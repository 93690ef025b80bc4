/// Requests as files of other programs.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Result<ExportedFile> exported(std::string_view text, std::string_view format = "proctree") {
  const Result<Request> request = read_request(text, Limits{});
  EXPECT_TRUE(request);
  return export_request(*request, format, Job::Options{});
}

std::vector<std::string> pointers_of(const ExportedFile& file) {
  std::vector<std::string> pointers;
  for (const Warning& warning : file.warnings) pointers.push_back(warning.pointer);
  return pointers;
}

// The first preset of proctree's page, as proctree.js saves it.
constexpr const char* listing =
    R"({"seed": 262, "segments": 6, "levels": 5, "vMultiplier": 0.36, "twigScale": 0.39,
  "initalBranchLength": 0.49, "lengthFalloffFactor": 0.85, "lengthFalloffPower": 0.99, "clumpMax": 0.454,
  "clumpMin": 0.404, "branchFactor": 2.45, "dropAmount": -0.1, "growAmount": 0.235, "sweepAmount": 0.01,
  "maxRadius": 0.139, "climbRate": 0.371, "trunkKink": 0.093, "treeSteps": 5, "taperRate": 0.947,
  "radiusFalloffRate": 0.73, "twistRate": 3.02, "trunkLength": 2.4})";

TEST(Export, WritesWhatProctreeSaved) {
  const Result<ImportedRequest> read = import_request({"proctree", "", listing}, Job::Options{});
  ASSERT_TRUE(read);
  const Result<ExportedFile> file = export_request(read->request, "proctree_js", Job::Options{});
  ASSERT_TRUE(file);
  EXPECT_EQ(nlohmann::json::parse(file->text), nlohmann::json::parse(listing));
  EXPECT_THAT(file->warnings, IsEmpty());
}

// Listing 2.1 of Hutsko's thesis (2022).
constexpr const char* thesis =
    R"({"mBranchFactor": 2.45, "mClimbRate": 0.37, "mClumpMax": 0.45, "mClumpMin": 0.40,
  "mDropAmount": -0.10, "mGrowAmount": 0.23, "mInitialBranchLength": 0.49, "mLengthFalloffFactor": 0.85,
  "mLengthFalloffPower": 0.99, "mLevels": 5, "mMaxRadius": 0.13, "mRadiusFalloffRate": 0.73, "mSeed": 262,
  "mSegments": 6, "mSweepAmount": 0.00, "mTaperRate": 0.94, "mTreeSteps": 5, "mTrunkKink": 0.09,
  "mTrunkLength": 2.40, "mTwigScale": 0.38, "mTwistRate": 3.019, "mVMultiplier": 0.36})";

TEST(Export, WritesListing2_1) {
  const Result<ImportedRequest> read = import_request({"", "", thesis}, Job::Options{});
  ASSERT_TRUE(read);
  const Result<ExportedFile> file = export_request(read->request, "proctree", Job::Options{});
  ASSERT_TRUE(file);
  EXPECT_EQ(nlohmann::json::parse(file->text), nlohmann::json::parse(thesis));
  EXPECT_THAT(file->warnings, IsEmpty());
}

TEST(Export, ARequestWithASeedIsNoFileOfProctree) {
  EXPECT_EQ(likely_import_format(R"({"generator": "tree", "seed": 5, "parameters": {"model": "proctree"}})"),
            "");
  EXPECT_EQ(likely_import_format(R"({"preset": "proctree_0", "seed": 5})"), "");
  EXPECT_EQ(likely_import_format(R"({"seed": 5, "levels": 3})"), "proctree");
}

TEST(Export, WarnsOfWhatProctreeCannotHold) {
  const auto file = exported(R"({"generator": "tree", "seed": 3,
      "parameters": {"model": "proctree", "mLevels": 4, "season": "autumn", "mSeed": 9}})");
  ASSERT_TRUE(file);
  EXPECT_EQ(nlohmann::json::parse(file->text).at("mLevels"), 4);
  EXPECT_EQ(nlohmann::json::parse(file->text).size(), 22U);
  EXPECT_THAT(pointers_of(*file), ::testing::ElementsAre("/parameters/sequence", "/parameters/season"));
}

TEST(Export, RefusesOtherModelsAndPrograms) {
  const auto aspen = exported(R"({"generator": "tree", "parameters": {}})");
  ASSERT_FALSE(aspen);
  EXPECT_EQ(aspen.error().issues[0].pointer, "/parameters/model");
  const auto other = exported(R"({"generator": "tree", "parameters": {"model": "proctree"}})", "blender");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().issues[0].message, HasSubstr("found `blender`"));
}

}  // namespace
}  // namespace seedmesh
