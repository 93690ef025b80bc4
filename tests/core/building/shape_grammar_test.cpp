#include "core/generators/building/shape_grammar/shape_grammar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "core/geom/mesh/finish.h"
#include "core/schema/issue_list.h"
#include "generated/params/building.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

BuildingParams read(const std::string& text) {
  IssueList faults;
  BuildingParams params = read_building(Json::parse(text), "", faults);
  EXPECT_TRUE(faults.empty());
  return params;
}

/// A request of two dimensions with these rules and this beginning.
std::string flat(const std::string& rules, const std::string& initial, const std::string& rest = "") {
  return R"({"shape_grammar":{"marker_size":0.1,"shapes":{"square":{"parameters":{"w":1,"h":1},
    "lines":[[[0,0],["w",0],["w","h"],[0,"h"],[0,0]]]}},"rules":[)" +
         rules + R"(],"initial":[)" + initial + "]}" + rest + "}";
}

Json derived(const std::string& text, std::uint64_t seed = 0) {
  Job job(seed, Job::Options{});
  const Result<Json> answer = derive(read(text), context_of(job));
  if (answer) return *answer;
  ADD_FAILURE() << answer.error().issues.front().pointer << " " << answer.error().issues.front().message;
  return {{"shapes", Json::array()}};
}

std::size_t count(const Json& answer, const std::string& symbol) {
  return static_cast<std::size_t>(
      std::ranges::count_if(answer["shapes"], [&](const Json& shape) { return shape["symbol"] == symbol; }));
}

std::vector<std::string> defects_of(const std::string& text) {
  std::vector<std::string> out;
  for (const Issue& issue : check(read(text), Limits{})) out.push_back(issue.pointer + " " + issue.message);
  return out;
}

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string mark_square =
    R"({"pair":[{"shapes":[{"shape":"square"}]},
               {"shapes":[{"shape":"square"}],"markers":[{"name":"found","points":[[0.5,0.5]]}]}]})";

TEST(ShapeGrammar, FindsTheSquareThatTwoSquaresMakeWhereTheyOverlap) {
  const std::string two = R"({"shapes":[{"shape":"square","values":{"w":2,"h":2}},
                                      {"shape":"square","values":{"w":2,"h":2},"at":[1,1]}]})";
  const Json answer = derived(flat(mark_square, two, R"(,"iterations":1,"derivation":{"mode":"parallel"})"));
  EXPECT_EQ(count(answer, "found"), 3U);
  EXPECT_EQ(count(answer, "line"), 8U);
}

TEST(ShapeGrammar, MatchesLeftShapesRotatedScaledAndMirrored) {
  const std::string flag =
      R"({"lines":[[[0,0],[0,2]],[[0,2],[1,2]]],"markers":[{"name":"a","points":[[0,0]]}]})";
  const std::string rule = R"({"pair":[)" + flag + R"(,{"lines":[[[0,0],[0,2]]]}]})";
  const auto placed = [&](const std::string& member) {
    return R"({"shape_grammar":{"shapes":{"flag":)" + flag + R"(},"rules":[)" + rule +
           R"(],"initial":[{"shapes":[{"shape":"flag",)" + member + "}]}]";
  };
  for (const std::string member :
       {R"("turn":[37],"scale":3,"at":[5,-2])", R"("turn":[-110],"mirror":true,"scale":0.2)"}) {
    EXPECT_EQ(derived(placed(member) + "}}")["reports"]["rule 1"]["count"], 1) << member;
  }
  const Json plain = derived(placed(R"("mirror":true)") + R"(,"mirror":false}})");
  EXPECT_TRUE(plain["reports"].empty());
  EXPECT_THAT(plain["warnings"][0]["message"].get<std::string>(), HasSubstr("no rule matches"));
}

TEST(ShapeGrammar, MatchesSolidsInAnyOrientation) {
  const std::string grammar = R"({"shape_grammar":{"dimensions":3,
    "rules":[{"pair":[{"solids":[{"size":[1,2,3]}]},{"solids":[{"size":[1,2,3]},{"solid":"cone","at":[0,2,0]}]}]}],
    "initial":[{"solids":[{"size":[2,6,4],"turn":[20,30,40],"at":[1,2,3]}]}]},"iterations":1})";
  const Json answer = derived(grammar);
  EXPECT_EQ(count(answer, "box"), 1U);
  ASSERT_EQ(count(answer, "cone"), 1U);
  EXPECT_NEAR(answer["shapes"][2]["scope"]["size"][1].get<double>(), 2, 1e-9);
}

