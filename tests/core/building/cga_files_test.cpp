/// What rule files of CityEngine have that single rules do not: attributes by functions, replaced rules, overloads.
#include <gmock/gmock.h>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

BuildingParams with_files(std::map<std::string, std::string> files,
                          std::array<double, 3> size = {10, 10, 10}) {
  BuildingParams params;
  params.rules = std::move(files);
  params.size = size;
  return params;
}

double reported(const Json& answer, const std::string& name) {
  return answer["reports"].contains(name) ? answer["reports"][name]["sum"].get<double>() : -1e300;
}

TEST(CgaFiles, FindsAttributesThatFunctionsOfOtherAttributesNeed) {
  // 4 floors of 3 m: `floors` and `floor_height` stand behind the attribute that needs them by two functions.
  const std::string rules =
      "attr height = whole\n"
      "whole = each * floors\n"
      "each = floor_height\n"
      "attr floors = 2 + extra\n"
      "attr floor_height = 3\n"
      "const extra = 2\n"
      "A --> report(\"h\", height) B.";
  EXPECT_EQ(reported(derived(with(rules)), "h"), 12);
  // The same with parameters that have the name of an attribute.
  const std::string hiding =
      "attr height = twice(5) + twice(other)  twice(other) = 2 * other  attr other = height_of(1)\n"
      "height_of(height) = height  A --> report(\"h\", height) B.";
  EXPECT_EQ(reported(derived(with(hiding)), "h"), 12);
  // A text by a case, as rule files state colours.
  const std::string colors =
      "attr color_of_wall = chosen\nchosen = case style_name == \"old\": \"#aa0000\" else: \"#ffffff\"\n"
      "attr style_name = \"old\"\nA --> case color_of_wall == \"#aa0000\": B. else: C.";
  EXPECT_EQ(leaves(colors), "B");
}

TEST(CgaFiles, RefusesAttributesThatNeedThemselvesByAFunction) {
  EXPECT_THAT(fault("attr a = f(1)  f(x) = x + b  attr b = a  A --> s(a, 1, 1) B."),
              HasSubstr("depends on itself"));
  EXPECT_THAT(fault("attr a = f(1)  f(x) = x + b  attr b = f(2)  A --> s(a, 1, 1) B."),
              HasSubstr("depends on itself"));
  EXPECT_EQ(fault("attr a = f(3)  f(x) = case x < 1: b else: f(x - 1)  attr b = 4  A --> s(a, 1, 1) B."),
            "none")
      << "a function may call itself";
}

TEST(CgaFiles, ReplacesRulesOfImportedFiles) {
  const std::map<std::string, std::string> files = {
      {"m.cga",
       "import towers : \"t.cga\"\nimport walls : \"w.cga\"\nLot --> towers.Tower walls.Wall(2)\n"
       "towers.Mass --> Glass.\nwalls.Wall(n) --> s(n, '1, '1) Brick."},
      {"t.cga", "import deep : \"d.cga\"\nTower --> extrude(9) Mass deep.Part\nMass --> Plain."},
      {"w.cga", "Wall(n) --> Plaster."},
      {"d.cga", "Part --> Small."}};
  const Json answer = derived(with_files(files, {10, 0, 10}));
  EXPECT_EQ(active(answer), "Glass Small Brick");
  EXPECT_TRUE(answer["warnings"].empty()) << answer["warnings"].dump();
  std::map<std::string, std::string> deeper = files;
  deeper["m.cga"] += "\ntowers.deep.Part --> case true: Big. else: NIL";
  EXPECT_EQ(active(derived(with_files(deeper, {10, 0, 10}))), "Glass Big Brick");
}

