#include <gmock/gmock.h>

#include "core/generators/lsystem/growth.h"
#include "core/generators/lsystem/table.h"
#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

TEST(Derive, RewritesAllModulesAtOnce) {
  EXPECT_EQ(derived(grammar_of("b", {"a -> ab", "b -> a"}, 5)), "abaababa");
}

TEST(Derive, MatchesByNameAndNumberOfParameters) {
  EXPECT_EQ(derived(grammar_of("AA(1)A(1,2)", {"A(x) -> B(x)"})), "AB(1)A(1,2)");
}

TEST(Derive, TakesTheFirstProductionThatMatches) {
  EXPECT_EQ(derived(grammar_of("A(5)", {"A(x) : x>3 -> B", "A(x) -> C"})), "B");
  EXPECT_EQ(derived(grammar_of("A(1)", {"A(x) : x>3 -> B", "A(x) -> C"})), "C");
}

TEST(Derive, PrefersContextsAndThenTheOrderOfTheFile) {
  EXPECT_EQ(derived(grammar_of("BA", {"A -> C", "B < A -> D"})), "BD");
}

TEST(Derive, LeavesModulesWithoutAMatchAsTheyAre) {
  EXPECT_EQ(derived(grammar_of("A(0)", {"A(x) : x>0 -> A(x-1)F"}, 7)), "A(0)");
  EXPECT_EQ(derived(grammar_of("A(3)", {"A(x) : x>0 -> A(x-1)F"}, 7)), "A(0)FFF");
}

TEST(Derive, CutsTheRestOfABranchInTheStepAfterTheCutWasWritten) {
  EXPECT_EQ(derived(grammar_of("[AF]G", {"A -> B%"}, 1)), "[B%F]G");
  EXPECT_EQ(derived(grammar_of("[AF]G", {"A -> B%"}, 2)), "[B]G");
  EXPECT_EQ(derived(grammar_of("[A[FA]F]G", {"A -> B%"}, 2)), "[B]G");
  EXPECT_EQ(derived(grammar_of("F[A]F%F", {"A -> AA"}, 2)), "F[AAAA]F");
}

TEST(Derive, ReachesTheSameWordWithAndWithoutTheWholeWord) {
  LsystemParams random =
      grammar_of("A(1)",
                 {"A(x) : x<4 -> [+A(x+ran(0,1))]F(x)A(x+1) : 2", "A(x) : x<4 -> A(x*1.5)F : 1",
                  "F(l) -> F(l*1.1)", "F -> F%F : 0.3", "F -> FF : 0.7"},
                 6);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    EXPECT_EQ(derived(random, seed), derived_as_word(random, seed)) << "seed " << seed;
  }
}

TEST(Derive, CopiesPlainWordsToTheSameText) {
  const LsystemParams plain = grammar_of("F-X", {"X -> F[+X]F[-X]+X", "F -> FF", "- -> "}, 6);
  EXPECT_EQ(derived(plain), derived_as_word(plain));
}

TEST(RandomChoice, FollowsTheWeightsOfTheMatchingSet) {
  const LsystemParams params = grammar_of("AAAAAAAAAA", {"A -> B : 10", "A -> C : 30"});
  int b = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    for (const char c : derived(params, seed)) b += c == 'B';
  }
  EXPECT_NEAR(b / 4000.0, 0.25, 0.03);
}

TEST(RandomChoice, ChoosesAnewForEachModuleAndStep) {
  const std::string word = derived(grammar_of("AAAAAAAAAAAAAAAAAAAAAAAA", {"A -> B : 1", "A -> C : 1"}), 3);
  EXPECT_NE(word.find('B'), std::string::npos);
  EXPECT_NE(word.find('C'), std::string::npos);
}

