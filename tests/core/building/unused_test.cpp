/// Parameters that are given and have no effect get a warning, and those that have one get none.
#include "core/generators/building/unused.h"

#include <gmock/gmock.h>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> pointers_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> out;
  out.reserve(warnings.size());
  for (const Warning& each : warnings) out.push_back(each.pointer);
  return out;
}

/// The pointers of all warnings. Those of `validate`, of `generate` and of `derive` are the same.
std::vector<std::string> warned(const BuildingParams& params) {
  Job job(0, Job::Options{});
  const Result<Appraisal> appraisal = appraise(params, context_of(job));
  EXPECT_TRUE(appraisal) << appraisal.error().issues.front().message;
  if (!appraisal) return {};
  std::vector<std::string> out = pointers_of(appraisal->warnings);
  EXPECT_EQ(out, pointers_of(model_of(params).warnings));
  std::vector<std::string> listed;
  const Json answer = derived(params);
  for (const Json& warning : answer["warnings"]) listed.push_back(warning["pointer"]);
  EXPECT_EQ(out, listed);
  return out;
}

TEST(UnusedSettings, OfADerivationWithoutSteps) {
  BuildingParams params = with("A --> split(x){ ~1: B | ~1: B }  B --> color(\"#ff0000\") C.");
  params.derivation.order = BuildingOrder::depth;
  EXPECT_THAT(warned(params), ElementsAre("/derivation/order"));
  params.derivation.mode = BuildingMode::sequential;
  EXPECT_THAT(warned(params), ElementsAre("/derivation/order", "/derivation/mode"));
  params.iterations = 2;
  EXPECT_THAT(warned(params), IsEmpty());
  params.derivation.mode = BuildingMode::parallel;
  EXPECT_THAT(warned(params), ElementsAre("/derivation/order"));
}

TEST(UnusedSettings, OfRepeatsAndProbabilities) {
  BuildingParams params = with("A --> split(x){ ~1: B. | ~1: C. }");
  params.repeat = BuildingRepeat::ceil;
  params.weights = BuildingWeights::strict;
  EXPECT_THAT(warned(params), ElementsAre("/repeat", "/weights"));
  params.rules = "A --> split(x){ { ~3: B }* }  B --> 30%: C. else: D.";
  EXPECT_THAT(warned(params), IsEmpty());
  params.rules = "A ~> Repeat(\"X\", 3){ B }  B ~> C. : 0.3  B ~> D. : 0.7";
  EXPECT_THAT(warned(params), IsEmpty());
}

TEST(UnusedSettings, OfASizeBesideAFootprint) {
  BuildingParams params = with("A --> extrude(3) B.", {4, 0, 4});
  EXPECT_THAT(warned(params), IsEmpty());
  params.footprint = {{{0, 0}, {10, 0}, {10, 10}}};
  EXPECT_THAT(warned(params), ElementsAre("/size"));
}

TEST(UnusedSettings, OfAFacadePictureThatIsNotGiven) {
  BuildingParams params = with("A --> B.");
  params.facade_tile = {2, 2};
  EXPECT_THAT(warned(params), ElementsAre("/facade_tile"));
}

TEST(UnusedSettings, OfNamesThatTheRulesDoNotContain) {
  BuildingParams params = with("A --> material(\"lime\" + \"_\" + \"wash\") split(y){ 3: Pebble. | ~1: B. }");
  for (const char* name : {"lime_wash", "pebble", "frame", "color_ff0000", "shingle"}) params.materials[name];
  params.tables["heights.csv"] = "1";
  EXPECT_THAT(warned(params), ElementsAre("/materials/shingle", "/tables/heights.csv"));
  params.rules = "attr m = \"plain\"\nA --> material(m) B.";
  params.materials.erase("lime_wash");
  params.tables.clear();
  EXPECT_THAT(warned(params), ElementsAre("/materials/pebble", "/materials/shingle"));
  params.attributes["m"] = std::string("shingle");
  EXPECT_THAT(warned(params), ElementsAre("/materials/pebble"));
}

TEST(UnusedSettings, OfAssetsThatTheRulesDoNotContain) {
  BuildingParams params = with("A --> i(\"statue\")");
  Grammar grammar;
  for (const char* name : {"statue", "fountain"}) params.assets[name];
  grammar.texts.id_of("statue");
  EXPECT_THAT(pointers_of(unused_settings(params, &grammar)), ElementsAre("/assets/fountain"));
}

TEST(UnusedSettings, OfAShapeGrammarAreErrors) {
  BuildingParams params;
  params.shape_grammar.emplace();
  params.weights = BuildingWeights::strict;
  params.tables["heights.csv"] = "1";
  std::vector<std::string> refused;
  for (const Issue& issue : check(params, Limits{})) refused.push_back(issue.pointer);
  EXPECT_THAT(refused, testing::IsSupersetOf({"/weights", "/tables"}));
}

/// 0.5 + 0.5 sum to 1 and pass; the attribute makes it 0.5 + 0.25, which only a shape finds.
TEST(StrictWeights, RefuseSumsThatAttributesDecide) {
  BuildingParams params = with("attr p = 50\nA --> split(x){ ~1: B }\nB --> p%: C. 50%: D.");
  params.weights = BuildingWeights::strict;
  EXPECT_EQ(refusal(params), "none");
  params.rules = "attr p = 0.5\nA --> B\nB ~> C. : p\nB ~> D. : 0.5";
  EXPECT_EQ(refusal(params), "none");
  params.attributes["p"] = 0.25;
  EXPECT_THAT(refusal(params), HasSubstr("3:1 the weights sum to 0.75 for a shape, expected 1"));
  params.weights = BuildingWeights::normalize;
  EXPECT_EQ(refusal(params), "none");
}

TEST(StrictWeights, RefuseSumsInsideASuccessor) {
  BuildingParams params = with("A --> [ 80%: C. 80%: D. else: E. ]");
  EXPECT_EQ(refusal(params), "none");
  params.weights = BuildingWeights::strict;
  EXPECT_THAT(refusal(params), HasSubstr("the weights sum to 1.6 for a shape, expected 1"));
}

}  // namespace
}  // namespace seedmesh::building
