/// What an answer says of requests that are wrong or that make nothing.
#include <gmock/gmock.h>

#include <chrono>

#include "core/base/math.h"
#include "tests/core/building/rules.h"
#include "tests/support/context.h"

namespace seedmesh::building {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> out;
  out.reserve(warnings.size());
  for (const Warning& each : warnings) {
    out.push_back(each.pointer + " " + std::to_string(each.line) + ":" + std::to_string(each.column) + " " +
                  each.message);
  }
  return out;
}

std::vector<std::string> warnings(const std::string& rules, std::array<double, 3> size = {10, 10, 10}) {
  return texts_of(model_of(with(rules, size)).warnings);
}

/// "pointer line:column message" of the first error, which is found before the grammar runs or while it runs.
std::string error_of(const BuildingParams& params) {
  Job job(0, Job::Options{});
  const auto text_of = [](const Issue& issue) {
    return issue.pointer + " " + std::to_string(issue.line) + ":" + std::to_string(issue.column) + " " +
           issue.message;
  };
  try {
    const Result<Model> answer = generate(params, context_of(job));
    return answer ? "none" : text_of(answer.error().issues.front());
  } catch (const Stop& stop) {
    return text_of(stop.issue());
  }
}

BuildingParams house() {
  BuildingParams params;
  params.blueprint = BuildingBlueprint::house;
  return params;
}

TEST(StrictWeights, RefuseSumsOtherThanOneAtTheirRule) {
  BuildingParams params = with("A --> 30%: B. else: C.  D ~> B. : 0.5  D ~> C. : 0.25");
  params.weights = BuildingWeights::strict;
  EXPECT_THAT(error_of(params), HasSubstr("/rules 1:25 the weights of `D` sum to 0.75, expected 1"));
  params.rules = "A --> 70%: B. 50%: C. else: NIL";
  EXPECT_THAT(error_of(params), HasSubstr("/rules 1:1 the weights of `A` sum to 1.2, expected at most 1"));
  params.rules = "A --> 30%: B. 70%: C.";
  EXPECT_EQ(error_of(params), "none");
}

TEST(Hints, PointAtTheCommentThatIsNotClosed) {
  EXPECT_EQ(error_of(with("A --> B.\n  /* B --> C.\nD --> E.")),
            "/rules 2:3 the comment that opens here is not closed");
  EXPECT_THAT(warnings("A --> B. /* B --> C.\n*/"), IsEmpty());
}

TEST(Hints, ReportThatNothingIsDrawn) {
  const auto nothing = ElementsAre(HasSubstr("nothing is drawn"));
  EXPECT_THAT(warnings("A ~> Comp(\"edge\", 3){ B. }"), nothing);
  EXPECT_THAT(warnings("A --> s(0, 0, 0) B."), nothing);
  EXPECT_THAT(warnings("A --> comp(f){ front: B. }", {10, 0, 10}), nothing);
  EXPECT_THAT(warnings("A --> NIL"), IsEmpty());
  EXPECT_THAT(warnings("A --> B."), IsEmpty());
  Job job(0, Job::Options{});
  EXPECT_THAT(texts_of(appraise(with("A --> s(0, 0, 0) B."), context_of(job))->warnings), nothing);
}

TEST(Hints, PointAtTheSizeThatABlueprintCannotStandOn) {
  BuildingParams params;
  params.blueprint = BuildingBlueprint::church;
  params.size = {0, 10, 10};
  EXPECT_THAT(error_of(params), HasSubstr("/size 0:0 a blueprint stands on the ground"));
}

TEST(Hints, PointAtTheRestrictionThatABlueprintBreaks) {
  BuildingParams params = house();
  params.restrict = BuildingRestrict::non_erasing;
  EXPECT_THAT(error_of(params),
              HasSubstr("/restrict 0:0 the rules of the blueprint do not satisfy this restriction"));
}

TEST(Hints, PointAtTheAttributeThatIsAText) {
  BuildingParams params = with("attr h = 3\nA --> extrude(h) B.", {10, 0, 10});
  params.attributes["h"] = std::string("tall");
  EXPECT_EQ(error_of(params),
            "/attributes/h 0:0 found the text `tall`, expected a number; the rules use it in line 2, column "
            "15");
}

