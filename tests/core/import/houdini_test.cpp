#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::string_view plant = R"(// the node's default
Premise: A(1)
Rule 1: A(s) : s > b = F(s)[+A(s*b)]-&(20)A(s*b) : 0.5
A(s)=F(s):0.5
Generations: 5
Angle: 30
Step Size: 0.2
b: 0.7
Random Seed: 4
)";

TEST(Houdini, ReadsAPremiseThatIsCalledAxiom) {
  const auto named = imported("houdini", "Axiom: F+A\nRule 1: A=F-A\nAngle: 30\n");
  const auto usual = imported("houdini", "Premise: F+A\nRule 1: A=F-A\nAngle: 30\n");
  ASSERT_TRUE(named) << reports(named)[0];
  ASSERT_TRUE(usual);
  EXPECT_EQ(named->answer, usual->answer);
  EXPECT_THAT(reports(imported("houdini", "Premise: A\nAxiom: B\nA=FA\n")),
              testing::Contains(testing::HasSubstr("2:1 found a second premise")));
}

TEST(Houdini, ExchangesTurnsThatHoudiniExchanges) {
  const auto result = imported("houdini", plant);
  ASSERT_TRUE(result) << reports(result)[0];
  const json parameters = parameters_of(result);
  EXPECT_EQ(parameters["productions"],
            json({"A(s) : s > b -> F(s)[-A(s*b)]+^(20)A(s*b) : 0.5", "A(s) -> F(s) : 0.5"}));
  EXPECT_EQ(parameters["iterations"], 5);
  EXPECT_EQ(parameters["angle"], 30);
  EXPECT_EQ(parameters["step"], 0.2);
  EXPECT_EQ(parameters["constants"]["b"], 0.7);
  EXPECT_EQ(result->request.seed(), 4U);
  EXPECT_THAT(reports(result), IsEmpty());
}

TEST(Houdini, ReadsParametersWithOtherSignsBehindTheirNames) {
  const auto expected = imported("houdini", "Premise: A\nRule 1: A(x):x==1=F\nAngle: 30\nStep Size: 2\n");
  ASSERT_TRUE(expected) << reports(expected)[0];
  for (const char* text : {"Premise = A\nRule1 = A(x):x==1=F\nangle=30\nStep Size = 2\n",
                           "premise A\nrule1 A(x):x==1=F\nangle 30\nstep size 2\n",
                           "Axiom: A\nRule 1: A(x):x==1=F\nAngle: 30\nStep: 2\n",
                           "Premise\tA\nRule 1 A(x):x==1=F\nAngle 30\nstep-size: 2\n"}) {
    const auto result = imported("houdini", text);
    ASSERT_TRUE(result) << text << reports(result)[0];
    EXPECT_EQ(parameters_of(result), parameters_of(expected)) << text;
  }
  // Names of one letter can be modules.
  EXPECT_EQ(parameters_of(imported("houdini", "b\nb=FA\nA=b\n"))["productions"], json({"b -> FA", "A -> b"}));
  EXPECT_EQ(parameters_of(imported("houdini", "A\nA=F\nIterations: 3\n"))["iterations"], 3);
}

