/// The language of CityEngine's rules: comments, files, cases, groups, texts, arrays, functions.
#include <gmock/gmock.h>

#include "core/generators/building/operations.h"
#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double reported(const std::string& expression, std::array<double, 3> size = {10, 10, 10}) {
  const Json answer = derived(with("A --> report(\"x\", " + expression + ") B.", size));
  return answer["reports"].contains("x") ? answer["reports"]["x"]["sum"].get<double>() : -1e300;
}

BuildingParams with_files(std::map<std::string, std::string> files,
                          std::array<double, 3> size = {10, 10, 10}) {
  BuildingParams params;
  params.rules = std::move(files);
  params.size = size;
  return params;
}

TEST(CgaLanguage, SkipsCommentsThatBeginWithANumberSign) {
  EXPECT_EQ(leaves("# rules of a wall\nA --> B. # not C.\nC --> D."), "B");
  EXPECT_EQ(leaves("A --> color(\"#ff0000\") B."), "B");
}

TEST(CgaLanguage, EndsANestedCaseWithItsOwnElse) {
  const std::string rules =
      "A --> case scope.sx > 5:\n"
      "        case scope.sy > 5: B.\n"
      "        else: C.\n"
      "      else: D.";
  EXPECT_EQ(leaves(rules, {10, 10, 1}), "B");
  EXPECT_EQ(leaves(rules, {10, 1, 1}), "C");
  EXPECT_EQ(leaves(rules, {1, 10, 1}), "D");
}

TEST(CgaLanguage, TakesCasesAndPercentagesInBrackets) {
  const std::string rules = "A --> [ case scope.sx > 5: B. else: C. ] [ 100%: D. else: E. ] F.";
  EXPECT_EQ(leaves(rules), "B D F");
  EXPECT_EQ(leaves(rules, {1, 1, 1}), "C D F");
}

TEST(CgaLanguage, DrawsFromPercentagesInsideAnElse) {
  std::map<std::string, int> counts;
  for (std::uint64_t seed = 0; seed < 3000; ++seed)
    ++counts[leaves("A --> 50%: B. else: case scope.sx > 5: 40%: C. else: D. else: E.", {10, 1, 1}, seed)];
  // Shares of 0.5, 0.5 * 0.4 and 0.5 * 0.6, within four standard deviations.
  EXPECT_NEAR(counts["B"], 1500, 110);
  EXPECT_NEAR(counts["C"], 600, 88);
  EXPECT_NEAR(counts["D"], 900, 101);
  EXPECT_EQ(counts.count("E"), 0U);
}

TEST(CgaLanguage, DrawsOnceBetweenSeveralPercentagesOfAValue) {
  std::map<std::string, int> counts;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    ++counts[leaves("const k = 30%: 1 50%: 2 else: 3  A --> case k == 1: B. case k == 2: C. else: D.",
                    {1, 1, 1}, seed)];
  }
  EXPECT_NEAR(counts["B"], 900, 101);
  EXPECT_NEAR(counts["C"], 1500, 110);
  EXPECT_NEAR(counts["D"], 600, 88);
}

TEST(CgaLanguage, DoesNotRepeatGroupsWithoutAStar) {
  EXPECT_THAT(sizes(derived(with("A --> split(x){ { 1: B. } | ~1: C. | { 2: D. } }")), 0),
              ElementsAre(1, 7, 2));
}

TEST(CgaLanguage, JoinsTextsAndReadsTheirParts) {
  EXPECT_EQ(reported("len(\"win\" + \"dow\")"), 6);
  EXPECT_EQ(reported("find(\"abcabc\", \"c\", 1)"), 5);
  EXPECT_EQ(reported("find(\"abc\", \"x\", 0)"), -1);
  EXPECT_EQ(reported("count(\"a-b-c\", \"-\")"), 2);
  EXPECT_EQ(reported("float(substring(\"x12y\", 1, 3))"), 12);
  EXPECT_EQ(reported("float(\"1\" + 2)"), 12);
  EXPECT_EQ(reported("listSize(listAdd(\"a;b;\", \"c\"))"), 3);
  EXPECT_EQ(reported("listIndex(\"a;b;\", listLast(\"a;b;\"))"), 1);
}

