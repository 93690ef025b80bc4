#include "core/generators/building/building.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/building/operations.h"
#include "core/geom/mesh/finish.h"
#include "generated/params/building.h"
#include "tests/core/building/rules.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(BuildingRules, ReadBothNotationsIntoTheSame) {
  EXPECT_EQ(leaves("A ~> Subdiv(\"X\", 2, 1r, 0.5*Scope.sx){ B. | C. | D. }"), "B C D");
  EXPECT_EQ(leaves("A --> split(x){ 2: B. | ~1: C. | '0.5: D. }"), "B C D");
}

TEST(BuildingRules, CanShareALine) {
  EXPECT_EQ(leaves("1: A ~> B C 2: B ~> D. D. 3: C : Scope.sx > 1 ~> E. C ~> F."), "D D E");
}

TEST(BuildingRules, KnowRulesOfTheThesis) {
  // Rules 4.2 to 4.6 of Kogovšek, with their labels.
  EXPECT_EQ(leaves("0: A ~> facade(Scope.sy) 1: facade(h) : h >= 9 ~> floor(h/3) floor(h/3) floor(h/3) : 0.9 "
                   "2: floor(h) ~> tile."),
            "tile tile tile");
  EXPECT_EQ(leaves("3: facade ~> Subdiv(\"Y\", 3.5, 0.3, 3r, 3){ floor. | ledge. | floor. | floor. }"),
            "floor ledge floor floor");
  EXPECT_EQ(leaves("4: floor ~> Repeat(\"X\", 2){ B. }"), "B B B B B");
  EXPECT_EQ(leaves("5: a ~> Comp(\"faces\"){ A. }"), "A A A A A A");
  EXPECT_EQ(leaves("5: a ~> Comp(\"edge\", 3){ B. }"), "B");
}

TEST(BuildingRules, TakeTheFirstCaseThatIsTrue) {
  const std::string rules = "A --> case scope.sx > 20: B. case scope.sx > 5: C. else: D.";
  EXPECT_EQ(leaves(rules, {30, 1, 1}), "B");
  EXPECT_EQ(leaves(rules, {10, 1, 1}), "C");
  EXPECT_EQ(leaves(rules, {1, 1, 1}), "D");
}

TEST(BuildingRules, ChooseByWeight) {
  int count = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
    count += leaves("A ~> B. : 0.3  A ~> C. : 0.7", {1, 1, 1}, seed) == "B";
  EXPECT_NEAR(count, 600, 80);
  count = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
    count += leaves("A --> 30%: B. 50%: C. else: D.", {1, 1, 1}, seed) == "D";
  EXPECT_NEAR(count, 400, 70);
}

TEST(BuildingRules, KnowAttributesConstantsAndFunctions) {
  BuildingParams params = with(
      "attr width = half * 2  const half = base / 2  attr base = 3\n"
      "grown(x, y) = case x > 2: x + y else: y\n"
      "A --> split(x){ width: B. | grown(base, 1): C. }");
  EXPECT_THAT(sizes(derived(params), 0), ElementsAre(3, 4));
  params.attributes["base"] = 1.0;
  EXPECT_THAT(sizes(derived(params), 0), ElementsAre(1, 1));
  params.attributes["nothing"] = 1.0;
  EXPECT_EQ(check(params, Limits{}).front().pointer, "/attributes/nothing");
  EXPECT_THAT(check(params, Limits{}).front().message, HasSubstr("; they declare base, width"));
  params.attributes = {{"widht", 2.0}};
  EXPECT_THAT(check(params, Limits{}).front().message, HasSubstr("; did you mean \"width\"?"));
}

TEST(BuildingRules, CheckAttributesByTheirAnnotations) {
  BuildingParams params = with("@Range(1, 5) attr w = 2 @Enum(\"a\", \"b\") attr s = \"a\" A --> B.");
  params.attributes = {{"w", 9.0}, {"s", std::string("c")}};
  std::vector<std::string> pointers;
  for (const Issue& issue : check(params, Limits{})) pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, ElementsAre("/attributes/s", "/attributes/w"));
  EXPECT_EQ(check(params, Limits{}).back().message, "found 9, expected a number from 1 to 5");
}

TEST(BuildingRules, CompareTexts) {
  EXPECT_EQ(leaves("attr style = \"old\" A --> case style == \"old\": B. else: C."), "B");
}

