#include <gmock/gmock.h>

#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Notation, TakesEveryArrowAndAnySpacing) {
  for (const char* production : {"A->AB", "A --> AB", "A ~> AB", "A→AB", "  A  ->  A B  ", "A-->AB"}) {
    EXPECT_EQ(derived(grammar_of("A", {production})), "AB") << production;
  }
}

TEST(Notation, RewritesTheTurnsThemselves) {
  EXPECT_EQ(derived(grammar_of("+-", {"+ -> -", "- -> +"})), "-+");
  EXPECT_EQ(derived(grammar_of("-", {"--> F"})), "F");
}

TEST(Notation, ErasesByAnEmptySideAStarOrEpsilon) {
  for (const char* production : {"A ->", "A -> *", "A -> ε", "A->  "}) {
    EXPECT_EQ(derived(grammar_of("BAB", {production})), "BB") << production;
  }
}

TEST(Notation, CountsASymbolWithItsAtSignAsOne) {
  EXPECT_EQ(derived(grammar_of("@vA", {"@v -> B", "v -> C"})), "BA");
}

TEST(Notation, KeepsColonsAndContextMarksInsideParentheses) {
  EXPECT_EQ(derived(grammar_of("A(2)", {"A(x) : x<3 -> A(x>1) : 1"})), "A(1)");
}

TEST(Notation, KeepsBracketsAfterATruncatedCharacter) {
  EXPECT_EQ(derived(grammar_of("F\xE2[+F]", {"A < B -> C"})), "F\xE2[+F]");
}

TEST(GrammarErrors, RefuseABracketWithParameters) {
  EXPECT_THAT(errors_of(grammar_of("F[(1)F]", {"A < B -> C"})),
              ElementsAre("/axiom 1:2 found parameters of a bracket; it takes none"));
  EXPECT_THAT(errors_of(grammar_of("F", {"F -> [F](2)"})),
              ElementsAre(StartsWith("/productions/0 1:8 found parameters of a bracket")));
}

TEST(GrammarErrors, PointAtTheCharacter) {
  EXPECT_THAT(errors_of(grammar_of("F", {"F -> F[+F"})),
              ElementsAre("/productions/0 1:7 found `[` without its `]`"));
  EXPECT_THAT(errors_of(grammar_of("F", {"F -> F]"})),
              ElementsAre(StartsWith("/productions/0 1:7 found `]`")));
  EXPECT_THAT(errors_of(grammar_of("F", {"F F"})),
              ElementsAre(StartsWith("/productions/0 1:1 found no arrow")));
  EXPECT_THAT(errors_of(grammar_of("A(1)", {"A(x) → A(y)"})),
              ElementsAre(StartsWith("/productions/0 1:10 ")));
}

TEST(GrammarErrors, ComeAllAtOnce) {
  LsystemParams params = grammar_of("F)", {"F F", "F -> F(1", "G -> F : -1"});
  params.constants = {{"a", "b+"}, {"b", "b"}};
  EXPECT_GE(errors_of(params).size(), 6U);
}

TEST(GrammarErrors, NameAPredecessorThatIsMissingOrDouble) {
  EXPECT_THAT(errors_of(grammar_of("F", {"-> F"})), ElementsAre(HasSubstr("no predecessor")));
  EXPECT_THAT(errors_of(grammar_of("F", {"AB -> F"})), ElementsAre(HasSubstr("found 2 modules")));
  EXPECT_THAT(errors_of(grammar_of("F", {"[ -> F"})), testing::Not(IsEmpty()));
}

TEST(GrammarErrors, HintThatARightContextTakesTheOtherMark) {
  EXPECT_THAT(errors_of(grammar_of("F", {"A < B < C -> D"})),
              ElementsAre(HasSubstr("right context is written after `>`")));
}

TEST(GrammarErrors, RefuseBracketsInALeftContext) {
  EXPECT_THAT(errors_of(grammar_of("F", {"A[B] < C -> D"})),
              ElementsAre(HasSubstr("bracket in a left context")));
}

TEST(GrammarErrors, RefuseAParameterNamedTwice) {
  EXPECT_THAT(errors_of(grammar_of("A(1,2)", {"A(x,x) -> A(x,x)"})), ElementsAre(HasSubstr("named twice")));
}

TEST(GrammarErrors, RefuseSymbolsOutsideTheAlphabetAtTheirColumn) {
  LsystemParams params = grammar_of("FX", {"X -> F[+Y]"});
  params.alphabet = LsystemParams::Alphabet{"FX", "[]+"};
  EXPECT_THAT(errors_of(params), ElementsAre("/productions/0 1:9 found `Y`, which is not in the alphabet"));
}

TEST(Constants, ResolveInAnyOrder) {
  LsystemParams params = grammar_of("F(h)", {}, 0);
  params.constants = {{"h", "(p*q)^0.5"}, {"q", "c-p"}, {"p", 0.3}, {"c", 1.0}};
  EXPECT_EQ(derived(params), "F(0.458258)");
}

TEST(Constants, RefuseACircleByName) {
  LsystemParams params = grammar_of("F", {}, 0);
  params.constants = {{"a", "b+1"}, {"b", "a"}};
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("a -> b -> a")));
}

TEST(Constants, RefuseDivisionByZero) {
  LsystemParams params = grammar_of("F", {}, 0);
  params.constants = {{"a", "1/0"}};
  EXPECT_THAT(errors_of(params), ElementsAre(StartsWith("/constants/a")));
}

TEST(Weights, ThatDoNotSumToOneAreReported) {
  Job job = job_of(0);
  const Result<Json> answer = derive(grammar_of("F", {"F -> F : 10", "F -> FF : 10"}), context_of(job));
  ASSERT_TRUE(answer);
  ASSERT_EQ(answer->at("warnings").size(), 1U);
  EXPECT_EQ(answer->at("warnings")[0].at("pointer"), "/productions/0");
}

TEST(Commands, AllDrawTheirExample) {
  for (const CommandRow& row : commands()) {
    LsystemParams params = grammar_of(std::string(row.example), {}, 0);
    params.surfaces["leaf"] = {};
    EXPECT_THAT(errors_of(params), IsEmpty()) << row.symbol;
    EXPECT_THAT(std::string(row.example), HasSubstr(std::string(row.symbol)));
    Job job = job_of(0);
    EXPECT_TRUE(derive(params, context_of(job))) << row.symbol;
  }
}

}  // namespace
}  // namespace seedmesh::lsystem
