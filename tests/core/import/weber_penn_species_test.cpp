/// Species of Arbaro, tree-gen and Sapling. The values of each file are its own numbers, under the names of the schema.
#include <gmock/gmock.h>

#include <cmath>

#include "core/pipeline.h"
#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* alder = R"(<?xml version='1.0' ?>
<!-- by hand -->
<arbaro>
  <species name='alder'>
    <param name='Shape' value='3'/>
    <param name='Levels' value='2'/>
    <param name='Scale' value='9.5'/>
    <param name='Lobes' value='0'/>
    <param name="0Branches" value="3"/>
    <param name='0BranchDist' value='0.75'/>
    <param name='0Length' value='0.9'/>
    <param name='1Branches' value='17'/>
    <param name='1BranchDist' value='0.25'/>
    <param name='1DownAngleV' value='-30'/>
    <param name='2DownAngle' value='40'/>
    <param name='2Branches' value='0'/>
    <param name='3CurveRes' value='0'/>
    <param name='LeafShape' value='disc4'/>
    <param name='LeafQuality' value='1'/>
  </species>
</arbaro>
)";

TEST(Arbaro, BecomesATreeWithItsParameters) {
  const auto result = imported("", alder);
  ASSERT_TRUE(result) << reports(result)[0];
  const nlohmann::json parameters = parameters_of(result);
  const nlohmann::json expected = {
      {"Shape", 3},     {"Levels", 2},     {"Scale", 9.5},        {"0Branches", 3},     {"0BranchDist", 0.75},
      {"0Length", 0.9}, {"1Branches", 17}, {"1BranchDist", 0.25}, {"1DownAngleV", -30}, {"2DownAngle", 40}};
  for (const auto& [name, value] : expected.items()) {
    ASSERT_TRUE(parameters.contains(name)) << name << " in " << parameters.dump();
    EXPECT_EQ(parameters[name].get<double>(), value.get<double>()) << name;
  }
  EXPECT_EQ(parameters.at("leaf").at("shape"), "kite");
  EXPECT_FALSE(parameters.contains("2Branches")) << "there is no level 2";
  EXPECT_FALSE(parameters.contains("3CurveRes")) << "0 of a level without limbs says nothing";
}

TEST(Arbaro, HasTheDefaultsOfArbaroWhereTheFileHasNone) {
  const nlohmann::json parameters = parameters_of(
      imported("arbaro", "<arbaro><species name='x'><param name='Leaves' value='4'/></species></arbaro>"));
  ASSERT_TRUE(parameters.is_object());
  const nlohmann::json expected = {{"Shape", 0},      {"Scale", 10},    {"BaseSize", 0.25}, {"Ratio", 0.05},
                                   {"1Branches", 10}, {"1Length", 0.5}, {"1DownAngle", 30}, {"1CurveRes", 3}};
  for (const auto& [name, value] : expected.items())
    EXPECT_EQ(parameters.value(name, -1.0), value.get<double>()) << name;
}

TEST(Arbaro, HasAtMostSixteenRibs) {
  const auto result = imported("arbaro",
                               "<arbaro><species name='x'>\n<param name='Lobes' value='20'/>\n"
                               "<param name='LobeDepth' value='0.2'/></species></arbaro>");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["Lobes"], 16);
  EXPECT_THAT(reports(result), Contains(AllOf(HasSubstr("2:28"), HasSubstr("at most 16 ribs"))));
}

TEST(Arbaro, ReportsWhatItDoesNotKnowAtItsLine) {
  EXPECT_THAT(reports(imported("arbaro",
                               "<arbaro><species name='x'>\n<param name='Shapes' value='3'/>\n"
                               "<param name='Scale' value='tall'/>\n"
                               "<param name='Ratio'/>\n</species></arbaro>")),
              ElementsAre(AllOf(HasSubstr("2:14"), HasSubstr("`Shapes` is no parameter of Arbaro")),
                          AllOf(HasSubstr("3:"), HasSubstr("`tall`, expected a number")),
                          AllOf(HasSubstr("4:1"), HasSubstr("expected `<param"))));
  EXPECT_THAT(reports(imported("arbaro", "<arbaro></arbaro>")), Contains(HasSubstr("found no species")));
  EXPECT_THAT(reports(imported("arbaro",
                               "<arbaro><species name='x'><param name='Scale' value='1'/>\n"
                               "<param name='Scale' value='2'/></species></arbaro>")),
              Contains(AllOf(HasSubstr("2:"), HasSubstr("second value of `Scale`"))));
}

