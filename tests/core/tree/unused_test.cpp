/// Parameters that have no effect on a tree are reported, and no others.
#include <gmock/gmock.h>

#include <string>

#include "core/generators/tree/tree.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* image = "data:image/png;base64,iVBORw0KGgo=";

std::vector<std::string> unused(const TreeParams& params) {
  std::vector<std::string> pointers;
  for (const Warning& each : warnings_of(params)) {
    EXPECT_THAT(each.message, HasSubstr(" has no effect ")) << each.pointer;
    pointers.push_back(each.pointer);
  }
  return pointers;
}

std::string only_message(const TreeParams& params) {
  const std::vector<Warning> warnings = warnings_of(params);
  return warnings.size() == 1 ? warnings.front().message : std::to_string(warnings.size()) + " warnings";
}

TreeParams of(TreeModel model) {
  TreeParams params;
  params.model = model;
  return params;
}

TEST(UnusedParameters, AreNoneOfTheDefaults) {
  for (const TreeModel model :
       {TreeModel::weber_penn, TreeModel::proctree, TreeModel::sculpt, TreeModel::grown})
    EXPECT_THAT(unused(of(model)), IsEmpty());
}

TEST(UnusedParameters, OfOtherModelsAreReported) {
  TreeParams params = of(TreeModel::proctree);
  params.Ratio = 0.03;
  params.sway.wind = 3;
  params.sides = 5;
  params.mLevels = 4;
  EXPECT_THAT(unused(params), ElementsAre("/sides", "/Ratio", "/sway"));
}

TEST(UnusedParameters, AreTheFoldOfLeavesThatAreTooCoarse) {
  TreeParams params;
  params.leaf.build = TreeBuild::twig;
  params.leaf.fold = 40;
  params.leaf.coarseness = 2;
  EXPECT_THAT(unused(params), IsEmpty());
  params.leaf.coarseness = 3;
  EXPECT_THAT(unused(params), ElementsAre("/leaf/fold"));
  params.leaf.build = TreeBuild::mesh;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreTheSeedOfProctreeBesideThatOfTheRequest) {
  TreeParams params = of(TreeModel::proctree);
  params.mSeed = 5;
  const auto pointers = [&](std::uint64_t seed) {
    Job job(seed, Job::Options{});
    std::vector<std::string> all;
    const Result<Appraisal> appraisal = appraise(params, {job});
    for (const Warning& each : appraisal->warnings) all.push_back(each.pointer);
    return all;
  };
  EXPECT_THAT(pointers(7), ElementsAre("/mSeed"));
  EXPECT_THAT(pointers(0), IsEmpty());
  params.sequence = TreeSequence::original;
  EXPECT_THAT(pointers(7), IsEmpty());
}

TEST(UnusedParameters, AreTheMatureAgeOfATreeWithoutAge) {
  TreeParams params;
  params.mature_age = 60;
  EXPECT_EQ(only_message(params), "`mature_age` has no effect unless `age` is given or `model` is grown.");
  params.age = 4;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreTheBendsOfLeavesThatAreFlat) {
  TreeParams params;
  params.leaf.fold = 40;
  params.leaf.droop = 50;
  params.leaf.coarseness = 2;
  for (const TreeBuild flat : {TreeBuild::usual, TreeBuild::card, TreeBuild::cross}) {
    params.leaf.build = flat;
    EXPECT_THAT(unused(params), ElementsAre("/leaf/fold", "/leaf/droop", "/leaf/coarseness"));
  }
  for (const TreeBuild bent : {TreeBuild::curved, TreeBuild::mesh, TreeBuild::twig, TreeBuild::bunch}) {
    params.leaf.build = bent;
    EXPECT_THAT(unused(params), IsEmpty());
  }
  params.model = TreeModel::proctree;  // whose usual leaves are bunches
  params.leaf.build = TreeBuild::usual;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreTheAppearanceOfLeavesThatAreAbsent) {
  TreeParams params;
  params.leaf.size = 2;
  params.season = TreeSeason::winter;  // in summer there are some
  EXPECT_THAT(unused(params), IsEmpty());
  params.leaf.build = TreeBuild::none;
  EXPECT_EQ(only_message(params), "`leaf.size` has no effect if `leaf.build` is none.");
  params.leaf.build = TreeBuild::card;
  params.Leaves = 0;
  params.LeafScale = 0.5;
  EXPECT_THAT(unused(params), ElementsAre("/leaf/size", "/LeafScale"));
}