TEST(RandomChoice, IsNotMovedByAnEditElsewhere) {
  const auto first_branch = [](const std::string& word) { return word.substr(0, word.find(']')); };
  const std::vector<std::string> rules = {"A -> F[+A]A : 1", "A -> FA : 1", "A -> F : 1"};
  std::vector<std::string> edited = rules;
  edited.push_back("B -> FFFF++B");
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    EXPECT_EQ(first_branch(derived(grammar_of("[A][B]", rules, 6), seed)),
              first_branch(derived(grammar_of("[A][+B]", edited, 6), seed)));
  }
}

TEST(Contexts, LeadLeftThroughABranchAndPastSiblings) {
  EXPECT_EQ(derived(grammar_of("A[B]C", {"A < C -> Z"})), "A[B]Z");
  EXPECT_EQ(derived(grammar_of("A[B]C", {"B < C -> Z"})), "A[B]C");
  EXPECT_EQ(derived(grammar_of("A[[B]C]", {"A < C -> Z"})), "A[[B]Z]");
}

TEST(Contexts, StopRightAtTheEndOfABranch) {
  EXPECT_EQ(derived(grammar_of("A[B]C", {"B > C -> Z"})), "A[B]C");
  EXPECT_EQ(derived(grammar_of("A[B]C", {"A > C -> Y", "A > B -> Z"})), "Y[B]C");
}

TEST(Contexts, MatchTheBeginningOfANamedBranch) {
  EXPECT_EQ(derived(grammar_of("ABC[DE][SG[HI[JK]L]MNO]", {"BC < S > G[H]M -> Z"})),
            "ABC[DE][ZG[HI[JK]L]MNO]");
  EXPECT_EQ(derived(grammar_of("S[A][B]C", {"S > [B]C -> Z"})), "Z[A][B]C");
  EXPECT_EQ(derived(grammar_of("S[A]C", {"S > [B]C -> Z"})), "S[A]C");
}

TEST(Contexts, PassOverIgnoredSymbolsButNeverBrackets) {
  LsystemParams params = grammar_of("B+A", {"B < A -> Z"});
  EXPECT_EQ(derived(params), "B+A");
  params.ignore = "+[]";
  EXPECT_EQ(derived(params), "B+Z");
}

TEST(Contexts, BindTheirParameters) {
  EXPECT_EQ(derived(grammar_of("A(4)B(5)C(6)", {"A(x) < B(y) > C(z) : x+y+z>10 -> E((x+y)/2)F((y+z)/2)"})),
            "A(4)E(4.5)F(5.5)C(6)");
}

TEST(Contexts, OfOneSymbolRunFromATableToTheSameWord) {
  LsystemParams params = grammar_of(
      "F1F1F1",
      {"0 < 0 > 0 -> 0", "0 < 0 > 1 -> 1[+F1F1]", "0 < 1 > 0 -> 1", "0 < 1 > 1 -> 1", "1 < 0 > 0 -> 0",
       "1 < 0 > 1 -> 1F1", "1 < 1 > 0 -> 0", "1 < 1 > 1 -> 0", "+ -> -", "- -> +"},
      20);
  params.ignore = "+-F";
  std::vector<Issue> issues;
  ASSERT_TRUE(TableRewriter::fits(compile(params, 0, Limits{}, issues)));
  EXPECT_EQ(derived(params), derived_as_word(params));
}

TEST(Growth, CountsPlainSystemsExactly) {
  std::vector<Issue> issues;
  const Grammar grammar = compile(grammar_of("X", {"X -> F[+X]F[-X]+X", "F -> FF"}), 0, Limits{}, issues);
  const std::vector<std::uint64_t> counts = exact_counts(grammar, 12);
  std::uint64_t sum = 0;
  for (const std::uint64_t each : counts) sum += each;
  EXPECT_EQ(sum, 3446171U);
  EXPECT_EQ(least_modules(grammar, 12), 3446171U);
}

