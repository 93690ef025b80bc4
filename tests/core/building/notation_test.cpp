/// The notations of 2006 and of today: names without a rule, signs of print, roofs by height and on volumes.
#include <gmock/gmock.h>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

using testing::HasSubstr;

/// The warnings of a derivation as "line:column message", one a line.
std::string warnings(const std::string& rules, std::array<double, 3> size = {10, 10, 10}) {
  std::string out;
  const Json answer = derived(with(rules, size));
  for (const Json& each : answer["warnings"]) {
    out += std::to_string(each.value("line", 0)) + ":" + std::to_string(each.value("column", 0)) + " " +
           each["message"].get<std::string>() + "\n";
  }
  return out;
}

/// The highest point of the model.
double top_of(const std::string& rules, std::array<double, 3> size = {12, 0, 8}) {
  double top = -1e9;
  const Model model = model_of(with(rules, size));
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const double high = bounds_of(primitive.mesh.position.span()).max.y;
      top = std::max(top, high + static_cast<double>(node.transform.translation.y));
    }
  }
  return top;
}

const std::string thesis = "1: facade(h) : h >= 9 ~> floor(h/3) floor(h/3) floor(h/3) : 0.9";

TEST(Notation, TakesTheRuleOfTheThesisByItselfAndBehindALot) {
  EXPECT_EQ(leaves(thesis), "floor floor floor");
  EXPECT_EQ(leaves("lot ~> facade(Scope.sy)\n" + thesis), "floor floor floor");
  EXPECT_EQ(leaves("lot ~> facade(Scope.sy)\n" + thesis, {10, 8, 10}), "facade");
}

std::vector<double> bottoms(const Json& answer) {
  std::vector<double> out;
  for (const Json& shape : answer["shapes"]) {
    if (shape["active"]) out.push_back(shape["scope"]["origin"][1]);
  }
  return out;
}

TEST(Notation, StacksSymbolsWhoseParametersAddUpToTheHeight) {
  // Rule 4.2 of Kogovšek on a facade of 9 m: three floors of 3 m.
  const Json floors = derived(with(thesis, {12, 9, 0.4}));
  EXPECT_EQ(sizes(floors, 1), (std::vector<double>{3, 3, 3}));
  EXPECT_EQ(bottoms(floors), (std::vector<double>{0, 3, 6}));
  const Json uneven = derived(with("facade(h) ~> floor(h/2) attic(h/2 - 1) ledge(1)", {12, 8, 0.4}));
  EXPECT_EQ(sizes(uneven, 1), (std::vector<double>{4, 3, 1}));
  EXPECT_EQ(bottoms(uneven), (std::vector<double>{0, 4, 7}));
}

TEST(Notation, LeavesOtherSymbolsSideBySideInOneScope) {
  const std::vector<double> whole{9, 9};
  EXPECT_EQ(sizes(derived(with("facade(h) ~> floor(h/3) floor(h/3)", {12, 9, 1})), 1), whole);
  EXPECT_EQ(sizes(derived(with("lot ~> facade(6) facade(h) ~> floor(h/2) floor(h/2)", {12, 9, 1})), 1),
            whole);
  EXPECT_EQ(sizes(derived(with("facade(h) --> floor(h/2) floor(h/2)", {12, 9, 1})), 1), whole);
  EXPECT_EQ(sizes(derived(with("facade(h) ~> floor floor", {12, 9, 1})), 1), whole);
}

TEST(Notation, CutsTheGeometryOfAStack) {
  BuildingParams params =
      with("lot --> primitiveCone() cone(scope.sy)\ncone(h) ~> foot(h/2) tip(h/2)", {10, 8, 10});
  const Json cone = derived(params);
  const auto width = [&](std::size_t i) { return sizes(cone, 0).at(i); };
  EXPECT_EQ(sizes(cone, 1), (std::vector<double>{4, 4}));
  EXPECT_NEAR(width(1), width(0) / 2, 1e-9);
}

TEST(Notation, GivesAFirstRuleWithOneParameterTheHeightOfTheLot) {
  EXPECT_EQ(leaves("fac(h) ~> S(1r, h/2, 1r) half."), "half");
  EXPECT_THAT(warnings("fac(h) ~> S(1r, h/2, 1r) half."), HasSubstr("1:1 `fac` has a parameter"));
  EXPECT_DOUBLE_EQ(sizes(derived(with("fac(h) ~> S(1r, h/2, 1r) half.", {10, 12, 10})), 1)[0], 6);
  EXPECT_THAT(fault("fac(a, b) ~> half."), HasSubstr("begin with a rule that gives them"));
}