TEST(Hints, PointAtTheAttributeThatIsANumber) {
  BuildingParams params = with("attr m = \"brick\"\nA --> material(m) B.");
  params.attributes["m"] = 3.0;
  EXPECT_THAT(error_of(params), HasSubstr("/attributes/m 0:0 found a number, expected a text"));
}

TEST(Hints, NameWhatAnEnumAllows) {
  BuildingParams params = house();
  params.attributes["roof"] = std::string("nope");
  EXPECT_EQ(error_of(params), "/attributes/roof 0:0 found \"nope\", expected \"gable\" or \"hip\"");
}

TEST(Hints, NameTheRangeOfACount) {
  EXPECT_EQ(
      error_of(with("A --> i(\"stairs\", 1000000000)")),
      "/rules 1:19 found 1e+09 for the count of a part, expected a number from 0 (by the size) to 1000");
  EXPECT_THAT(error_of(with("A --> i(\"stairs\", \"many\")")), HasSubstr("found the text `many`"));
}

TEST(Hints, ReportThatAFootprintWithoutAnAreaCrossesItself) {
  BuildingParams params = with("A --> B.");
  params.footprint = {{{0, 0}, {10, 10}, {10, 0}, {0, 10}}};
  EXPECT_THAT(error_of(params), HasSubstr("/footprint/0/2 0:0 the edge from here meets"));
  EXPECT_THAT(error_of(params), HasSubstr("it crosses itself"));
  params.footprint = {{{0, 0}, {5, 0}, {10, 0}}};
  EXPECT_THAT(error_of(params), HasSubstr("the ring has no area"));
}

TEST(Hints, AskWhetherAMaterialIsMisspelt) {
  EXPECT_THAT(warnings("A -->\n material(\"brik\") B."),
              ElementsAre("/rules 2:2 there is no material `brik`; the shape gets a plain material of this "
                          "name; did you mean "
                          "`brick`?"));
  EXPECT_THAT(warnings("A --> material(\"velvet\") B."), IsEmpty());
  BuildingParams params = with("A --> material(\"brik\") B.");
  params.materials["brik"] = {};
  EXPECT_THAT(model_of(params).warnings, IsEmpty());
}

TEST(Hints, WarnOfOptionsThatASolidIgnores) {
  EXPECT_THAT(warnings("A --> i(\"cube\", 5, 7, 9)"),
              ElementsAre(HasSubstr("/rules 1:7 the numbers after `cube` have no effect")));
  EXPECT_THAT(warnings("A --> i(\"stairs\", 5)"), IsEmpty());
}

TEST(Hints, WarnOfARuleThatIsNeverUsed) {
  EXPECT_THAT(warnings("A --> B.\nA --> C."),
              ElementsAre("/rules 2:1 this rule of `A` is never used: the rule in line 1 before it always "
                          "applies"));
  EXPECT_THAT(warnings("A ~> B. : 0.4\nA ~> C. : 0.6"), IsEmpty());
  EXPECT_THAT(warnings("A : Scope.sx > 3 ~> B.\nA ~> C."), IsEmpty());
  EXPECT_THAT(warnings("A --> B(1)\nB(x) --> C.\nB(x) --> D."), ElementsAre(HasSubstr("/rules 3:1")));
}

TEST(Hints, EndARoofOverThousandsOfCornersAtTheDeadline) {
  BuildingParams params = with("A --> roofGable(30, 1) R.");
  params.footprint.emplace_back();
  for (int i = 0; i < 4'000; ++i) {
    const double angle = 2 * math::pi * i / 4'000, reach = i % 2 == 0 ? 60 : 100;
    params.footprint[0].push_back({reach * math::cos(angle), reach * math::sin(angle)});
  }
  Job::Options options;
  options.deadline = Job::Clock::now() + std::chrono::milliseconds(100);
  Job job(0, options);
  EXPECT_THROW(static_cast<void>(generate(params, context_of(job))), Stop);
  EXPECT_LT(Job::Clock::now() - options.deadline, std::chrono::seconds(20));
}

}  // namespace
}  // namespace seedmesh::building
