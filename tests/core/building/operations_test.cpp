#include "core/generators/building/operations.h"

#include <gmock/gmock.h>

#include "core/generators/building/inner_rectangle.h"
#include "core/generators/building/spatial_queries.h"
#include "tests/core/building/rules.h"
#include "tests/core/geom/plans.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::vector<std::array<double, 2>>> l_shape = {
    {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 12}, {0, 12}}};

double sum_of(const Json& answer, const char* key) { return answer["reports"][key]["sum"].get<double>(); }

TEST(SplitArea, CutsAFaceIntoCellsOfTheirArea) {
  BuildingParams params = with(
      "Lot --> splitArea(x){ 20: Cell(\"a\") | '0.25: Cell(\"b\") | ~1: Cell(\"c\") | ~2: Cell(\"d\") }\n"
      "Cell(key) --> report(key, geometry.area) Cell.");
  params.footprint = l_shape;  // 72 square metres
  const Json answer = derived(params);
  EXPECT_NEAR(sum_of(answer, "a"), 20, 1e-6);
  EXPECT_NEAR(sum_of(answer, "b"), 18, 1e-6);
  EXPECT_NEAR(sum_of(answer, "c"), 34.0 / 3, 1e-6);
  EXPECT_NEAR(sum_of(answer, "d"), 68.0 / 3, 1e-6);
  EXPECT_EQ(sizes(derived(with("A --> splitArea(z){ 12: B. | ~1: C. }", {6, 0, 5})), 2),
            (std::vector<double>{2, 3}));
  EXPECT_THAT(refusal(with("A --> splitArea(x){ ~1: B. }")), HasSubstr("expected a face"));
}

TEST(Resize, MakesACutSolidTheFaceThatItCovers) {
  BuildingParams params = with(
      "Lot --> extrude(5) split(x){ ~1: Part | ~1: Part } Part --> s('1, 0, '1) report(\"area\", "
      "geometry.area) roofShed(20, 0) R.");
  params.footprint = {{{0, 0}, {20, 0}, {20, 10}, {0, 10}}};
  const Json answer = derived(params);
  EXPECT_NEAR(sum_of(answer, "area"), 200, 1e-9);
  EXPECT_EQ(answer["warnings"].dump().find("no roof"), std::string::npos) << answer["warnings"].dump();
  params.footprint = l_shape;  // 72 square metres
  EXPECT_NEAR(sum_of(derived(params), "area"), 72, 1e-9);
}

TEST(Operations, RefuseArgumentsThatTheyDoNotHave) {
  EXPECT_THAT(refusal(with("A --> s('1, 0, '1) taper(9, 2) B.")),
              HasSubstr("`taper` takes (height), found another argument"));
  EXPECT_THAT(refusal(with("A --> t(1, 2, 3, 4) B.")),
              HasSubstr("`t` takes (x, y, z), found another argument"));
  EXPECT_THAT(refusal(with("A --> deleteHoles(1) B.")), HasSubstr("`deleteHoles` takes ()"));
  EXPECT_THAT(refusal(with("A ~> Repeat(\"X\", 2, 3){ B. }")), HasSubstr("`Repeat` takes (axis, size)"));
  EXPECT_EQ(leaves("A ~> Subdiv(\"X\", 2, 3, 1r){ B. | C. | D. }"), "B C D");
  // Rule files of CityEngine are used as they are.
  for (const char* header : {"version \"2025.0\" A -->", "B --> C. @StartRule A -->"}) {
    const Json answer = derived(with(std::string(header) + " t(1, 2, 3, 4) D.", {10, 0, 8}));
    EXPECT_THAT(answer["warnings"].dump(), HasSubstr("found more, which has no effect"));
    EXPECT_EQ(active(answer), "D");
  }
}

TEST(InnerRectangle, IsTheLargestInsideAFace) {
  BuildingParams params = with(
      "Lot --> innerRectangle(scope){ shape: report(\"in\", geometry.area) B. | remainder: report(\"rest\", "
      "geometry.area) C. }");
  params.footprint = l_shape;
  const Json answer = derived(params);
  EXPECT_NEAR(sum_of(answer, "in"), 48, 1e-6);
  EXPECT_NEAR(sum_of(answer, "rest"), 24, 1e-6);
  // A square that stands on its corner: along its edges it is all there is, along the axes half of it.
  params.footprint = {{{5, 0}, {10, 5}, {5, 10}, {0, 5}}};
  EXPECT_NEAR(sum_of(derived(params), "in"), 25, 0.05);
  params.rules = "Lot --> innerRectangle(edge){ shape: report(\"in\", geometry.area) B. }";
  EXPECT_NEAR(sum_of(derived(params), "in"), 50, 1e-4);
}

