/// Warnings of check_grammar.cpp: modules, productions and parameters without effect.
#include <gmock/gmock.h>

#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> warnings_of(const LsystemParams& params) {
  Job job = job_of(0);
  const Result<Appraisal> appraisal = appraise(params, context_of(job));
  std::vector<std::string> texts;
  if (!appraisal) return {"refused: " + appraisal.error().issues[0].message};
  for (const Warning& each : appraisal->warnings) {
    texts.push_back(each.pointer + " " + std::to_string(each.line) + ":" + std::to_string(each.column) + " " +
                    each.message);
  }
  return texts;
}

/// Returns the error of generation as "pointer message".
std::string refusal_of(const LsystemParams& params, Limits limits = {}) {
  Job job = job_of(0, limits);
  try {
    const Result<Json> answer = derive(params, context_of(job));
    return answer ? "" : "at once: " + answer.error().issues[0].message;
  } catch (const Stop& stop) {
    return stop.issue().pointer + " " + stop.issue().message;
  }
}

TEST(Weights, ThatDoNotSumToOneAreReportedWithAPlainProduction) {
  EXPECT_THAT(
      warnings_of(grammar_of("F", {"F->G:0.3", "F->FF"})),
      ElementsAre(
          HasSubstr("/productions/0 0:0 the probabilities of the productions of `F` do not sum"),
          HasSubstr("/productions/1 0:0 this production of `F` is never used: `productions/0` before it "
                    "has a probability")));
  EXPECT_THAT(warnings_of(grammar_of("F", {"F->G:0.3", "F->FF:0.7"})), IsEmpty());
}

TEST(Weights, ThatDoNotSumToOneAreErrorsWhereTheyAreStrict) {
  LsystemParams params = grammar_of("F", {"F->G:0.3", "F->FF:0.6"});
  params.weights = LsystemParams::Weights::strict;
  EXPECT_THAT(
      warnings_of(params),
      ElementsAre("refused: the probabilities of the productions of `F` sum to 0.9, expected 1 because "
                  "`weights` is strict"));
  params.productions[1] = "F->FF:0.7";
  EXPECT_THAT(warnings_of(params), IsEmpty());
}

/// Contexts, conditions and weights that depend on parameters decide which productions match a module.
TEST(Weights, OfTheProductionsThatMatchAModuleSumToOneWhereTheyAreStrict) {
  const auto refused = [](const std::string& axiom, std::vector<std::string> productions) {
    LsystemParams params = grammar_of(axiom, std::move(productions));
    params.weights = LsystemParams::Weights::strict;
    return refusal_of(params);
  };
  EXPECT_EQ(refused("AF", {"A<F->G:0.4", "A<F->FF:0.6"}), "");
  EXPECT_THAT(refused("AF", {"A<F->G:0.4", "A<F->FF:0.3"}),
              HasSubstr("/productions/1 the probabilities of the productions that match `F` sum to 0.7, "
                        "expected 1 because `weights` is strict"));
  EXPECT_EQ(refused("AF", {"F->FF:0.5", "F->FG:0.5", "A<F->G:0.4", "A<F->GG:0.6"}), "")
      << "of each left side";
  EXPECT_THAT(refused("AF", {"F->FF:0.5", "F->FG:0.5", "A<F->G:0.4"}), HasSubstr("sum to 0.4"));
  EXPECT_EQ(refused("FA", {"A<F->G:0.4", "A<F->FF:0.3"}), "") << "no production matches";
  EXPECT_EQ(refused("F(0.4)", {"F(x)->G:x", "F(x)->F(x):1-x"}), "");
  EXPECT_THAT(refused("F(0.4)", {"F(x)->G:x", "F(x)->F(x):x"}), HasSubstr("sum to 0.8"));
  EXPECT_THAT(refused("F(2)", {"F(x):x>1->G:0.5", "F(x):x<1->FF:0.5"}), HasSubstr("sum to 0.5"));
}

/// Kogovšek 2014, section 3.2.2: rules with a context have priority over those without.
TEST(Weights, OfProductionsWithoutAContextCountOnlyWhereNoneWithAContextMatches) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(derived(grammar_of("AF", {"F->B:100", "A<F->C:0.1"}), seed), "AC");
    EXPECT_EQ(derived(grammar_of("FA", {"F->B:100", "A<F->C:0.1"}), seed), "BA");
  }
}

