#include "server/manifest.h"

#include <gmock/gmock.h>

namespace seedmesh {
namespace {

using testing::HasSubstr;

TEST(Manifest, NamesLinesByTheirNumberWhereNothingElseDoes) {
  const auto jobs = read_manifest("{\"preset\":\"small\"}\n\n{\"name\":\"oaks/a b\", \"request\":{}}\n");
  EXPECT_FALSE(jobs) << "a name with a space";
  const auto named =
      read_manifest("{\"preset\":\"small\"}\n \r\n{\"name\":\"oaks/7\",\"request\":{\"seed\": 1}}");
  ASSERT_TRUE(named);
  ASSERT_EQ(named->size(), 2U);
  EXPECT_EQ((*named)[0].name, "000001");
  EXPECT_EQ((*named)[0].request, "{\"preset\":\"small\"}");
  EXPECT_EQ((*named)[1].name, "oaks/7");
  EXPECT_EQ((*named)[1].line, 3U);
  EXPECT_EQ((*named)[1].request, "{\"seed\":1}");
}

TEST(Manifest, KeepsLargeSeedsExact) {
  const auto jobs = read_manifest("{\"request\":{\"seed\":18446744073709551615}}");
  ASSERT_TRUE(jobs);
  EXPECT_EQ((*jobs)[0].request, "{\"seed\":18446744073709551615}");
}

TEST(Manifest, ListsEveryErrorWithItsLine) {
  const auto jobs = read_manifest(
      "[]\n{\"request\":{},\"nmae\":\"x\"}\n{\"request\":3}\nnot JSON\n{\"name\":\"a\",\"request\":{}}\n"
      "{\"name\":\"a\",\"request\":{}}\n");
  ASSERT_FALSE(jobs);
  std::vector<int> lines;
  for (const Issue& issue : jobs.error().issues) lines.push_back(issue.line);
  EXPECT_THAT(lines, testing::ElementsAre(1, 2, 3, 4, 6));
  EXPECT_THAT(jobs.error().issues.back().message, HasSubstr("line 5"));
}

TEST(Manifest, LetsNoNameLeadOutOfTheFolder) {
  for (const char* name :
       {"../a", "/a", "a/../b", "a//b", ".a", "a/.b", "a/", "", "a\\\\b", "c:a", "a\\u0000b"}) {
    EXPECT_FALSE(read_manifest(std::string("{\"request\":{},\"name\":\"") + name + "\"}")) << name;
  }
  EXPECT_TRUE(read_manifest("{\"request\":{},\"name\":\"a-1/b.2_c\"}"));
}

TEST(Part, IsIndexOfCount) {
  const auto part = read_part("3/8");
  ASSERT_TRUE(part);
  EXPECT_EQ(part->index, 3U);
  EXPECT_EQ(part->count, 8U);
  for (const char* text : {"8/8", "3", "/8", "3/", "a/8", "-1/8", "0/0", "1/2/3"})
    EXPECT_FALSE(read_part(text)) << text;
}

}  // namespace
}  // namespace seedmesh
