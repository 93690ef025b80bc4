#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::string_view shed = R"(// a shed of two storeys
param height = 6;
const gap = 0.5;
func half(x) = x / 2;
rule Axiom = { size(8, 0, 4) quad Shed };
rule Shed = { extrude(height) splitFace("top", { Lid_ }, "vertical", { Wall }) };
rule Wall :: size_x > 5 = { splitX("f(s)f", gap, { Edge_ }, half(4), { Bay_ }, gap, { Edge_ }) };
rule Wall :: !(size_x > 5) = { splitRepeatY(3, { Storey_ }) };
)";

/// Symbols of the active shapes of the request, sorted.
std::map<std::string, int> leaves_of(const Result<ImportedRequest>& result) {
  std::map<std::string, int> counts;
  if (!result) return counts;
  const Result<std::string> answer = derive(result->request, {});
  if (!answer) return counts;
  const json derived = json::parse(*answer);
  for (const json& shape : derived.at("shapes")) {
    if (shape.at("active")) ++counts[shape.at("symbol").get<std::string>()];
  }
  return counts;
}

TEST(Shapeml, BecomesABuildingWithTheSameRules) {
  const auto result = imported("shapeml", shed);
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), IsEmpty());
  // Two walls of 8 m: 7 m between the edges take four bays of 2 m; two walls of 4 m have two storeys.
  const std::map<std::string, int> expected = {{"Bay_", 8}, {"Edge_", 4}, {"Lid_", 1}, {"Storey_", 4}};
  EXPECT_EQ(leaves_of(result), expected);
}

TEST(Shapeml, IsRecognisedByItsRules) {
  const auto result = imported("", shed);
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(json::parse(result->answer).at("format"), "shapeml");
}

TEST(Shapeml, MakesPercentagesOfWeights) {
  const auto result = imported("shapeml", "rule Axiom : 3 = { cube A_ }; rule Axiom : 1 = { cube B_ };");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(parameters_of(result)["rules"].get<std::string>(), HasSubstr("75.000000% :"));
}

TEST(Shapeml, WritesOperationsThatAreValuesInTheirPlace) {
  const auto result = imported(
      "shapeml",
      "func F(length) = { sizeY(length) [ cube Part_ ] translateY(length) };\n"
      "func twice(length) = { ^F(length) ^F(0.5 * length) };\n"
      "const flat = { sizeY(0) };\n"
      "rule Axiom = { set(\"wide\", 2) sizeX(wide) ^twice(4) ^flat quad splitFace(\"all\", ^End) };\n"
      "rule End = { End_ };\n");
  ASSERT_TRUE(result) << reports(result)[0];
  const std::map<std::string, int> expected = {{"End_", 1}, {"Part_", 2}};
  EXPECT_EQ(leaves_of(result), expected);
  const json derived = json::parse(*derive(result->request, {}));
  std::vector<double> heights;
  for (const json& shape : derived.at("shapes")) {
    if (shape.at("symbol") != "Part_") continue;
    heights.push_back(shape.at("scope").at("size")[1]);
    EXPECT_EQ(shape.at("scope").at("size")[0], 2);
  }
  EXPECT_THAT(heights, testing::ElementsAre(4, 2));
  EXPECT_THAT(reports(imported("shapeml", "func f(a) = { sizeX(a) };\nrule Axiom = { ^f(1, 2) };")),
              Contains(HasSubstr("2:17 found 2 arguments")));
  EXPECT_THAT(reports(imported("shapeml", "func f() = { ^f() };\nrule Axiom = { ^f() };")),
              Contains(HasSubstr("more than 30 deep")));
}

TEST(Shapeml, GivesOperationsToRulesAndSplits) {
  const auto result = imported("shapeml",
                               "const red = { Red_ };\nconst blue = { Blue_ };\n"
                               "rule Pane(box) :: index % 2 == 0 = { ^box };\n"
                               "rule Pane(box) :: index % 2 == 1 = { sizeY(3) ^box };\n"
                               "rule Wall(made, height) = { sizeY(height) ^made };\n"
                               "rule Axiom = { size(10, 1, 1) cube splitX(\"fff\", 2, red, 4, blue, 3, red)\n"
                               "  splitRepeatX(2, { Pane(blue) }) Wall(red, 2) Wall({ cube Own_ }, 5) };\n");
  ASSERT_TRUE(result) << reports(result)[0];
  // 2 m, 4 m and 3 m of 10 m; five panes of 2 m, two of them 3 m high; two walls.
  const std::map<std::string, int> expected = {{"Red_", 3}, {"Blue_", 6}, {"Own_", 1}};
  EXPECT_EQ(leaves_of(result), expected);
  const json derived = json::parse(*derive(result->request, {}));
  std::map<std::string, double> heights;
  for (const json& shape : derived.at("shapes")) {
    if (shape.at("active")) heights[shape.at("symbol")] += double{shape.at("scope").at("size")[1]};
  }
  EXPECT_NEAR(heights["Blue_"], 1 + 3 + 2 * 3, 1e-9);
  EXPECT_NEAR(heights["Red_"], 2 + 2, 1e-9);
  EXPECT_NEAR(heights["Own_"], 5, 1e-9);
}