TEST(UnusedParameters, AreColoursThatAnImageReplaces) {
  TreeParams params;
  params.leaf.autumn = Color{200, 100, 0};
  params.bark_color = Color{1, 2, 3};
  EXPECT_THAT(unused(params), IsEmpty());
  params.leaf.images.color = image;
  params.bark_images.color = image;
  EXPECT_THAT(unused(params), ElementsAre("/leaf/autumn", "/bark_color"));
  params.leaf.images.color.clear();
  params.bark_images.color.clear();
  params.leaf.evergreen = true;
  EXPECT_EQ(only_message(params), "`leaf.autumn` has no effect unless `leaf.evergreen` is false.");
}

TEST(UnusedParameters, AreCutsOfImagesThatAreAbsent) {
  TreeParams params;
  params.leaf.images.cut_out = true;
  params.bark_images.cut_out = true;
  EXPECT_THAT(unused(params), ElementsAre("/leaf/images/cut_out", "/bark_images/cut_out"));
  params.leaf.images.normal = image;
  params.bark_images.color = image;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreTheSeedOfNoBarkAndTheSizeOfNoRoots) {
  TreeParams params;
  params.bark_seed = 4;
  params.roots.depth = 0.5;
  params.roots.length = 4;
  params.bark = TreeBark::none;
  EXPECT_THAT(unused(params), ElementsAre("/roots/length", "/roots/depth", "/bark_seed"));
  params.roots.count = 3;
  params.bark = TreeBark::pine_bark;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreThoseOfLevelsThatDoNotBranch) {
  TreeParams params;
  params.Levels = 2;
  params.branches_2 = 7;
  params.curve_3 = 20;
  params.down_angle_2 = 20;  // of the leaves
  params.rotate_2 = 90;
  params.AttractionUp = 2;
  EXPECT_THAT(unused(params), ElementsAre("/AttractionUp", "/2Branches", "/3Curve"));
  params.Levels = 4;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreTheAnglesOfStemsThatDoNotSplit) {
  TreeParams params;
  params.split_angle_0 = params.split_angle_1 = params.split_angle_v_1 = 20;
  EXPECT_THAT(unused(params), ElementsAre("/0SplitAngle", "/1SplitAngle", "/1SplitAngleV"));
  params.base_splits = 1;
  params.seg_splits_1 = 0.5;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreTheLengthsOfLimbsOfABareTrunk) {
  TreeParams params;
  params.Levels = 1;
  params.crown_shape = 1;
  params.RatioPower = 2;
  EXPECT_THAT(unused(params), ElementsAre("/Shape", "/RatioPower"));
}

TEST(UnusedParameters, AreThoseOfAnEnvelopeThatPrunesNothing) {
  TreeParams params;
  params.PruneWidth = 0.3;
  params.PrunePowerLow = 0.2;
  EXPECT_THAT(unused(params), ElementsAre("/PruneWidth", "/PrunePowerLow"));
  params.crown_shape = 8;
  EXPECT_THAT(unused(params), ElementsAre("/PruneWidth"));
  params.PruneRatio = 0.5;
  EXPECT_THAT(unused(params), IsEmpty());
}

TEST(UnusedParameters, AreProfilesOfOtherShapesThanLathe) {
  TreeParams params = of(TreeModel::sculpt);
  params.sculpt.level.resize(4);
  params.sculpt.level[0].profile = {0, 1};
  params.sculpt.level[1].profile = {0, 1};
  params.sculpt.level[1].shape = TreeShape::lathe;
  params.sculpt.leaves = 0;
  params.sculpt.leaf_angle = 20;
  EXPECT_THAT(unused(params),
              ElementsAre("/sculpt/level/0/profile", "/sculpt/leaf_angle", "/sculpt/level/3"));
}

TEST(UnusedParameters, AreReportedWithTheModelAndTheEstimate) {
  TreeParams params;
  params.Levels = 1;
  params.mature_age = 60;
  Job job(1, Job::Options{});
  const Result<Model> model = generate(params, {job});
  ASSERT_TRUE(model);
  ASSERT_EQ(model->warnings.size(), 1U);
  EXPECT_EQ(model->warnings.front().pointer, "/mature_age");
  const Result<Appraisal> appraisal = appraise(params, {job});
  ASSERT_TRUE(appraisal);
  EXPECT_EQ(appraisal->warnings.size(), 1U);
}

}  // namespace
}  // namespace seedmesh::tree
