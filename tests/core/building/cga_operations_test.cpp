/// Operations of the CGA reference on geometry, with numbers in closed form.
#include <gmock/gmock.h>

#include <cmath>

#include "core/generators/building/boolean.h"
#include "core/generators/building/solid_tools.h"
#include "tests/core/building/rules.h"
#include "tests/support/context.h"

namespace seedmesh::building {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double pi = 3.14159265358979323846;

double sum_of(const BuildingParams& params, const char* key) {
  const Json answer = derived(params);
  return answer["reports"].contains(key) ? answer["reports"][key]["sum"].get<double>() : -1e300;
}
double sum_of(const std::string& rules, const char* key, std::array<double, 3> size = {10, 10, 10}) {
  return sum_of(with(rules, size), key);
}
/// The volume of what the steps make of a shape.
double volume_after(const std::string& steps, std::array<double, 3> size = {10, 10, 10}) {
  return sum_of("A --> " + steps + " report(\"v\", geometry.volume) B.  X --> Y.", "v", size);
}
double area_after(const std::string& steps, std::array<double, 3> size = {10, 0, 10}) {
  return sum_of("A --> " + steps + " report(\"a\", geometry.area) B.  X --> Y.", "a", size);
}

const std::vector<std::vector<std::array<double, 2>>> l_shape = {
    {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 12}, {0, 12}}};
const std::vector<std::vector<std::array<double, 2>>> court = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                                                               {{3, 3}, {3, 7}, {7, 7}, {7, 3}}};

BuildingParams over(const std::vector<std::vector<std::array<double, 2>>>& footprint,
                    const std::string& rules) {
  BuildingParams params = with(rules);
  params.footprint = footprint;
  return params;
}

TEST(Primitives, HaveTheVolumesOfTheirPolygons) {
  const auto polygon = [](double n, double r) { return 0.5 * n * r * r * std::sin(2 * pi / n); };
  EXPECT_NEAR(volume_after("primitiveCylinder(12, 2, 5)"), 5 * polygon(12, 2), 1e-9);
  EXPECT_NEAR(volume_after("primitiveCone(7, 2, 6)"), 2 * polygon(7, 2), 1e-9);
  EXPECT_NEAR(volume_after("primitiveCube(1, 2, 3)"), 6, 1e-12);
  EXPECT_NEAR(area_after("primitiveDisk(5, 3)"), polygon(5, 3), 1e-9);
  EXPECT_NEAR(area_after("primitiveQuad(3, 4)"), 12, 1e-12);
  const double sphere = volume_after("primitiveSphere(64, 32, 1)");
  EXPECT_LT(sphere, 4 * pi / 3);
  EXPECT_GT(sphere, 0.99 * 4 * pi / 3);
}

TEST(Primitives, CanTouchAllSidesOfTheScope) {
  EXPECT_NEAR(volume_after("primitiveFitted(\"cylinder\", 4)"), 1000, 1e-9);
  EXPECT_NEAR(volume_after("primitiveFitted(\"cone\", 4)"), 1000.0 / 3, 1e-9);
  EXPECT_NEAR(area_after("primitiveFitted(\"disk\", 3)"), 50, 1e-9);
  // Pappus: a polygon of 13 corners around a circle, of which the solid has 19 straight pieces.
  const double section = 0.5 * 13 * 4 * std::sin(2 * pi / 13);
  const double torus = volume_after("s(0, 0, 0) primitiveFitted(\"torus\", 4, 2, 19, 13)");
  EXPECT_LT(torus, section * 2 * pi * 4);
  EXPECT_GT(torus, 0.95 * section * 2 * pi * 4);
  const double sphere = volume_after("primitiveFitted(\"sphere\", 64, 32)", {2, 2, 2});
  EXPECT_NEAR(sphere, 4 * pi / 3, 0.02);
  EXPECT_NEAR(area_after("primitivePolygon([0, 0, 4, 0, 4, 1, 1, 1, 1, 3, 0, 3])"), 100.0 * 6 / 12, 1e-9);
  EXPECT_NEAR(volume_after("primitivePolygon([0, 0, 0, 2, 2, 0]) extrude(3)", {10, 0, 10}), 150, 1e-9);
}

