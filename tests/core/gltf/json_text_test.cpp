#include "core/gltf/json_text.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/rng.h"

namespace seedmesh::gltf {
namespace {

std::string number(float value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string quoted(std::string_view value) {
  std::string text;
  append_string(text, value);
  return text;
}

TEST(JsonText, PrintsFloatsAsShortAsTheyReadBack) {
  EXPECT_EQ(number(0.1F), "0.1");
  EXPECT_EQ(number(1.0F), "1");
  EXPECT_EQ(number(-2.5F), "-2.5");
  EXPECT_EQ(number(16'777'216.0F), "16777216");
  EXPECT_EQ(number(1e-7F), "1e-07");
}

TEST(JsonText, HasNoNegativeZero) { EXPECT_EQ(number(-0.0F), "0"); }

TEST(JsonText, GivesEveryFloatBackBothAsTextAndAsDouble) {
  Rng rng = Rng::of_seed(1).at("floats");
  for (int i = 0; i < 20'000; ++i) {
    const auto bits = static_cast<std::uint32_t>(rng.next());
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(nlohmann::json::parse(number(value)).get<float>(), value);
    EXPECT_EQ(static_cast<float>(shortest(value)), value);
  }
  const float largest = std::numeric_limits<float>::max();
  EXPECT_EQ(static_cast<float>(shortest(largest)), largest);
}

TEST(JsonText, EscapesWhatJsonWants) {
  EXPECT_EQ(quoted("plain name"), R"("plain name")");
  EXPECT_EQ(nlohmann::json::parse(quoted("quote\" back\\slash \n \x01 é 木")),
            "quote\" back\\slash \n \x01 é 木");
}

TEST(JsonText, ReplacesBytesThatAreNoText) { EXPECT_EQ(nlohmann::json::parse(quoted("a\xFFz")), "a\uFFFDz"); }

}  // namespace
}  // namespace seedmesh::gltf
