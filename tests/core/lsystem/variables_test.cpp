/// Variables, arrays, statements between steps, strict predecessors, the order of productions.
#include <gmock/gmock.h>

#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The message of the refusal.
std::string refusal(const LsystemParams& params) {
  try {
    return derived(params);
  } catch (const Stop& stop) {
    return stop.issue().pointer + " " + stop.issue().message;
  }
}

TEST(Variables, ChangeBetweenSteps) {
  LsystemParams params = grammar_of("A(n)", {"A(x) -> A(n)B(x)"}, 3);
  params.variables = {{"n", 1.0}, {"m", "n + 1"}};
  params.start_each = "n = n * m;";
  params.end_each = "m += 1;";
  // The steps have n = 1 * 2 = 2, 2 * 3 = 6, 6 * 4 = 24.
  EXPECT_EQ(derived(params), "A(24)B(6)B(2)B(1)");
}

TEST(Variables, AreSharedByAllProductionsOfAStep) {
  LsystemParams params = grammar_of("AAB", {"A : {n = n + 1;} n > 0 -> C(n)", "B -> D(n)"}, 1);
  params.variables = {{"n", 0.0}};
  EXPECT_EQ(derived(params), "C(1)C(2)D(2)") << "from the left to the right";
  params.decomposition = {"D(x) : {n = n * 10;} -> E(n)"};
  params.end_each = "n = n + 1;";
  params.productions.emplace_back("E(x) -> G(n)");
  params.iterations = 2;
  EXPECT_EQ(derived(params), "C(1)C(2)G(21)");
}

TEST(Variables, AreHiddenByParameters) {
  LsystemParams params = grammar_of("D(3)A", {"D(n) : n > 0 -> D(n - 1)", "A -> B(n)"}, 2);
  params.variables = {{"n", 7.0}};
  EXPECT_EQ(derived(params), "D(1)B(7)");
}

TEST(Variables, AreChangedOnceByAProductionThatIsDrawn) {
  LsystemParams params =
      grammar_of("A", {"A : {n = n + 1;} -> B(n) : 0.5", "A : {n = n + 1;} -> C(n) : 0.5"}, 1);
  params.variables = {{"n", 0.0}};
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    EXPECT_THAT(derived(params, seed), testing::AnyOf("B(1)", "C(1)"));
}

TEST(Variables, ReachInterpretationRules) {
  LsystemParams params = grammar_of("A", {}, 2);
  params.variables = {{"n", 1.0}};
  params.end_each = "n = n * 3;";
  params.interpretation = {"A -> F(n)"};
  Job job = job_of(0);
  const Result<Json> answer = derive(params, context_of(job));
  ASSERT_TRUE(answer);
  EXPECT_NEAR(answer->at("turtle").at("total_length").get<double>(), 9, 1e-12);
}

TEST(Variables, HaveNamesOfTheirOwn) {
  LsystemParams params = grammar_of("A", {}, 1);
  params.constants = {{"n", 1.0}};
  params.variables = {{"n", 1.0}, {"m", "2 +"}, {"k", "k"}};
  params.arrays = {{"n", {1.0}}};
  EXPECT_THAT(errors_of(params),
              testing::UnorderedElementsAre(HasSubstr("/variables/n"), HasSubstr("/arrays/n"),
                                            HasSubstr("/variables/m"), HasSubstr("/variables/k")));
  params = grammar_of("A", {"A -> B"}, 1);
  params.start_each = "n = ;";
  params.end_each = "F";
  EXPECT_THAT(errors_of(params),
              testing::UnorderedElementsAre(HasSubstr("/start_each 1:"), HasSubstr("/end_each 1:1")));
}

TEST(Variables, NeedWholeSteps) {
  LsystemParams params = grammar_of("A", {"A -> F"}, 2);
  params.variables = {{"n", 1.0}};
  params.age = 1.5;
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("/age")));
}

TEST(Arrays, AreReadByTheirIndex) {
  LsystemParams params =
      grammar_of("A(0)", {"A(i) : list[i] < 9 -> B(list[i + 1])A(i + 1)", "A(i) -> C(list[list[0]])"}, 4);
  params.arrays = {{"list", {2.0, 5.0, 9.0, 1.0}}};
  EXPECT_EQ(derived(params), "B(5)B(9)C(9)");
}