TEST(BuildingRules, ReportErrorsWithLineAndColumn) {
  EXPECT_THAT(fault("A --> split(q){ 1: B. }"), HasSubstr("1:14 found the axis `q`"));
  EXPECT_THAT(fault("A -->\n  split(x){ hight: B. }"), HasSubstr("2:13 unknown name `hight`"));
  EXPECT_THAT(fault("A --> extrud(3) B."), HasSubstr("did you mean `extrude`?"));
  EXPECT_THAT(fault("A --> [ B."), HasSubstr("is not closed"));
  EXPECT_THAT(fault("A(h) --> B. C --> A"), HasSubstr("`A` takes 1 parameters, found 0"));
  EXPECT_THAT(fault("A --> comp(f){ frnt: B. }"), HasSubstr("expected a selector"));
  EXPECT_EQ(check(with("A --> split(q){ 1: B. }\nB --> Roof(\"x\") C\nD --> size("), Limits{}).size(), 4U);
}

TEST(BuildingRules, WarnOfSymbolsWithoutARuleOrAPoint) {
  EXPECT_EQ(derived(with("A --> B C."))["warnings"].size(), 1U);
  EXPECT_EQ(derived(with("A --> B. C."))["warnings"].size(), 0U);
}

TEST(BuildingRules, RejectEndlessRules) {
  EXPECT_THAT(refusal(with("A --> B\nB --> A")), HasSubstr("without an end"));
  EXPECT_THAT(refusal(with("A --> A A")), HasSubstr("1:1 `A` is nested 1,000 shapes deep"));
  EXPECT_THAT(refusal(with("A --> split(x){ 0.000000001: B. }*")), HasSubstr("1:7 this split makes"));
  EXPECT_THAT(refusal(with("A --> s(1 / (scope.sx - 10), 1, 1) B.")), HasSubstr("divided by 0"));
}

TEST(BuildingRules, MakeALeafOfAShapeThatAlwaysCutsItself) {
  const Json answer = derived(with("A --> split(x){ '0.1:A | '0.1:B. }*", {1, 1, 1}));
  EXPECT_EQ(active(answer), "A B A B A B A B A B");
  EXPECT_THAT(answer["warnings"][0]["message"].get<std::string>(), HasSubstr("becomes a leaf"));
}

TEST(BuildingList, NamesTheRuleLineAndChoiceThatReplacedAShape) {
  const Json shapes =
      derived(with("A ~> B C\n1: B : Scope.sx > 1 ~> D. : 0.9 ~> E. : 0.1 2: C ~>\n  F."))["shapes"];
  EXPECT_EQ(shapes[0]["rule"], "A ~> B C");
  EXPECT_EQ(shapes[0]["line"], 1);
  EXPECT_FALSE(shapes[0].contains("choice"));
  EXPECT_EQ(shapes[1]["symbol"], "B");
  EXPECT_EQ(shapes[1]["rule"], "B : Scope.sx > 1 ~> D. : 0.9 ~> E. : 0.1");
  EXPECT_EQ(shapes[1]["line"], 2);
  EXPECT_EQ(shapes[2]["rule"], "C ~>");
  for (std::uint32_t i = 3; i < shapes.size(); ++i) EXPECT_FALSE(shapes[i].contains("rule"));
}

TEST(BuildingList, CountsTheChoicesOfARule) {
  std::set<int> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Json answer = derived(with("A --> 50%: B.\n  50%: C."), seed);
    const int choice = answer["shapes"][0]["choice"];
    EXPECT_EQ(choice, answer["shapes"][1]["symbol"] == "B" ? 1 : 2);
    seen.insert(choice);
  }
  EXPECT_EQ(seen, (std::set{1, 2}));
}

TEST(BuildingScope, MovesTurnsAndCenters) {
  const Json answer =
      derived(with("A ~> S(0.8*Scope.sx, Scope.sy, 0.8*Scope.sz) center(xz) extrude(20) Env  Env ~> "
                   "Repeat(\"Y\", 4){ Floor. }",
                   {30, 0, 20}));
  EXPECT_EQ(active(answer), "Floor Floor Floor Floor Floor");
  const Json& env = answer["shapes"][1]["scope"];
  EXPECT_EQ(env["size"], Json::array({24, 20, 16}));
  EXPECT_EQ(env["origin"], Json::array({-12, 0, -8}));
  const Json turned = derived(with("A ~> R(0, 90, 0) B.", {2, 3, 4}))["shapes"][1]["scope"];
  EXPECT_EQ(turned["axes"][0], Json::array({0, 0, -1}));
}

