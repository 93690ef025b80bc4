#include "core/base/result.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

TEST(PlaceOf, CountsLinesAndCharactersFromOne) {
  EXPECT_EQ(place_of("abc", 0).column, 1);
  EXPECT_EQ(place_of("abc", 2).column, 3);
  EXPECT_EQ(place_of("a\nbc", 3).line, 2);
  EXPECT_EQ(place_of("a\nbc", 3).column, 2);
}

TEST(PlaceOf, CountsACharacterOfSeveralBytesOnce) {
  const std::string text = "A → B";
  EXPECT_EQ(place_of(text, text.find('B')).column, 5);
}

TEST(Result, HoldsAValueOrItsFaults) {
  const Result<int> good = 3;
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 3);
  const Result<int> bad = Error{Code::invalid, {{"/seed", "found -1; expected 0 or more"}}};
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().issues[0].pointer, "/seed");
}

}  // namespace
}  // namespace seedmesh