TEST(CgaLanguage, JoinsTextsThatParametersBring) {
  const Json answer = derived(with("A --> B(\"x\", \"y\")  B(a, b) --> report(a + b, 4) C."));
  EXPECT_EQ(answer["reports"]["xy"]["sum"], 4);
  EXPECT_EQ(derived(with("A --> B(2, 3)  B(a, b) --> report(\"s\", a + b) C."))["reports"]["s"]["sum"], 5);
}

TEST(CgaLanguage, HasArraysWithRowsRangesAndOperators) {
  EXPECT_EQ(reported("sum([1, 2, 3])"), 6);
  EXPECT_EQ(reported("size([0:4])"), 5);
  EXPECT_EQ(reported("sum([0:0.5:2])"), 5);
  EXPECT_EQ(reported("nRows([1, 2; 3, 4; 5, 6])"), 3);
  EXPECT_EQ(reported("nColumns([1, 2; 3, 4; 5, 6])"), 2);
  EXPECT_EQ(reported("transpose([1, 2; 3, 4])[0, 1]"), 3);
  EXPECT_EQ(reported("sum([1, 2] * 3 + 1)"), 11);
  EXPECT_EQ(reported("index([5, 7], 7)"), 1);
  EXPECT_EQ(reported("sum([1, 2; 3, 4][1])"), 7);
  EXPECT_THAT(refusal(with("A --> s([1, 2][2], 1, 1) B.")),
              HasSubstr("expected one inside the array of 2 values"));
}

TEST(CgaLanguage, RunsFunctionsThatCallThemselves) {
  const std::string rules = "fac(n) = case n <= 1: 1 else: n * fac(n - 1)  A --> report(\"x\", fac(10)) B.";
  EXPECT_EQ(derived(with(rules))["reports"]["x"]["sum"], 3628800);
  EXPECT_THAT(refusal(with("f(n) = f(n + 1)  A --> report(\"x\", f(0)) B.")),
              HasSubstr("perhaps without an end"));
}

TEST(CgaLanguage, ReadsValuesOfWith) {
  const Json answer = derived(with("A --> with (w := scope.sx / 2  h := w + 1) s(w, h, 1) B."));
  EXPECT_THAT(sizes(answer, 0), ElementsAre(5));
  EXPECT_THAT(sizes(answer, 1), ElementsAre(6));
}

TEST(CgaLanguage, ImportsFilesWithPrefixes) {
  const Json answer = derived(with_files(
      {{"main.cga", "import w : \"wall.cga\"\nLot --> w.Wall(w.width)"},
       {"wall.cga", "attr width = 4\nWall(x) --> split(x){ x: Brick. | ~1: Rest }\nRest --> Plaster."}}));
  EXPECT_EQ(active(answer), "Brick Plaster");
  EXPECT_THAT(sizes(answer, 0), ElementsAre(4, 6));
}

TEST(CgaLanguage, GivesAttributesToImportedFiles) {
  const std::string library = "attr width = 4  attr depth = 1\nStart --> s(width, depth, 1) B.";
  // An attribute of the importing file replaces that of the imported one, unless the import keeps or sets it.
  EXPECT_THAT(
      sizes(derived(with_files({{"m", "import l : \"l\"  attr width = 7  Lot --> l.Start"}, {"l", library}})),
            0),
      ElementsAre(7));
  EXPECT_THAT(sizes(derived(with_files(
                        {{"m", "import l : \"l\"(width)  attr width = 7  Lot --> l.Start"}, {"l", library}})),
                    0),
              ElementsAre(4));
  EXPECT_THAT(
      sizes(derived(with_files({{"m", "import l : \"l\"(width = 2 + 3)  Lot --> l.Start"}, {"l", library}})),
            0),
      ElementsAre(5));
}

TEST(CgaLanguage, RedefinesExtensionRulesAndAcceptsStartRules) {
  const std::string library = "extension Roof(a) --> Flat.\nstart Init --> Roof(22)";
  EXPECT_EQ(active(derived(with_files({{"m", "import l : \"l\"  Lot --> l.start"}, {"l", library}}))),
            "Flat");
  EXPECT_EQ(active(derived(with_files(
                {{"m", "import l : \"l\"( Roof(a) --> Steep. )  Lot --> l.start"}, {"l", library}}))),
            "Steep");
}