TEST(Primitives, RefusePolygonsThatAreNone) {
  const auto fault = [](const std::string& corners) {
    Job job(0, Job::Options{});
    try {
      const Result<Json> answer =
          derive(with("A --> primitivePolygon([" + corners + "]) B."), context_of(job));
      return answer ? std::string() : answer.error().issues.front().message;
    } catch (const Stop& stop) {
      return stop.issue().message;
    }
  };
  EXPECT_THAT(fault("0, 0, 4, 4, 4, 0, 0, 5"), HasSubstr("the sides of the polygon cross"));
  EXPECT_THAT(fault("0, 0, 1, 1, 2, 2"), HasSubstr("without an area"));
  EXPECT_THAT(fault("0, 0, 1, 1, 2"), HasSubstr("3 to 1000 corners"));
}

TEST(ExtrudeInADirection, KeepsTheVolumeOfTheProjection) {
  // A slope of 30 degrees over 10 x 5 has the plan 50, so that 2 m straight up add 100 cubic metres.
  const std::string slope = "A --> s('1, 0, '1) roofShed(30) comp(f){ aslant: ";
  EXPECT_NEAR(sum_of(slope + "extrude(world.up, 2) report(\"v\", geometry.volume) B. }", "v", {10, 0, 5}),
              100, 1e-6);
  EXPECT_NEAR(sum_of(slope + "extrude(2) report(\"v\", geometry.volume) B. }", "v", {10, 0, 5}),
              100 / std::cos(pi / 6), 1e-6);
  // Two planes of a gable as one surface, moved up together: a closed shell without walls inside.
  EXPECT_NEAR(sum_of("A --> s('1, 0, '1) roofGable(30) comp(f){ aslant = extrude(world.up, 0.5) "
                     "report(\"v\", geometry.volume) "
                     "report(\"closed\", geometry.isClosedSurface) B. }",
                     "v", {10, 0, 6}),
              30, 1e-6);
}

TEST(Selectors, TakeFacesByTheWorldAndEdgesOfRoofs) {
  EXPECT_EQ(leaves("A --> r(0, 90, 0) comp(f){ world.south: S. | object.top: T. | world.side = R. }"),
            "S T R");
  // A hip roof over 10 x 6: four eaves, four hips and a ridge of 4 m.
  const Json answer =
      derived(with("A --> s('1, 0, '1) roofHip(45) comp(e){ eave: report(\"eave\", scope.sx) E. | hip: "
                   "report(\"hip\", scope.sx) H. | "
                   "ridge: report(\"ridge\", scope.sx) R. }",
                   {10, 0, 6}));
  EXPECT_NEAR(answer["reports"]["eave"]["sum"].get<double>(), 32, 1e-6);
  EXPECT_EQ(answer["reports"]["hip"]["count"], 4);
  EXPECT_NEAR(answer["reports"]["hip"]["mean"].get<double>(), std::sqrt(27.0), 1e-6);
  EXPECT_NEAR(answer["reports"]["ridge"]["sum"].get<double>(), 4, 1e-6);
}

TEST(Selectors, TakeTheEdgesOfTheCoverWhereARoofHasAnOverhang) {
  // Half a metre along a slope of 45 degrees moves each eave outwards by half a metre times the cosine. The ridge stays.
  const Json answer =
      derived(with("A --> s('1, 0, '1) roofHip(45, 0.5) comp(e){ eave: report(\"eave\", scope.sx) E. | hip: "
                   "report(\"hip\", scope.sx) H. | ridge: report(\"ridge\", scope.sx) R. | valley: "
                   "report(\"valley\", 1) V. }",
                   {10, 0, 6}));
  EXPECT_EQ(answer["reports"]["eave"]["count"], 4);
  EXPECT_NEAR(answer["reports"]["eave"]["sum"].get<double>(), 32 + 8 * 0.5 * std::cos(pi / 4), 1e-6);
  EXPECT_EQ(answer["reports"]["hip"]["count"], 4);
  EXPECT_EQ(answer["reports"]["ridge"]["count"], 1);
  EXPECT_NEAR(answer["reports"]["ridge"]["sum"].get<double>(), 4, 1e-6);
  EXPECT_FALSE(answer["reports"].contains("valley"));
}

