/// Long texts with errors everywhere: they are read once, and the number of reported errors is bounded.
#include <gmock/gmock.h>

#include <chrono>

#include "core/generators/lsystem/notation.h"
#include "tests/core/lsystem/support.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t length = 300'000;

std::string repeated(std::string_view piece) {
  std::string text;
  while (text.size() < length) text += piece;
  return text;
}

/// A quadratic scan would take minutes. The bound is far above one pass, for slow machines and sanitizers.
std::vector<Issue> checked(const LsystemParams& params) {
  const auto begun = std::chrono::steady_clock::now();
  std::vector<Issue> issues = check(params, Limits{});
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
  return issues;
}

TEST(HostileTexts, AreReadOnceAsAnAxiom) {
  for (const char* piece : {"(", ")", "[", "]", "{", "~", "@ ", "*A", "F(x)", "F(1", "for(i=0;i<1;i++){",
                            "if(", "while(", "let a=1;", "\n)", "->", "@M(1)", "@#(9)", "@Gc(-3)"}) {
    SCOPED_TRACE(piece);
    EXPECT_LE(checked(grammar_of(repeated(piece), {})).size(), 1'001U);
  }
}

TEST(HostileTexts, AreReadOnceAsAProduction) {
  for (const char* piece : {"for(", "for(i=0;i<1;i++){", "for(i=0;i<1;i++){F}", "if(", "if(1<2)", "while(",
                            "A", "A++", "let a=1;", "->", "A<", "A>", ":", "{", "n=", "(", "[("}) {
    SCOPED_TRACE(piece);
    EXPECT_LE(checked(grammar_of("A", {"A(n) -> " + repeated(piece)})).size(), 101U);
    EXPECT_LE(checked(grammar_of("A", {"A -> let a=1; " + repeated(piece)})).size(), 101U);
    EXPECT_LE(checked(grammar_of("A", {repeated(piece)})).size(), 101U);
  }
}

TEST(HostileTexts, ListAHundredErrorsAndCountTheOthers) {
  const std::vector<std::string> errors = errors_of(grammar_of(repeated("\n)"), {}));
  ASSERT_EQ(errors.size(), 101U);
  EXPECT_EQ(errors[99], "/axiom 101:1 found `)`; expected a symbol before its parameters");
  EXPECT_EQ(errors[100], "/axiom 102:1 and 1 more error");
}

TEST(HostileTexts, AreReadOnceAsArguments) {
  EXPECT_LE(checked(grammar_of("F(" + repeated(",") + ")", {})).size(), 101U);
  EXPECT_LE(checked(grammar_of("@A(" + repeated("copy(") + "frame()" + repeated(")") + ")", {})).size(),
            101U);
  for (const char* piece : {"-", "1+", "(", "1^", "!", "a.", "9"})
    checked(grammar_of("F(" + repeated(piece) + "1)", {}));
}

TEST(HostileTexts, DoNotInlineALongFunctionInEveryLine) {
  LsystemParams params = grammar_of("", {});
  params.functions = {"f(x) = 1" + repeated("+1").substr(0, 200'000)};
  while (params.axiom.size() < length) params.axiom += "F(f(1))";
  const std::vector<Issue> issues = checked(params);
  ASSERT_EQ(issues.size(), 101U);
  EXPECT_THAT(issues[0].message, testing::HasSubstr("more than 4000000 tokens"));
}

TEST(HostileTexts, CanHaveManySimilarNames) {
  LsystemParams params = grammar_of(repeated("abcd"), {});
  for (int i = 0; i < 1'000; ++i) params.modules.push_back("abcde" + std::to_string(i));
  EXPECT_TRUE(checked(params).empty());
  const std::string name(60, 'a');
  for (int i = 0; i < 1'000; ++i) params.constants.emplace(name + std::to_string(i), 1.0);
  params.axiom = "F";
  params.productions.assign(10'000, "F -> F(" + name + "bcdef)");
  EXPECT_EQ(checked(params).size(), 10'000U);
}

TEST(HostileTexts, OfTablesAreBoundedTogether) {
  LsystemParams params = grammar_of("A", {});
  params.productions.assign(10'000, "A -> B");
  params.tables.resize(100);
  for (auto& table : params.tables) table.productions = {"A -> C"};
  const std::vector<Issue> issues = checked(params);
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].pointer, "/tables");
}

TEST(HostileTexts, GetAHundredWarningsAndACountOfTheOthers) {
  Job job = job_of(0);
  const Result<Appraisal> appraisal = appraise(grammar_of(std::string(40'000, '~'), {}), context_of(job));
  ASSERT_TRUE(appraisal);
  ASSERT_EQ(appraisal->warnings.size(), 102U);  // including "nothing is drawn"
  EXPECT_EQ(appraisal->warnings[99].column, 100);
  EXPECT_EQ(appraisal->warnings[100].message, "and 39900 more warnings");
}

TEST(HostileTexts, StopWithTheirRequest) {
  std::stop_source stop;
  stop.request_stop();
  Job::Options options;
  options.stop = stop.get_token();
  Job job(0, options);
  const LsystemParams params = grammar_of(repeated("F"), {});
  std::vector<Issue> issues;
  EXPECT_THROW(compile(params, 0, Limits{}, issues, &job), Stop);
}

TEST(Notation, ReadsTheLongestNameAtAPosition) {
  Symbols symbols;
  for (const char* name : {"ab", "abcd", "abce", "b"}) symbols.declare(name);
  const auto at = [&](std::string_view text) { return symbols.length_at(text, 0, text.size()); };
  EXPECT_EQ(at("abcd"), 4U);
  EXPECT_EQ(at("abcx"), 2U);
  EXPECT_EQ(at("abc"), 2U);
  EXPECT_EQ(at("a"), 1U);
  EXPECT_EQ(at("bcd"), 1U);
  EXPECT_EQ(at("@Dix"), 3U);
  EXPECT_EQ(at("@Dx"), 2U);
  EXPECT_EQ(at("@"), 0U);
}

TEST(Notation, MarksAgreeWithTheSearchForPartners) {
  const std::string text = "a(b[c)d]{e(}f)((g)";
  const Marks marks(text);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '(' && text[i] != '[' && text[i] != '{') continue;
    for (std::size_t to = i + 1; to <= text.size(); ++to)
      EXPECT_EQ(marks.closing(i, to), closing(text, i, to)) << i << " " << to;
  }
  EXPECT_TRUE(Marks("a;b").has_semicolon({0, 2}));
  EXPECT_FALSE(Marks("a;b").has_semicolon({2, 3}));
  EXPECT_TRUE(Marks("a<b").has_condition_operator({1, 2}));
}

}  // namespace
}  // namespace seedmesh::lsystem
