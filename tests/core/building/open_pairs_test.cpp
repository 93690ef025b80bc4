// Pairs of shapes whose left shape has open variables. Expected numbers follow from elementary geometry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "core/schema/issue_list.h"
#include "generated/params/building.h"
#include "tests/support/context.h"

namespace seedmesh::building {
namespace {

BuildingParams read(const std::string& text) {
  IssueList faults;
  BuildingParams params = read_building(Json::parse(text), "", faults);
  EXPECT_TRUE(faults.empty());
  return params;
}

/// One rule of two dimensions in one parallel step, unless `rest` states otherwise.
std::string request(const std::string& rule, const std::string& initial,
                    const std::string& rest = R"(,"iterations":1,"derivation":{"mode":"parallel"})",
                    const std::string& more = "") {
  return R"({"shape_grammar":{"marker_size":0.1,"width":0.1,"shapes":{
    "rectangle":{"parameters":{"w":1,"h":1},"lines":[[[0,0],["w",0],["w","h"],[0,"h"],[0,0]]]},
    "triangle":{"parameters":{"x":0,"y":1},"lines":[[[0,0],[1,0],["x","y"],[0,0]]]}},"rules":[)" +
         rule + R"(],"initial":[)" + initial + "]" + more + "}" + rest + "}";
}

Json derived(const std::string& text, std::uint64_t seed = 0) {
  Job job(seed, Job::Options{});
  const Result<Json> answer = derive(read(text), context_of(job));
  if (answer) return *answer;
  ADD_FAILURE() << answer.error().issues.front().pointer << " " << answer.error().issues.front().message;
  return {{"shapes", Json::array()}};
}

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> out;
  for (const Issue& issue : check(read(text), Limits{})) out.push_back(issue.pointer + " " + issue.message);
  return out;
}

/// Middles of the scopes of a symbol, seen from above as the request writes them: x and y; sorted.
std::vector<std::array<double, 2>> middles(const Json& answer, const std::string& symbol) {
  std::vector<std::array<double, 2>> out;
  for (const Json& shape : answer["shapes"]) {
    if (shape["symbol"] != symbol) continue;
    std::array<double, 3> middle{};
    for (std::size_t i = 0; i < 3; ++i) {
      middle[i] = shape["scope"]["origin"][i];
      for (std::size_t k = 0; k < 3; ++k)
        middle[i] +=
            0.5 * shape["scope"]["size"][k].get<double>() * shape["scope"]["axes"][k][i].get<double>();
    }
    out.push_back({middle[0], -middle[2]});
  }
  std::ranges::sort(out);
  return out;
}

using testing::ElementsAre;
using testing::HasSubstr;

const std::string any_rectangle =
    R"({"open":[{"name":"b","low":0.05,"high":20}],CONDITION"pair":[
      {"shapes":[{"shape":"rectangle","values":{"h":"b"}}]},
      {"shapes":[{"shape":"rectangle","values":{"h":"b"}}],"markers":[{"name":"found","points":[[0.5,"b / 2"]]}]}]})";

std::string rectangles(const std::string& condition = "") {
  return std::string(any_rectangle).replace(any_rectangle.find("CONDITION"), 9, condition);
}

