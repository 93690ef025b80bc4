#include "core/base/base64.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace seedmesh {
namespace {

// The examples of RFC 4648, section 10.
TEST(Base64, ReadsTheExamplesOfTheStandard) {
  const std::vector<std::pair<std::string, std::string>> examples = {
      {"", ""},
      {"Zg==", "f"},
      {"Zm8=", "fo"},
      {"Zm9v", "foo"},
      {"Zm9vYg==", "foob"},
      {"Zm9vYmE=", "fooba"},
      {"Zm9vYmFy", "foobar"},
  };
  for (const auto& [text, expected] : examples) {
    const std::string_view digits = without_padding(text);
    std::string bytes(base64_bytes(digits.size()), '?');
    const Base64End end = read_base64(digits, reinterpret_cast<std::uint8_t*>(bytes.data()));
    EXPECT_EQ(bytes, expected) << text;
    EXPECT_EQ(end.bad, std::string_view::npos) << text;
    EXPECT_EQ(end.unused, 0U) << text;
  }
}

TEST(Base64, ReportsTheFirstCharacterThatIsNoDigit) {
  std::vector<std::uint8_t> bytes(base64_bytes(8));
  EXPECT_EQ(read_base64("Zm9v-mFy", bytes.data()).bad, 4U);  // a sign of base64url
  EXPECT_EQ(read_base64("=m9vYmFy", bytes.data()).bad, 0U);
}

TEST(Base64, ReportsBitsBehindTheLastByte) {
  std::uint8_t byte = 0;
  EXPECT_EQ(read_base64("Zh", &byte).unused, 1U);  // h is 33: two bits of the byte, then 0001
  EXPECT_EQ(byte, 'f');
}

TEST(Base64, RemovesAtMostTwoSignsOfPadding) {
  EXPECT_EQ(without_padding("Zg=="), "Zg");
  EXPECT_EQ(without_padding("Z==="), "Z=");
  EXPECT_EQ(without_padding("="), "");
}

}  // namespace
}  // namespace seedmesh