TEST(Selectors, CanBeConditionsNumbersAndTags) {
  EXPECT_EQ(leaves("A --> comp(f){ top || bottom: T. | all: S. }"), "T T S S S S");
  EXPECT_EQ(leaves("A --> split(x){ ~1: tag(\"low\") B | ~1: B }  B --> comp(f){ isTagged(\"low\") && top: "
                   "T. | top: U. }"),
            "T U");
  EXPECT_EQ(leaves("attr n = 2  A --> comp(f){ n: B. | 0: C. }"), "B C");
  EXPECT_EQ(leaves("A --> comp(f){ front: case comp.sel == \"front\": B. else: C. | side: D. }"), "B D D D");
  EXPECT_EQ(sum_of("A --> s('1, 0, '1) comp(fe){ all: report(\"e\", scope.sx) B. }", "e", {10, 0, 6}), 32);
}

TEST(GeometryFunctions, AgreeWithClosedForms) {
  const auto of_box = [](const std::string& f) {
    return sum_of("A --> report(\"x\", " + f + ") B.", "x", {2, 3, 4});
  };
  EXPECT_EQ(of_box("geometry.nFaces"), 6);
  EXPECT_EQ(of_box("geometry.nEdges"), 12);
  EXPECT_EQ(of_box("geometry.nVertices"), 8);
  EXPECT_NEAR(of_box("geometry.area(top)"), 8, 1e-12);
  EXPECT_NEAR(of_box("geometry.area(side)"), 36, 1e-12);
  EXPECT_EQ(of_box("geometry.isClosedSurface"), 1);
  EXPECT_EQ(of_box("geometry.isRectangular"), 1);
  EXPECT_EQ(sum_of(over(l_shape, "A --> report(\"x\", geometry.isConcave()) B."), "x"), 1);
  EXPECT_EQ(sum_of(over(l_shape, "A --> report(\"x\", geometry.isRectangular(5)) B."), "x"), 0);
  EXPECT_NEAR(sum_of(over(l_shape, "A --> report(\"x\", geometry.boundaryLength) B."), "x"), 44, 1e-9);
  EXPECT_EQ(sum_of(over(court, "A --> report(\"x\", geometry.nHoles) B."), "x"), 1);
  EXPECT_NEAR(sum_of("A --> comp(f){ front: report(\"x\", geometry.du(0, unitSpace)) B. }", "x", {2, 3, 4}),
              2, 1e-12);
  EXPECT_NEAR(sum_of("A --> comp(f){ front: tileUV(0, 0.5, 1) report(\"x\", geometry.dv(0, uvSpace)) B. }",
                     "x", {2, 3, 4}),
              3, 1e-12);
  EXPECT_NEAR(sum_of("A --> comp(f){ top: report(\"x\", geometry.angle(zenith)) B. }", "x"), 0, 1e-9);
  EXPECT_NEAR(sum_of("A --> t(0, 2, 0) report(\"x\", scope.elevation) B.", "x"), 2, 1e-12);
  EXPECT_NEAR(sum_of("A --> r(10, 20, 30) report(\"x\", scope.ry) B.", "x"), 20, 1e-9);
  EXPECT_NEAR(sum_of("A --> t(1, 2, 3) report(\"x\", convert(y, scope, world, pos, 0, 5, 0)) B.", "x"), 7,
              1e-12);
}