TEST(Growth, RefusesAnExplosionBeforeItStarts) {
  Job job = job_of(0);
  EXPECT_THROW((void)derive(grammar_of("F", {"F -> FFFFFFFFFF"}, 30), context_of(job)), Stop);
  EXPECT_EQ(job.budget()->used(), 0U);
}

TEST(Growth, StopsAnExplosionThatRandomChoicesHide) {
  Limits limits;
  limits.modules = 100'000;
  Job job = job_of(0, limits);
  EXPECT_THROW((void)derive(grammar_of("F", {"F -> FFFFFFFFFF : 1", "F -> F : 0.0001"}, 30), context_of(job)),
               Stop);
  Job other = job_of(0, limits);
  EXPECT_THROW(
      (void)derive(grammar_of("AF", {"A < F -> FFFFFFFFFF", "F -> FFFFFFFF"}, 30), context_of(other)), Stop);
}

TEST(Growth, RefusesMoreSegmentsThanTrianglesAllowBeforeItDraws) {
  Job job = job_of(0);
  LsystemParams whole = grammar_of("F", {"F -> F+F-F+F"}, 12);
  whole.share = LsystemParams::Share::never;
  EXPECT_THROW((void)generate(whole, context_of(job)), Stop);
  EXPECT_EQ(job.budget()->used(), 0U);
  Limits limits;
  limits.triangles = 16 * 100;
  Job random = job_of(0, limits);
  EXPECT_THROW((void)generate(grammar_of("F", {"F -> FF : 1", "F -> FFF : 1"}, 9), context_of(random)), Stop);
}

TEST(Growth, RefusesGrammarsOfMillionsOfModulesWhileTheyAreRead) {
  EXPECT_EQ(errors_of(grammar_of(std::string(3'000'000, 'F'), {})).size(), 1U);
}

TEST(Numbers, ThatAreNotFiniteAreRefusedAtTheirProduction) {
  for (const char* axiom : {"F(0/0)", "F(1/0)", "F(1e308)F(1e308)F(1e308)"}) {
    Job job = job_of(0);
    try {
      const Result<Json> answer = derive(grammar_of(axiom, {}, 0), context_of(job));
      FAIL() << axiom << " derived";
    } catch (const Stop& stop) {
      EXPECT_EQ(stop.code(), Code::invalid);
    }
  }
}

TEST(Interpretation, DrawsWithoutEnteringTheWord) {
  LsystemParams params = grammar_of("L", {"L -> LL"}, 3);
  params.interpretation = {"L -> F+F"};
  Job job = job_of(0);
  const Result<Json> answer = derive(params, context_of(job));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->at("string"), "LLLLLLLL");
  EXPECT_EQ(answer->at("turtle").at("segments"), 16);
}

TEST(Interpretation, GivesParametersToWordsThatHaveNone) {
  LsystemParams params = grammar_of("J[+I]I", {"J < I -> J"});
  params.interpretation = {"I -> ;(0)F", "J -> ;(1)F"};
  Job job = job_of(0);
  const Result<Json> answer = derive(params, context_of(job));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->at("turtle").at("segments"), 3);
}

TEST(Width, ThinsByTheStepInWhichASegmentWasWritten) {
  LsystemParams params = grammar_of("FA", {"A -> FA"}, 3);
  params.width.value = 1;
  params.width_decrement = 0.2;
  params.width_rule = LsystemParams::WidthRule::decrement;
  Job job = job_of(0);
  std::vector<Issue> issues;
  const Grammar grammar = compile(params, 0, Limits{}, issues);
  std::vector<std::uint32_t> steps;
  struct Steps {
    std::vector<std::uint32_t>& steps;
    void module(KindId, const double*, std::uint64_t, std::uint32_t step) { steps.push_back(step); }
  } sink{steps};
  ContextFreeDerivation<Steps>(grammar, 3, false, job, sink).run();
  EXPECT_THAT(steps, testing::ElementsAre(0, 1, 2, 3, 3));
}

}  // namespace
}  // namespace seedmesh::lsystem
