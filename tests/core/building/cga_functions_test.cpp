/// Every function and attribute of the CGA reference in an expression of its own.
/// The values are those of the definitions in the reference (editions 2019 to 2025), in closed form, on a lot of 10 m by
/// 8 m.
#include <gmock/gmock.h>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

struct Case {
  const char* expression;
  double value;
};
constexpr Case cases[] = {
    {"scope.sx", 10},
    {"scope.sy", 0},
    {"scope.sz", 8},
    {"scope.ty", 0},
    {"scope.rx", 0},
    {"scope.ry", 0},
    {"scope.rz", 0},
    {"scope.elevation", 0},
    {"pivot.ox", 0},
    {"pivot.oy", 0},
    {"pivot.oz", 0},
    {"initialShape.origin.py", 0},
    {"initialShape.origin.ox", 0},
    {"initialShape.origin.oy", 0},
    {"initialShape.origin.oz", 0},
    {"abs(-2)", 2},
    {"acos(0)", 90},
    {"asin(1)", 90},
    {"atan(1)", 45},
    {"atan2(1,1)", 45},
    {"ceil(1.2)", 2},
    {"cos(60)", 0.5},
    {"exp(1)", 2.718281828459},
    {"floor(1.7)", 1},
    {"ln(exp(2))", 2},
    {"log10(1000)", 3},
    {"pow(2,3)", 8},
    {"rint(1.6)", 2},
    {"sin(30)", 0.5},
    {"sqrt(9)", 3},
    {"tan(45)", 1},
    {"float(isinf(1))", 0},
    {"float(isnan(1))", 0},
    {"min(1,2)", 1},
    {"max(1,2)", 2},
    {"7%4", 3},
    {"5 % 3", 2},
    {R"~(float("2.5"))~", 2.5},
    {R"~(float(bool("true")))~", 1},
    {"len(str(12.5))", 4},
    {R"~(count("banana","an"))~", 2},
    {R"~(find("banana","an",1))~", 3},
    {R"~(find("banana","xx",0))~", -1},
    {R"~(len("abc"))~", 3},
    {R"~(len(substring("abcdef",1,3)))~", 2},
    {R"~(size(splitString("a;b;c",";")))~", 3},
    {R"~(float(splitString("1;2;4",";")[2]))~", 4},
    {R"~(findFirst("abcabc","c"))~", 2},
    {R"~(findLast("abcabc","c"))~", 5},
    {R"~(len(replace("abcabc","c","dd")))~", 8},
    {R"~(len(getPrefix("a_b","_")))~", 1},
    {R"~(len(getSuffix("a_bc","_")))~", 2},
    {R"~(len(getRange("a(bcd)e","(",")")))~", 3},
    {R"~(listSize("a;b;"))~", 2},
    {R"~(listIndex("a;b;","b"))~", 1},
    {R"~(listCount("a;b;a;","a"))~", 2},
    {R"~(len(listItem("a;bcd;",1)))~", 3},
    {R"~(len(listAdd("a;","b")))~", 4},
    {R"~(len(listFirst("ab;c;")))~", 2},
    {R"~(len(listLast("ab;c;")))~", 1},
    {R"~(len(listRange("a;b;c;",0,2)))~", 4},
    {R"~(len(listRemove("a;b;a;","a")))~", 4},
    {R"~(len(listRemoveAll("a;b;a;","a")))~", 2},
    {R"~(len(listRetainAll("a;b;a;","a")))~", 4},
    {R"~(len(listClean("a;;b;")))~", 4},
    {R"~(len(listTerminate("a;b")))~", 4},
    {R"~(len(listRandom("a;b;")))~", 1},
    {R"~(size(listToArray("a;b;")))~", 2},
    {R"~(len(listFromArray(["a","b"])))~", 4},
    {"geometry.area", 80},
    {"geometry.volume", 0},
    {"geometry.nFaces", 1},
    {"geometry.nEdges", 4},
    {"geometry.nVertices", 4},
    {"geometry.nHoles", 0},
    {"geometry.boundaryLength", 36},
    {"float(geometry.isClosedSurface)", 0},
    {"float(geometry.isConcave)", 0},
    {"float(geometry.isPlanar)", 1},
    {"float(geometry.isRectangular)", 1},
    {"float(geometry.isRectangular(5))", 1},
    {"float(geometry.isPlanar(1))", 1},
    {"float(geometry.isInstanced)", 0},
    {"geometry.height", 0},
    {"geometry.area(all)", 80},
    {"geometry.area(top)", 80},
    {"geometry.area(world.up)", 80},
    {R"~(float(geometry.isTagged("x")))~", 0},
    {"size([1,2,3])", 3},
    {"[1,2,3][1]", 2},
    {"index([1,2,3],3)", 2},
    {"nRows([1,2;3,4;5,6])", 3},
    {"nColumns([1,2;3,4;5,6])", 2},
    {"sum([1,2,3])", 6},
    {"transpose([1,2;3,4])[0,1]", 3},
    {"sortIndices([3,1,2])[0]", 1},
    {"sortRowIndices([3,1;1,2])[0]", 1},
    {"size([0:0.5:3])", 7},
    {"setElems([1,2,3],1,9)[1]", 9},
    {"size([])", 0},
    {R"~(colorHexToR("#804020"))~", 0.501960784314},
    {R"~(colorHexToG("#804020"))~", 0.250980392157},
    {R"~(colorHexToB("#804020"))~", 0.125490196078},
    {R"~(colorHexToH("#ff0000"))~", 0},
    {R"~(colorHexToS("#ff0000"))~", 1},
    {R"~(colorHexToV("#800000"))~", 0.501960784314},
    {R"~(colorHexToO("#80000080"))~", 0.501960784314},
    {"colorRGBToH(0,1,0)", 120},
    {"colorRGBToS(0,1,0)", 1},
    {"colorRGBToV(0,1,0)", 1},
    {"colorHSVToR(120,1,1)", 0},
    {"colorHSVToG(120,1,1)", 1},
    {"colorHSVToB(120,1,1)", 0},
    {"len(colorHSVToHex(120,1,1))", 7},
    {"len(colorHSVOToHex(120,1,1,0.5))", 9},
    {"len(colorRGBToHex(1,0,0))", 7},
    {R"~(len(colorRamp("whiteToBlue",0.5)))~", 7},
    {R"~(len(colorRamp("spectrum",0.5)))~", 7},
    {"convert(y,scope,world,pos,0,3,0)", 3},
    {"convert(x,object,world,dir,1,0,0)", 1},
    {R"~(contextCount(intra,"a"))~", 0},
    {R"~(edgeAttr.getFloat("w"))~", 0},
    {R"~(len(edgeAttr.getString("w")))~", 0},
    {R"~(float(edgeAttr.getBool("w")))~", 0},
    {R"~(float(fileExists("a.jpg")))~", 0},
    {R"~(len(fileSearch("*.jpg")))~", 0},
    {R"~(len(fileRandom("*.jpg")))~", 0},
    {R"~(len(fileName("a/b.jpg")))~", 5},
    {R"~(len(fileBasename("a/b.jpg")))~", 1},
    {R"~(len(fileExtension("a/b.jpg")))~", 3},
    {R"~(len(fileDirectory("a/b.jpg")))~", 2},
    {"len(initialShape.startRule)", 3},
    {"rand(3,3)", 3},
    {"float(p(1))", 1},
    {"float(p(0))", 0},
    {"rand(5)*0", 0},
    {"rand*0", 0},
    {"clamp(5,0,3)", 3},
    {"case 1>2: 3 else: 4", 4},
    {"float(!true)", 0},
    {"float(true && false || true)", 1},
    {R"~(float("a"=="a"))~", 1},
    {"-2", -2},
    {"2-1", 1},
    {"print(3)", 3},
    {"float(overlaps())", 0},
    {"float(inside())", 0},
    {"float(touches())", 0},
    {"float(overlaps(inter))", 0},
    {R"~(float(inside(intra,"a")))~", 0},
    {"float(geometry.isClosedSurface())", 0},
};

TEST(CgaFunctions, OfWhichAPartIsMissingWarn) {
  const Json answer = result_of("Lot --> label(\"a\") report(\"x\", contextCompare(all, \"a\", 3)) X.");
  EXPECT_THAT(answer["warnings"].dump(), testing::HasSubstr("contextCompare compares no values"));
}

// Else expect_done() would accept everything.
TEST(CgaFunctions, ThatCannotBeDoneAreLeftOutWithAWarning) {
  const Json answer = result_of("Lot --> report(\"x\", getGeoCoord(lat)) X.");
  EXPECT_THAT(answer["warnings"].dump(), testing::HasSubstr("is left out"));
}

TEST(CgaFunctions, HaveTheValuesOfTheReference) {
  for (const Case& each : cases) {
    const Json answer =
        result_of("Lot --> label(\"q\") report(\"x\", " + std::string(each.expression) + ") X.");
    expect_done(answer, each.expression);
    ASSERT_TRUE(answer["reports"].contains("x")) << each.expression;
    EXPECT_NEAR(answer["reports"]["x"]["sum"].get<double>(), each.value, 1e-6) << each.expression;
  }
}

}  // namespace
}  // namespace seedmesh::building