/// Against 40 x 40 rectangles tried out: nothing that lies inside is larger by more than a hundredth.
TEST(InnerRectangle, IsTheLargestOfTheTriedOnesInRandomBlocksWithHoles) {
  Rng rng(3);
  Job job(0, Job::Options{});
  for (int trial = 0; trial < 200; ++trial) {
    const double width = rng.uniform(4, 20), depth = rng.uniform(4, 20);
    const glm::dvec2 hole_low(rng.uniform(0.5, width - 2), rng.uniform(0.5, depth - 2));
    const glm::dvec2 hole_high(rng.uniform(hole_low.x + 0.5, width - 0.2),
                               rng.uniform(hole_low.y + 0.5, depth - 0.2));
    const std::vector<std::vector<glm::dvec2>> rings = {
        {{0, 0}, {width, 0}, {width, depth}, {0, depth}},
        {hole_low, {hole_low.x, hole_high.y}, hole_high, {hole_high.x, hole_low.y}}};
    const InnerRectangle found = inner_rectangle(rings, job);
    const double best = std::max({hole_low.x * depth, (width - hole_high.x) * depth, hole_low.y * width,
                                  (depth - hole_high.y) * width});
    EXPECT_NEAR(found.area(), best, 1e-9 * best) << trial;
  }
}

/// Nothing is lost and nothing is there twice, however plans with courtyards are cut.
TEST(Splits, OfTenThousandRandomPlansFillThePlan) {
  Rng rng(77);
  const std::array<const char*, 3> cells = {
      "split(x){ ~1: split(z){ ~0.7: B | 0.9: B }* | 1.3: B | '0.2: B }",
      "split(z){ { 1.1: B | ~2: split(y){ ~1: B }* }* | 0.4: B }",
      "split(y){ '0.3: split(x){ 2: B }* | ~1: split(z, noAdjust){ ~3: B | ~1: B } }"};
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    Rng here = rng.at(seed);
    const Plan plan = seed % 2
                          ? random_star(here, 3 + static_cast<std::uint32_t>(seed / 2 % 12), seed % 4 == 1)
                          : random_blocks(here, 2 + static_cast<int>(seed / 2 % 4));
    BuildingParams params = with(std::string("Lot --> extrude(3) ") + cells[seed % 3] +
                                 " B --> report(\"v\", geometry.volume) C.");
    for (const PlanRing& ring : plan.rings) {
      auto& points = params.footprint.emplace_back();
      for (const glm::dvec2& p : ring) points.push_back({p.x, -p.y});
    }
    EXPECT_NEAR(sum_of(derived(params), "v"), 3 * area(plan), 3e-7 * area(plan)) << seed;
  }
}

TEST(AlignScope, TurnsTheScopeAndLeavesTheShape) {
  const Json to_axes = derived(with("A --> r(0, 90, 0) alignScopeToAxes() B.", {2, 3, 4}));
  EXPECT_EQ(to_axes["shapes"][1]["scope"]["axes"][0], Json::array({1, 0, 0}));
  const Json& size = to_axes["shapes"][1]["scope"]["size"];
  EXPECT_NEAR(size[0].get<double>(), 4, 1e-9);
  EXPECT_NEAR(size[2].get<double>(), 2, 1e-9);
  // A turned box keeps its volume in a scope around it.
  const BuildingParams turned = with("A --> r(10, 30, 5) alignScopeToAxes(y) B.", {2, 3, 4});
  EXPECT_NEAR(volume(turned), 24, 1e-4);
  EXPECT_NEAR(derived(turned)["shapes"][1]["scope"]["axes"][1][1].get<double>(), 1, 1e-12);
  EXPECT_THAT(faults(model_of(turned)), IsEmpty());
  BuildingParams diamond = with("Lot --> alignScopeToGeometryBBox(yUp) B.");
  diamond.footprint = {{{5, 0}, {10, 5}, {5, 10}, {0, 5}}};
  EXPECT_NEAR(sizes(derived(diamond), 0)[0], 50 / sizes(derived(diamond), 2)[0], 1e-9);
  BuildingParams longest = with("Lot --> alignScopeToGeometry(zUp, 0, longest) B.");
  longest.footprint = {{{0, 0}, {12, 5}, {0, 5}}};
  EXPECT_NEAR(sizes(derived(longest), 0)[0], 13, 1e-9);
  EXPECT_NEAR(sizes(derived(longest), 1)[0], 60.0 / 13, 1e-9);
}

