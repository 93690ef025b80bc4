/// Expressions whose values can be texts.
#include <gmock/gmock.h>

#include <cmath>

#include "core/lang/expression.h"

namespace seedmesh::lang {
namespace {

/// The value of an expression in which "a" is text 1, "b" text 2, and so on; `t` is a slot with the text "a",
/// `u` one with "b", `n` one with 5.
TaggedValue value_of(const char* text) {
  std::vector<TextError> errors;
  std::vector<Token> tokens = tokenize(text, 0, std::string_view(text).size(), errors);
  for (Token& token : tokens) {
    if (token.kind == TokenKind::string) token.number = token.text[0] - 'a' + 1;
  }
  Names names;
  names.bind_slot("t", 0);
  names.bind_slot("u", 1);
  names.bind_slot("n", 2);
  Program program;
  std::size_t at = 0;
  const Expression expression = program.parse(tokens, at, names, errors);
  EXPECT_TRUE(errors.empty()) << text;
  const TaggedValue slots[] = {{0, 1}, {0, 2}, {5, 0}};
  Rng rng(1);
  return program.evaluate_tagged(expression, slots, rng);
}

TEST(TaggedValues, CompareTextsByWhatTheyAre) {
  const std::pair<const char*, double> table[] = {
      {"t == \"a\"", 1},
      {"t == \"b\"", 0},
      {"\"a\" == \"a\"", 1},
      {"\"a\" != \"b\"", 1},
      {"t == u", 0},
      {"t != u", 1},
      {"t == 1", 0},
      {"n == \"a\"", 0},
      {"t == 0", 0},
      {"t == \"a\" && n > 4", 1},
      {"t == \"b\" || u == \"b\"", 1},
      {"n == 5", 1},
  };
  for (const auto& [text, expected] : table) EXPECT_EQ(value_of(text), (TaggedValue{expected, 0})) << text;
}

TEST(TaggedValues, PassTextsThroughSelect) {
  EXPECT_EQ(value_of("select(n > 4, \"a\", \"b\")"), (TaggedValue{0, 1}));
  EXPECT_EQ(value_of("select(n > 5, t, u)"), (TaggedValue{0, 2}));
  EXPECT_EQ(value_of("select(1, \"c\", 3)"), (TaggedValue{0, 3}));
  EXPECT_EQ(value_of("select(t == \"b\", 1, select(n == 5, \"b\", 2))"), (TaggedValue{0, 2}));
  EXPECT_EQ(value_of("t"), (TaggedValue{0, 1}));
  EXPECT_EQ(value_of("\"b\""), (TaggedValue{0, 2}));
}

TEST(TaggedValues, MakeNoNumbersOfTexts) {
  for (const char* text : {"t + 1", "\"a\" * 2", "-t", "sqrt(t)", "n + t * 0"}) {
    EXPECT_TRUE(std::isnan(value_of(text).number)) << text;
    EXPECT_FALSE(value_of(text).is_text()) << text;
  }
  EXPECT_EQ(value_of("t < u"), (TaggedValue{0, 0}));
}

TEST(TaggedValues, ComputeNumbersAsDoublesDo) {
  EXPECT_EQ(value_of("2 * n + 1"), (TaggedValue{11, 0}));
  EXPECT_EQ(value_of("max(n, 7) - min(n, 2) * 3"), (TaggedValue{1, 0}));
  EXPECT_EQ(value_of("n > 4 && n < 6 || 0"), (TaggedValue{1, 0}));
  EXPECT_EQ(value_of("n > 5 && n / 0 > 1"), (TaggedValue{0, 0}));
}

}  // namespace
}  // namespace seedmesh::lang
