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

TEST(Shapeml, ReportsWhatHasNoCounterpart) {
  EXPECT_THAT(reports(imported("shapeml", "rule Axiom = { torus(1, 2, 3, 4) A_ };")),
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