constexpr const char* fir = R"(# a fir
params = {
    'shape': 0, 'g_scale': 6, 'g_scale_v': 1, 'levels': 3, 'ratio': 0.02, 'flare': 0.3,
    'base_size': [0.1, 0.05, 0], 'branches': [1, 30, 6, 0], 'branch_dist': [0, 2, 1, 0],
    'length': [1, 0.4, 0.5, 0], 'down_angle': [0, 90, -50, 45], 'rotate': [0, 60, -180, 140],
    'curve_res': (8, 4, 1, 0), 'leaf_blos_num': -3, 'tropism': [0, 0, 0.5], 'leaf_shape': 2,
}
)";

TEST(Arbaro, LeavesTheImagesOfOtherProgramsOut) {
  const auto result = imported("arbaro",
                               "<arbaro><species name='oak'>\n<param name='Levels' value='2'/>\n"
                               "<param name='BarkTexture' value='bark7.jpg'/>\n"
                               "<param name='LeafTexture' value='leaf2.png'/>\n"
                               "<param name='LeafTextureRotation' value='135.0'/>\n</species></arbaro>");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(
      reports(result),
      testing::IsSupersetOf({"3:34 `BarkTexture` belongs to an image that does not exist here",
                             "5:42 `LeafTextureRotation` belongs to an image that does not exist here"}));
}

TEST(TreeGen, BecomesATreeWithItsParameters) {
  const auto result = imported("", fir);
  ASSERT_TRUE(result) << reports(result)[0];
  const nlohmann::json parameters = parameters_of(result);
  const nlohmann::json expected = {
      {"Shape", 0},      {"Scale", 6},        {"ScaleV", 1},     {"Ratio", 0.02},     {"Flare", 0.3},
      {"BaseSize", 0.1}, {"1BaseSize", 0.05}, {"1Branches", 30}, {"2Branches", 6},    {"1Whorl", 3},
      {"2Whorl", 2},     {"1Length", 0.4},    {"2Length", 0.5},  {"2DownAngle", -50}, {"2Rotate", -180},
      {"0CurveRes", 8},  {"Leaves", -3}};
  for (const auto& [name, value] : expected.items()) {
    ASSERT_TRUE(parameters.contains(name)) << name << " in " << parameters.dump();
    EXPECT_EQ(parameters[name].get<double>(), value.get<double>()) << name;
  }
  EXPECT_EQ(parameters.at("leaf").at("shape"), "willow");
}

TEST(TreeGen, HasAsManyTrunksAsAClumpOfBamboo) {
  const auto result = imported(
      "tree_gen", R"(params = {'shape': 0, 'levels': 2, 'floor_splits': 50, 'branches': [0, 25, 0, 10]})");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["0Branches"], 51);
}

TEST(TreeGen, ReadsPresetsOfSapling) {
  const auto result = imported("",
                               "{'shape': '4', 'scale': 7.5, 'levels': 2, 'ratioPower': 1.5, 'ratio': 0.03,\n"
                               " 'curveRes': (9, 6, 3, 1), 'branches': (0, 21, 30, 10), 'baseSize': 0.3,\n"
                               " 'attractUp': 0.25, 'showLeaves': False, 'prune': False, 'pruneRatio': 1.0,\n"
                               " 'bevel': True, 'handleType': '0', 'seed': 12, 'leaves': 11}");
  ASSERT_TRUE(result) << reports(result)[0];
  const nlohmann::json request = nlohmann::json::parse(result->request.canonical());
  const nlohmann::json& parameters = request.at("parameters");
  EXPECT_EQ(request.at("seed"), 12);
  EXPECT_EQ(parameters.at("Shape"), 4);
  EXPECT_EQ(parameters.at("Scale"), 7.5);
  EXPECT_EQ(parameters.at("BaseSize"), 0.3);
  EXPECT_EQ(parameters.at("0CurveRes"), 9);
  EXPECT_EQ(parameters.at("1Branches"), 21);
  EXPECT_FALSE(parameters.contains("PruneRatio")) << "pruning is off";
  EXPECT_EQ(parameters.at("leaf").at("build"), "none");
}

TEST(TreeGen, HasTheDefaultsOfTreeGenWhereTheFileHasNone) {
  const nlohmann::json parameters =
      parameters_of(imported("tree_gen", "{'shape': 0, 'g_scale': 9, 'seg_splits': [0.5, 0, 0, 0]}"));
  // The numbers are those of tree-gen's tree_param.py where they are not those of the aspen.
  EXPECT_EQ(parameters.value("BaseSize", -1.0), 0.3);
  EXPECT_EQ(parameters.value("1BaseSize", -1.0), 0.02);
  EXPECT_EQ(parameters.value("2BaseSize", -1.0), 0.02);
  EXPECT_EQ(parameters.value("LeafBend", -1.0), 0);
  EXPECT_EQ(parameters.value("0CurveRes", -1), 5);
  EXPECT_EQ(parameters.value("0SplitAngle", -1.0), 40);
  EXPECT_EQ(parameters.value("0SplitAngleV", -1.0), 5);
  EXPECT_FALSE(parameters.contains("Flare")) << "it is 0.6, as that of the aspen";
}

