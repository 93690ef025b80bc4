/// Statements in successors: loops, conditionals, locals, functions.
#include <gmock/gmock.h>

#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Loop, WritesItsBodyInEveryIteration) {
  EXPECT_EQ(derived(grammar_of("A(2)", {"A(n) -> for(i=0;i<=n;i++){ B(i) }"})), "B(0)B(1)B(2)");
  EXPECT_EQ(derived(grammar_of("A(3)", {"A(n) -> F for (i = n; i > 0; i--) { [+(i)F] } F"})),
            "F[+(3)F][+(2)F][+(1)F]F");
  EXPECT_EQ(derived(grammar_of("A(9)", {"A(n) -> for(i=1;i<n;i*=2)B(i)C"})), "B(1)B(2)B(4)B(8)C");
}

TEST(Loop, TakesOneModuleOrOneBranchWithoutBraces) {
  EXPECT_EQ(derived(grammar_of("A(1)", {"A(n) -> for(i = 0; i <= n; i++) BC"})), "BBC");
  EXPECT_EQ(derived(grammar_of("A(1)", {"A(n) -> for(i = 0; i <= n; i++) [BC]D"})), "[BC][BC]D");
  EXPECT_EQ(derived(grammar_of("A(1)", {"A(n) -> for(i=0;i<2;i++) for(k=0;k<=i;k++) B(i,k)"})),
            "B(0,0)B(1,0)B(1,1)");
}

TEST(Loop, KeepsPolygonsInItsBody) {
  EXPECT_EQ(derived(grammar_of("A", {"A -> for(i=0;i<2;i++){ {.f.} }"})), "{.f.}{.f.}");
}

TEST(Loop, RunsWhileItsConditionIsTrue) {
  EXPECT_EQ(derived(grammar_of("A(20)", {"A(n) -> let x = n; while (x > 1) { F(x) x /= 2; } G(x)"})),
            "F(20)F(10)F(5)F(2.5)F(1.25)G(0.625)");
}

TEST(Choice, TakesOneOfTwo) {
  const LsystemParams params =
      grammar_of("A(1)A(5)A(9)", {"A(n) -> F if (n < 3) { B } else if (n < 7) { C } else [D] E"});
  EXPECT_EQ(derived(params), "FBEFCEF[D]E");
}

TEST(Choice, IsNoneWhereTheOlderNotationHasModules) {
  EXPECT_EQ(derived(grammar_of("A", {"A -> if(2)F"})), "if(2)F");
  EXPECT_EQ(derived(grammar_of("A", {"A -> for(2)F"})), "for(2)F");
  EXPECT_EQ(derived(grammar_of("A(2)", {"A(n) -> n++F"})), "n++F");
  EXPECT_EQ(derived(grammar_of("A(2)", {"A(n) -> if(n==2)F"})), "F");
}

TEST(Local, KeepsItsValueAndHidesOuterNames) {
  LsystemParams params = grammar_of("A(3)", {"A(x) -> let y = x * k; F(y) let k = y + 1; F(k) A(x)"});
  params.constants = {{"k", 2.0}};
  EXPECT_EQ(derived(params), "F(6)F(7)A(3)");
}

TEST(Local, EndsWithItsBlock) {
  EXPECT_THAT(errors_of(grammar_of("A", {"A -> if (1 > 0) { let y = 2; F(y) } F(y)"})),
              ElementsAre(HasSubstr("1:39 unknown name `y`")));
}

TEST(Local, CanBeSetAroundTheConditionAsInCpfg) {
  EXPECT_EQ(derived(grammar_of("A(1.5)A(0.5)", {"A(t) : {t=t-1;} t>0 {x=2*t;} -> F(x)A(t)"})),
            "F(1)A(0.5)A(0.5)");
  EXPECT_EQ(derived(grammar_of("A(3)", {"A(t) : {if(t>2){t=2;}} -> A(t)"})), "A(2)");
}

TEST(Function, IsKnownInEveryExpression) {
  LsystemParams params = grammar_of("A(twice(2))", {"A(x) : twice(x) > 7 -> F(area(x, k))"});
  params.functions = {"twice(a) = a * 2", "area(w, h) = twice(w * h)"};
  params.constants = {{"k", 0.5}};
  EXPECT_EQ(derived(params), "F(4)");
}