TEST(BuildingScope, FitsPartsWhereSizesAreLeftOpen) {
  EXPECT_EQ(derived(with("A ~> S(8, 8, 0) i(\"cube\")"))["shapes"][1]["scope"]["size"],
            Json::array({8, 8, 8}));
}

TEST(BuildingComponents, TakeFacesOnceInTheOrderOfSelectors) {
  EXPECT_EQ(leaves("A --> comp(f){ front: F. | side: S. | top: T. | all: R. }"), "F S S S T R");
  const Json answer = derived(with("A --> comp(f){ right: F. }", {2, 3, 4}));
  EXPECT_EQ(answer["shapes"][1]["scope"]["size"], Json::array({4, 3, 0}));
  EXPECT_EQ(answer["shapes"][1]["scope"]["axes"][2], Json::array({1, 0, 0}));
}

TEST(BuildingReports, AreSums) {
  const Json report =
      derived(with("A --> split(x){ 2: report(\"length\", scope.sx) B. }*"))["reports"]["length"];
  EXPECT_EQ(report["count"], 5);
  EXPECT_EQ(report["sum"], 10);
  EXPECT_EQ(report["min"], 2);
}

TEST(BuildingQueries, SeeTheShapesOfTheFirstPass) {
  const std::string rules =
      "A ~> [ S(4, 4, 4) mass ] T(2, 0, 1) S(4, 4, 2) mass  mass ~> Comp(\"sidefaces\"){ face }\n"
      "face : Shape.occ(\"noparent\") != \"none\" ~> wall.  face ~> window.";
  // The left face of the second lies inside the first; the right face of the first is partly covered.
  EXPECT_EQ(leaves(rules), "window wall window window wall window wall wall");
}

TEST(BuildingSnaps, DrawBordersToLines) {
  const std::string rules =
      "A ~> [ T(3, 0, 0) S(1, 1, 1) Snap(\"X\") NIL ] Subdiv(\"XS\", 1r, 1r, 1r){ B. | C. | D. }";
  EXPECT_THAT(sizes(derived(with(rules)), 0), ElementsAre(3, 1, 6));
}

TEST(BuildingOrder, ShowsInTheStepsAlone) {
  const std::string rules = "A --> B C  B --> D. D.  C --> E. E. E.";
  BuildingParams params = with(rules);
  params.iterations = 2;
  params.derivation = {BuildingOrder::breadth, BuildingMode::parallel};
  EXPECT_EQ(active(derived(params)), "D D E E E");
  params.derivation = {BuildingOrder::depth, BuildingMode::sequential};
  EXPECT_EQ(active(derived(params)), "C D D");
  params.iterations = 3;
  EXPECT_EQ(active(derived(params)), "D D E E E");
}

TEST(BuildingRestrictions, RejectRulesOfOtherKinds) {
  BuildingParams params = with("A --> B. A");
  params.iterations = 3;
  params.restrict = BuildingRestrict::unimarker;
  EXPECT_EQ(active(derived(params)), "B B B A");
  params.rules = "A --> B. A A";
  EXPECT_EQ(check(params, Limits{}).front().column, 12);
  params.restrict = BuildingRestrict::non_erasing;
  EXPECT_TRUE(check(params, Limits{}).empty());
  params.rules = "A --> NIL";
  EXPECT_EQ(check(params, Limits{}).front().column, 7);
}