constexpr const char* sapling = R"({'shape': '7', 'levels': 3, 'curveRes': (8, 5, 3, 1), 'baseSize': 0.4,
 'baseSize_s': 0.25, 'branches': (3, 50, 30, 1), 'useOldDownAngle': False, 'downAngle': (90.0, 110.0, 45.0, 45.0),
 'downAngleV': (0.0, 80.0, -10.0, 10.0), 'leafDownAngle': 48.0, 'leafDownAngleV': 16.0, 'leafRotate': 137.5,
 'rotate': (99.5, 137.5, 137.5, 77.0), 'radiusTweak': (1.0, 1.0, 1.0, 1.0), 'rootFlare': 1.0, 'pruneRatio': 1.0,
 'branchDist': 1.0, 'leaves': 9})";

TEST(TreeGen, ReadsTheBasesAndAnglesOfNewerVersionsOfSapling) {
  const auto result = imported("", sapling);
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), testing::IsEmpty());
  const nlohmann::json parameters = parameters_of(result);
  // Each level has a quarter of the base of the level before; the last of the three has none.
  EXPECT_NEAR(parameters.at("1BaseSize").get<double>(), 0.4 * 0.25, 1e-12);
  EXPECT_FALSE(parameters.contains("2BaseSize"));
  // 110 and 80 are the 60 and -50 of the older formula, as a comment in Sapling's source says.
  EXPECT_FALSE(parameters.contains("1DownAngle")) << "60, as that of the aspen: " << parameters["1DownAngle"];
  EXPECT_FALSE(parameters.contains("1DownAngleV"));
  EXPECT_FALSE(parameters.contains("2DownAngleV")) << "-10 is random, and the aspen has 10 degrees, too";
  // Leaves turn from 48 degrees at the base to 32 at the tip: D + |V| and D - 0.6 |V|.
  EXPECT_NEAR(parameters.at("3DownAngle").get<double>(), 38, 1e-12);
  EXPECT_NEAR(parameters.at("3DownAngleV").get<double>(), -10, 1e-12);
  EXPECT_EQ(parameters.at("3Rotate"), 137.5);
  EXPECT_FALSE(parameters.contains("0Branches")) << "Sapling does not read the first number";
  EXPECT_FALSE(parameters.contains("PruneRatio")) << "pruning is off unless it is on";
  EXPECT_EQ(parameters.at("AttractionUp"), 0);
}

TEST(TreeGen, TakesTheCrownShapeThatIsMostSimilarToSaplingsOwn) {
  const auto made = [](const std::string& custom) {
    return imported(
        "tree_gen",
        "{'shape': '8', 'baseSize': 0.4, 'length': (1.0, 0.4, 0.4, 0.3),\n'customShape': " + custom + "}");
  };
  // A cylinder of 0.6 of the length, and lengths that rise from a half to 1 at 0.3 and fall to a half again.
  const auto cylinder = made("(0.6, 0.6, 0.5, 0.6)");
  ASSERT_TRUE(cylinder) << reports(cylinder)[0];
  EXPECT_EQ(parameters_of(cylinder)["Shape"], 3);
  EXPECT_NEAR(double{parameters_of(cylinder)["1Length"]}, 0.24, 1e-9);
  EXPECT_THAT(reports(cylinder), Contains(HasSubstr("1:11 shape 8 of Sapling")));
  EXPECT_EQ(parameters_of(made("(0.5, 1.0, 0.3, 0.5)")).value("Shape", 7), 7);
}

TEST(TreeGen, TakesTheVariationOfSaplingsLengthsAsAShare) {
  const auto parameters = parameters_of(imported(
      "tree_gen",
      "{'shape': '7', 'baseSize': 0.4, 'length': (1.0, 0.2, 0.5, 0.4), 'lengthV': (0.1, 0.25, 0.1, 0)}"));
  EXPECT_NEAR(double{parameters["0LengthV"]}, 0.1, 1e-12);
  EXPECT_NEAR(double{parameters["1LengthV"]}, 0.05, 1e-12);
  EXPECT_NEAR(double{parameters["2LengthV"]}, 0.05, 1e-12);
}