TEST(Notation, MakesALeafOfANameWithParametersAndNoRule) {
  EXPECT_EQ(leaves("A --> extrude(5) Floor(3)", {10, 0, 10}), "Floor");
  EXPECT_THAT(warnings("A --> Floor(3)"), HasSubstr("1:7 there is no rule for `Floor`"));
}

TEST(Notation, RejectsAMisspeltOperation) {
  EXPECT_EQ(fault("A --> extrud(3) B."),
            "1:7 there is no operation and no rule `extrud`; did you mean `extrude`?");
  EXPECT_EQ(fault("A --> Taper(3) B."),
            "1:7 there is no operation and no rule `Taper`; did you mean `taper`?");
  EXPECT_EQ(fault("A --> strew(3){ B. }"), "1:7 there is no operation and no rule `strew`");
  // A name of one letter is near to every operation of one.
  EXPECT_EQ(fault("A --> B(3)"), "none");
}

TEST(Notation, TakesTheSignsOfPrintForComparisons) {
  EXPECT_EQ(leaves("lot ~> f(9) f(h) : h ≥ 9 ~> floor(h/3)"), "floor");
  EXPECT_EQ(leaves("lot ~> f(9) f(h) : h ≤ 8 ~> floor(h/3)"), "f");
  EXPECT_EQ(leaves("lot ~> f(9) f(h) : h ≠ 8 ~> floor(h/3)"), "floor");
  // Texts are unchanged. Columns count the characters of the notation as it was written.
  EXPECT_EQ(leaves("A --> case \"≥\" == \"≥\": B. else: C."), "B");
  EXPECT_THAT(fault("f(h) : h ≥ 9 ~> extrud(3)"), HasSubstr("1:17 there is no operation"));
}

TEST(Notation, GivesRoofsOfEveryKindTheRequestedHeight) {
  for (const std::string roof :
       {"roofHip(byHeight(3))", "roofHip(byHeight, 3)", "roofGable(byHeight(3))", "roofPyramid(byHeight(3))",
        "roofShed(byHeight(3), 0)", "roofMansard(byHeight(3), 20)", "roofMansard(byHeight(3), 20, 2)",
        "roofGambrel(byHeight(3), 25)", "roofGambrel(byHeight(3), 25, 1.5)"})
    EXPECT_NEAR(top_of("A --> " + roof + " R."), 3, 1e-5) << roof;
  EXPECT_NEAR(top_of("A ~> Roof(\"hipped\", byHeight(3)){ R. }"), 3, 1e-5);
  EXPECT_NEAR(top_of("A --> roofHip(byAngle(45)) R."), 4, 1e-5);
}

TEST(Notation, RefusesARoofWithoutHeightOrWithABreakAboveIt) {
  EXPECT_THAT(refusal(with("A --> roofHip(byHeight(0)) R.", {12, 0, 8})), HasSubstr("above 0"));
  EXPECT_THAT(refusal(with("A --> roofMansard(byHeight(3), 20, 4) R.", {12, 0, 8})),
              HasSubstr("the slope breaks at 4 m, expected below the height of the roof, 3 m"));
}

const std::string chain =
    "footprint ~> S(1r, 6, 1r) facades T(0, 6, 0) Roof(\"hipped\", 45){ roof. } "
    "facades ~> Comp(\"sidefaces\"){ facade. }";

TEST(Notation, PutsTheRoofOfTheChainOf2006OnTopOfTheWalls) {
  EXPECT_EQ(leaves(chain, {12, 0, 8}), "roof facade facade facade facade");
  EXPECT_NEAR(top_of(chain), 6 + 4, 1e-5);
}

TEST(Notation, PutsTheRoofOfTheChainOf2006OnAPolygonToo) {
  BuildingParams params = with(chain);
  params.footprint = {{{0, 0}, {12, 0}, {12, 8}, {6, 8}, {6, 4}, {0, 4}}};
  const Json answer = derived(params);
  EXPECT_EQ(active(answer), "roof facade facade facade facade facade facade");
  params.rules = "A ~> S(1r, 6, 1r) wall. T(0, 6, 0) Roof(\"hipped\", 45){ roof. }";
  EXPECT_GT(volume(params), 6 * (12 * 4 + 6 * 4));
}

TEST(Notation, MakesAPrismOfAPolygonThatGetsAHeight) {
  BuildingParams params = with("A --> s('1, 5, '1) B.");
  params.footprint = {{{0, 0}, {12, 0}, {12, 8}, {6, 8}, {6, 4}, {0, 4}}};
  EXPECT_NEAR(volume(params), 5 * 72, 1e-3);
  params.rules = "A --> s('1, -5, '1) B.";
  EXPECT_NEAR(volume(params), 5 * 72, 1e-3);
}

}  // namespace
}  // namespace seedmesh::building