TEST(Function, ReportsItsErrorsAtItsOwnPosition) {
  LsystemParams params = grammar_of("A(f(1))", {"A(x) -> F(g(x))"});
  params.functions = {"f(a) = a + b", "g(a) = h(a)", "h(a) = g(a)", "sin(a) = a"};
  EXPECT_THAT(errors_of(params),
              ElementsAre(HasSubstr("/functions/0 1:12 unknown name `b`"),
                          HasSubstr("/functions/1 1:8 `h`: `g`: `h` calls itself"),
                          StartsWith("/functions/3 1:1 `sin` is the name of a built-in function")));
}

TEST(Statements, ReportTheirErrorsAtTheirColumn) {
  const auto errors = [](const char* successor) {
    return errors_of(grammar_of("A(1)", {std::string("A(n) -> ") + successor}));
  };
  EXPECT_THAT(errors("for(i=0;i<n){F}"), Contains(HasSubstr("1:12 expected `(start; condition; change)`")));
  EXPECT_THAT(errors("for(i=0;i<m;i++){F}"), Contains(HasSubstr("unknown name `m`")));
  EXPECT_THAT(errors("for(i=0;i<n;j++){F}"), Contains(HasSubstr("`j` has no value yet")));
  EXPECT_THAT(errors("while(n<2){F"), Contains(HasSubstr("found `{` without its `}`")));
  EXPECT_THAT(errors("let x = n F(x)"), Contains(HasSubstr("without its `;`")));
  EXPECT_THAT(errors("for(i=0;i<n;i++){[F}]"), Contains(HasSubstr("in the same block")));
  EXPECT_THAT(errors("if(n<2)"), Contains(HasSubstr("expected a module or `{`")));
}

TEST(Statements, StopAtTheLimitOfModules) {
  Limits limits;
  limits.modules = 1000;
  for (const char* successor : {"while(1>0){}", "while(1>0){F}", "for(i=0;i<10;i--){ if(i>5) F }"}) {
    Job job = job_of(0, limits);
    EXPECT_THROW((void)derive(grammar_of("A", {std::string("A -> ") + successor}), context_of(job)), Stop)
        << successor;
  }
  LsystemParams params = grammar_of("A", {}, 0);
  params.interpretation = {"A -> while(1>0){}"};
  Job job = job_of(0, limits);
  EXPECT_THROW((void)derive(params, context_of(job)), Stop);
}

TEST(Statements, UseSeparateRandomValuesInEveryIteration) {
  LsystemParams params = grammar_of("A", {"A -> for(i=0;i<4;i++){ F(ran(1)) }"});
  const std::string four = derived(params, 7);
  params.productions = {"A -> for(i=0;i<6;i++){ F(ran(1)) }"};
  const std::string six = derived(params, 7);
  EXPECT_EQ(six.substr(0, four.size()), four)
      << "more iterations do not change the random values of the first";
  EXPECT_NE(four.substr(0, four.size() / 4), four.substr(four.size() / 4, four.size() / 4));
  EXPECT_NE(derived(params, 8), six);
}

TEST(Statements, WorkInInterpretationToo) {
  LsystemParams params = grammar_of("A(3)", {}, 0);
  params.interpretation = {"A(n) -> for(i=0;i<n;i++){ F(i+1) }"};
  Job job = job_of(0);
  const Result<Json> answer = derive(params, context_of(job));
  EXPECT_EQ(answer->at("string"), "A(3)");
  EXPECT_EQ(answer->at("turtle").at("total_length"), 6);
}

// Kogovšek 2014, rules 3.3 to 3.10; in 3.4 and 3.5 the right contexts are written after `>`.
TEST(Kogovsek, ReplacesALongBranch) {
  EXPECT_EQ(derived(grammar_of("FFFF", {"FF < F -> D"})), "FFDD");
  EXPECT_EQ(derived(grammar_of("FFCD", {"F > CD -> C"})), "FCCD");
  EXPECT_EQ(derived(grammar_of("FFFD", {"FF < F > D -> C"})), "FFCD");
}

TEST(Kogovsek, NarrowsABranchAtEveryThirdStep) {
  const std::vector<std::string> rules = {"F(dol, deb) : dol mod 3 == 0 -> F(dol + 1, deb/2)",
                                          "F(dol, deb) : dol mod 3 > 0 -> F(dol + 1, deb)"};
  EXPECT_EQ(derived(grammar_of("F(1,8)", rules, 3)), "F(4,4)");
  EXPECT_EQ(derived(grammar_of("F(1,8)", rules, 6)), "F(7,2)");
}

TEST(Kogovsek, RepeatsAModuleInALoop) {
  EXPECT_EQ(derived(grammar_of("A(2)", {"A(n) -> for(i = 0; i <= n; i++) B"})), "BBB");
}

}  // namespace
}  // namespace seedmesh::lsystem