TEST(TextureSplits, FollowTheProjection) {
  // Tiles of 2 m along x: a cell of 1.5 tiles has 3 m.
  EXPECT_THAT(sizes(derived(with("A --> s('1, '1, 0) setupProjection(0, scope.xy, 2, 1) "
                                 "split(u, uvSpace, 0){ 1.5: B. | ~1: C. }")),
                    0),
              ElementsAre(3, 7));
  EXPECT_THAT(sizes(derived(with("A --> s('1, '1, 0) setupProjection(0, scope.xy, 2, 1) "
                                 "split(v, unitSpace, 0){ 1.5: B. | ~1: C. }")),
                    1),
              ElementsAre(1.5, 8.5));
  // Across the scope: u runs along the diagonal of a wall that was turned away from the world's axes.
  const std::string slanted =
      "A --> s('1, '1, 0) r(0, 0, 45, scopeCenter) setupProjection(0, world.xy, 1, 1) split(u){ { 1: "
      "report(\"area\", "
      "geometry.area) B. }* }";
  const Json answer = derived(with(slanted, {4, 4, 4}));
  EXPECT_NEAR(sum_of(answer, "area"), 16, 1e-9);
  EXPECT_EQ(answer["reports"]["area"]["count"], 6);
  EXPECT_THAT(refusal(with("A --> s('1, '1, 0) setupProjection(0, scope.zx, 1, 1) split(u){ 1: B. }")),
              HasSubstr("cannot be split along it"));
  EXPECT_THAT(fault("A --> split(u, metres){ 1: B. }"), HasSubstr("expected uvSpace or unitSpace"));
  EXPECT_THAT(fault("A --> split(x, adjust, 0){ 1: B. }"), HasSubstr("none with the axes x, y and z"));
}

TEST(Projections, RunOverTheCellsOfAFacade) {
  const std::string picture =
      "data:image/"
      "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJR"
      "U5ErkJggg==";
  BuildingParams params = with(
      "A --> s('1, '1, 0) material(\"poster\") setupProjection(0, scope.xy, '1, '1) split(x){ { 2.5: "
      "projectUV(0) B. "
      "}* }",
      {10, 4, 1});
  params.materials["poster"].images.emplace().color = picture;
  const Model model = model_of(params);
  float low = 1e9F, high = -1e9F, top = 1e9F;
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) {
      for (const glm::vec2& uv : primitive.mesh.uv[0]) {
        low = std::min(low, uv.x);
        high = std::max(high, uv.x);
        top = std::min(top, uv.y);
      }
    }
  }
  EXPECT_NEAR(low, 0, 1e-6);
  EXPECT_NEAR(high, 1, 1e-6);
  EXPECT_NEAR(top, -1, 1e-6);
  EXPECT_THAT(derived(with("A --> projectUV(0) B."))["warnings"].dump(),
              HasSubstr("without a setupProjection"));
  EXPECT_THAT(refusal(with("A --> setupProjection(10, scope.xy, 1, 1) B.")),
              HasSubstr("expected one from 0 to 9"));
}

TEST(Parts, AreTurnedByTheirOptions) {
  const auto triangles = [](const std::string& rules) {
    return count(model_of(with(rules, {2, 2, 2}))).triangles;
  };
  EXPECT_LT(triangles("A --> i(\"stairs\", 3)"), triangles("A --> i(\"stairs\", 12)"));
  EXPECT_LT(triangles("A --> i(\"window\", 1)"), triangles("A --> i(\"window\", 4)"));
  // Two sizes of steps in one model are two parts, and equal ones are one.
  Job job(1, Job::Options{});
  Result<Model> both =
      generate(with("A --> split(x){ 0.5: i(\"stairs\", 3) | 0.5: i(\"stairs\", 12) | 0.5: i(\"stairs\", 3) "
                    "| 0.5: i(\"stairs\") }",
                    {2, 2, 2}),
               context_of(job, {.share_organs = true}));
  ASSERT_TRUE(both);
  finish(*both, job);
  EXPECT_EQ(both->meshes.size(), 3U);
  EXPECT_THAT(faults(*both), IsEmpty());
  EXPECT_THAT(refusal(with("A --> i(\"stairs\", 2000)")), HasSubstr("from 0 (by the size) to 1000"));
}

TEST(Components, OfARoofAreClassifiedByTheVerticalOfTheWorld) {
  const std::string faces =
      " Roof --> comp(f){ bottom: Under. | vertical: Gable. | front: Front. | back: Back. | aslant: Slope. }";
  const std::string expected = "Under Gable Gable Front Back";
  // On a lot, whose scope is upright, and on the top of a mass, whose scope lies.
  EXPECT_EQ(leaves("Lot --> roofGable(60) Roof" + faces, {12, 0, 8}), expected);
  EXPECT_EQ(leaves("Lot --> extrude(3) comp(f){ top: roofGable(60) Roof }" + faces, {12, 0, 8}), expected);
  EXPECT_EQ(leaves("Lot --> extrude(3) comp(f){ top: Roof(\"gable\", 60){ Roof } }" + faces, {12, 0, 8}),
            expected);
}

