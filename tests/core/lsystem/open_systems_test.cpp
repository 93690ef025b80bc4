/// Open L-systems: answers to queries, and pruning by the environment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

LsystemParams::Environment inside(LsystemParams::SolidShape shape, std::array<double, 3> size) {
  LsystemParams::Environment environment;
  LsystemParams::Solid guide;
  guide.solid_shape = shape;
  guide.size = size;
  environment.solids.push_back(guide);
  return environment;
}

Box bounds_of_drawing(LsystemParams params) {
  params.style = LsystemParams::Style::lines;
  Job job = job_of(1);
  const Result<Model> model = generate(params, context_of(job));
  EXPECT_TRUE(model) << model.error().issues[0].message;
  return bounds_of(*model);
}

TEST(OpenSystems, ReportsThePositionOfTheTurtle) {
  EXPECT_EQ(derived(grammar_of("F(2)+(90)F?P(0,0,0)?H(0,0,0)?L(0,0,0)?U(0,0,0)", {}, 0)),
            "F(2)+(90)F?P(-1,2,0)?H(-1,0,0)?L(0,-1,0)?U(0,0,1)");
}

TEST(OpenSystems, AnswersInTheNextStep) {
  LsystemParams params = grammar_of("?E(1)A", {"?E(x) < A : x == 1 -> F?E(1)A", "?E(x) -> "}, 5);
  params.environment = inside(LsystemParams::SolidShape::box, {4, 3.5, 4});
  EXPECT_EQ(derived(params), "FFFA") << "three steps of one metre fit into three and a half";
}

TEST(OpenSystems, RunsRulesThreeNineAndThreeTenOfKogovsek) {
  LsystemParams params = grammar_of(
      "F(1)?E(r2)A(1)", {"?E(x) < A(v) : x == 1 -> [+(a2)F(v*r2)?E(r2)A(v*r2)]-(a2)", "?E(x) -> "}, 2);
  params.constants = {{"r2", 0.5}, {"a2", 30.0}};
  EXPECT_EQ(derived(params).substr(0, 30), "F(1)[+(30)F(0.5)[+(30)F(0.25)?");
}

TEST(OpenSystems, ReportsTheDistanceNowAndAfterTheStep) {
  LsystemParams params = grammar_of("F(0.5)?E(1,0,0)", {}, 0);
  params.environment = inside(LsystemParams::SolidShape::box, {10, 1, 10});
  EXPECT_EQ(derived(params), "F(0.5)?E(0,0.5,-0.5)");
}

TEST(OpenSystems, ReportsTheDirectionToTheSurface) {
  LsystemParams params = grammar_of("F(0.5)?E(1,0,0,0,0,0,0)", {}, 0);
  params.environment.emplace();
  LsystemParams::Solid post;
  post.role = LsystemParams::Role::obstacle;
  post.solid_shape = LsystemParams::SolidShape::cylinder;
  post.position = {3, 0, 0};
  post.size = {2, 10, 2};
  params.environment->solids.push_back(post);
  EXPECT_EQ(derived(params), "F(0.5)?E(1,2,2,1,1,0,0)");
}

TEST(OpenSystems, FindsWhatHasGrownButNotItsOwnStem) {
  const auto answer = [](const char* axiom) {
    const std::string word = derived(grammar_of(axiom, {}, 0));
    return word.substr(word.find("?E"), 5);
  };
  EXPECT_EQ(answer("F(1)?E(1)"), "?E(1)");
  EXPECT_EQ(answer("F(1)[+(90)F(1)]-(90)?E(1)F(1)"), "?E(1)") << "siblings do not count";
  EXPECT_EQ(answer("[F(2)]@M(-1,1,0)@R(1,0,0)F(0.5)?E(1)"), "?E(0)") << "a stem blocks the step";
  EXPECT_EQ(answer("[F(2)]@M(-1,1,0)@R(1,0,0)F(0.5)?E(0.3)"), "?E(1)");
  for (const char* own : {"?E(1)F", "@M(5,0,0)?E(1)F", "F?E(1)F", "F?E(1)FF", "F?E(1)f(0.5)F", "F?E(1)F[+F]F",
                          "[?E(1)F][+F]", "F[+?E(1)FF[-F]F]FF", "!(2)FF(0.1)F(0.1)F(0.1)F(0.1)?E(1)F"}) {
    EXPECT_EQ(answer(own), "?E(1)") << own << " has its own internode before it";
  }
  EXPECT_EQ(answer("F[+(90)F-(90)FF]F+(90)?E(1.5)"), "?E(0)") << "another's";
}

TEST(OpenSystems, ReportsNoNegativeZero) {
  EXPECT_EQ(derived(grammar_of("?E(1,0,0,0,0,0,0)", {}, 0)).find('-'), std::string::npos);
  LsystemParams params = grammar_of("F(1)?E(0.5,0,0,0,0,0,0)", {}, 0);
  params.environment = inside(LsystemParams::SolidShape::box, {10, 1, 10});
  EXPECT_EQ(derived(params).find("-0,"), std::string::npos) << "on the surface the distance is 0";
}