TEST(OpenPairs, MatchRectanglesOfAnyProportion) {
  const std::string three = R"({"shapes":[{"shape":"rectangle","values":{"w":4,"h":2}},
    {"shape":"rectangle","values":{"w":3,"h":3},"at":[10,0]},
    {"shape":"rectangle","values":{"w":6,"h":1},"at":[0,10],"turn":[30]}]})";
  const Json answer = derived(request(rectangles(), three));
  const std::vector<std::array<double, 2>> found = middles(answer, "found");
  ASSERT_EQ(found.size(), 3U);
  const double c = std::sqrt(0.75), s = 0.5;
  const std::array<std::array<double, 2>, 3> expected{
      {{2, 1}, {3 * c - 0.5 * s, 10 + 3 * s + 0.5 * c}, {11.5, 1.5}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto near = [&](const std::array<double, 2>& p) {
      return std::hypot(p[0] - expected[i][0], p[1] - expected[i][1]) < 1e-6;
    };
    EXPECT_TRUE(std::ranges::any_of(found, near)) << i;
  }
  // Each matches in eight ways: from four corners, as it is and mirrored. Half of them are higher than wide.
  EXPECT_EQ(answer["reports"]["rule 1"]["count"], 24);
  const Json high = derived(request(rectangles(R"("condition":"b > 1.5",)"), three));
  EXPECT_EQ(high["reports"]["rule 1"]["count"], 8);
  EXPECT_EQ(middles(high, "found").size(), 2U);
  // Values outside of the range do not count: 4 x 2 has 0.5 and 2, 6 x 1 has 1/6 and 6.
  const std::string narrow = std::string(rectangles()).replace(rectangles().find("0.05"), 4, "3");
  EXPECT_EQ(derived(request(narrow, three))["reports"]["rule 1"]["count"], 4);
}

TEST(OpenPairs, FindRectanglesAmongLongerLines) {
  // Three lines across three others make 9 crossings and 9 rectangles, of which each matches in eight ways.
  const std::string lattice = R"({"lines":[[[0,0],[7,0]],[[0,2],[7,2]],[[0,5],[7,5]],
    [[0,0],[0,5]],[[3,0],[3,5]],[[7,0],[7,5]]]})";
  const Json answer = derived(request(rectangles(), lattice));
  EXPECT_EQ(answer["reports"]["rule 1"]["count"], 72);
  EXPECT_EQ(middles(answer, "found").size(), 9U);
}

TEST(OpenPairs, MatchAnyTriangle) {
  // The rule adds the triangle of the middles of the sides, whose corners are known.
  const std::string rule =
      R"({"open":[{"name":"x","low":-5,"high":5},{"name":"y","low":0.1,"high":5}],"pair":[
    {"shapes":[{"shape":"triangle","values":{"x":"x","y":"y"}}],"markers":[{"name":"m","points":[["(1 + x) / 3","y / 3"]]}]},
    {"shapes":[{"shape":"triangle","values":{"x":"x","y":"y"}}],
     "lines":[[[0.5,0],["(1 + x) / 2","y / 2"],["x / 2","y / 2"],[0.5,0]]],"markers":[{"name":"done","points":[["(1 + x) / 3","y / 3"]]}]}]})";
  const std::string initial =
      R"({"lines":[[[1,2],[8,3],[4,9],[1,2]]],"markers":[{"name":"m","points":[["13 / 3","14 / 3"]]}]})";
  const Json answer = derived(request(rule, initial, R"(,"iterations":5)"));
  EXPECT_EQ(answer["reports"]["rule 1"]["count"], 1);  // then no marker m is left
  ASSERT_EQ(middles(answer, "done").size(), 1U);
  EXPECT_NEAR(middles(answer, "done")[0][0], 13.0 / 3, 1e-6);
  std::vector<double> lengths;
  for (const Json& shape : answer["shapes"]) {
    if (shape["symbol"] == "line") lengths.push_back(shape["scope"]["size"][0].get<double>() - 0.1);
  }
  std::ranges::sort(lengths);
  const double a = std::hypot(7, 1), b = std::hypot(4, 6), c = std::hypot(3, 7);
  const std::vector<double> expected{a / 2, b / 2, c / 2, a, b, c};
  std::vector<double> sorted = expected;
  std::ranges::sort(sorted);
  ASSERT_EQ(lengths.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(lengths[i], sorted[i], 1e-6);
}