/// Stems of each level and leaves of a file.
std::vector<double> counts_of(const std::string& file) {
  const auto result = imported("tree_gen", file);
  EXPECT_TRUE(result) << reports(result)[0];
  if (!result) return {};
  const nlohmann::json tree = nlohmann::json::parse(*derive(result->request, {}));
  std::vector<double> counts;
  for (const nlohmann::json& level : tree.at("levels")) counts.push_back(level.at("count"));
  counts.push_back(tree.at("leaves"));
  return counts;
}

TEST(TreeGen, HasAsManyLimbsAndLeavesAsSapling) {
  // The numbers are those of Sapling's own script with these values.
  const std::string same = "'prune': False, 'ratio': 0.015, 'ratioPower': 1.2, 'scaleV': 0.0";
  const std::vector<double> three = counts_of(
      "{'shape': '7', 'shapeS': '4', 'levels': 3, 'scale': 10.0, 'branches': (0, 40, 12, 0), 'leaves': 20, "
      "'leafDist': '6', 'baseSize': 0.3, 'baseSize_s': 0.5, 'length': (1.0, 0.4, 0.5, 0.4), 'curveRes': "
      "(6, 4, 3, 1), " +
      same + "}");
  ASSERT_EQ(three.size(), 4U);
  EXPECT_EQ(three[1], 28);
  EXPECT_NEAR(three[2], 233, 0.03 * 233);
  EXPECT_NEAR(three[3], 1847, 0.03 * 1847);
  const std::vector<double> two = counts_of(
      "{'shape': '4', 'levels': 2, 'scale': 8.0, 'branches': (0, 31, 10, 0), 'leaves': 33, 'leafDist': '4', "
      "'baseSize': 0.45, 'baseSize_s': 0.25, 'length': (1.0, 0.3, 0.5, 0.4), 'curveRes': (6, 5, 3, 1), " +
      same + "}");
  ASSERT_EQ(two.size(), 3U);
  EXPECT_EQ(two[1], 17);
  EXPECT_NEAR(two[2], 275, 0.03 * 275);
}

TEST(TreeGen, KeepsTheSignsOfOlderVersionsOfSapling) {
  const nlohmann::json parameters = parameters_of(imported(
      "",
      "{'shape': '7', 'levels': 2, 'curveRes': (8, 5, 3, 1), 'baseSize': 0.4, 'baseSize_s': 0.25,\n"
      " 'downAngle': (0, 70.0, 30, 45), 'downAngleV': (0.0, -35.0, 20, 10), 'branches': (0, 20, 30, 1)}"));
  EXPECT_EQ(parameters.at("1DownAngle"), 70);
  EXPECT_EQ(parameters.at("1DownAngleV"), -35);
  EXPECT_EQ(parameters.at("2DownAngle"), 30);
  EXPECT_FALSE(parameters.contains("1BaseSize")) << "the last level has none";
}

TEST(TreeGen, GivesSeveralTrunksTheSpaceOfTheOriginal) {
  const auto result =
      imported("tree_gen", "{'shape': 1, 'g_scale': 5, 'ratio': 0.02, 'branches': [5, 3, 0, 0]}");
  ASSERT_TRUE(result);
  EXPECT_EQ(parameters_of(result).at("0Branches"), 5);
  EXPECT_NEAR(parameters_of(result).at("0BranchDist").get<double>(), std::sqrt(5 / 2.5 * 5 * 0.02), 1e-9);
}

TEST(TreeGen, WarnsOfWhatHasNoCounterpartAndReportsErrors) {
  EXPECT_THAT(reports(imported("tree_gen", "{'shape': 7,\n 'blossom_rate': 0.5,\n 'tropism': [1, 0, 0.5]}")),
              AllOf(Contains(AllOf(HasSubstr("2:2"), HasSubstr("`blossom_rate` has no counterpart"))),
                    Contains(AllOf(HasSubstr("3:2"), HasSubstr("not sideways")))));
  EXPECT_THAT(reports(imported("tree_gen", "{'shape': 7, 'branches': [0, many]}")),
              Contains(HasSubstr("`many`, expected a number")));
  EXPECT_THAT(reports(imported("tree_gen", "{'shape': 7,\n 'branches' [0]}")), Contains(HasSubstr("2:2")));
  EXPECT_THAT(reports(imported("tree_gen", "{'shape': 7")), Contains(HasSubstr("without its `}`")));
  EXPECT_THAT(reports(imported("tree_gen", "shape = 7")), Contains(HasSubstr("found no dictionary")));
  EXPECT_THAT(reports(imported("tree_gen", "{'shape': 7, 'g_scale': 1e9}")), Contains(HasSubstr("1:25")))
      << "errors of the generator are at the value";
}

}  // namespace
}  // namespace seedmesh
