#include "core/lang/lexer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace seedmesh::lang {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<Token> tokens(std::string_view text) {
  std::vector<TextError> faults;
  std::vector<Token> found = tokenize(text, 0, text.size(), faults);
  EXPECT_THAT(faults, IsEmpty()) << text;
  return found;
}

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> found;
  for (const Token& token : tokens(text)) found.emplace_back(token.text);
  found.pop_back();  // the end
  return found;
}

std::vector<std::string> messages(std::string_view text) {
  std::vector<TextError> faults;
  tokenize(text, 0, text.size(), faults);
  std::vector<std::string> found;
  for (const TextError& fault : faults) found.push_back(std::to_string(fault.offset) + ": " + fault.message);
  return found;
}

double number(std::string_view text) {
  const std::vector<Token> found = tokens(text);
  EXPECT_THAT(found, SizeIs(2)) << text;
  EXPECT_EQ(found[0].kind, TokenKind::number) << text;
  return found[0].number;
}

TEST(Lexer, ReadsEveryFormOfANumber) {
  EXPECT_EQ(number("1"), 1);
  EXPECT_EQ(number("1.5"), 1.5);
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("1e3"), 1000);
  EXPECT_EQ(number("1E+3"), 1000);
  EXPECT_EQ(number("1e-3"), 0.001);
  EXPECT_EQ(number("007"), 7);
}

TEST(Lexer, RoundsNumbersToTheNearestDouble) {
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("9007199254740993"), 9007199254740992.0);  // a tie goes to the even one
  EXPECT_EQ(number("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(number("4.9e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("1e-400"), 0);
  EXPECT_EQ(number("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(number("1e-99999999999999999999"), 0);
  EXPECT_EQ(number("0e999"), 0);
}

TEST(Lexer, RefusesNumbersBeyondDouble) {
  for (const std::string& text :
       {std::string("1e309"), "1" + std::string(400, '0'), std::string("1e99999999999999999999"),
        std::string("0.001e400"), "1" + std::string(400, '0') + ".5e-10"}) {
    EXPECT_THAT(messages("x " + text), ElementsAre(HasSubstr("2: the number `"))) << text;
  }
}

TEST(Lexer, EndsANumberWhereItCannotGoOn) {
  EXPECT_THAT(words("1r"), ElementsAre("1", "r"));
  EXPECT_THAT(words("1e"), ElementsAre("1", "e"));
  EXPECT_THAT(words("1e+x"), ElementsAre("1", "e", "+", "x"));
  EXPECT_THAT(words("1..5"), ElementsAre("1.", ".5"));
  EXPECT_THAT(words("0x10"), ElementsAre("0", "x10"));
  EXPECT_THAT(words("a.b"), ElementsAre("a", ".", "b"));
}

TEST(Lexer, TakesTheLongestSymbol) {
  EXPECT_THAT(words("== = != ! <= < >= > && & || |"),
              ElementsAre("==", "=", "!=", "!", "<=", "<", ">=", ">", "&&", "&", "||", "|"));
  EXPECT_THAT(words("a-->b"), ElementsAre("a", "-->", "b"));
  EXPECT_THAT(words("a->b~>c<<d>>e"), ElementsAre("a", "->", "b", "~>", "c", "<<", "d", ">>", "e"));
  EXPECT_THAT(words("a--b"), ElementsAre("a", "-", "-", "b"));
  EXPECT_THAT(words("$@#'`\\?"), ElementsAre("$", "@", "#", "'", "`", "\\", "?"));
}

TEST(Lexer, TakesTypesetArrowsForArrows) {
  const std::vector<Token> found = tokens("a\u2192b\u27F6c");
  ASSERT_THAT(found, SizeIs(6));
  EXPECT_TRUE(is_symbol(found[1], "->"));
  EXPECT_EQ(found[1].offset, 1U);
  EXPECT_EQ(found[1].length, 3U);
  EXPECT_TRUE(is_symbol(found[3], "->"));
  EXPECT_EQ(found[4].offset, 8U);
}

TEST(Lexer, KeepsOffsetsOfAPartOfAText) {
  const std::string text = "A(l*r1, w)";
  std::vector<TextError> faults;
  const std::vector<Token> found = tokenize(text, 2, 9, faults);
  ASSERT_THAT(found, SizeIs(6));
  EXPECT_EQ(found[0].offset, 2U);
  EXPECT_EQ(found[2].text, "r1");
  EXPECT_EQ(found[2].offset, 4U);
  EXPECT_EQ(found.back().kind, TokenKind::end);
  EXPECT_EQ(found.back().offset, 9U);
}

TEST(Lexer, StopsANumberAtTheEndOfThePart) {
  std::vector<TextError> faults;
  const std::vector<Token> found = tokenize("12345", 1, 3, faults);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].number, 23);
}

