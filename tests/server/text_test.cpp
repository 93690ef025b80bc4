#include "server/http/text.h"

#include <gtest/gtest.h>

#include <set>

namespace seedmesh::http {
namespace {

TEST(Text, DecodesPercentEscapes) {
  EXPECT_EQ(percent_decode("a%2Bb+c%20d"), "a+b+c d");
  EXPECT_EQ(percent_decode("a%2bb+c", PlusSign::space), "a+b c");
  for (const char* text : {"%", "%4", "a%4", "%g0", "%0g", "%-1", "%+1"})
    EXPECT_FALSE(percent_decode(text)) << text;
}

TEST(Text, TakesPartsOfAList) {
  std::string_view rest = " a , b,, c";
  EXPECT_EQ(take_part(rest, ','), "a");
  EXPECT_EQ(take_part(rest, ','), "b");
  EXPECT_EQ(take_part(rest, ','), "");
  EXPECT_EQ(take_part(rest, ','), "c");
  EXPECT_TRUE(rest.empty());
}

TEST(Text, ReadsANumberOnlyWhereTheWholeTextIsOne) {
  EXPECT_EQ(parse_number<int>("-12"), -12);
  EXPECT_EQ(parse_number<double>("0.5"), 0.5);
  for (const char* text : {"", " 1", "1 ", "1x", "0x1", "99999999999"})
    EXPECT_FALSE(parse_number<int>(text)) << text;
}

TEST(Text, DrawsIdsThatDiffer) {
  std::set<std::string> ids;
  for (int i = 0; i < 1'000; ++i) ids.insert(random_id());
  EXPECT_EQ(ids.size(), 1'000U);
  for (const std::string& id : ids) {
    EXPECT_EQ(id.size(), 16U);
    EXPECT_EQ(id.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

TEST(Text, WritesHexadecimalDigits) { EXPECT_EQ(hex(std::string("\x00\xff\x1a", 3)), "00ff1a"); }

}  // namespace
}  // namespace seedmesh::http