/// Kogovšek 2014, section 4.2: successors stay within the volume of their predecessor.
TEST(BuildingRestrictions, RejectShapesThatLeaveTheirPredecessor) {
  BuildingParams params = with("Lot --> s(30,20,30) Roof.", {4, 3, 5});
  const Json free = derived(params);
  ASSERT_EQ(free["warnings"].size(), 1U);
  EXPECT_EQ(free["warnings"][0]["column"], 21);
  EXPECT_THAT(free["warnings"][0]["message"].get<std::string>(),
              HasSubstr("leaves the scope of `Lot` by 26 m along x, where the scope has 4 m"));
  const BuildingParams sill = with("Lot --> [ t(0, 0, -0.2) Sill. ] Wall.", {4, 3, 5});
  EXPECT_THAT(derived(sill)["warnings"][0]["message"].get<std::string>(),
              HasSubstr("leaves the scope of `Lot` by 0.2 m along z"));
  params.restrict = BuildingRestrict::split;
  EXPECT_THAT(refusal(params), HasSubstr("1:21 this shape leaves the scope of `Lot` by 26 m along x"));
  // A protruding sill of 0.2 m, a turn, and a leaf without a symbol.
  params.rules = "Lot --> [ t(0, 0, -0.2) Sill. ] Wall.";
  EXPECT_THAT(refusal(params), HasSubstr("1:25 this shape leaves the scope of `Lot` by 0.2 m along z"));
  params.rules = "Lot --> R(0, 90, 0) Wall.";
  EXPECT_THAT(refusal(params), HasSubstr("leaves the scope of `Lot` by"));
  params.rules = "Lot --> t(1, 0, 0)";
  EXPECT_THAT(refusal(params), HasSubstr("1:9 this shape leaves the scope of `Lot` by 1 m along x"));
}

/// I() adds a part beside the shape. Rule 4.3 of Kogovšek 2014 leaves a lot of 10 x 20 x 10 m by 9 m.
TEST(BuildingRestrictions, RejectAddedPartsThatLeaveTheirPredecessor) {
  BuildingParams params = with("Lot ~> S(30, 20, 30) I(\"cube\")", {4, 3, 5});
  const Json free = derived(params);
  ASSERT_EQ(free["warnings"].size(), 1U);
  EXPECT_THAT(free["warnings"][0]["message"].get<std::string>(),
              HasSubstr("leaves the scope of `Lot` by 26 m along x"));
  params.restrict = BuildingRestrict::split;
  EXPECT_THAT(refusal(params), HasSubstr("1:22 this shape leaves the scope of `Lot` by 26 m along x"));
  params.rules = "Lot ~> S(2, 3, 2) I(\"cube\") T(1, 0, 1) I(\"cylinder\")";
  EXPECT_EQ(refusal(params), "none");
  params = with("A ~> [T(0,0,6)S(8,10,18)I(\"cube\")]T(6,0,0)S(7,13,18)I(\"cube\")", {10, 20, 10});
  params.restrict = BuildingRestrict::split;
  EXPECT_THAT(refusal(params), HasSubstr("leaves the scope of `A` by 14 m along z"));
}

TEST(BuildingRestrictions, AcceptSplitsRepeatsComponentsAndFittingBodies) {
  BuildingParams params = with(
      "Lot --> split(y){ 1: Floor | ~1: Floor } Floor --> comp(f){ side: Facade | top: Cap. } "
      "Facade --> split(x){ ~0.7: Tile }* Tile --> s('0.5, '0.5, 0) center(xy) Window.",
      {4, 3, 5});
  params.restrict = BuildingRestrict::split;
  EXPECT_EQ(refusal(params), "none");
  params.rules = "Lot --> s(2, 3, 2) R(0, 45, 0, scopeCenter) i(\"cylinder\")";  // within, unlike its scope
  EXPECT_EQ(refusal(params), "none");
}

/// Gips: a square with a marker becomes a square with half as large a one in it, turned by 45 degrees.
TEST(BuildingRestrictions, EmbedSquares) {
  BuildingParams params =
      with("M ~> [ square. ] S(0.5^0.5*Scope.sx, 1r, 0.5^0.5*Scope.sz) center(xz) R(0, 45, 0, scopeCenter) M",
           {1, 0, 1});
  params.iterations = 5;
  params.restrict = BuildingRestrict::unimarker;
  const Json answer = derived(params);
  const std::vector<double> sides = sizes(answer, 0);
  ASSERT_EQ(sides.size(), 6U);
  EXPECT_NEAR(sides[4], 0.25, 1e-12);
}

TEST(BuildingRandomness, DependsOnThePositionInTheTree) {
  const std::string before = "A --> split(x){ 1: B }* B --> 50%: C. else: D.";
  const std::string after = "A --> split(x){ 1: B }* B --> 50%: C. else: E(rand()) E(x) --> F.";
  std::string expected = leaves(before);
  std::replace(expected.begin(), expected.end(), 'D', 'F');
  EXPECT_EQ(leaves(after), expected);
}

