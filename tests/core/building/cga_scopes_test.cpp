/// Scopes in files of CityEngine: of raised faces, and of faces whose scope has a depth.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> vector_of(const Json& shape, const char* name) {
  std::vector<double> out;
  for (const Json& each : shape["scope"][name]) out.push_back(each.get<double>());
  return out;
}

/// The active shapes of a symbol.
std::vector<Json> shapes_of(const Json& answer, const std::string& symbol) {
  std::vector<Json> out;
  for (const Json& shape : answer["shapes"]) {
    if (shape["active"] && shape["symbol"] == symbol) out.push_back(shape);
  }
  return out;
}

testing::Matcher<std::vector<double>> near(double x, double y, double z) {
  return ElementsAre(DoubleNear(x, 1e-9), DoubleNear(y, 1e-9), DoubleNear(z, 1e-9));
}

/// On a flat lot of 10 x 10 m.
BuildingParams on_lot(std::string rules) { return with(std::move(rules), {10, 0, 10}); }

constexpr const char* headers[] = {"version \"2024.0\"\n", "@StartRule\n"};

TEST(CgaScopes, OfMassesOnTerracesStandUpInAllRules) {
  const std::string tower =
      "Lot --> Stage(3)\n"
      "Stage(k) --> case k > 0: extrude(6) comp(f){ side: Wall. | top: setback(1){ all: Ledge. | "
      "remainder: Stage(k - 1) } } else: taper(4) Spire.";
  const Json answer = derived(on_lot(tower));
  const std::vector<Json> walls = shapes_of(answer, "Wall");
  ASSERT_EQ(walls.size(), 12U);
  for (const Json& wall : walls) EXPECT_NEAR(vector_of(wall, "size")[1], 6, 1e-9);
  const std::vector<Json> spires = shapes_of(answer, "Spire");
  ASSERT_EQ(spires.size(), 1U);
  EXPECT_THAT(vector_of(spires[0], "size"), near(4, 4, 4));
  EXPECT_NEAR(spires[0]["scope"]["origin"][1].get<double>(), 18, 1e-9);
  // After @KeepScopes the scope of the second stage keeps the axes of the terrace: its y is horizontal.
  const Json kept = derived(on_lot("@KeepScopes " + tower));
  ASSERT_EQ(shapes_of(kept, "Spire").size(), 1U);
  EXPECT_LT(shapes_of(kept, "Spire")[0]["scope"]["origin"][1].get<double>(), 12);
}

TEST(CgaScopes, TurnWithRaisedFacesAfterStartRule) {
  // On a facade of 10 x 4 m, y of the extruded slab is its depth.
  const std::string rules = "Lot --> extrude(4) comp(f){ front: extrude(0.5) Slab. | all: NIL }";
  for (const char* header : headers) {
    EXPECT_THAT(vector_of(shapes_of(derived(on_lot(header + rules)), "Slab")[0], "size"), near(10, 0.5, 4))
        << header;
  }
  EXPECT_THAT(vector_of(shapes_of(derived(on_lot(rules)), "Slab")[0], "size"), near(10, 4, 0.5));
  EXPECT_THAT(vector_of(shapes_of(derived(on_lot("@StartRule @KeepScopes\n" + rules)), "Slab")[0], "size"),
              near(10, 4, 0.5));
}