TEST(Lexer, SeparatesByAnyWhiteSpace) { EXPECT_THAT(words(" a\t\r\n\u00A0b\v\f"), ElementsAre("a", "b")); }

TEST(Lexer, ReadsStringsWithEscapes) {
  const std::vector<Token> found = tokens(R"(x "a\"b\\\n\t" y)");
  ASSERT_THAT(found, SizeIs(4));
  EXPECT_EQ(found[1].kind, TokenKind::string);
  EXPECT_EQ(found[1].offset, 2U);
  EXPECT_EQ(found[1].length, 12U);
  EXPECT_EQ(found[1].text, R"(a\"b\\\n\t)");
  EXPECT_EQ(string_value(found[1]), "a\"b\\\n\t");
  EXPECT_EQ(found[2].text, "y");
}

TEST(Lexer, ReportsErrorsInStrings) {
  EXPECT_THAT(messages("\"abc\nx"), ElementsAre("0: the string that opens here is not closed on its line"));
  EXPECT_THAT(messages("\"abc\\"), ElementsAre("0: the string that opens here is not closed on its line"));
  EXPECT_THAT(messages(R"("a\qb")"), ElementsAre(HasSubstr("2: unknown escape")));
  EXPECT_THAT(messages(R"("a\qb)"), ElementsAre(HasSubstr("0: the string"), HasSubstr("2: unknown escape")));
}

TEST(Lexer, NamesCharactersThatDoNotBelong) {
  EXPECT_THAT(messages("a \u2212 b \u00E9"),
              ElementsAre("2: unexpected character `\u2212`; write `-`", "8: unexpected character `\u00E9`"));
  EXPECT_THAT(messages(std::string_view("a\0b", 3)),
              ElementsAre("1: unexpected byte 0, which is not part of a text"));
  EXPECT_THAT(messages("a\xE2\x86"),
              ElementsAre(HasSubstr("1: unexpected byte 226"), HasSubstr("2: unexpected byte 134")));
}

TEST(Lexer, LeavesOutWhatDoesNotBelong) {
  std::vector<TextError> faults;
  EXPECT_THAT(tokenize("a\u00E9b", 0, 4, faults), SizeIs(3));
}

TEST(Lexer, StopsAfterTooManyErrorsOrTokens) {
  EXPECT_THAT(messages(std::string(100'000, '\x01')), SizeIs(max_errors - 1));
  std::vector<TextError> faults;
  const std::string flood(max_tokens + 10, '+');
  EXPECT_THAT(tokenize(flood, 0, flood.size(), faults), SizeIs(max_tokens + 1));
  EXPECT_THAT(faults, SizeIs(1));
}

TEST(Lexer, QuotesForMessages) {
  EXPECT_EQ(in_quotes("x"), "`x`");
  EXPECT_EQ(in_quotes(std::string(50, 'a')), "`" + std::string(40, 'a') + "...`");
  EXPECT_EQ(in_quotes("\xFF"), "`?`");
  EXPECT_EQ(in_quotes(tokens("").front()), "the end");
  EXPECT_EQ(in_quotes(tokens("\"a\"").front()), "the string `a`");
}

}  // namespace
}  // namespace seedmesh::lang