TEST(Productions, AfterOneThatAlwaysAppliesAreReported) {
  EXPECT_THAT(warnings_of(grammar_of("F", {"F->FF", "F->G"})),
              ElementsAre(HasSubstr(
                  "/productions/1 0:0 this production of `F` is never used: `productions/0` before it "
                  "always applies")));
  EXPECT_THAT(warnings_of(grammar_of("F", {"F->FF", "F->G:0.3"})), testing::SizeIs(2));
  EXPECT_THAT(warnings_of(grammar_of("F", {"G<F->FF", "F->G"})), IsEmpty());
  EXPECT_THAT(warnings_of(grammar_of("F(1)", {"F(x):x>1->F(2)", "F(x)->G"})), IsEmpty());
}

TEST(Productions, WithANumberOfParametersThatNeverOccursAreReported) {
  EXPECT_THAT(warnings_of(grammar_of("A(1)", {"A -> FA"})),
              ElementsAre(HasSubstr("/productions/0 0:0 this production is never used: `A` occurs with 1 "
                                    "parameter, and the production expects 0 parameters"),
                          HasSubstr("nothing will be drawn")));
  EXPECT_THAT(warnings_of(grammar_of("A", {"A(x,y) -> F", "A -> FB(1)", "B(x) -> F(x)", "B -> F"})),
              ElementsAre(HasSubstr("/productions/0 0:0 this production is never used: `A` occurs with 0 "
                                    "parameters, and the production expects 2 parameters"),
                          HasSubstr("/productions/3 0:0 this production is never used: `B` occurs with 1 "
                                    "parameter, and the production expects 0 parameters")));
  EXPECT_THAT(warnings_of(grammar_of("A(1)", {"A(x) : x > 1 -> A", "A -> FA(2)", "C -> F"})), IsEmpty());
}

TEST(Productions, OfATableMayHideThoseOfEveryStep) {
  LsystemParams params = grammar_of("F", {"F->FF"});
  params.tables.resize(1);
  params.tables[0].productions = {"F->G"};
  EXPECT_THAT(warnings_of(params), IsEmpty());
}

TEST(WidthRules, ReportParametersOfOtherRules) {
  LsystemParams params = grammar_of("F", {"F->FF"});
  params.width_factor = 0.25;
  params.tip_width = 0.5;
  EXPECT_THAT(
      warnings_of(params),
      ElementsAre("/width_factor 0:0 `width_factor` has no effect unless `width_rule` is branch_factor.",
                  "/tip_width 0:0 `tip_width` has no effect unless `width_rule` is longest_chain or "
                  "pipe_model."));
  params.width_rule = LsystemWidthRule::branch_factor;
  params.tip_width = LsystemParams().tip_width;
  EXPECT_THAT(warnings_of(params), IsEmpty());
}

TEST(Materials, ReportSeedsAndCutoutsWithoutTextures) {
  LsystemParams params = grammar_of("F", {"F->FF"});
  params.materials.resize(2);
  for (LsystemMaterial& each : params.materials) {
    each.color = Color{1, 2, 3};
    each.texture_seed = 5;
  }
  params.materials[1].texture = LsystemTexture::oak_bark;
  params.materials[1].images.cut_out = true;
  EXPECT_THAT(warnings_of(params),
              ElementsAre("/materials/0/texture_seed 0:0 `texture_seed` has no effect if `texture` is none.",
                          HasSubstr("`images.cut_out` has no effect unless `images.color` is given or")));
}

TEST(Lines, ReportParametersOfTubes) {
  LsystemParams params = grammar_of("F", {"F->FF"});
  params.sides = 5;
  params.adapt = true;
  EXPECT_THAT(warnings_of(params), IsEmpty());
  params.style = LsystemParams::Style::lines;
  EXPECT_THAT(warnings_of(params),
              ElementsAre(HasSubstr("/sides 0:0 `sides` has no effect unless `style` is tubes"),
                          HasSubstr("/adapt 0:0 `adapt` has no effect")));
}