TEST(TextureCoordinates, FollowTheOperationsInOrder) {
  const auto range = [](const std::string& steps, const std::string& what) {
    return sum_of("A --> comp(f){ front: " + steps + " report(\"x\", " + what + ") B. }", "x", {6, 4, 1});
  };
  EXPECT_NEAR(range("normalizeUV(0, uv, separatePerFace)", "geometry.uMax(0)"), 1, 1e-12);
  EXPECT_NEAR(range("normalizeUV(0, uv, separatePerFace) scaleUV(0, 3, 5)", "geometry.vMax(0)"), 5, 1e-12);
  EXPECT_NEAR(range("scaleUV(0, 2, 1) translateUV(0, -4, 0)", "geometry.uMin(0)"), -4, 1e-12);
  EXPECT_NEAR(range("rotateUV(0, 90)", "geometry.uMin(0)"), -4, 1e-9);
  EXPECT_NEAR(range("rotateUV(0, 90)", "geometry.vMax(0)"), 6, 1e-9);
  EXPECT_NEAR(range("tileUV(0, ~2.5, ~2.5)", "geometry.uMax(0)"), 2, 1e-12);  // 2.4 tiles become 2
  EXPECT_NEAR(range("tileUV(0, 2, 2) copyUV(0, 7)", "geometry.uMax(7)"), 3, 1e-12);
  EXPECT_NEAR(range("setupProjection(3, scope.xy, 2, 2) projectUV(3)", "geometry.uMax(3)"), 3, 1e-12);
  EXPECT_NEAR(range("tileUV(0, 2, 2) deleteUV(0)", "geometry.uMax(0)"), 6, 1e-12);
}

TEST(Setbacks, LeaveTheAreasOfRectangles) {
  EXPECT_NEAR(sum_of("A --> setbackToArea(25){ all: B. | remainder: report(\"r\", geometry.area) C. }", "r",
                     {10, 0, 10}),
              25, 1e-6);
  EXPECT_NEAR(sum_of("A --> setbackToArea('0.5){ front: B. | remainder: report(\"r\", scope.sz) C. }", "r",
                     {10, 0, 10}),
              5, 1e-6);
  // A tenth of each edge: 1 m from the edges of 10 m, 0.6 m from those of 6 m.
  EXPECT_NEAR(
      sum_of("A --> setbackPerEdge(scope.sx / 10){ all: B. | remainder: report(\"r\", geometry.area) C. }",
             "r", {10, 0, 6}),
      (10 - 1.2) * (6 - 2), 1e-6);
  EXPECT_NEAR(sum_of("A --> setback([1, 0, 2, 0]){ all: B. | remainder: report(\"r\", geometry.area) C. }",
                     "r", {10, 0, 10}),
              70, 1e-6);
  EXPECT_NEAR(sum_of("A --> setback(comp(fe){ front = 3 | all : 1 }){ all: B. | remainder: report(\"r\", "
                     "geometry.area) C. }",
                     "r", {10, 0, 10}),
              48, 1e-6);
  EXPECT_EQ(leaves("A --> setback(1){ all = B. | remainder: C. }", {10, 0, 10}), "B C");
}

TEST(SplitAndSetbackPerimeter, DividesTheBorderByLength) {
  // Sections of 10 m around a square of 10 m, 2 m deep: the four strips of the border.
  const Json answer =
      derived(with("A --> splitAndSetbackPerimeter(0){ 10 : 2 : report(\"s\", geometry.area) B. }* { "
                   "remainder: report(\"r\", geometry.area) C. }",
                   {10, 0, 10}));
  EXPECT_EQ(answer["reports"]["s"]["count"], 4);
  EXPECT_NEAR(answer["reports"]["s"]["sum"].get<double>(), 64, 1e-6);
  EXPECT_NEAR(answer["reports"]["r"]["sum"].get<double>(), 36, 1e-6);
}

TEST(Envelopes, AreCutBySlopes) {
  // 45 degrees from 2 m over 10 x 10, cut at 5 m: a prism of 2 m and a frustum of 3 m between squares of 10 and 4 m.
  EXPECT_NEAR(volume_after("envelope(normal, 5, 2, 45)", {10, 0, 10}), 200 + 3.0 / 3 * (100 + 16 + 40), 1e-6);
  EXPECT_NEAR(volume_after("envelope(world.up, 5, 5, 90)", {10, 0, 10}), 500, 1e-6);
}

TEST(RoofRidge, IsAWedgeAlongX) {
  EXPECT_NEAR(volume_after("roofRidge(byHeight(3))", {10, 0, 6}), 90, 1e-6);
  EXPECT_NEAR(volume_after("roofRidge(45)", {10, 0, 6}), 90, 1e-6);
}