TEST(Queries, SeeTheRealSolidNotItsBox) {
  // A gable of 45 degrees fills half of its box: a panel under the ridge is in it, one beside the ridge is
  // not.
  const std::string body = "[ t(0, 0, 0) s(10, 5, 10) i(\"triangular_prism\") Mass. ] ";
  const auto answer = [&](const std::string& panel) {
    return leaves(
        "A ~> " + body + panel +
        " P  P : Shape.occ(\"noparent\") == \"none\" ~> free.  P : Shape.occ(\"noparent\") == \"full\" ~> "
        "full.  P ~> part.");
  };
  EXPECT_EQ(answer("T(4.5, 1, 4) S(1, 1, 1)"), "Mass full");
  EXPECT_EQ(answer("T(0.2, 4, 4) S(1, 0.8, 1)"), "Mass free");
  EXPECT_EQ(answer("T(0.5, 0.5, 4) S(1, 1, 1)"), "Mass part");
  EXPECT_EQ(answer("T(4.5, 1, 10) S(1, 1, 0)"), "Mass full");  // flat, on the face of the gable
  EXPECT_EQ(answer("T(0.2, 4, 10) S(1, 0.8, 0)"), "Mass free");
}

TEST(Queries, FindWhetherAStreetIsVisible) {
  const auto seen = [&](const std::string& wall) {
    return leaves("A ~> [ T(0, 0, 20) S(10, 0, 2) Street. ] " + wall +
                      " S(10, 5, 0) T(0, 0, 2) F  F : Shape.visible(\"Street\") ~> sees.  F ~> blind.",
                  {10, 5, 10});
  };
  EXPECT_EQ(seen(""), "Street sees");
  EXPECT_EQ(seen("[ T(0, 0, 10) S(10, 6, 1) Wall. ]"), "Street Wall blind");
  EXPECT_EQ(seen("[ T(8, 0, 10) S(2, 6, 1) Wall. ]"), "Street Wall sees");
  // The box of the prism is in the way, the prism is not.
  EXPECT_EQ(seen("[ T(-5, 0, 10) S(12, 12, 1) R(0, 0, 0) i(\"triangular_prism\") Wall. ]"),
            "Street Wall blind");
  EXPECT_EQ(leaves("A ~> F  F : Shape.visible(\"Street\") ~> sees.  F ~> blind."), "blind");
}

TEST(Vocabulary, HasExamplesThatRun) {
  const Json all = vocabulary();
  for (const char* list : {"building_operations", "building_words", "building_parts"}) {
    EXPECT_GT(all[list].size(), 15U);
    for (const Json& row : all[list]) {
      EXPECT_FALSE(row["kind"].get<std::string>().empty());
      EXPECT_FALSE(row["text"].get<std::string>().empty());
      if (row.contains("status") && row["status"] == "error") continue;
      EXPECT_FALSE(active(derived(with(row["example"].get<std::string>(), {6, 6, 6}))).empty())
          << row["name"];
    }
  }
}

TEST(VolumeShares, AreSharesOfABox) {
  const Scope whole{{0, 0, 0}, {2, 2, 2}, glm::dmat3(1)};
  EXPECT_NEAR(share_inside({{0, 0, 0}, {2, 2, 2}, glm::dmat3(1)}, triangular_prism(), whole), 0.5, 1e-9);
  EXPECT_NEAR(share_inside({{1, 0, 0}, {2, 2, 2}, glm::dmat3(1)}, triangular_prism(), whole), 0.25, 1e-9);
  EXPECT_NEAR(share_inside({{3, 0, 0}, {2, 2, 2}, glm::dmat3(1)}, triangular_prism(), whole), 0, 1e-9);
  const Solid prism = triangular_prism();
  EXPECT_TRUE(is_line_blocked({-1, 0.5, 1}, {3, 0.5, 1}, &prism, whole, 1e-5));
  EXPECT_FALSE(is_line_blocked({-1, 1.5, 1}, {0.2, 1.5, 1}, &prism, whole, 1e-5));
  EXPECT_TRUE(is_line_blocked({-1, 1.5, 1}, {0.2, 1.5, 1}, nullptr, whole, 1e-5));
}

}  // namespace
}  // namespace seedmesh::building