TEST(Depths, OfMissingRulesAreReported) {
  LsystemParams params = grammar_of("F", {"F->FF"});
  params.interpretation_depth = 2;
  params.decomposition_depth = 3;
  EXPECT_THAT(
      warnings_of(params),
      ElementsAre(
          HasSubstr(
              "/decomposition_depth 0:0 `decomposition_depth` has no effect unless `decomposition` is given"),
          HasSubstr(
              "/interpretation_depth 0:0 `interpretation_depth` has no effect unless `interpretation` is")));
}

TEST(UnusedSettings, AreReportedWithTheirReason) {
  LsystemParams params = grammar_of("F", {"F->FF"});
  params.ring = true;
  params.rule_order = LsystemRuleOrder::listed;
  params.weights = LsystemWeights::strict;
  params.strict_predecessors = true;
  params.crown_normals = 0.5;
  EXPECT_THAT(warnings_of(params),
              ElementsAre("/ring 0:0 has no effect: no production has a context",
                          "/rule_order 0:0 has no effect: no production has a context",
                          "/weights 0:0 has no effect: no production has a probability",
                          "/strict_predecessors 0:0 has no effect: no predecessor has several modules",
                          "/crown_normals 0:0 has no effect: the plant has no organs"));
  params.surfaces["leaf"];
  params.productions = {"F<F->F~leaf", "FF->G", "G: 1 ->F"};
  params.productions.back() = "G->F : 1";
  EXPECT_THAT(warnings_of(params), testing::Not(testing::Contains(HasSubstr("has no effect"))));
}

TEST(UnusedSettings, AreTheAgeThatNoRuleUses) {
  LsystemParams params = grammar_of("A(1)", {"A(x) -> F(x)A(x+1)"});
  params.timed = true;
  EXPECT_THAT(warnings_of(params), ElementsAre("/timed 0:0 has no effect: no rule uses the name `age`"));
  params.age = 3;
  EXPECT_THAT(warnings_of(params), ElementsAre("/age 0:0 has no effect: no rule uses the name `age`"));
  params.productions = {"A(x) -> F(min(1, age - x))A(x+1)"};
  EXPECT_THAT(warnings_of(params), IsEmpty());
  params.productions = {"A(x) -> F(x)A(x+1)"};
  params.constants["half"] = std::string("age / 2");
  EXPECT_THAT(warnings_of(params), IsEmpty());
}

TEST(Weather, ReportsADirectionWithoutWind) {
  LsystemParams params = grammar_of("F", {"F->FF"});
  params.weather.emplace();
  params.weather->direction = 40;
  params.weather->stiffness = 2;
  EXPECT_THAT(warnings_of(params),
              ElementsAre(HasSubstr("/weather/direction"), HasSubstr("/weather/stiffness")));
  params.weather->snow = 4;
  EXPECT_THAT(warnings_of(params), ElementsAre(HasSubstr("/weather/direction")));
}

TEST(TurtleSymbols, WithTooFewParametersAreReported) {
  EXPECT_THAT(
      warnings_of(grammar_of("@M(1,2)F", {})),
      ElementsAre("/axiom 1:1 `@M` expects (x,y,z), found 2 parameters; the turtle ignores the symbol"));
  EXPECT_THAT(warnings_of(grammar_of("F@#F", {})),
              ElementsAre(HasSubstr("/axiom 1:2 `@#` expects (number)")));
  EXPECT_THAT(warnings_of(grammar_of("F?P(0,0)", {})), ElementsAre(HasSubstr("1:2 `?P` expects (x,y,z)")));
  EXPECT_THAT(warnings_of(grammar_of("F(1,2)", {})), IsEmpty());
  EXPECT_THAT(warnings_of(grammar_of("@M(1,2)F", {"@M(x,y)->@M(x,y,0)"})), IsEmpty());
}

TEST(TurtleSymbols, WithUselessValuesAreReported) {
  EXPECT_THAT(warnings_of(grammar_of("F@Gc(-3)", {})), ElementsAre(HasSubstr("expected 1 to 1000")));
  EXPECT_THAT(warnings_of(grammar_of("F@Gc(100000000)", {})), ElementsAre(HasSubstr("found 1e+08 strips")));
  EXPECT_THAT(warnings_of(grammar_of("@R(0,0,0)F", {})), ElementsAre(HasSubstr("no direction")));
  EXPECT_THAT(warnings_of(grammar_of("@Ts(0.3)F", {})), ElementsAre(HasSubstr("without `tropism`")));
  LsystemParams params = grammar_of("@Ts(3,.3)F", {});
  params.tropism.resize(1);
  EXPECT_THAT(warnings_of(params), ElementsAre(HasSubstr("found tropism 3 in `@Ts`; expected 0 to 0")));
}