TEST(Shapeml, GivesOperationsToSplitsInsideOfRules) {
  const auto result =
      imported("shapeml",
               "rule Frame(inner, width) = { splitX(\"fsf\", width, { Beam_ }, 1, inner, width, "
               "{ Beam_ }) };\n"
               "rule Axiom = { size(10, 4, 1) cube Frame({ Glass_ }, 2) [ Frame({ Row }, 1) ] };\n"
               "rule Row = { splitRepeatY(2, { Pane_ }) };\n");
  ASSERT_TRUE(result) << reports(result)[0];
  const std::map<std::string, int> expected = {{"Beam_", 4}, {"Glass_", 1}, {"Pane_", 2}};
  EXPECT_EQ(leaves_of(result), expected);
}

/// Offsets and sizes along x of the active shapes, in order.
std::vector<std::pair<double, double>> parts_along_x(const std::string& split) {
  std::vector<std::pair<double, double>> parts;
  const auto result = imported("shapeml", "rule Axiom = { size(10, 1, 1) cube " + split + " };");
  if (!result) return parts;
  const json derived = json::parse(*derive(result->request, {}));
  for (const json& shape : derived.at("shapes")) {
    if (shape.at("active"))
      parts.emplace_back(double{shape.at("scope").at("origin")[0]} + 0.5, shape.at("scope").at("size")[0]);
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

TEST(Shapeml, CountsTheRepetitionsOfPatternsAsItsInterpreterDoes) {
  // The number of repetitions is the rounded (length - outside) / inside, at most what the fixed sizes allow.
  struct Case {
    std::string split;
    std::size_t count;
    double first, end;
  };
  const Case cases[] = {
      {"splitX(\"fff\", 2, { A_ }, 4, { B_ }, 5, { C_ })", 2, 2, 6},
      {"splitX(\"(f)\", 0.95, { A_ })", 10, 0.95, 9.5},
      {"splitX(\"(ff)\", 0.9, { A_ }, 2.1, { B_ })", 6, 0.9, 9},
      {"splitX(\"(ff)f\", 0.7, { A_ }, 2, { B_ }, 0.7, { C_ })", 7, 0.7, 8.8},
      {"splitX(\"(s)(s)\", 0.7, { A_ }, 2, { B_ })", 8, 10 * 0.7 / (4 * 2.7), 10},
      {"splitX(\"(f)(s)\", 0.7, { A_ }, 2, { B_ })", 8, 0.7, 10},
      {"splitX(\"(s)(f)\", 0.7, { A_ }, 2, { B_ })", 8, 0.5, 10},
      {"splitX(\"(f)(f)\", 0.7, { A_ }, 2, { B_ })", 6, 0.7, 8.1},
  };
  for (const Case& each : cases) {
    const auto parts = parts_along_x(each.split);
    ASSERT_EQ(parts.size(), each.count) << each.split;
    EXPECT_NEAR(parts[0].second, each.first, 1e-6) << each.split;
    EXPECT_NEAR(parts.back().first + parts.back().second, each.end, 1e-6) << each.split;
  }
}

TEST(Shapeml, MakesNothingOfShapesWithoutAName) {
  const auto result =
      imported("shapeml",
               "rule Axiom = { quad [ A_ ] translateX(3) Low Bare splitX(\"ff\", 0.5, { B_ }, 0.5, "
               "{ color(1, 0, 0) }) translateX(2) };\n"
               "rule Low :: size_x > 5 = { C_ };\nrule Low :: !(size_x > 5) = {};\n"
               "rule Bare = { extrude(2) };\n");
  const std::map<std::string, int> expected = {{"A_", 1}, {"B_", 1}};
  EXPECT_EQ(leaves_of(result), expected);
}

TEST(Shapeml, RepeatsOperations) {
  const auto result =
      imported("shapeml",
               "rule Axiom = { Row(3) Row(0) };\n"
               "rule Row(width) = { repeat(7, { translateX(rand_uniform(0, 9)) sizeX(width) quad A_ }) };\n");
  ASSERT_TRUE(result) << reports(result)[0];
  const std::map<std::string, int> expected = {{"A_", 14}};
  EXPECT_EQ(leaves_of(result), expected);
}

TEST(Shapeml, ReadsIncludedFiles) {
  const json files = {{"files",
                       {{"house.shp",
                         "#include \"colours.shp\"\nfunc half(x) = clamp(0, 1, x / 2);\n"
                         "rule Axiom = { sizeX(half(1)) quad color(red) extrudeWorld(0, 1, 0, 2) A_ };"},
                        {"colours.shp", "const red = \"#ff0000\";\n"}}}};
  const auto result = imported("shapeml", files.dump());
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(leaves_of(result), (std::map<std::string, int>{{"A_", 1}}));
  EXPECT_THAT(reports(imported("shapeml", "#include \"colours.shp\"\nrule Axiom = { color(red) A_ };")),
              Contains(HasSubstr("1:1 the file of this `#include` is not given")));
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { quad extrudeWorld(1, 0, 0, 2) A_ };")),
              Contains(HasSubstr("the direction 0, 1, 0 only")));
}

/// The lexer of ShapeML knows `#include` alone, at the beginning of a line.
TEST(Shapeml, SaysThatANumberSignBeginsNoComment) {
  const std::string text =
      "# the author's {house}\nparam w = 3;\nrule Axiom = { size(w, 2, 4) cube # wall\n B_ };\n";
  EXPECT_THAT(
      reports(imported("", text)),
      testing::ElementsAre(testing::StartsWith("1:1 read as shapeml: found `#`, which begins no comment"),
                           testing::StartsWith("3:35 found `#`")));
  EXPECT_TRUE(
      imported("", "// note\nparam w = 3;\nrule Axiom = { size(w, 2, 4) color(\"#ff0000\") cube B_ };\n"));
}

/// The faces in each direction that a plan of 10 by 8 m has as a prism, if its area is the given one.
std::map<std::string, int> faces_of_plan(const std::string& plan, int area) {
  const std::string condition = "abs(area - " + std::to_string(area) + ") < 0.001";
  return leaves_of(imported("shapeml", "rule Axiom = { size(10, 0, 8) [ " + plan +
                                           " Plan ] };\n"
                                           "rule Plan :: " +
                                           condition +
                                           " = { extrude(3) splitFace(\"front\", { F_ }, \"back\", { B_ },"
                                           " \"left\", { L_ }, \"right\", { R_ }) };\n"
                                           "rule Plan :: !(" +
                                           condition + ") = { Other_ };\n"));
}

TEST(Shapeml, MakesPlansWithWings) {
  using Faces = std::map<std::string, int>;
  // At the back 2 m, on the left 3 m: 2 * 10 + 3 * 6.
  EXPECT_EQ(faces_of_plan("shapeL(2, 3)", 38), (Faces{{"F_", 2}, {"B_", 1}, {"L_", 1}, {"R_", 2}}));
  // On the right 1 m more.
  EXPECT_EQ(faces_of_plan("shapeU(2, 3, 1)", 44), (Faces{{"F_", 3}, {"B_", 1}, {"L_", 2}, {"R_", 2}}));
  // Two wings of 8 m, and 6 m of a connection that is 2.5 m wide.
  EXPECT_EQ(faces_of_plan("shapeH(3, 2.5, 1, 0.25)", 47),
            (Faces{{"F_", 3}, {"B_", 3}, {"L_", 3}, {"R_", 3}}));
  // A bar of 2 m at the back, and a wing of 3 m at 0.4 of the 7 m left: 20 + 18.
  EXPECT_EQ(faces_of_plan("shapeT(2, 3, 0.4)", 38), (Faces{{"F_", 3}, {"B_", 1}, {"L_", 2}, {"R_", 2}}));
  // The triangle has half of the area. Its corners are seen from above, with y to the back.
  EXPECT_EQ(faces_of_plan("polygon(0, 0, 5, 0, 0, 1)", 40).count("F_"), 1U);
}

TEST(Shapeml, MakesSolidsThatTouchAllSidesOfTheirScope) {
  // Source: geometry/primitives.cc; the first side is at the front, and the mesh is stretched to the scope.
  const auto volume_is = [](const std::string& solid, const std::string& area) {
    const auto result =
        imported("shapeml", "rule Axiom = { size(10, 10, 10) [ " + solid + " S ] };\nrule S :: abs(area - (" +
                                area + ")) < 0.001 = { Yes_ };\nrule S :: !(abs(area - (" + area +
                                ")) < 0.001) = { No_ };\n");
    return leaves_of(result).count("Yes_") == 1;
  };
  EXPECT_TRUE(volume_is("cylinder(4, 1, 1)", "600"));
  EXPECT_TRUE(volume_is("circle(4)", "100"));
  EXPECT_TRUE(volume_is("disk(4, 3)", "100"));
  EXPECT_TRUE(volume_is("coneFlat(4, 1, 1)", "100 + 4 * 5 * sqrt(125)"));
  // The front of a prism of three sides is a wall as wide as the scope.
  const auto result =
      imported("shapeml",
               "rule Axiom = { size(6, 4, 9) cylinder(3, 1, 1) splitFace(\"front\", { F } ) };\n"
               "rule F :: abs(size_x - 6) < 0.001 = { Wide_ };\n");
  EXPECT_EQ(leaves_of(result), (std::map<std::string, int>{{"Wide_", 1}}));
  const auto ring =
      imported("shapeml", "rule Axiom = { torus(4, 2, 19, 13) [ splitFace(\"all\", { T_ }) ] };");
  EXPECT_EQ(leaves_of(ring), (std::map<std::string, int>{{"T_", 19 * 13}}));
}

TEST(Shapeml, CountsFacesAndRepetitions) {
  const auto result = imported(
      "shapeml",
      "rule Axiom = { size(4, 4, 4) [ cube splitFace(\"vertical\", { T }) ] repeat(5, { quad R }) };\n"
      "rule T :: index % 2 == 0 = { Even_ };\nrule T :: index % 2 == 1 = { Odd_ };\n"
      "rule R :: index == 4 = { Last_ };\nrule R :: index < 4 = { Other_ };\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), IsEmpty());
  const std::map<std::string, int> expected = {{"Even_", 2}, {"Last_", 1}, {"Odd_", 2}, {"Other_", 4}};
  EXPECT_EQ(leaves_of(result), expected);
}

TEST(Shapeml, CutsQuotientsOfIntegers) {
  const auto result =
      imported("shapeml",
               "const seven = 7; param half = 0.5; const three = seven / 2;\n"
               "rule Axiom = { sizeX(7 / 2) sizeY(1 + seven / 2 * half) sizeZ(7.0 / 2) cube A_ "
               "size(three, 9 / half, 2 * 3 + rand_int(5, 5) / 2) B_ };\n");
  ASSERT_TRUE(result) << reports(result)[0];
  const json derived = json::parse(*derive(result->request, {}));
  std::map<std::string, json> sizes;
  for (const json& shape : derived.at("shapes")) sizes[shape.at("symbol")] = shape.at("scope").at("size");
  EXPECT_EQ(sizes["A_"], json({3, 2.5, 3.5}));
  EXPECT_EQ(sizes["B_"], json({3, 18, 8}));
}

TEST(Shapeml, HidesWhatFollowsUntilItIsShown) {
  const auto result =
      imported("shapeml", "rule Axiom = { cube [ hide A_ Inside show B_ ] C_ };\nrule Inside = { D_ };\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(leaves_of(result), (std::map<std::string, int>{{"B_", 1}, {"C_", 1}}));
}

TEST(Shapeml, ReportsBracketsWithoutPartners) {
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { size(4, 3, 2)\n cube")),
              Contains(HasSubstr("1:14 found `{` without its `}`")));
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { [ cube A_ };\nrule B = { cube B_ };")),
              Contains(HasSubstr("1:26 found `}` without its opening bracket")));
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { cube A_ } };")),
              Contains(HasSubstr("1:26 found `}` without its opening bracket")));
}

TEST(Shapeml, ReportsWhatHasNoCounterpart) {
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { rotate(1, 0, 0, 30) A_ };")),
              Contains(HasSubstr("no rule, and no operation")));
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { ^other };")),
              Contains(HasSubstr("no rule, and no operation")));
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { cube\n metallic(1) A_ };")),
              Contains(HasSubstr("2:2 `metallic` has no counterpart")));
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { splitX(\"fs\", 1, { A_ }) };")),
              Contains(HasSubstr("does not fit")));
  EXPECT_THAT(reports(imported("shapeml", "what = 3;")),
              Contains(HasSubstr("expected param, const, func or rule")));
}

}  // namespace
}  // namespace seedmesh
