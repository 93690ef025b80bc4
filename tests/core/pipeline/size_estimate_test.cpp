/// The bytes that `validate` estimates, compared with those of the file.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

Result<Request> request_of(const std::string& preset, const std::string& output) {
  return read_request(R"({"preset":")" + preset + R"(","output":)" + output + "}", Limits{});
}

double estimated_bytes(const Request& request) {
  return nlohmann::json::parse(*validate(request, {}))["estimate"]["bytes"].get<double>();
}

/// Models of one file share their images, so an estimate that counts images with each model is far too high.
TEST(SizeEstimate, OfScenesCitiesAndHousesIsWithinAQuarter) {
  for (const char* preset : {"kogovsek_4_5", "hutsko_garden", "forest_interior", "orchard", "alpine_meadow",
                             "given_quarter", "hillside_harbour", "roman_quarter", "garden_village",
                             "factory", "church", "terraced_house", "office_tower", "temple"}) {
    const Result<Request> request = request_of(preset, R"({"textures":256})");
    ASSERT_TRUE(request) << preset;
    const Result<Product> product = produce(*request, {});
    ASSERT_TRUE(product) << preset;
    const auto made = static_cast<double>(product->payload.size());
    EXPECT_LT(estimated_bytes(*request), 1.25 * made) << preset;
    EXPECT_GT(estimated_bytes(*request), 0.75 * made) << preset;
  }
}

TEST(SizeEstimate, OfGrowingScenesContainsTheirBones) {
  for (const char* preset : {"growing_garden", "fallow_field"}) {
    const Result<Request> request = request_of(preset, R"({"animation":"growth"})");
    ASSERT_TRUE(request) << preset;
    const Result<Product> product = produce(*request, {});
    ASSERT_TRUE(product) << preset;
    const auto made = static_cast<double>(product->payload.size());
    EXPECT_LT(estimated_bytes(*request), 1.25 * made) << preset;
    EXPECT_GT(estimated_bytes(*request), 0.75 * made) << preset;
  }
}

TEST(SizeEstimate, FollowsOptionsOfTheOutput) {
  for (const auto& [preset, output] :
       {std::pair{"hutsko_garden", R"({"instancing":"merge","textures":256})"},
        std::pair{"oak", R"({"wind":"weights"})"}, std::pair{"oak", R"({"image_format":"webp"})"},
        std::pair{"oak", R"({"image_format":"both"})"}}) {
    const Result<Request> request = request_of(preset, output);
    ASSERT_TRUE(request) << output;
    const Result<Product> product = produce(*request, {});
    ASSERT_TRUE(product) << output;
    const auto made = static_cast<double>(product->payload.size());
    EXPECT_LT(estimated_bytes(*request), 1.25 * made) << output;
    EXPECT_GT(estimated_bytes(*request), 0.75 * made) << output;
  }
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