TEST(ShapeGrammar, EmbedsSquaresAsGipsDid) {
  const std::string rule =
      R"({"pair":[{"shapes":[{"shape":"square"}],"markers":[{"name":"m","points":[[1,1]]}]},
        {"shapes":[{"shape":"square"},{"shape":"square","at":[0.5,0],"turn":[45],"scale":"0.5^0.5"}],
         "markers":[{"name":"m","points":[[0.5,1]]}]}]})";
  const std::string initial =
      R"({"shapes":[{"shape":"square","scale":8}],"markers":[{"name":"m","points":[[8,8]]}]})";
  for (int steps = 0; steps < 10; ++steps) {
    const Json answer =
        derived(flat(rule, initial, R"(,"restrict":"unimarker","iterations":)" + std::to_string(steps)));
    EXPECT_EQ(count(answer, "line"), 4U * static_cast<std::size_t>(steps + 1));
    EXPECT_EQ(count(answer, "m"), 1U);
  }
  // Without a last step it ends where squares are too small to be found.
  EXPECT_LT(derived(flat(rule, initial))["reports"]["rule 1"]["count"].get<int>(), 60);
}

TEST(ShapeGrammar, MakesMembersOfFamiliesWithValuesOfTheirOwn) {
  const Json answer = derived(flat(
      mark_square, R"({"parameters":{"k":3},"shapes":[{"shape":"square","values":{"w":"2 * k","h":2}}]})"));
  std::vector<double> lengths;
  for (const Json& shape : answer["shapes"]) {
    if (shape["symbol"] == "line") lengths.push_back(shape["scope"]["size"][0]);
  }
  std::ranges::sort(lengths);
  ASSERT_EQ(lengths.size(), 4U);
  EXPECT_NEAR(lengths[0], 2.1, 1e-9);
  EXPECT_NEAR(lengths[3], 6.1, 1e-9);
  EXPECT_EQ(count(answer, "found"), 0U);  // a rectangle is no square
}

TEST(ShapeGrammar, RejectsWhatARestrictionForbidsByPointer) {
  const std::string erases =
      R"({"pair":[{"shapes":[{"shape":"square"}],"markers":[{"name":"m","points":[[0,0]]}]},
                                        {"lines":[[[0,0],[1,0]]]}]})";
  const std::string initial = R"({"markers":[{"name":"m","points":[[0,0]]}]})";
  EXPECT_THAT(defects_of(flat(erases, initial)), IsEmpty());
  const std::vector<std::string> found = defects_of(flat(erases, initial, R"(,"restrict":"non_erasing")"));
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(
      found[0],
      "/shape_grammar/rules/0/pair/1 the line from (1, 0) to (1, 1) of the left shape is not in the right "
      "shape, which a non-erasing grammar does not allow");
  const std::string doubles =
      R"({"pair":[{"markers":[{"name":"m","points":[[0,0],[1,0]]}]},
        {"markers":[{"name":"m","points":[[0,0],[0,1]]},{"name":"m","points":[[1,0],[1,1]]}]}]})";
  EXPECT_THAT(defects_of(flat(doubles, initial, R"(,"restrict":"non_erasing")")), IsEmpty());
  EXPECT_THAT(defects_of(flat(doubles, initial, R"(,"restrict":"unimarker")")),
              ElementsAre("/shape_grammar/rules/0/pair/1 found 2 markers, expected at most one in the right "
                          "shape of a unimarker grammar"));
}

TEST(ShapeGrammar, ReportsErrorsByPointer) {
  EXPECT_THAT(
      defects_of(flat(R"({"pair":[{"markers":[{"name":"m","points":[[0,0]]}]},{}]})", "{}")),
      ElementsAre(HasSubstr("/shape_grammar/rules/0/pair/0 this shape does not determine a position")));
  EXPECT_THAT(defects_of(flat(mark_square, R"({"shapes":[{"shape":"circle"}]})")),
              ElementsAre(HasSubstr("/shape_grammar/initial/0/shapes/0/shape there is no family")));
  EXPECT_THAT(defects_of(flat(mark_square, R"({"lines":[[[0,0],["2 *",1]]]})")),
              ElementsAre(HasSubstr("/shape_grammar/initial/0/lines/0/1/0")));
  EXPECT_THAT(defects_of(flat(mark_square, R"({"lines":[[[0,0],[1,1,1]]]})")),
              ElementsAre(HasSubstr("found 3 coordinates, expected 2")));
  EXPECT_THAT(defects_of(flat(mark_square, "{}", R"(,"rules":"A --> B.","start":"A")")),
              ElementsAre(HasSubstr("/rules has no meaning"), HasSubstr("/start has no meaning")));
  EXPECT_THAT(defects_of(R"({"shape_grammar":{"shapes":{"a":{"shapes":[{"shape":"a"}]}},"rules":[)" +
                         mark_square + R"(],"initial":[{"shapes":[{"shape":"a"}]}]}})"),
              testing::Contains(HasSubstr("more than 16 deep")));
}

