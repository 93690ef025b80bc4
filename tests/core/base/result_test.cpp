#include "core/base/result.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

TEST(TextPosition, CountsLinesAndCharactersFromOne) {
  EXPECT_EQ(text_position("abc", 0).column, 1);
  EXPECT_EQ(text_position("abc", 2).column, 3);
  EXPECT_EQ(text_position("a\nbc", 3).line, 2);
  EXPECT_EQ(text_position("a\nbc", 3).column, 2);
}

TEST(TextPosition, CountsACharacterOfSeveralBytesOnce) {
  const std::string text = "A → B";
  EXPECT_EQ(text_position(text, text.find('B')).column, 5);
}

TEST(Result, ContainsAValueOrItsErrors) {
  const Result<int> good = 3;
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 3);
  const Result<int> bad =
      Error{Code::invalid, {{IssueKind::out_of_range, "/seed", "found -1; expected 0 or more"}}};
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().issues[0].pointer, "/seed");
}

TEST(WordOf, NamesKindsAndResourcesAsTheContractDoes) {
  EXPECT_EQ(word_of(IssueKind::syntax), "syntax");
  EXPECT_EQ(word_of(IssueKind::unknown_key), "unknown_key");
  EXPECT_EQ(word_of(IssueKind::not_available), "not_available");
  EXPECT_EQ(word_of(IssueKind::truncated_list), "truncated_list");
  EXPECT_EQ(word_of(IssueKind::internal), "internal");
  EXPECT_EQ(word_of(Resource::modules), "modules");
  EXPECT_EQ(word_of(Resource::memory_bytes), "memory_bytes");
  EXPECT_EQ(word_of(Resource::steps), "steps");
}

TEST(TruncatedList, CountsWhatItLeavesOut) {
  const Issue issue = truncated_list(9899);
  EXPECT_EQ(issue.kind, IssueKind::truncated_list);
  EXPECT_EQ(issue.unlisted, 9899U);
  EXPECT_EQ(issue.message, "and 9899 more errors");
}

}  // namespace
}  // namespace seedmesh