TEST(GeometryEdits, KeepAreasAndCountCorners) {
  EXPECT_NEAR(sum_of(over(court, "A --> deleteHoles() report(\"a\", geometry.area) B."), "a"), 100, 1e-9);
  EXPECT_NEAR(
      sum_of(
          over(court, "A --> convexify() report(\"a\", geometry.area) report(\"c\", geometry.isConcave) B."),
          "a"),
      84, 1e-9);
  EXPECT_EQ(sum_of(over(court, "A --> convexify() report(\"c\", geometry.isConcave) B."), "c"), 0);
  EXPECT_EQ(
      sum_of(over(l_shape, "A --> convexify() cleanupGeometry(all, 0) report(\"n\", geometry.nFaces) B."),
             "n"),
      1);
  EXPECT_EQ(sum_of(over({{{0, 0}, {5, 0}, {10, 0}, {10, 8}, {0, 8}}},
                        "A --> cleanupGeometry(vertices, 0.01) report(\"n\", geometry.nVertices) B."),
                   "n"),
            4);
  EXPECT_EQ(sum_of(over({{{0, 0}, {10, 0.5}, {10.3, 8}, {0.2, 8.2}}},
                        "A --> rectify(15) report(\"r\", geometry.isRectangular(0.001)) B."),
                   "r"),
            1);
  EXPECT_EQ(
      sum_of("A --> primitiveDisk(32, 5) reduceGeometry(0.5) report(\"n\", geometry.nVertices) B.", "n"), 16);
  EXPECT_NEAR(sum_of("A --> primitiveCylinder(6, 2, 3) footprint() report(\"a\", geometry.area) B.", "a"),
              6 * std::sqrt(3.0), 1e-9);
  EXPECT_EQ(leaves("A --> comp(f){ top: reverseNormals() comp(f){ world.down: B. | world.up: C. } }"), "B");
  EXPECT_NEAR(volume_after("t(1, 2, 3) s(1, 1, 1) resetGeometry()", {2, 3, 4}), 24, 1e-12);
}

TEST(Frames, MoveAndRotateShapesInTheWorld) {
  const Json moved = derived(with("A --> r(0, 90, 0) B.", {2, 2, 2})),
             by = derived(with("A --> r(0, 90, 0) translate(rel, world, 1, 2, 3) B.", {2, 2, 2}));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(by["shapes"][1]["scope"]["origin"][axis].get<double>() -
                    moved["shapes"][1]["scope"]["origin"][axis].get<double>(),
                static_cast<double>(axis) + 1, 1e-12);
  }
  // A box of 2 x 2 in a scope turned by 45 degrees: its box has the diagonal as its side.
  EXPECT_NEAR(sizes(derived(with("A --> rotateScope(0, 45, 0) B.", {2, 1, 2})), 0).at(0), std::sqrt(8.0),
              1e-9);
  EXPECT_NEAR(sizes(derived(with("A --> rotate(rel, world, 0, 45, 0) B.", {2, 1, 2})), 0).at(0), 2, 1e-9);
  EXPECT_THAT(sizes(derived(with("A --> setPivot(xzy, 0) B.", {2, 3, 4})), 1), ElementsAre(4));
}

TEST(Scatter, PutsPointsWhereTheDomainIs) {
  const Json answer =
      derived(with("A --> scatter(scope, 2000, uniform){ report(\"x\", scope.tx) B. }", {8, 4, 2}));
  EXPECT_EQ(answer["reports"]["x"]["count"], 2000);
  EXPECT_NEAR(answer["reports"]["x"]["mean"].get<double>(), 0, 4 * 8 / std::sqrt(12.0 * 2000));
  EXPECT_GE(answer["reports"]["x"]["min"].get<double>(), -4);
  // On a prism over the L shape no point has z beyond 4 and x beyond 4.
  EXPECT_EQ(active(derived(over(l_shape,
                                "A --> extrude(3) scatter(volume, 500, uniform){ case scope.tx > 4.0001 && "
                                "scope.tz > 4.0001: Out. else: In. }")))
                .find("Out"),
            std::string::npos);
}