TEST(CgaFiles, ImportWithoutANameAddsTheDeclarationsOfAFile) {
  // The importing file replaces what it declares, too; its own start rule counts.
  const std::map<std::string, std::string> files = {
      {"m.cga",
       "import \"w.cga\"\nattr height = 5\n@StartRule\nLot --> extrude(twice(height)) Mass\nWall --> Brick."},
      {"w.cga",
       "import \"v.cga\"\nattr height = 1\ntwice(x) = 2 * x\n@StartRule\nOther --> Wrong.\n"
       "Mass --> comp(f){ front: Wall | top: Roof }\nWall --> Plaster."},
      {"v.cga", "Roof --> Tiles.\nMass --> Wrong."}};
  const Json answer = derived(with_files(files, {10, 0, 10}));
  EXPECT_EQ(active(answer), "Brick Tiles");
  EXPECT_EQ(answer["shapes"].back()["scope"]["origin"][1], 10);
  EXPECT_THAT(answer["warnings"].dump(), HasSubstr("get no prefix"));
  // Without quotes, and with the start rule of the imported file.
  EXPECT_EQ(
      active(derived(with_files({{"m.cga", "import w.cga\nWall --> Brick."},
                                 {"w.cga", "X --> Wrong.\n@StartRule Lot --> Wall\nWall --> Plaster."}}))),
      "Brick");
  // A file that is imported with a name can include another, whose names get the prefix.
  EXPECT_EQ(active(derived(with_files({{"m.cga", "import a : \"a.cga\"\nLot --> a.Wall a.Roof"},
                                       {"a.cga", "import \"b.cga\"\nWall --> Roof"},
                                       {"b.cga", "Roof --> Tiles."}}))),
            "Tiles Tiles");
}

TEST(CgaFiles, CanHaveValuesAloneAndAByteOrderMark) {
  const Json answer =
      derived(with("\xEF\xBB\xBF"
                   "version \"2025.0\"\nconst a = 3\nf(x) = x + a"));
  EXPECT_EQ(active(answer), "Lot");
  EXPECT_THAT(answer["warnings"].dump(), HasSubstr("found no rule"));
  EXPECT_EQ(leaves("\xEF\xBB\xBF"
                   "attr h = 2\nLot --> extrude(h) Mass."),
            "Mass");
  EXPECT_THAT(fault("  "), HasSubstr("found no rule"));
}

TEST(CgaFiles, RefusesFilesThatIncludeEachOther) {
  const std::vector<Issue> issues = check(with_files({{"m.cga", "import \"a.cga\"\n@StartRule\nLot --> A"},
                                                      {"a.cga", "import \"b.cga\"\nA --> B"},
                                                      {"b.cga", "import \"a.cga\"\nB --> C."}}),
                                          Limits{});
  ASSERT_FALSE(issues.empty());
  EXPECT_THAT(issues[0].message, HasSubstr("in a cycle"));
  EXPECT_EQ(issues[0].line, 1);
}

TEST(CgaFiles, KeepsFunctionsWithAndWithoutParametersApart) {
  const std::string rules =
      "mix = case scope.sx > 5: \"a\" else: \"b\"\n"
      "mix(n) = n + 1\n"
      "mix(n, m) = n * m\n"
      "A --> report(\"x\", mix(2) + mix(3, 4)) D  D --> case mix == \"a\": B. else: C.";
  EXPECT_EQ(reported(derived(with(rules)), "x"), 15);
  EXPECT_EQ(leaves(rules), "B");
}

TEST(CgaFiles, TakesCasesInBracketsInsideArguments) {
  const std::string rules =
      "A --> B((case scope.sx > 5: 0 else: 2), 3)\n"
      "B(a, b) --> report(\"a\", a) report(\"b\", 10 * (case b == 3: 1 else: 2) + a) C.";
  const Json answer = derived(with(rules));
  EXPECT_EQ(reported(answer, "a"), 0);
  EXPECT_EQ(reported(answer, "b"), 10);
}

TEST(CgaFiles, JoinsTheOperationsInBracesBehindInline) {
  const std::string rules =
      "A --> comp(f){ top: T }  T --> extrude(2) inline(append){ Put } Wall.  Put --> color(\"#00ff00\") "
      "Grass.";
  EXPECT_EQ(fault(rules), "none");
  const Json answer = derived(with(rules, {4, 1, 4}));
  EXPECT_THAT(active(answer), HasSubstr("Wall"));
}