TEST(Houdini, FillsArgumentsThatAreNotGivenForCopiesOfGeometry) {
  const auto result = imported("houdini", "A\nA=FJ(,,2)[K(,)]M()\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["productions"], json({"A -> FJ(0,0,2)[K(0,0)]M"}));
}

TEST(Houdini, RefusesArrowsAndAPremiseWithoutRules) {
  EXPECT_THAT(reports(imported("houdini", "Premise: A\nRule 1: A=>FA\n")),
              Contains(HasSubstr("2:10 found `=>`")));
  EXPECT_THAT(reports(imported("houdini", "dear all\n")), Contains(HasSubstr("found no rule")));
}

TEST(Houdini, ExchangesTurnsInContextsToo) {
  const auto result = imported("houdini", "F+A\nF<+>A=-\nA = &A\nGenerations: 1\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["productions"], json({"F < - > A -> +", "A -> ^A"}));
  EXPECT_EQ(derived(result), "F+^A");
}

TEST(Houdini, WritesTheNodesFactorsOut) {
  const auto result =
      imported("houdini", "Premise: \"F!F_?;@*~(5)\"(0.5)\nThickness Scale: 0.75\nGenerations: 0\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["axiom"],
            "@Di(0.9)F@w(0.75)F@Dd(0.9)@w(1/(0.75))@a(0.9)@a(1/(0.9))\\(180)"
            "/(ran(-(5),(5)))&(ran(-(5),(5)))+(ran(-(5),(5)))@Di(0.5)");
}

TEST(Houdini, GivesWidthsAndHalfLengthsAMeaning) {
  const auto result = imported("houdini", "Premise: F(1,0.2)H H(3)F\nGenerations: 0\nStep Size: 1\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["interpretation"],
            json({"F(l,w) -> !(w)F(l)", "H -> @Di(0.5)F@Dd(0.5)", "H(l) -> F(l/2)"}));
  EXPECT_EQ(json::parse(*derive(result->request, {}))["turtle"]["total_length"], 4);
}

TEST(Houdini, WarnsOfSymbolsWithoutACounterpart) {
  const auto result = imported("houdini", "Premise: FT(0.1)J'K\nGenerations: 0\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), ElementsAre(StartsWith("1:11 `T`"), StartsWith("1:17 `J`"),
                                           StartsWith("1:18 `'`"), StartsWith("1:19 `K`")));
}

TEST(Houdini, GrowsByPartsOfAGeneration) {
  const auto result = imported("houdini", "Premise: A\nA=FA\nGenerations: 2.5\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["iterations"], 3);
  EXPECT_EQ(parameters_of(result)["age"], 2.5);
  EXPECT_FALSE(parameters_of(imported("houdini", "Premise: A\nA=FA\nGenerations: 2\n")).contains("age"));
}

TEST(Houdini, ReportsEveryErrorAtOnce) {
  EXPECT_THAT(reports(imported("houdini", "Premise: A(\nA=F[\nB=F(q)\nColour: red\nGenerations: 1e9\n")),
              ElementsAre(StartsWith("1:11 found `(`"), StartsWith("2:4 found `[`"),
                          StartsWith("3:5 unknown name `q`"), StartsWith("5:14 expected a number")));
}

TEST(Houdini, RefusesUnknownTextAtItsLineAndColumn) {
  const auto fault = [](std::string_view lines) {
    const auto result = imported("houdini", "Premise: A\n" + std::string(lines));
    return result ? "" : reports(result)[0];
  };
  EXPECT_EQ(fault("Colour: red\n"), "") << "a warning";
  EXPECT_THAT(fault("Angle: wide\n"), StartsWith("2:8 expected a number"));
  EXPECT_THAT(fault("A = F(2\n"), StartsWith("2:6 found `(`"));
  EXPECT_THAT(fault("!=F\n"), testing::Not(testing::StrEq("")));
  EXPECT_THAT(fault("A = F(q)\n"), StartsWith("2:7 unknown name `q`"));
  EXPECT_THAT(fault("A=F\n  Generations: 99999\n"), StartsWith("3:16 expected generations"));
  EXPECT_THAT(fault("A=F\nRandom Seed: 0.5\n"), StartsWith("3:14 expected a random seed"));
  EXPECT_THAT(fault("A=F\nangle=wide\n"), StartsWith("3:7 expected a number"));
  EXPECT_THAT(fault("A=F\nAngle: 4000\n"), StartsWith("3:8 "));
  EXPECT_THAT(reports(imported("houdini", "A=F\n")), Contains(HasSubstr("no premise")));
}

TEST(Houdini, ReadsTheVariablesOfItsNode) {
  const auto result = imported(
      "houdini", "Premise: A\nGenerations: 3\nGravity: 4\nRule 1: A=F(t)B(i,T)A\nRule 2: C(t)=C(t+1)\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "F(0)B(1,4)F(1)B(1,4)F(2)B(1,4)A")
      << "t counts generations, i the symbols of a rule";
  const auto other = imported("houdini", "Premise: A\nRule 1: A:in(x,y,z)=F(K)A\nRule 2: A=FA\n");
  ASSERT_TRUE(other) << reports(other)[0];
  EXPECT_THAT(reports(other), testing::IsSupersetOf({HasSubstr("`in()`"), HasSubstr("`K` is a variable")}));
  const auto index = imported("houdini", "Premise: A\nGenerations: 2\nRule 1: A:i<1=F(i)A\n");
  ASSERT_TRUE(index) << reports(index)[0];
  EXPECT_EQ(derived(index), "F(0)F(0)A");
  EXPECT_THAT(reports(index), Contains(HasSubstr("`i` is a variable")));
}

TEST(Houdini, ReadsThePositionOfTheTurtle) {
  // Steps of 1 m: A becomes B where its height is above 2 m, which is so after three steps.
  const std::string lines = "Premise: A\nRule 1: A:y>2=B\nRule 2: A=FA\nStep Size: 1\nGenerations: ";
  EXPECT_EQ(derived(imported("houdini", lines + "3\n")), "FFF?P(0,3,0)A");
  EXPECT_EQ(derived(imported("houdini", lines + "6\n")), "FFFB");
  EXPECT_THAT(reports(imported("houdini", lines + "6\n")), IsEmpty());
  // Branches have positions of their own; parameters stay, and a module that no rule takes keeps its query.
  const auto branches =
      imported("houdini", "Premise: A(1)[+(90)F A(2)]\nA(n):x>0.5=B(n,x)\nStep Size: 1\nGenerations: 2\n");
  EXPECT_EQ(derived(branches), "?P(0,0,0)A(1)[-(90)FB(2,1)]");
}

TEST(Houdini, WarnsOfLabelsWithoutACounterpart) {
  const auto result = imported("houdini", "Type: Tube\nRows: 8\nPremise: F\nRule 1: F=FF\nGenerations: 1\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(
      reports(result),
      testing::IsSupersetOf({HasSubstr("`Type` is a parameter without a counterpart"), HasSubstr("`Rows`")}));
}

TEST(Houdini, DrawsNothingForVariables) {
  const auto result = imported("houdini", "Premise: FG\nRule 1: G=+G\nRule 2: g=gF\nGenerations: 2\n");
  ASSERT_TRUE(result) << reports(result)[0];
  const auto answer = nlohmann::json::parse(*derive(result->request, {}));
  EXPECT_EQ(answer["turtle"]["segments"], 1);
}

}  // namespace
}  // namespace seedmesh
