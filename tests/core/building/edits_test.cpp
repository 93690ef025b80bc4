#include <gmock/gmock.h>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

using testing::HasSubstr;

const std::string facade =
    "attr glass = 1\n"
    "Lot --> split(y){ 3: floor | 3: floor | ~1: attic. }\n"
    "floor --> split(x){ 2: window | 2: window | ~1: window }\n"
    "window --> case glass > 1: s('1, glass, '1) wide. else: pane.\n"
    "door --> doorway.\n";

BuildingEdit edit_of(const std::string& shape) {
  BuildingEdit edit;
  edit.shape = shape;
  return edit;
}

std::vector<std::string> paths(const Json& answer) {
  std::vector<std::string> out;
  for (const Json& shape : answer["shapes"]) {
    if (shape["active"]) out.push_back(shape["path"]);
  }
  return out;
}

TEST(Edits, FindShapesByThePathsThatDeriveLists) {
  const std::vector<std::string> expected{"Lot/floor[1]/window[1]/pane[1]",
                                          "Lot/floor[1]/window[2]/pane[1]",
                                          "Lot/floor[1]/window[3]/pane[1]",
                                          "Lot/floor[2]/window[1]/pane[1]",
                                          "Lot/floor[2]/window[2]/pane[1]",
                                          "Lot/floor[2]/window[3]/pane[1]",
                                          "Lot/attic[1]"};
  EXPECT_THAT(paths(derived(with(facade))), testing::UnorderedElementsAreArray(expected));
}

TEST(Edits, RemoveOneShapeWithAllThatIsMadeOfIt) {
  BuildingParams params = with(facade);
  params.edits = {edit_of("Lot/floor[2]/window[2]")};
  params.edits[0].remove = true;
  const std::vector<std::string> left = paths(derived(params));
  EXPECT_EQ(left.size(), 6U);
  EXPECT_THAT(left, testing::Not(testing::Contains(HasSubstr("floor[2]/window[2]"))));
}

TEST(Edits, ReplaceTheRuleOfOneShapeAndKeepItsPath) {
  BuildingParams params = with(facade);
  params.edits = {edit_of("Lot/floor/window[2]")};
  params.edits[0].rule = "door";
  const Json answer = derived(params);
  EXPECT_THAT(paths(answer), testing::Contains("Lot/floor[1]/window[2]/doorway[1]"));
  EXPECT_EQ(paths(answer).size(), 7U);
  EXPECT_TRUE(answer["warnings"].empty());
}

TEST(Edits, GiveAttributesToAShapeAndItsDescendants) {
  BuildingParams params = with(facade);
  params.edits = {edit_of("Lot/floor[2]")};
  params.edits[0].attributes["glass"] = 2.5;
  EXPECT_EQ(active(derived(params)), "attic pane pane pane wide wide wide");
}

TEST(Edits, ChangeALeafAndTheFirstShape) {
  BuildingParams params = with(facade);
  params.edits = {edit_of("Lot/attic")};
  params.edits[0].rule = "door";
  EXPECT_THAT(active(derived(params)), testing::EndsWith("doorway"));
  params.edits = {edit_of("Lot")};
  params.edits[0].rule = "floor";
  EXPECT_EQ(active(derived(params)), "pane pane pane");
}

TEST(Edits, SurviveChangesOfOtherShapes) {
  BuildingParams params = with(facade);
  params.edits = {edit_of("Lot/floor[2]/window[3]")};
  params.edits[0].rule = "door";
  const auto box = [](const Json& answer) {
    for (const Json& shape : answer["shapes"]) {
      if (shape["symbol"] == "doorway") return shape["scope"];
    }
    return Json();
  };
  const Json before = box(derived(params));
  // A ledge between the floors, and another first floor.
  params.rules =
      "attr glass = 1\n"
      "Lot --> split(y){ 3: floor | 0: ledge. | 3: floor | ~1: attic. }\n"
      "floor --> split(x){ 2: window | 2: window | ~1: window }\n"
      "window --> pane.\n"
      "door --> doorway.\n";
  params.edits.push_back(edit_of("Lot/floor[1]"));
  params.edits[1].remove = true;
  const Json after = derived(params);
  EXPECT_EQ(box(after), before);
  EXPECT_EQ(active(after), "attic pane pane doorway");
}

TEST(Edits, KeepTheRandomNumbersOfOtherShapes) {
  const std::string rules =
      "Lot --> split(x){ 1: A }*\nA --> 50%: t(rand(1), 0, 0) B. else: t(0, rand(1), 0) C.\nD --> E.\n";
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    BuildingParams params = with(rules, {20, 1, 1});
    const Json before = derived(params, seed);
    params.edits = {edit_of("Lot/A[7]")};
    params.edits[0].rule = "D";
    const Json after = derived(params, seed);
    const auto scopes = [](const Json& answer) {
      std::map<std::string, Json> out;
      for (const Json& shape : answer["shapes"]) {
        if (!shape["path"].get<std::string>().starts_with("Lot/A[7]")) out[shape["path"]] = shape["scope"];
      }
      return out;
    };
    EXPECT_EQ(scopes(after), scopes(before));
  }
}

TEST(Edits, WithoutAShapeAreWarnings) {
  BuildingParams params = with(facade);
  params.edits = {edit_of("Lot/floor[3]")};
  params.edits[0].remove = true;
  const Json answer = derived(params);
  ASSERT_EQ(answer["warnings"].size(), 1U);
  EXPECT_EQ(answer["warnings"][0]["pointer"], "/edits/0/shape");
}

TEST(Edits, AreRefusedWithTheirPointer) {
  BuildingParams params = with(facade);
  params.edits = {edit_of("Lot/flor[1]"), edit_of("Lot//x"), edit_of("floor"), edit_of("Lot/floor"),
                  edit_of("Lot/floor[1]")};
  params.edits[0].remove = params.edits[1].remove = params.edits[2].remove = params.edits[4].remove = true;
  params.edits[3].rule = "porch";
  params.edits[3].attributes["glas"] = 2.0;
  std::vector<std::string> found;
  for (const Issue& issue : check(params, Limits{})) found.push_back(issue.pointer + " " + issue.message);
  EXPECT_THAT(found,
              testing::UnorderedElementsAre(
                  HasSubstr("/edits/0/shape the rules have no symbol \"flor\"; did you mean \"floor\"?"),
                  HasSubstr("/edits/1/shape expected names of shapes"),
                  HasSubstr("/edits/2/shape found \"floor\" as the first shape, expected \"Lot\""),
                  HasSubstr("/edits/3/rule the rules have no symbol \"porch\""),
                  HasSubstr("/edits/3/attributes/glas the rules declare no attribute of this name"),
                  HasSubstr("/edits/4/shape edit 3 changes the same shape")));
}

}  // namespace
}  // namespace seedmesh::building