TEST(BuildingBodies, KeepTheirVolumeUnderAnyCuts) {
  for (const char* body : {"cube", "cylinder", "pyramid", "prism", "triangular_prism", "cone", "sphere"}) {
    const std::string insert = std::string("A --> i(\"") + body + "\")";
    const double whole = volume(with(insert + " B.", {4, 6, 5}));
    ASSERT_GT(whole, 10) << body;
    for (const char* axis : {"x", "y", "z"}) {
      const BuildingParams cut =
          with(insert + " split(" + axis + "){ 0.7: B. | ~1: C. | '0.21: D. }", {4, 6, 5});
      EXPECT_NEAR(volume(cut), whole, 1e-4 * whole) << body << " across " << axis;
      const Model model = model_of(cut);
      EXPECT_THAT(faults(model), testing::IsEmpty()) << body << " across " << axis;
    }
  }
}

TEST(BuildingBodies, CutFootprintsWithCourtyards) {
  BuildingParams params = with("Lot --> extrude(3) split(x){ ~1: split(z){ ~1: B. }* }*");
  params.footprint = {{{0, 0}, {10, 0}, {10, 8}, {6, 8}, {6, 6}, {4, 6}, {4, 8}, {0, 8}},
                      {{2.5, 2.5}, {7.5, 2.5}, {7.5, 4.5}, {2.5, 4.5}}};
  EXPECT_NEAR(volume(params), 3 * (80 - 4 - 10), 1e-3);
  EXPECT_THAT(faults(model_of(params)), testing::IsEmpty());
}

TEST(BuildingBodies, StandOnFootprintsOrAreRefused) {
  BuildingParams params = with("Lot --> extrude(3) B.");
  params.footprint = {{{0, 0}, {10, 10}, {10, 0}, {0, 4}}};
  EXPECT_EQ(check(params, Limits{}).front().pointer, "/footprint/0/2");
  params.footprint = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{20, 20}, {21, 20}, {21, 21}}};
  EXPECT_EQ(check(params, Limits{}).front().pointer, "/footprint/1");
}

TEST(BuildingBodies, ShareAMeshWhereThatIsSmallerAndAreMergedElsewhere) {
  const Model boxes = model_of(with("A --> split(x){ 1: B. }*"));
  EXPECT_EQ(boxes.meshes.size(), 2U);  // neighbours that touch are in different layers
  for (const Node& node : boxes.nodes) EXPECT_TRUE(node.instances.transforms.empty());
  // Bells have many triangles: 20 of them are one mesh, two are merged.
  const auto bells = [](int count) {
    return model_of(with(
        "A --> split(x){ '" + std::to_string(1.0 / count) + ": [ s('0.8, '1, '1) i(\"bell\", 64) ] NIL }*",
        {20, 1, 1}));
  };
  const auto copies = [](const Model& model) {
    std::size_t most = 0;
    for (const Node& node : model.nodes) most = std::max(most, node.instances.transforms.size());
    return most;
  };
  EXPECT_EQ(copies(bells(20)), 20U);
  EXPECT_EQ(copies(bells(2)), 0U);
  const Model many = model_of(with("A --> split(x){ 0.5: split(y){ 0.5: B. }* }* ", {20, 20, 1}));
  EXPECT_THAT(faults(many), testing::IsEmpty());
  EXPECT_LE(many.meshes.size(), 8U);
  EXPECT_EQ(count(many).triangles, 40U * 40U * 12U);
}

TEST(BuildingRoofs, CloseOverEveryPlan) {
  for (const char* roof : {"roofHip(35, 0.3)", "roofGable(40, 0.3, 0.2)", "roofPyramid(45)", "roofShed(15)",
                           "roofMansard(70, 20, 1.2, 0.3)", "roofGambrel(60, 25)"}) {
    BuildingParams params =
        with(std::string("Lot --> extrude(3) comp(f){ top: Top | all: Wall. } Top --> ") + roof + " Roof.");
    params.footprint = {{{0, 0}, {12, 0}, {12, 6}, {6, 6}, {6, 12}, {0, 12}}};
    const Model model = model_of(params);
    EXPECT_THAT(faults(model), testing::IsEmpty()) << roof;
    EXPECT_GT(bounds_of(model).max.y, 3.5F) << roof;
  }
}