std::string refusal(const std::string& text, std::uint64_t shapes) {
  Job::Options options;
  options.limits.shapes = shapes;
  Job job(0, options);
  try {
    const Result<Model> model = generate(read(text), context_of(job));
    return model ? "none" : model.error().issues.front().message;
  } catch (const Stop& stop) {
    return stop.issue().message;
  }
}

TEST(ShapeGrammar, RefusesFamiliesThatExpandBeyondTheLimit) {
  std::string shapes = R"("a":{"lines":[[[0,0],[1,0]]]})";
  for (char name = 'b'; name < 'p'; ++name) {
    const std::string use = R"({"shape":")" + std::string(1, static_cast<char>(name - 1)) + R"("})";
    shapes += std::string(",\"") + name + R"(":{"shapes":[)" + use + "," + use + "," + use + "," + use + "]}";
  }
  EXPECT_THAT(
      defects_of(
          R"({"shape_grammar":{"shapes":{)" + shapes +
          R"(},"rules":[{"pair":[{"lines":[[[0,0],[1,0]]]},{}]}],"initial":[{"shapes":[{"shape":"o"}]}]}})"),
      testing::Contains(HasSubstr("more than 2000 elements")));
}

TEST(ShapeGrammar, StopsEndlessRules) {
  const std::string turns = R"({"pair":[{"markers":[{"name":"m","points":[[0,0],[1,0]]}]},
                                       {"markers":[{"name":"m","points":[[0,0],[0,1]]}]}]})";
  const std::string doubles = R"({"pair":[{"markers":[{"name":"m","points":[[0,0],[1,0]]}]},
    {"markers":[{"name":"m","points":[[0,0],[0,0.7]]},{"name":"m","points":[[1,0],[1,0.8]]}]}]})";
  const std::string grows = R"({"pair":[{"markers":[{"name":"m","points":[[0,0],[1,0]]}]},
                                       {"markers":[{"name":"m","points":[[0,0],[9,0]]}]}]})";
  const std::string initial = R"({"markers":[{"name":"m","points":[[0,0],[1,0]]}]})";
  EXPECT_THAT(refusal(flat(turns, initial), 4'000'000), HasSubstr("100,000 times"));
  EXPECT_THAT(refusal(flat(doubles, initial), 5'000), HasSubstr("shapes"));
  EXPECT_THAT(refusal(flat(grows, initial), 5'000), HasSubstr("larger than 1,000 km"));
}

TEST(ShapeGrammar, KeepsLinesMaximal) {
  // Against a row of cells, each of them there or not.
  Rng rng(5);
  for (int trial = 0; trial < 300; ++trial) {
    const glm::dvec3 along(0.6, 0, 0.8), start(rng.uniform(-5, 5), 0, rng.uniform(-5, 5));
    std::vector<FigureLine> lines;
    std::vector<bool> cells(20, false);
    for (int i = 0; i < 25; ++i) {
      const std::uint32_t from = rng.below(19), to = from + 1 + rng.below(19 - from);
      FigureLine line{start + along * static_cast<double>(from), start + along * static_cast<double>(to)};
      if (rng.below(2) == 0) std::swap(line.from, line.to);
      const bool adds = rng.below(3) > 0;
      for (std::uint32_t c = from; c < to; ++c) cells[c] = adds;
      if (adds)
        add_line(lines, line, 1e-7);
      else
        remove_line(lines, line, 1e-7);
      std::size_t runs = 0;
      for (std::size_t c = 0; c < cells.size(); ++c) runs += cells[c] && (c == 0 || !cells[c - 1]);
      ASSERT_EQ(lines.size(), runs) << trial << " " << i;
      for (std::size_t c = 0; c < 19; ++c) {
        const FigureLine cell{start + along * static_cast<double>(c),
                              start + along * static_cast<double>(c + 1)};
        ASSERT_EQ(contains(lines, cell, 1e-7), cells[c]);
      }
    }
  }
}

TEST(ShapeGrammar, MakesSoundModels) {
  for (const char* mode : {"parallel", "sequential"}) {
    const std::string rule = R"({"pair":[{"markers":[{"name":"m","points":[[0,0],[1,0]]}]},
      {"lines":[[[0,0],[1,0]]],"solids":[{"solid":"cylinder","at":[0,0],"size":[0.2]}],
       "markers":[{"name":"m","points":[[1,0],[1.5,0.5]]},{"name":"m","points":[[1,0],[1.5,-0.5]]}]}]})";
    Job job(0, Job::Options{});
    Result<Model> model =
        generate(read(flat(rule, R"({"markers":[{"name":"m","points":[[0,0],[4,0]]}]})",
                           std::string(R"(,"iterations":5,"derivation":{"mode":")") + mode + "\"}")),
                 context_of(job));
    ASSERT_TRUE(model);
    finish(*model, job);
    EXPECT_THAT(faults(*model), IsEmpty());
  }
}

}  // namespace
}  // namespace seedmesh::building
