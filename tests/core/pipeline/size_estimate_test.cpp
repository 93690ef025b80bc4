/// The bytes that `validate` estimates, compared with those of the file.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

Result<Request> request_of(const std::string& preset, const std::string& output) {
  return read_request(R"({"preset":")" + preset + R"(","output":)" + output + "}", Limits{});
}

double estimated_bytes(const Request& request) {
  return nlohmann::json::parse(*validate(request, {}))["estimate"]["bytes"].get<double>();
}

void expect_within_a_quarter(const std::string& preset, const std::string& output) {
  SCOPED_TRACE(preset + " " + output);
  const Result<Request> request = request_of(preset, output);
  ASSERT_TRUE(request);
  const Result<Product> product = produce(*request, {});
  ASSERT_TRUE(product);
  const auto made = static_cast<double>(product->payload.size());
  EXPECT_LT(estimated_bytes(*request), 1.25 * made);
  EXPECT_GT(estimated_bytes(*request), 0.75 * made);
}

/// Models of one file share their images, so an estimate that counts images with each model is far too high.
TEST(SizeEstimate, OfScenesCitiesAndHousesIsWithinAQuarter) {
  for (const char* preset : {"kogovsek_4_5", "hutsko_garden", "forest_interior", "orchard", "alpine_meadow",
                             "given_quarter", "hillside_harbour", "roman_quarter", "garden_village",
                             "factory", "church", "terraced_house", "office_tower", "temple"})
    expect_within_a_quarter(preset, R"({"textures":256})");
}

TEST(SizeEstimate, OfTerrainsFollowsTheirClassesOfGround) {
  for (const char* preset : {"alps", "dunes", "lava_plain", "mesas", "ridges", "snowfield", "tile_0_0"})
    expect_within_a_quarter(preset, R"({"textures":256})");
}

TEST(SizeEstimate, OfTerrainsContainsTheirLevels) {
  expect_within_a_quarter("levels_of_detail", R"({"lods":4,"profile":"unity"})");
  expect_within_a_quarter("dunes", R"({"lods":3,"profile":"unity"})");
}

TEST(SizeEstimate, OfCurvesAndCopiesCountsSharedPointsOnce) {
  for (const char* preset : {"hutsko_dragon_curve", "snowflake_curve", "koch_curve_rounds",
                             "corner_cube_centre", "menger_sponge", "jerusalem_cube"})
    expect_within_a_quarter(preset, "{}");
}

TEST(SizeEstimate, OfGrowingScenesContainsTheirBones) {
  for (const char* preset : {"growing_garden", "fallow_field"})
    expect_within_a_quarter(preset, R"({"animation":"growth"})");
}

TEST(SizeEstimate, FollowsOptionsOfTheOutput) {
  expect_within_a_quarter("hutsko_garden", R"({"instancing":"merge","textures":256})");
  expect_within_a_quarter("oak", R"({"wind":"weights"})");
  expect_within_a_quarter("oak", R"({"image_format":"webp"})");
  expect_within_a_quarter("oak", R"({"image_format":"both"})");
}

TEST(SizeEstimate, HasNoImagesWhereTheFileHasLinks) {
  const Result<Request> linked = request_of("oak", R"({"textures":"links"})"),
                        whole = request_of("oak", "{}");
  ASSERT_TRUE(linked && whole);
  EXPECT_LT(estimated_bytes(*linked) + 500'000, estimated_bytes(*whole));
}

TEST(SizeEstimate, CountsTheImagesOfVariantsOnce) {
  const Result<Request> one = request_of("oak", "{}"), two = request_of("oak", R"({"variants":2})");
  ASSERT_TRUE(one && two);
  EXPECT_LT(estimated_bytes(*two), 2 * estimated_bytes(*one) - 500'000);
  EXPECT_GT(estimated_bytes(*two), 1.5 * estimated_bytes(*one));
}

}  // namespace
}  // namespace seedmesh