TEST(CgaLanguage, ReportsErrorsInTheFileThatHasThem) {
  const std::vector<Issue> issues = check(with_files({{"main.cga", "import w : \"w.cga\"\nLot --> w.Wall"},
                                                      {"w.cga", "Wall -->\n  s(1, oops, 1) B."}}),
                                          Limits{});
  ASSERT_FALSE(issues.empty());
  EXPECT_EQ(issues[0].pointer, "/rules/w.cga");
  EXPECT_EQ(issues[0].line, 2);
  EXPECT_EQ(issues[0].column, 8);
}

TEST(CgaLanguage, WarnsOfAFileThatTheRequestDoesNotHave) {
  const Json answer = derived(with("import x : \"lib/none.cga\"\nLot --> x.Wall"));
  EXPECT_EQ(active(answer), "x.Wall");
  EXPECT_THAT(answer["warnings"].dump(), HasSubstr("has no rule file"));
}

TEST(CgaLanguage, LeavesOutWhatBelongsToAFileThatTheRequestDoesNotHave) {
  const Json answer =
      derived(with("version \"2020.1\"\nimport x : \"none.cga\"(h = 2)\nattr h = 3\n"
                   "Lot --> set(x.width, 4) Mass\n"
                   "Mass --> case x.kind(h) == \"tower\": x.Tower(2) else: extrude(h + x.height) B."));
  EXPECT_EQ(active(answer), "B");
}

TEST(CgaLanguage, ComparesEachValueOfAnArray) {
  EXPECT_EQ(reported("sum([1, 2; 3, 4][[7, 8] .== 8, 1])"), 4);
  EXPECT_EQ(reported("sum([1, 2; 3, 4; 5, 6][[\"a\", \"b\", \"a\"] .== \"a\", 1])"), 2 + 6);
  EXPECT_EQ(reported("sum([1, 2; 3, 4; 5, 6][0:1, 0])"), 1 + 3);
  EXPECT_EQ(reported("sum([5, 6, 7][[5, 6, 7] .> 5])"), 6 + 7);
  EXPECT_EQ(reported("nRows([1, 2; 3, 4; 5, 6][[0, 2], [1, 0]])"), 2);
}

TEST(CgaLanguage, SplitsALotWithoutTextureCoordinatesAlongItsAxes) {
  const std::string rules =
      "Lot --> split(v, unitSpace, 0){ 2 : A. | ~1 : split(u, unitSpace, 0){ 3 : B. | ~1 : C. } }";
  const Json answer = derived(with(rules, {10, 0, 8}));
  EXPECT_EQ(active(answer), "A B C");
  EXPECT_THAT(sizes(answer, 0), ElementsAre(10, 3, 7));
  EXPECT_THAT(sizes(answer, 2), ElementsAre(2, 6, 6));
}

TEST(CgaLanguage, WarnsWhereAStepOfARuleFileCannotBeDone) {
  const std::string rules = "Lot --> primitiveCube(4, 5, 6) offset(0.5, border) A.";
  EXPECT_THROW(derived(with(rules)), Stop);
  const Json answer = derived(with("version \"2019.1\"\n" + rules));
  EXPECT_EQ(active(answer), "A");
  EXPECT_THAT(answer["warnings"].dump(), HasSubstr("expected a face for offset; the operation is left out"));
  // A rule without an end stays an error.
  EXPECT_THROW(derived(with("version \"2019.1\"\nLot --> t(0, 1, 0) Lot")), Stop);
}

TEST(CgaLanguage, RequiresTheMainFileIfSeveralAreCandidates) {
  const std::vector<Issue> issues = check(with_files({{"a", "A --> B."}, {"b", "A --> C."}}), Limits{});
  ASSERT_FALSE(issues.empty());
  EXPECT_THAT(issues[0].message, HasSubstr("several files that no other file imports (a, b)"));
  EXPECT_EQ(active(derived(with_files({{"a", "A --> B."}, {"b", "@StartRule A --> C."}}))), "C");
}

TEST(CgaLanguage, SelectsAStyle) {
  BuildingParams params = with("attr w = 2  Lot --> s(w, 1, 1) B.\nstyle Wide\nattr w = 8");
  EXPECT_THAT(sizes(derived(params), 0), ElementsAre(2));
  params.start = "Wide$Lot";
  EXPECT_THAT(sizes(derived(params), 0), ElementsAre(8));
}