TEST(CgaFiles, ExtrudesAReversedFaceAlongItsNormal) {
  const auto low = [](const std::string& rules) {
    const Model model = model_of(with("version \"2024.1\"\n" + rules, {4, 4, 4}));
    double lowest = 1e300;
    for (const Mesh* mesh : {&model.meshes.at(0).primitives.at(0).mesh}) {
      for (const glm::vec3& p : mesh->position) lowest = std::min<double>(lowest, p.y);
    }
    return lowest;
  };
  EXPECT_NEAR(low("Lot --> comp(f){ bottom: extrude(3) A. }"), -3, 1e-6);
  EXPECT_NEAR(low("Lot --> comp(f){ bottom: reverseNormals() extrude(3) A. }"), 0, 1e-6);
  EXPECT_NEAR(low("Lot --> comp(f){ bottom: reverseNormals() rotateScope(0, 0, 180) roofPyramid(45) A. }"), 0,
              1e-6);
}

TEST(CgaFiles, TakesConstantsWithEmptyBrackets) {
  EXPECT_EQ(
      reported(derived(with("const n = 3\nattr m = n() + 1\nf() = m()\nA --> report(\"x\", n() * f()) B.")),
               "x"),
      12);
}

TEST(CgaFiles, TakesRangesOfTextsAsLists) {
  BuildingParams params = with(
      "version \"2018.0\"\n@Range(\"square\", \"round\") attr kind = \"square\"\n@Range(true, false) attr "
      "roofs = false\n"
      "A --> case kind == \"round\" && roofs: B. else: C.");
  EXPECT_EQ(active(derived(params)), "C");
  params.attributes = {{"kind", std::string("round")}, {"roofs", true}};
  EXPECT_EQ(active(derived(params)), "B");
  params.attributes["kind"] = std::string("oval");
  const std::vector<Issue> issues = check(params, Limits{});
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].pointer, "/attributes/kind");
}

/// The CGA reference on extrude and roofHip: y along the normal of the face, x kept as much as possible.
TEST(CgaFiles, TurnsTheScopeTowardsTheDirectionOfAnExtrusion) {
  const auto scopes = [](const std::string& rules) {
    return derived(with("version \"2024.1\"\n" + rules, {10, 0, 8}));
  };
  const Json roof = scopes("Lot --> extrude(9) comp(f){ top: roofHip(45) s('1, 2, '1) Roof. }");
  EXPECT_EQ(active(roof), "Roof");
  EXPECT_THAT(sizes(roof, 0), ElementsAre(10));
  EXPECT_THAT(sizes(roof, 1), ElementsAre(2));
  EXPECT_THAT(sizes(roof, 2), ElementsAre(8));
  EXPECT_NEAR(
      volume(with("version \"2024.1\"\nLot --> extrude(9) comp(f){ top: roofHip(45) s('1, 2, '1) Roof. }",
                  {10, 0, 8})),
      // A hip roof of height h over a x b: h b (3 a - b) / 6, with a ridge of a - b.
      2.0 * 8 * (3 * 10 - 8) / 6, 1e-4);
  const Json wall =
      scopes("Lot --> extrude(9) comp(f){ front: extrude(0.5) split(y){ 0.2: Inner. | ~1: Outer. } }");
  EXPECT_EQ(active(wall), "Inner Outer");
  EXPECT_THAT(sizes(wall, 0), ElementsAre(10, 10));
  EXPECT_THAT(sizes(wall, 2), ElementsAre(9, 9));
  EXPECT_NEAR(sizes(wall, 1)[0], 0.2, 1e-12);
  EXPECT_EQ(
      active(scopes("Lot --> extrude(9) comp(f){ front: extrude(0.5) comp(f){ top: Front. | all: NIL } }")),
      "Front");
  // Lots have y upwards already, and rules without a version keep the axes of the face.
  EXPECT_THAT(sizes(scopes("Lot --> extrude(9) A."), 1), ElementsAre(9));
  EXPECT_THAT(sizes(derived(with("A --> comp(f){ front: extrude(0.5) B. }")), 2), ElementsAre(0.5));
}

}  // namespace
}  // namespace seedmesh::building