TEST(TurtleSymbols, WithValuesThatAreRefusedAreErrorsOfTheText) {
  EXPECT_THAT(errors_of(grammar_of("F@#(3)F", {})),
              ElementsAre(HasSubstr("/axiom 1:2 found @#(3); expected 0")));
  EXPECT_THAT(errors_of(grammar_of("F", {"F->F@Dd(0)"})),
              ElementsAre("/productions/0 1:5 found a divisor of 0 in `@Dd`"));
}

TEST(TurtleSymbols, ThatAreRefusedWhileDrawingNameTheirModuleAndText) {
  EXPECT_EQ(refusal_of(grammar_of("F(1e300)", {})),
            "/axiom `F(1e+300)`: the turtle went further than 1e15 metres from its start");
  EXPECT_EQ(refusal_of(grammar_of("A(2)", {"A(x)->F@Dd(x-2)"})),
            "/productions/0 `@Dd(0)`: makes a scale or width infinite");
}

TEST(Limits, ThatADerivationPassesPointAtTheIterations) {
  Limits few;
  few.modules = 100;
  EXPECT_THAT(refusal_of(grammar_of("A(1)", {"B<A(x)->A(x)", "A(x)->A(x)A(x)"}, 20), few),
              testing::AllOf(testing::StartsWith("/iterations step "),
                             testing::EndsWith(" needs more than 100 modules, which is the limit")));
  Limits shallow;
  shallow.bracket_depth = 10;
  EXPECT_EQ(refusal_of(grammar_of("A", {"A->[A]"}, 20), shallow), "/iterations brackets nest deeper than 10");
}

TEST(Polygons, WithoutTheirOtherBraceAreReported) {
  EXPECT_THAT(warnings_of(grammar_of("F{F+F+F", {})), ElementsAre(HasSubstr("1 polygon is not closed")));
  EXPECT_THAT(warnings_of(grammar_of("F}", {})), ElementsAre(HasSubstr("found 1 `}` without a `{`")));
  EXPECT_THAT(warnings_of(grammar_of("F[{.f.]+f.}", {})), IsEmpty());
  Job job = job_of(0);
  const Result<Model> model = generate(grammar_of("F}{F", {}), context_of(job));
  ASSERT_TRUE(model);
  EXPECT_EQ(model->warnings.size(), 2U);
}

TEST(Words, ThatDrawNothingAreReportedBeforeDrawing) {
  EXPECT_THAT(warnings_of(grammar_of("A+B", {"A->[C]"})), ElementsAre(HasSubstr("nothing will be drawn")));
  EXPECT_THAT(warnings_of(grammar_of("A", {"A->F"})), IsEmpty());
}

TEST(Labels, OfTheBookAreUnderstood) {
  EXPECT_EQ(derived(grammar_of("F", {"p1 : F -> FG", "p2: G -> F"}, 2)), "FGF");
  EXPECT_EQ(derived(grammar_of("A(1)A(3)", {" p1 : A(x) : x>2 -> B", "p12:A(x)->C"})), "CB");
  EXPECT_THAT(errors_of(grammar_of("F", {"p1 : F -> F("})), ElementsAre(HasSubstr("/productions/0 1:12 ")));
  LsystemParams params = grammar_of("p1", {"p1 : 1 -> F"});
  params.modules = {"p1"};
  EXPECT_EQ(derived(params), "F");
  EXPECT_EQ(derived(grammar_of("p", {"p : 1 -> F"})), "F");
}

TEST(Words, WithASecondArrowOrAnAssignmentAreErrors) {
  EXPECT_THAT(errors_of(grammar_of("F", {"F->F->F"})),
              ElementsAre("/productions/0 1:5 found an arrow among modules; a text is one production"));
  EXPECT_THAT(errors_of(grammar_of("A(1)", {"A(n) -> n = 4; F(n)"})), ElementsAre(HasSubstr("`let m = 4;`")));
  EXPECT_EQ(derived(grammar_of("=", {"= -> =;="})), "=;=");
}

}  // namespace
}  // namespace seedmesh::lsystem