TEST(BuildingPlans, FillTheWholePlan) {
  for (const char* operation :
       {"setback(1){ front: B | left: B | remainder: B }", "shapeL(2, 1){ shape: B | remainder: B }",
        "shapeU(2, 1, 1){ shape: B | remainder: B }", "shapeO(2, 1, 2, 1){ shape: B | remainder: B }",
        "offset(-1) comp(f){ inside: B | border: B }"}) {
    const std::string rules = std::string("A --> ") + operation + " B --> report(\"area\", geometry.area) C.";
    EXPECT_NEAR(derived(with(rules, {10, 0, 8}))["reports"]["area"]["sum"].get<double>(), 80, 1e-6)
        << operation;
  }
}

TEST(BuildingOperations, RunTheExamplesOfTheirRows) {
  for (const OperationRow& row : operations()) {
    if (row.status == Status::error) continue;
    const Json answer = derived(with(std::string(row.example), {6, 6, 6}));
    EXPECT_FALSE(active(answer).empty()) << row.name;
    // Operations without a counterpart, and those whose purpose is a message, warn. Some examples leave the volume.
    const bool warns = row.status == Status::ignored || row.op == Op::print || row.op == Op::texture;
    const bool has_other_warnings =
        std::any_of(answer["warnings"].begin(), answer["warnings"].end(), [](const Json& warning) {
          return warning["message"].get<std::string>().find("leaves the scope of") == std::string::npos;
        });
    EXPECT_EQ(has_other_warnings, warns) << row.name << ": " << answer["warnings"].dump();
  }
}

/// Rules with letters left out, doubled and swapped: each ends in a refusal or in a model, and soon.
TEST(BuildingRules, SurviveDamage) {
  const std::string rules =
      "@Range(1, 9) attr h = 6 const k = case h > 3: 2 else: 1\n"
      "f(x) = 30%: x else: x * k\n"
      "Lot --> extrude(h) comp(f){ side: Facade | top: [ roofHip(30, 0.3) Roof. ] offset(-1, inside) Court. "
      "| 0: NIL }\n"
      "Facade --> split(y){ { ~f(2): Floor | 0.2: Ledge. }* | '0.1: i(\"cylinder\") }\n"
      "Floor --> case scope.sx > 3: split(x, noAdjust){ ~1: Wall. | 1: Window(1) }* else: Wall.\n"
      "1: Window(a) : Shape.occ(\"noparent\") == \"none\" ~> T(0, 0, -0.1) S(1r, 1r, 0.05) I(\"window\") : "
      "0.5 ~> Wall. : 0.5\n"
      "2: Window(a) ~> Subdiv(\"XS\", 1r, { 2, 1r }*){ A. | B. | C. } Comp(\"edges\"){ D. } setback(1){ "
      "front: E. | remainder: report(\"r\") F. }\n";
  const std::string letters = "(){}[]|:~'*.,\"+-/<>= \nr1A%@#";
  Rng rng(5);
  Job::Options options;
  options.limits.shapes = 20'000;
  options.limits.triangles = 200'000;
  for (int trial = 0; trial < 4'000; ++trial) {
    std::string text = rules;
    for (std::uint32_t k = 1 + rng.below(4); k-- > 0;) {
      const std::size_t at = rng.below(static_cast<std::uint32_t>(text.size()));
      const std::size_t span = 1 + rng.below(rng.below(8) == 0 ? 60 : 3);
      const std::uint32_t kind = rng.below(3);
      if (kind == 0) text.erase(at, span);
      if (kind == 1) text.insert(at, text.substr(rng.below(static_cast<std::uint32_t>(text.size())), span));
      if (kind == 2) text[at] = letters[rng.below(static_cast<std::uint32_t>(letters.size()))];
    }
    BuildingParams params = with(text, {8, 0, 6});
    if (trial % 3 == 0) params.iterations = 4;
    const bool sound = check(params, Limits{}).empty();
    Job job(1, options);
    try {
      const Result<Model> model = generate(params, context_of(job));
      EXPECT_EQ(static_cast<bool>(model), sound) << text;
    } catch (const Stop&) {
      EXPECT_TRUE(sound) << text;
    }
  }
}

}  // namespace
}  // namespace seedmesh::building
