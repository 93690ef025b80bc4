/// Values of CityEngine's rules: with(...), functions of one name, materials as arrays, lists, axes that are flipped.
#include <gmock/gmock.h>

#include <map>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

using testing::HasSubstr;

double reported(const std::string& rules, std::array<double, 3> size = {10, 10, 10}) {
  const Json answer = derived(with(rules, size));
  return answer["reports"].contains("x") ? answer["reports"]["x"]["sum"].get<double>() : -1e300;
}

TEST(CgaValues, ReadsValuesOfWithBeforeTheArrow) {
  // The forms of the help of CityEngine, "Local variables": behind the name, and behind the parameters.
  const std::string rules =
      "Lot with ( height := scope.sx * 2 ) --> A(height)\n"
      "A(h) with ( floors := rint(h / 3)\n"
      "            each   := h / floors ) --> report(\"x\", floors + each / 100) B.";
  EXPECT_NEAR(reported(rules, {9, 0, 9}), 6.03, 1e-12);
  EXPECT_EQ(leaves("A --> with (w := 2, v := w + 1; u := v) case u == 3: B. else: C."), "B");
}

TEST(CgaValues, FindsAValueOfWithOnceForEachCall) {
  const std::string rules =
      "f(n) with ( r := rand(0, n)  s := r * 2 ) = s - r - r  A --> report(\"x\", f(9)) B.";
  EXPECT_EQ(reported(rules), 0) << "another random number at each use would differ";
  EXPECT_EQ(reported("g with ( a := 3 ) = a * a  A --> report(\"x\", g) B."), 9);
}

TEST(CgaValues, DistinguishesFunctionsOfOneNameByTheirParameters) {
  // The example of the reference: the numbers of Fibonacci.
  const std::string fibonacci =
      "fibonacci(n) = case n <= 2 : [0:n-1] else : fibonacci([0,1], n)\n"
      "fibonacci(a, n) = case size(a) == n : a else : fibonacci([a, a[size(a)-2] + a[size(a)-1]], n)\n";
  EXPECT_EQ(reported(fibonacci + "A --> report(\"x\", fibonacci(10)[9]) B."), 34);
  EXPECT_EQ(reported(fibonacci + "A --> report(\"x\", sum(fibonacci(10))) B."), 88);
  EXPECT_THAT(fault("f(a) = 1  f(b) = 2  A --> s(f(1), '1, '1) B."), HasSubstr("declared twice"));
}

TEST(CgaValues, ReadsCharactersByTheirCode) {
  EXPECT_EQ(leaves("A --> case \"\\u0041\" == \"A\": B. else: C."), "B");
  EXPECT_EQ(leaves("A --> case len(\"\\ue000\") == 3: B. else: C."), "B") << "three bytes in UTF-8";
  EXPECT_EQ(leaves("A --> case isNull(\"\\ue000\"): B. else: C."), "B");
  EXPECT_THAT(fault("A --> label(\"\\u00g0\") B."), HasSubstr("unknown escape"));
}

TEST(CgaValues, SetsMaterialsByArraysOfNamesAndValues) {
  const std::string red = "setMaterial([\"color.r\", \"1\", \"color.g\", \"0\", \"color.b\", \"0.2\"]) ";
  EXPECT_NEAR(reported("A --> " + red + "report(\"x\", material.color.b) B."), 0.2, 1e-12);
  EXPECT_EQ(reported("A --> " + red + "report(\"x\", nRows(getMaterial(used, changed))) B."), 4);
  EXPECT_EQ(leaves("A --> setMaterial(readMaterial(\"walls/red_brick.cgamat\")) D  "
                   "D --> case material.name == \"red_brick\": B. else: C."),
            "B");
  EXPECT_EQ(leaves("A --> " + red +
                   "setMaterial(getMaterial()) D  "
                   "D --> case material.color == \"#ff0033\": B. else: C."),
            "B");
  EXPECT_THAT(refusal(with("A --> setMaterial([\"color.r\", \"red\"]) B.")), HasSubstr("expected a number"));
}

TEST(CgaValues, ChangesArraysAndLists) {
  EXPECT_EQ(reported("A --> report(\"x\", sum(setElems([1, 2, 3], 1, [5, 7]))) B."), 13);
  EXPECT_EQ(reported("A --> report(\"x\", setElems([1, 2; 3, 4], 1, 0, 9)[1, 0]) B."), 9);
  EXPECT_THAT(refusal(with("A --> report(\"x\", setElems([1], 1, 2)[0]) B.")),
              HasSubstr("outside of the array"));
  // The examples of the reference.
  EXPECT_EQ(leaves("A --> case listFromArray([1,2,3]) == \"1;2;3;\": B. else: C."), "B");
  EXPECT_EQ(
      leaves("A --> case listFromArray([\"rule\",\"your\",\"city\"]) == \"rule;your;city;\": B. else: C."),
      "B");
  EXPECT_EQ(
      leaves(
          "A --> case listToArray(\"a;b;\")[1] == \"b\" && listTerminate(\"a;b\") == \"a;b;\": B. else: C."),
      "B");
}

TEST(CgaValues, QueriesTagsAndTextureCoordinates) {
  EXPECT_EQ(leaves("A --> tag(\"wall\") D  D --> case geometry.hasTags && geometry.hasTags(\"wall\") && "
                   "!geometry.hasTags(\"roof\"): B. else: C."),
            "B");
  EXPECT_EQ(leaves("A --> comp(f){ front: D }  D --> case geometry.hasUVs(0): C. else: tileUV(0, 1, 1) E  "
                   "E --> case geometry.hasUVs(0): B. else: C."),
            "B");
}

TEST(CgaValues, SelectsEdgesOfFacesByTheirPlaceInTheRoof) {
  const Json roof =
      derived(with("A --> roofHip(30) comp(fe){ ridge: B. | eave: C. | hip: D. | border: E. }", {9, 0, 6}));
  std::map<std::string, int> count;
  for (const Json& shape : roof["shapes"]) ++count[shape["symbol"].get<std::string>()];
  EXPECT_EQ(count["B"], 2) << "the ridge, seen from both sides";
  EXPECT_EQ(count["D"], 8);
  EXPECT_EQ(count["E"], 0);
}

TEST(CgaValues, FlipsTheScopeAlongTwoAxes) {
  const Json flipped =
      derived(with("A --> s(2, 4, 6) mirrorScope(true, true, false) split(x){ 0.5: B. | ~1: C. }"));
  for (const Json& shape : flipped["shapes"]) {
    if (shape["symbol"] != "B") continue;
    EXPECT_NEAR(shape["scope"]["axes"][0][0].get<double>(), -1, 1e-12);
    EXPECT_NEAR(shape["scope"]["axes"][1][1].get<double>(), -1, 1e-12);
    EXPECT_NEAR(shape["scope"]["axes"][2][2].get<double>(), 1, 1e-12);
  }
  EXPECT_NEAR(volume(with("A --> s(2, 4, 6) mirrorScope(true, false, true) B.")), 48, 1e-4);
  const Json one = derived(with("A --> mirrorScope(true, false, false) B."));
  ASSERT_EQ(one["warnings"].size(), 1U);
  EXPECT_THAT(one["warnings"][0]["message"].get<std::string>(), HasSubstr("left-handed"));
}

}  // namespace
}  // namespace seedmesh::building