TEST(CgaScopes, OfFacesHaveADepthAndTheFacesStayFlat) {
  const auto front = [](const std::string& header, const std::string& successor) {
    return derived(on_lot(header + "Lot --> extrude(4) comp(f){ front: " + successor + " | all: NIL }\n" +
                          "Panel --> primitiveCube() Body."));
  };
  for (const std::string header : headers) {
    // A leaf is the face itself, at the low side of the scope.
    EXPECT_THAT(vector_of(shapes_of(front(header, "s('0.5, '1, 0.3) Leaf."), "Leaf")[0], "size"),
                near(5, 4, 0));
    EXPECT_THAT(vector_of(shapes_of(front(header, "s('0.5, '1, -0.3) Leaf."), "Leaf")[0], "size"),
                near(5, 4, 0));
    // Primitives fill the scope, in another rule, too, and behind the face where the depth is negative.
    const Json body = shapes_of(front(header, "s('1, '1, -0.3) Panel"), "Body")[0];
    EXPECT_THAT(vector_of(body, "size"), near(10, 4, 0.3));
    EXPECT_NEAR(body["scope"]["origin"][2].get<double>(), 5 - 0.3, 1e-9);
    EXPECT_THAT(
        vector_of(shapes_of(front(header, "s('1, '1, 0.3) t(0, 0, '-1) i(\"cube\") A."), "A")[0], "size"),
        near(10, 4, 0.3));
    // Operations on faces find a face.
    EXPECT_THAT(vector_of(shapes_of(front(header, "s('1, '1, 0.3) extrude(0.1) Ledge."), "Ledge")[0], "size"),
                near(10, 0.1, 4));
    EXPECT_EQ(active(front(header, "s('1, '1, 0.3) offset(-0.5) comp(f){ border: B. | inside: I. }")),
              "B B B B I");
    EXPECT_EQ(active(front(header, "s('1, '1, 0.3) split(x){ 4: A. | ~1: B. }")), "A B");
    EXPECT_THAT(
        vector_of(shapes_of(front(header, "s('1, '1, 0.3) split(x){ 4: A. | ~1: B. }"), "B")[0], "size"),
        near(6, 4, 0));
  }
  EXPECT_THAT(vector_of(shapes_of(front("", "s('0.5, '1, 0.3) Leaf."), "Leaf")[0], "size"), near(5, 4, 0.3));
}

TEST(CgaScopes, CanBecomeALine) {
  // A post stands at a corner of the lot; the two sizes of 0 follow from the part.
  const Json answer = derived(on_lot("version \"2024.0\"\nLot --> s(0, 5, 0) i(\"cube\") Post."));
  EXPECT_THAT(vector_of(shapes_of(answer, "Post")[0], "size"), near(5, 5, 5));
}

TEST(CgaScopes, OfPolygonsHaveADepthToo) {
  BuildingParams params = on_lot(
      "version \"2024.0\"\nLot --> s('1, 3, '1) report(\"area\", geometry.area) Ground\n"
      "Ground --> extrude(2) report(\"volume\", geometry.volume) Mass.");
  params.footprint = {{{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}}};
  const Json answer = derived(params);
  EXPECT_NEAR(answer["reports"]["area"]["sum"].get<double>(), 48, 1e-9);
  EXPECT_NEAR(answer["reports"]["volume"]["sum"].get<double>(), 96, 1e-9);
  EXPECT_THAT(vector_of(shapes_of(answer, "Mass")[0], "size"), near(8, 2, 8));
}

TEST(CgaScopes, AlignToTheLowestFace) {
  // The lowest face is the underside.
  const Json answer =
      derived(on_lot("version \"2024.0\"\nLot --> extrude(3) r(5, 0, 0) alignScopeToGeometry(zUp, "
                     "world.lowest, longest) Mass."));
  EXPECT_THAT(answer["warnings"], testing::IsEmpty());
  const Json mass = shapes_of(answer, "Mass")[0];
  // z is the normal of the underside, turned by 5 degrees about x.
  EXPECT_THAT(vector_of(mass, "size"), near(10, 10, 3));
}

/// The reference: a primitive with sizes is "positioned in the xz-center of the scope lying on y=0".
TEST(CgaPrimitives, OfAGivenSizeStandInTheMiddleOfTheScope) {
  const struct {
    const char* steps;
    std::array<double, 3> size;
  } cases[] = {{"primitiveQuad(4, 6)", {4, 0, 6}},         {"primitiveDisk(4, 3)", {6, 0, 6}},
               {"primitiveCube(2, 3, 14)", {2, 3, 14}},    {"primitiveSphere(16, 8, 1)", {2, 2, 2}},
               {"primitiveCylinder(16, 2, 5)", {4, 5, 4}}, {"primitiveCone(16, 1, 5)", {2, 5, 2}}};
  for (const auto& each : cases) {
    SCOPED_TRACE(each.steps);
    const std::string place = "t(1, 2, 3) r(0, 90, 0) s(10, 4, 10)";
    std::string rules = "Lot --> [ ";
    rules.append(place).append(" Box. ] ").append(place).append(" ").append(each.steps).append(" Solid.");
    const Json answer = derived(on_lot(rules));
    const Json box = shapes_of(answer, "Box")[0], solid = shapes_of(answer, "Solid")[0];
    EXPECT_THAT(vector_of(solid, "size"), near(each.size[0], each.size[1], each.size[2]));
    const std::vector<double> from = vector_of(box, "origin"), at = vector_of(solid, "origin");
    // After the turn, x points to -z and z to x.
    EXPECT_THAT(at, near(from[0] + (10 - each.size[2]) / 2, from[1], from[2] - (10 - each.size[0]) / 2));
  }
}