TEST(OpenSystems, AnswersWhereLinesAreDrawn) {
  LsystemParams params = grammar_of("F?E(1)F[+F]F", {}, 1);
  params.style = LsystemParams::Style::lines;
  EXPECT_EQ(derived(params), "F?E(1)F[+F]F");
}

TEST(OpenSystems, LeavesLessLightBelowOthers) {
  const std::string lit = derived(grammar_of("F(0.1)?E(1,0,0,0)", {}, 0));
  EXPECT_EQ(lit, "F(0.1)?E(1,1e+09,1e+09,1)");
  const std::string shaded = derived(grammar_of("[f(2)F(0.1)]F(0.1)?E(1,0,0,0)", {}, 0));
  EXPECT_NE(shaded.substr(shaded.size() - 3), ",1)");
}

TEST(OpenSystems, CutsWhatLeavesTheGuide) {
  LsystemParams params = grammar_of("FFFF[+(90)F]", {}, 0);
  params.environment = inside(LsystemParams::SolidShape::box, {10, 2.6, 10});
  EXPECT_FLOAT_EQ(bounds_of_drawing(params).max.y, 3) << "the centre of the third is at 2.5";
  params.environment->membership = LsystemParams::Membership::whole;
  EXPECT_FLOAT_EQ(bounds_of_drawing(params).max.y, 2);
  params.environment->membership = LsystemParams::Membership::clipped;
  EXPECT_NEAR(bounds_of_drawing(params).max.y, 2.6, 1e-4);
}

TEST(OpenSystems, CutsCrossSectionsWithTheirLimbs) {
  LsystemParams params = grammar_of("[@#(1)+(60)FFFF]@#(0)FF@#(1)F", {}, 0);
  params.environment = inside(LsystemParams::SolidShape::box, {2, 10, 2});
  params.contours = {{{0.9, 0.1}, {-0.5, 0.8}, {-0.5, -0.8}}};
  Job job = job_of(1);
  const Result<Model> model = generate(params, context_of(job));
  ASSERT_TRUE(model);
  EXPECT_FLOAT_EQ(bounds_of(*model).max.y, 3);
}

TEST(OpenSystems, MeasuresWhatRemainsOfTheDrawing) {
  LsystemParams params = grammar_of("A", {"A -> FA"}, 10);
  params.environment = inside(LsystemParams::SolidShape::box, {2, 4, 2});
  const auto report = [&] {
    Job job = job_of(1);
    return derive(params, context_of(job))->at("turtle");
  };
  EXPECT_EQ(report().at("segments"), 4);
  EXPECT_EQ(report().at("total_length"), 4);
  EXPECT_EQ(report().at("bounds").at("max")[1], 4);
  params.age = 2.5;
  EXPECT_EQ(report().at("segments"), 3);
  EXPECT_EQ(report().at("total_length"), 2.5) << "as it is drawn at its age";
}

TEST(OpenSystems, GrowsCompanionsStepByStep) {
  // Each plant queries whether its next step is free; the two meet in the middle.
  LsystemParams params =
      grammar_of("@R(1,0,0)F(0.5)?E(1)A", {"?E(x) < A : x == 1 -> F(1)?E(1)A", "?E(x) -> "}, 9);
  params.environment.emplace();
  LsystemParams::Companion other;
  other.position = {8, 0, 0};
  other.system.generator = "lsystem";
  other.system.parameters =
      R"({"axiom":"@R(-1,0,0)F(0.5)?E(1)A","productions":["?E(x) < A : x == 1 -> F(1)?E(1)A","?E(x) -> "],"iterations":9})";
  params.environment->companions.push_back(other);
  EXPECT_EQ(derived(params), "@R(1,0,0)F(0.5)F(1)F(1)F(1)A");
  const Box box = bounds_of_drawing(params);
  EXPECT_FLOAT_EQ(box.min.x, 0);
  EXPECT_FLOAT_EQ(box.max.x, 8);
}

TEST(OpenSystems, ReportsWhatTheSchemaCannot) {
  LsystemParams params = grammar_of("F", {}, 0);
  params.environment = inside(LsystemParams::SolidShape::mesh, {1, 1, 1});
  params.environment->solids.push_back(params.environment->solids[0]);
  params.environment->solids[1].glb = "no uri";
  params.environment->solids.push_back(inside(LsystemParams::SolidShape::box, {1, 1, 1}).solids[0]);
  params.environment->solids[2].role = LsystemParams::Role::host;
  LsystemParams::Companion other;
  other.system.generator = "tree";
  params.environment->companions.push_back(other);
  std::vector<std::string> pointers;
  for (const Issue& issue : check(params, Limits{})) pointers.push_back(issue.pointer);
  EXPECT_EQ(pointers, (std::vector<std::string>{"/environment/solids/0", "/environment/solids/1/glb",
                                                "/environment/solids/2/shape",
                                                "/environment/companions/0/system/generator"}));
}

}  // namespace
}  // namespace seedmesh::lsystem