TEST(Arrays, AreChangedByStatements) {
  LsystemParams params = grammar_of("AAA", {"A : {list[i] = i * i; i += 1;} -> B(i)"}, 2);
  params.variables = {{"i", 0.0}};
  params.arrays = {{"list", {0.0, 0.0, 0.0}}};
  params.end_each = "list[1] += 5; for (k = 0; k < 3; k++) { list[2] = list[2] + list[k]; }";
  params.interpretation = {"B(x) -> F(list[2])"};
  Job job = job_of(0);
  params.iterations = 1;
  const Result<Json> answer = derive(params, context_of(job));
  ASSERT_TRUE(answer);
  // After the productions 0, 1, 4; then 0, 6, 4; then 4 + 0, + 6 is 10, + 10 is 20. Three segments.
  EXPECT_NEAR(answer->at("turtle").at("total_length").get<double>(), 60, 1e-12);
}

TEST(Arrays, AreReadByFunctions) {
  LsystemParams params = grammar_of("A(1)", {"A(x) -> B(twice(x))"}, 1);
  params.arrays = {{"list", {2.0, 5.0}}};
  params.functions = {"twice(i) = 2 * list[i]"};
  EXPECT_EQ(derived(params), "B(10)");
}

TEST(Arrays, AreRefusedBeyondTheirEnds) {
  LsystemParams params = grammar_of("A", {"A -> B(list[2])"}, 1);
  params.arrays = {{"list", {1.0, 2.0}}};
  EXPECT_THAT(refusal(params), HasSubstr("parameter 1 of `B` became undefined"));
  params = grammar_of("A", {"A -> B"}, 1);
  params.arrays = {{"list", {1.0, 2.0}}};
  params.end_each = "list[0 - 1] = 3;";
  EXPECT_THAT(refusal(params), HasSubstr("/arrays found the index -1 of an array of 2 elements"));
  params.end_each = "x = list;";
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("`list` is an array: write `list[0]`")));
  params.end_each = "list = 3;";
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("expected a new value of an element")));
}

TEST(StrictPredecessor, IsReplacedAsAWhole) {
  LsystemParams params = grammar_of("fE(1)fE(0)f", {"fE(x) : x == 1 -> A", "fE(x) -> fB(x)"}, 1);
  params.strict_predecessors = true;
  EXPECT_EQ(derived(params), "AfB(0)f");
}

TEST(StrictPredecessor, IsMatchedWithoutModulesInBetween) {
  LsystemParams params = grammar_of("A+BA[C]BAB", {"AB -> D"}, 1);
  params.strict_predecessors = true;
  params.ignore = "+";
  EXPECT_EQ(derived(params), "A+BA[C]BD");
  params.productions = {"AA -> B"};
  params.axiom = "AAAAA";
  EXPECT_EQ(derived(params), "BBA") << "from the left, without overlaps";
}

TEST(StrictPredecessor, HasContextsOnBothSides) {
  LsystemParams params = grammar_of("X(2)A(3)B(4)Y(5)A(3)B(4)Z", {"X(x) < A(a)B(b) > Y(y) -> C(x,a,b,y)"}, 1);
  params.strict_predecessors = true;
  EXPECT_EQ(derived(params), "X(2)C(2,3,4,5)Y(5)A(3)B(4)Z");
}

TEST(StrictPredecessor, CanHoldBranches) {
  LsystemParams params = grammar_of("A[B]CA[B]D", {"A[B]C -> E[F]"}, 2);
  params.strict_predecessors = true;
  EXPECT_EQ(derived(params), "E[F]A[B]D");
  params.productions = {"[B] -> C"};
  EXPECT_EQ(derived(params), "ACCACD");
  params.productions = {"A[B -> C"};
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("found `[` without its `]`")));
}

TEST(StrictPredecessor, NeedsTheOption) {
  EXPECT_THAT(errors_of(grammar_of("AB", {"AB -> C"})),
              ElementsAre(HasSubstr("`strict_predecessors` allows")));
}

TEST(RuleOrder, CanBeThatOfTheList) {
  LsystemParams params = grammar_of("BA", {"A -> C", "B < A -> D"}, 1);
  EXPECT_EQ(derived(params), "BD");
  params.rule_order = LsystemRuleOrder::listed;
  EXPECT_EQ(derived(params), "BC");
}

TEST(Depth, MayBeGreat) {
  LsystemParams params = grammar_of("A(500)", {}, 0);
  params.decomposition = {"A(n) : n > 0 -> FA(n - 1)"};
  params.decomposition_depth = 1000;
  EXPECT_EQ(derived(params), std::string(500, 'F') + "A(0)");
  params = grammar_of("A(900)", {}, 0);
  params.interpretation = {"A(n) : n > 0 -> FA(n - 1)"};
  params.interpretation_depth = 1000;
  Job job = job_of(0);
  const Result<Json> answer = derive(params, context_of(job));
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->at("turtle").at("segments"), 900);
}

}  // namespace
}  // namespace seedmesh::lsystem