/// The reference: a quad or disk lies "with respect to the plane defined by the valued scope sizes".
TEST(CgaPrimitives, OfFlatShapesLieInTheFace) {
  const struct {
    const char* steps;
    std::array<double, 3> low, size;
  } cases[] = {{"primitiveQuad()", {0, 0, 0}, {20, 6, 0}},
               {"primitiveDisk(4)", {0, 0, 0}, {20, 6, 0}},
               {"primitiveQuad(2, 3)", {9, 1.5, 0}, {2, 3, 0}},
               {"primitiveDisk(4, 1)", {9, 2, 0}, {2, 2, 0}}};
  for (const auto& each : cases) {
    SCOPED_TRACE(each.steps);
    const std::string rules = "version \"2022.0\"\nLot --> extrude(6) comp(f){ front: [ Face. ] " +
                              std::string(each.steps) + " report(\"area\", geometry.area) Flat. | all: NIL }";
    const Json answer = derived(with(rules, {20, 0, 8}));
    const std::vector<double> face = vector_of(shapes_of(answer, "Face")[0], "origin");
    const Json flat = shapes_of(answer, "Flat")[0];
    EXPECT_THAT(vector_of(flat, "origin"),
                near(face[0] + each.low[0], face[1] + each.low[1], face[2] + each.low[2]));
    EXPECT_THAT(vector_of(flat, "size"), near(each.size[0], each.size[1], each.size[2]));
    const double share = std::string(each.steps).find("Disk") != std::string::npos ? 0.5 : 1;
    EXPECT_NEAR(answer["reports"]["area"]["sum"].get<double>(), share * each.size[0] * each.size[1], 1e-9);
  }
}

/// The first edge is that along the x axis of the lot, so that the roof rises across it.
TEST(CgaScopes, OfLotsHaveTheirFirstEdgeAtTheFront) {
  for (const char* header : headers) {
    const BuildingParams params = with(std::string(header) +
                                           "Lot --> [ roofShed(45) Roof. ] comp(e){ 0: Front. | 1: Right. | "
                                           "2: Back. | 3: Left. }",
                                       {20, 0, 8});
    const Json answer = derived(params);
    EXPECT_NEAR(vector_of(shapes_of(answer, "Roof")[0], "size")[1], 8, 1e-9);
    const std::vector<double> front = vector_of(shapes_of(answer, "Front")[0], "origin"),
                              back = vector_of(shapes_of(answer, "Back")[0], "origin");
    EXPECT_NEAR(vector_of(shapes_of(answer, "Front")[0], "size")[0], 20, 1e-9);
    EXPECT_NEAR(vector_of(shapes_of(answer, "Right")[0], "size")[0], 8, 1e-9);
    EXPECT_NEAR(front[2] - back[2], 8, 1e-9);
  }
}

/// CityEngine 2022.1: "the original geometry is retained".
TEST(CgaOffset, KeepsAFaceThatIsTooSmall) {
  const Json answer = derived(on_lot("version \"2022.1\"\nLot --> offset(-6, inside) extrude(3) Mass."));
  EXPECT_THAT(vector_of(shapes_of(answer, "Mass")[0], "size"), near(10, 3, 10));
  ASSERT_EQ(answer["warnings"].size(), 1U);
  EXPECT_THAT(answer["warnings"][0]["message"].get<std::string>(), HasSubstr("nothing inside"));
}

TEST(CgaColors, CanBeNamesOfCss) {
  const auto red_of = [](const std::string& value) {
    const Json answer =
        derived(on_lot("Lot --> color(" + value + ") report(\"red\", material.color.r) Leaf."));
    return std::lround(answer["reports"]["red"]["sum"].get<double>() * 255);
  };
  EXPECT_EQ(red_of("\"white\""), 0xff);
  EXPECT_EQ(red_of("\"MidnightBlue\""), 0x19);
  EXPECT_EQ(red_of("\"DAFAF3\""), 0xda);
  EXPECT_EQ(red_of("\"#123456\""), 0x12);
  EXPECT_THAT(refusal(with("Lot --> color(\"whitish\") Leaf.")), HasSubstr("a name of CSS"));
}

}  // namespace
}  // namespace seedmesh::building