TEST(Booleans, HaveTheVolumesOfSets) {
  const std::string b = "B --> primitiveCube(4, 4, 4)  ";
  BuildingParams params =
      with("A --> union { B | t(2, 2, 2) B } report(\"v\", geometry.volume) C.  " + b, {4, 4, 4});
  EXPECT_NEAR(sum_of(params, "v"), 120, 1e-9);
  params.rules = "A --> subtract { B | t(2, 2, 2) B } report(\"v\", geometry.volume) C.  " + b;
  EXPECT_NEAR(sum_of(params, "v"), 56, 1e-9);
  params.rules = "A --> intersect { B | t(2, 2, 2) B } report(\"v\", geometry.volume) C.  " + b;
  EXPECT_NEAR(sum_of(params, "v"), 8, 1e-9);
}

/// Random boxes and prisms: the volumes of union and intersection sum to those of the operands, and every result is closed.
TEST(Booleans, AreClosedAndAddUpForRandomSolids) {
  Job job(0, Job::Options{});
  Rng rng(11);
  for (int trial = 0; trial < 300; ++trial) {
    Solid solids[2];
    for (Solid& solid : solids) {
      solid = trial % 3 == 0 ? unit_box() : trial % 3 == 1 ? triangular_prism() : cylinder();
      const glm::dvec3 size(rng.uniform(0.5, 3), rng.uniform(0.5, 3), rng.uniform(0.5, 3));
      const glm::dvec3 at(rng.uniform(0, 2), rng.uniform(0, 2), rng.uniform(0, 2));
      for (glm::dvec3& p : solid.points) p = at + p * size;
    }
    const glm::dvec3 one(1);
    const Solid both = boolean(solids[0], solids[1], BooleanKind::unite, job),
                common = boolean(solids[0], solids[1], BooleanKind::intersect, job),
                rest = boolean(solids[0], solids[1], BooleanKind::subtract, job);
    const double a = volume_of(solids[0], one), b = volume_of(solids[1], one);
    ASSERT_TRUE(both.is_closed && (common.faces.empty() || common.is_closed) &&
                (rest.faces.empty() || rest.is_closed))
        << trial;
    EXPECT_NEAR(volume_of(both, one) + volume_of(common, one), a + b, 1e-7) << trial;
    EXPECT_NEAR(volume_of(rest, one) + volume_of(common, one), a, 1e-7) << trial;
  }
}

TEST(Inline, MakesOneShapeOfSeveral) {
  EXPECT_EQ(leaves("A --> inline split(x){ ~1: B. | ~1: NIL | ~1: B. } C."), "C");
  EXPECT_NEAR(area_after("inline split(x){ ~1: X | ~1: NIL | ~1: X }", {9, 0, 2}), 12, 1e-9);
  EXPECT_NEAR(volume_after("inline(unify) comp(f){ top: extrude(1) X | side: extrude(1) X }", {2, 2, 2}), 20,
              1e-9);
}

TEST(Modify, MovesTheCornersOfAComponent) {
  // A frustum: the top of a cube of 2 m shrinks to a half about its centre.
  EXPECT_NEAR(volume_after("modify(f){ top: s('0.5, '0.5, '1) center(xyz) X }", {2, 2, 2}),
              2.0 / 3 * (4 + 1 + 2), 1e-9);
  EXPECT_NEAR(volume_after("modify(f){ top: t(0, 0, 1) X }", {2, 2, 2}), 12, 1e-9);
}