TEST(CgaLanguage, ReadsTablesOfTheRequest) {
  BuildingParams params = with(
      "const t = readStringTable(\"heights.csv\")\n"
      "A --> report(t[0, 0], float(t[0, 1])) report(t[1, 0], float(t[1, 1])) report(\"rows\", nRows(t)) B.");
  params.tables["heights.csv"] = "old,9\n\"new, tall\",21\n";
  const Json answer = derived(params);
  EXPECT_EQ(answer["reports"]["old"]["sum"], 9);
  EXPECT_EQ(answer["reports"]["new, tall"]["sum"], 21);
  EXPECT_EQ(answer["reports"]["rows"]["sum"], 2);
}

TEST(CgaLanguage, ConvertsColours) {
  EXPECT_NEAR(reported("colorHSVToR(0, 1, 1)"), 1, 1e-12);
  EXPECT_NEAR(reported("colorHSVToG(60, 0.5, 0.8)"), 0.8, 1e-12);
  EXPECT_NEAR(reported("colorHSVToB(60, 0.5, 0.8)"), 0.4, 1e-12);
  EXPECT_NEAR(reported("colorRGBToH(0, 0.5, 1)"), 210, 1e-9);
  EXPECT_NEAR(reported("colorHexToG(\"#336699\")"), 0.4, 1e-12);
  EXPECT_NEAR(reported("colorHexToG(colorRamp(\"blackToWhite\", 5, 0, 10))"), 128.0 / 255, 1e-9);
}

TEST(CgaLanguage, RestrictsAttributesOnlyByTheAnnotation) {
  BuildingParams params = with("@Range(min=1, max=5, restricted=false) attr w = 2  A --> s(w, 1, 1) B.");
  params.attributes["w"] = 9.0;
  EXPECT_THAT(check(params, Limits{}), IsEmpty());
  params.rules = "@Range(min=1, max=5) attr w = 2  A --> s(w, 1, 1) B.";
  EXPECT_EQ(check(params, Limits{}).size(), 1U);
  params.rules = "@Unheard(1) attr w = 2  A --> s(w, 1, 1) B.";
  EXPECT_THAT(check(params, Limits{}), IsEmpty());
}

/// The operations of the CGA reference from 2019 to 2025, by its own list of pages.
TEST(CgaNames, AreAllKnownAsOperations) {
  for (const char* name : {"alignScopeToAxes",
                           "alignScopeToGeometry",
                           "alignScopeToGeometryBBox",
                           "center",
                           "cleanupGeometry",
                           "color",
                           "comp",
                           "convexify",
                           "copyUV",
                           "deleteHoles",
                           "deleteTags",
                           "deleteUV",
                           "envelope",
                           "extrude",
                           "footprint",
                           "i",
                           "inline",
                           "innerRectangle",
                           "insertAlongUV",
                           "intersect",
                           "label",
                           "mirror",
                           "mirrorScope",
                           "modify",
                           "normalizeUV",
                           "offset",
                           "primitiveCone",
                           "primitiveCube",
                           "primitiveCylinder",
                           "primitiveDisk",
                           "primitiveQuad",
                           "primitiveSphere",
                           "print",
                           "projectUV",
                           "r",
                           "rectify",
                           "reduceGeometry",
                           "report",
                           "resetGeometry",
                           "resetMaterial",
                           "reverseNormals",
                           "roofGable",
                           "roofHip",
                           "roofPyramid",
                           "roofRidge",
                           "roofShed",
                           "rotate",
                           "rotateScope",
                           "rotateUV",
                           "s",
                           "scaleUV",
                           "scatter",
                           "set",
                           "setback",
                           "setbackPerEdge",
                           "setbackToArea",
                           "setMaterial",
                           "setNormals",
                           "setPivot",
                           "setTagsFromEdgeAttrs",
                           "setupProjection",
                           "shapeL",
                           "shapeO",
                           "shapeU",
                           "softenNormals",
                           "split",
                           "splitAndSetbackPerimeter",
                           "splitArea",
                           "subtract",
                           "t",
                           "tag",
                           "taper",
                           "texture",
                           "tileUV",
                           "translate",
                           "translateUV",
                           "trim",
                           "union"}) {
    EXPECT_NE(find_operation(name), nullptr) << name;
  }
}

TEST(CgaNames, MakeNoShape) {
  // A box, a step that serves textures alone, a leaf: one shape.
  EXPECT_EQ(leaves("A --> texture(\"x.jpg\") trim() setTagsFromEdgeAttrs(\"e\") B."), "B");
  EXPECT_EQ(leaves("A --> primitiveCube"), "A");
}

}  // namespace
}  // namespace seedmesh::building