TEST(OpenPairs, MatchSolidsInThePlaneAndInSpace) {
  const std::string flat = R"({"open":[{"name":"b"}],"condition":"b > 1.01","pair":[
    {"solids":[{"solid":"box","size":[1,"b"]}]},
    {"solids":[{"solid":"box","size":[1,"b / 2"],"at":[0,"b / 4"],"material":"half"},{"solid":"box","size":[1,"b / 2"],"at":[0,"-b / 4"],"material":"half"}]}]})";
  const Json two = derived(request(
      flat,
      R"({"solids":[{"solid":"box","size":[2,6],"turn":[20]},{"solid":"box","size":[3,3],"at":[20,0]}]})"));
  EXPECT_EQ(two["reports"]["rule 1"]["count"], 1);
  EXPECT_EQ(middles(two, "box").size(), 3U);
  // A block of any height becomes two of half the height, until they are lower than wide: 2 x 12 x 2 gives 8 of 1.5.
  const std::string block = R"({"open":[{"name":"h","low":0.1,"high":50}],"condition":"h > 1.2","pair":[
    {"solids":[{"solid":"box","size":[1,"h",1]}]},
    {"solids":[{"solid":"box","size":[1,"h / 2",1]},{"solid":"box","size":[1,"h / 2",1],"at":[0,"h / 2",0]}]}]})";
  const Json tower = derived(request(block, R"({"solids":[{"solid":"box","size":[2,12,2],"turn":[0,33,0]}]})",
                                     R"(,"iterations":100)", R"(,"dimensions":3)"),
                             1);
  EXPECT_EQ(tower["reports"]["rule 1"]["count"], 7);
  std::vector<double> heights;
  for (const Json& shape : tower["shapes"]) {
    if (shape["active"]) heights.push_back(shape["scope"]["size"][1]);
  }
  ASSERT_EQ(heights.size(), 8U);
  for (const double height : heights) EXPECT_NEAR(height, 1.5, 1e-6);
}

TEST(OpenPairs, RejectLeftShapesThatDoNotDetermineTheirVariables) {
  const std::string initial = R"({"shapes":[{"shape":"rectangle"}]})";
  const auto errors = [&](const std::string& open, const std::string& values, const std::string& more = "") {
    const std::string figure = R"({"shapes":[{"shape":"rectangle","values":{)" + values + "}}]" + more + "}";
    return errors_of(
        request(R"({"open":[)" + open + R"(],"pair":[)" + figure + "," + figure + "]}", initial));
  };
  const std::string h = R"({"name":"h"})", w = R"({"name":"w"})";
  EXPECT_THAT(errors(h, R"("h":"h")"), testing::IsEmpty());
  EXPECT_THAT(
      errors(h + "," + w, R"("w":"w","h":"h")"),
      ElementsAre(HasSubstr("/shape_grammar/rules/0/pair/0 the points of this shape do not determine")));
  EXPECT_THAT(errors(h, R"("h":"h * h")"), ElementsAre(HasSubstr("are not linear in its open variables")));
  EXPECT_THAT(errors(h, R"("h":2)"), ElementsAre(HasSubstr("do not determine")));
  EXPECT_THAT(errors(h + "," + h, R"("h":"h")"),
              ElementsAre(HasSubstr("/shape_grammar/rules/0/open/1/name found two variables of this name")));
  EXPECT_THAT(errors(R"({"name":"h","low":3,"high":2})", R"("h":"h")"),
              ElementsAre(HasSubstr("/shape_grammar/rules/0/open/0 found a range without an extent")));
  EXPECT_THAT(errors(h, R"("h":"h")", R"(,"parameters":{"h":2})"),
              ElementsAre(HasSubstr("/pair/0/parameters/h found a value"),
                          HasSubstr("/pair/1/parameters/h found a value")));
  EXPECT_THAT(errors_of(request(R"({"condition":"1","pair":[)" + initial + "," + initial + "]}", initial)),
              ElementsAre(HasSubstr("/condition found a condition without open variables")));
  EXPECT_THAT(errors_of(request(rectangles(R"("condition":"b > q",)"), initial)),
              ElementsAre(HasSubstr("/shape_grammar/rules/0/condition")));
}

}  // namespace
}  // namespace seedmesh::building