TEST(Modify, PutsOtherGeometryInThePlaceOfAFace) {
  // A box of 10 m x 3 m x 8 m with a second one on top, without the face between them.
  const std::array<double, 3> lot{10, 0, 8};
  EXPECT_NEAR(volume_after("extrude(3) modify(f){ top: extrude(2) X }", lot), 400, 1e-9);
  EXPECT_NEAR(area_after("extrude(3) modify(f){ top: extrude(2) X }", lot), 2 * 80 + 36 * 5, 1e-9);
  EXPECT_NEAR(volume_after("extrude(3) modify(f){ top: roofGable(45) X }", lot), 240 + 160, 1e-9);
  // A hole, and half of a face.
  EXPECT_NEAR(area_after("extrude(3) modify(f){ top: NIL }", lot), 80 + 108, 1e-9);
  EXPECT_NEAR(area_after("extrude(3) modify(f){ front: split(x){ 5: X | ~1: NIL } }", lot), 160 + 108 - 15,
              1e-9);
  // The inner part of the top is raised; its border stays.
  EXPECT_NEAR(volume_after(
                  "extrude(3) modify(f){ top: offset(-1) comp(f){ inside: extrude(1) X | border: X } }", lot),
              240 + 48, 1e-9);
}

TEST(Recompose, JoinsPiecesWhereTheyMeet) {
  // The letter E of splits across each other becomes one polygon of twelve corners.
  const std::string letter =
      "inline(recompose) split(x){ 2: X | ~1: split(z){ 2: X | 2: NIL }* } cleanupGeometry(all, 0) ";
  EXPECT_EQ(sum_of("A --> " + letter + "report(\"n\", geometry.nFaces) B.  X --> Y.", "n", {6, 0, 10}), 1);
  EXPECT_EQ(sum_of("A --> " + letter + "report(\"n\", geometry.nVertices) B.  X --> Y.", "n", {6, 0, 10}),
            12);
  EXPECT_NEAR(area_after(letter, {6, 0, 10}), 20 + 3 * 8, 1e-9);
}

TEST(Insert, PutsABoxInThePlaceOfAFileThatIsNotThere) {
  const Json answer = derived(with("A --> i(\"assets/window.old.obj\") B."));
  EXPECT_EQ(active(answer), "B");
  EXPECT_THAT(derived(with("A --> i(\"assets/oak.obj\") B."))["warnings"].dump(), HasSubstr("has no asset"));
  EXPECT_THAT(refusal(with("A --> i(\"oak\") B.")), HasSubstr("there is no part"));
  EXPECT_THAT(refusal(with("A --> i(\"builtin:cube\") B.")), testing::StrEq("none"));
}

TEST(Insert, KeepsTheSizeOrThePositionOfAnAsset) {
  // The asset is 2 by 4 by 3 m. The middle of its depth is its origin; it begins 0.5 m above it.
  const Child model{"building", std::nullopt,
                    R"({"size": [2, 0, 3], "rules": "L --> extrude(4) t(1, 0.5, 0) X."})"};
  const auto scope_of = [&](const std::string& words) {
    BuildingParams params = with("Lot --> s(6, 1, 1) t(2, 1, 2) i(\"box.obj\"" + words + ") B.", {10, 0, 8});
    params.assets["box"].model = model;
    const Json scope = derived(params)["shapes"].back()["scope"];
    return Json{scope["origin"], scope["size"]};
  };
  // The corner of the lot is (-5, 0, -4).
  EXPECT_EQ(scope_of(""), Json::parse("[[-3, 1, -2], [6, 1, 1]]"));
  EXPECT_EQ(scope_of(", yUp, alignSizeAndPosition"), Json::parse("[[-3, 1, -2], [6, 1, 1]]"));
  EXPECT_EQ(scope_of(", yUp, keepSizeAlignPosition"), Json::parse("[[-3, 1, -2], [2, 4, 3]]"));
  EXPECT_EQ(scope_of(", yUp, keepSizeAndPosition"), Json::parse("[[-3, 1.5, -3.5], [2, 4, 3]]"));
  EXPECT_THAT(refusal(with("Lot --> i(\"box.obj\", yUp, hard) B.")), HasSubstr("keepSizeAndPosition"));
}

TEST(InsertAlongUv, PutsACopyInEveryTile) {
  const Json answer =
      derived(with("A --> normalizeUV(0, uv, separatePerFace) scaleUV(0, 5, 2) insertAlongUV(0, \"cube\", 1)",
                   {10, 0, 4}));
  EXPECT_EQ(sizes(answer, 0), std::vector<double>(10, 2.0));
}

}  // namespace
}  // namespace seedmesh::building
