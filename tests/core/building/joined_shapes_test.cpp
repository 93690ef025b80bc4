#include <gmock/gmock.h>

#include <algorithm>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

/// The sum of what the rules reported under "m".
double measured(const Json& answer) { return answer["reports"]["m"]["sum"]; }

TEST(LeftSides, OfSeveralShapesJoinNeighbours) {
  const Json wide =
      derived(with("Lot --> split(x){ 2: pane | 2: pane | 2: pane | ~1: wall. }\npane + pane ~> wide."));
  EXPECT_EQ(active(wide), "pane wall wide");
  EXPECT_THAT(sizes(wide, 0), testing::ElementsAre(2, 4, 4));
  EXPECT_EQ(leaves("Lot --> split(x){ 2: a | 3: b | ~1: a }\na + b ~> c."), "a c");
  EXPECT_EQ(leaves("Lot --> split(x){ 2: b | 3: a | ~1: b }\na + b ~> c."), "b c");
  EXPECT_EQ(leaves("Lot --> split(x){ 2: a | 1: wall. | ~1: a }\na + a ~> c."), "a wall a");
}

TEST(LeftSides, OfSeveralShapesMatchShapesOfDifferentPredecessors) {
  const Json tall = derived(with(
      "Lot --> split(y){ 4: floor | ~1: floor }\nfloor --> split(x){ 3: pane | ~1: wall. }\npane + pane ~> "
      "tall."));
  EXPECT_EQ(active(tall), "wall wall tall");
  EXPECT_THAT(sizes(tall, 1), testing::ElementsAre(4, 6, 10));
  // Dominoes on a grid of 5 columns of 3 cells, the first free neighbour in the order of the tree: by hand, 7 and one cell.
  const Json grid =
      derived(with("Lot --> split(x){ { ~2: column }* }\ncolumn --> split(y){ { ~10/3: A }* }\nA + A ~> B."));
  EXPECT_EQ(std::ranges::count(active(grid), 'B'), 7);
  EXPECT_EQ(std::ranges::count(active(grid), 'A'), 1);
}

TEST(LeftSides, OfSeveralShapesUniteWhatFillsNoBox) {
  const std::string lot = "Lot --> split(x){ 5: a | 5: split(y){ 4: a | ~1: a } }\n";
  const Json bent = derived(with(lot + "a + a ~> report(\"m\", geometry.volume) c."));
  EXPECT_EQ(active(bent), "a c");
  EXPECT_NEAR(measured(bent), 500 + 200, 1e-6);
  // A condition can ask for a box; then the two shapes on the right match.
  const Json box = derived(with(lot + "a + a : geometry.volume > 0.999 * scope.sx * scope.sy * scope.sz ~> "
                                      "report(\"m\", geometry.volume) c."));
  EXPECT_EQ(active(box), "a c");
  EXPECT_NEAR(measured(box), 500, 1e-6);
  // Two parts of a lot are one polygon, over which a house has one prism: 6 x 10 and 4 x 4 m, 3 m high.
  const Json house =
      derived(with("Lot --> split(x){ 6: part | ~1: split(z){ 4: part | ~1: garden. } }\npart + part ~> "
                   "extrude(3) report(\"m\", geometry.volume) comp(f){ top: Top. | side: Wall. }",
                   {10, 0, 10}));
  EXPECT_NEAR(measured(house), 3 * (60 + 16), 1e-6);
  EXPECT_EQ(active(house), "garden Top Wall Wall Wall Wall Wall Wall");
}

TEST(LeftSides, OfSeveralShapesMatchFacesAroundACornerAndSolids) {
  // Two facades of 10 x 10 m share an edge; the other two of the box are the second match.
  const Json corner = derived(with(
      "Lot --> comp(f){ side: facade | all: NIL }\nfacade + facade ~> report(\"m\", geometry.area) bent."));
  EXPECT_EQ(active(corner), "bent bent");
  EXPECT_NEAR(measured(corner), 400, 1e-6);
  EXPECT_NEAR(corner["reports"]["m"]["min"], 200, 1e-6);
  // Two cylinders, one on the other, are one solid of both volumes.
  const std::string drums = "Lot --> split(y){ 4: i(\"cylinder\") drum | ~1: i(\"cylinder\") drum }\n";
  const double apart = measured(derived(with(drums + "drum ~> report(\"m\", geometry.volume) one.")));
  const Json column = derived(with(drums + "drum + drum ~> report(\"m\", geometry.volume) column."));
  EXPECT_EQ(active(column), "column");
  EXPECT_NEAR(measured(column), apart, 1e-6 * apart);
  // A sign on a wall is its neighbour, one before it is not.
  const std::string sign =
      "Lot --> [ s('1, '1, 2) wall ] [ t(1, 1, AT) s(2, 2, 0) sign ]\nsign + [wall] ~> fixed.";
  const auto at = [&](const char* z) { return std::string(sign).replace(sign.find("AT"), 2, z); };
  EXPECT_EQ(leaves(at("2")), "wall fixed");
  EXPECT_EQ(leaves(at("2.1")), "wall sign");
}

TEST(LeftSides, OfSeveralShapesMatchAtAnyRotation) {
  // The second cube is turned by a quarter; with the first it fills a box of 8 x 4 x 4 m, whatever turns both.
  const std::string cubes = "[ s(4, 4, 4) A ] [ t(4, 0, 4) r(0, 90, 0) s(4, 4, 4) A ]\nA + A ~> B.";
  for (const std::string turn : {"", "r(0, 30, 0) ", "r(20, -50, 70) "}) {
    const Json box = derived(with("Lot --> " + turn + cubes));
    EXPECT_EQ(active(box), "B") << turn;
    EXPECT_NEAR(sizes(box, 0)[0], 8, 1e-9);
    EXPECT_NEAR(sizes(box, 1)[0], 4, 1e-9);
    EXPECT_NEAR(sizes(box, 2)[0], 4, 1e-9);
  }
}

TEST(LeftSides, KeepShapesInBrackets) {
  const std::string plots = "Lot --> split(x){ 2: street | 4: plot(1) | 4: plot(2) }\n";
  EXPECT_EQ(leaves(plots + "plot(n) + [street] ~> corner. plot(n) ~> inner. street ~> road."),
            "corner road inner");
  // The split rule of the theses: one of two connected shapes is divided, the other stays.
  const Json shop = derived(with(plots + "plot(n) + [street] ~> Subdiv(\"X\", 1, 1r){ step. | shop(n). }"));
  EXPECT_EQ(active(shop), "street plot step shop");
  EXPECT_THAT(sizes(shop, 0), testing::ElementsAre(2, 4, 1, 3));
  // A kept shape can be the neighbour of several others.
  EXPECT_EQ(leaves("Lot --> split(x){ 4: plot | 2: street | ~1: plot }\nplot + [street] ~> corner."),
            "street corner corner");
}

TEST(LeftSides, HaveTheParametersOfAllShapesAndConditions) {
  const std::string lot = "Lot --> split(x){ 2: pane(1) | 2: pane(4) | 2: pane(7) | ~1: wall. }\n";
  const Json sum = derived(with(lot + "pane(a) + pane(b) : a + b > 10 ~> wide(a + 2*b)"));
  EXPECT_EQ(active(sum), "pane wall wide");
  for (const Json& shape : sum["shapes"]) {
    if (shape["symbol"] == "wide") {
      EXPECT_EQ(shape["parameters"][0], 18);
      EXPECT_EQ(shape["scope"]["origin"][0], -3);
    }
  }
}

TEST(LeftSides, OfThreeShapesAreSearchedInAnyOrder) {
  EXPECT_EQ(leaves("Lot --> split(x){ 2: c | 2: a | 2: b | ~1: wall. }\na + b + c ~> all."), "wall all");
  EXPECT_EQ(leaves("Lot --> split(x){ 2: c | 2: b | 2: a | ~1: wall. }\na + b + c ~> all."), "wall all");
  // The first two of the left side are no neighbours.
  EXPECT_EQ(leaves("Lot --> split(x){ 2: a | 2: b | 2: c | ~1: wall. }\na + c + b ~> all."), "wall all");
  EXPECT_EQ(leaves("Lot --> split(x){ 2: c | 2: b | 2: b | ~1: wall. }\na + b + c ~> all."), "c b b wall");
}

TEST(LeftSides, MatchParametersThatAreWrittenAsValues) {
  const std::string rules =
      "Lot --> split(y){ 2: floor(0) | 2: floor(1) | ~1: floor(2) }\n"
      "floor(0) ~> shop.\nfloor(1 + 1) ~> attic.\nfloor(n) ~> flat.";
  EXPECT_EQ(leaves(rules), "shop flat attic");
  EXPECT_EQ(leaves("Lot --> A(\"oak\") A(\"ash\")\nA(\"ash\") --> yes.\nA(kind) --> no."), "no yes");
  EXPECT_EQ(leaves("Lot ~> A(3) A(n) : n > 0 ~> B. A(n - 1) A(0) ~> end."), "B B B end");
}

TEST(LeftSides, OfSeveralShapesFollowTheOrderOfTheRules) {
  const std::string lot = "Lot --> split(x){ 2: a | 2: a | 2: a | 2: a | ~1: a }\n";
  // A tile of three is preferred to tiles of two, as long as there is one.
  EXPECT_EQ(leaves(lot + "a + a + a ~> three. a + a ~> two."), "three two");
  EXPECT_EQ(leaves(lot + "a + a ~> two. a + a + a ~> three."), "a two two");
}

TEST(LeftSides, OfSeveralShapesAreErrorsWithoutAnEnd) {
  const std::string message =
      refusal(with("Lot --> split(x){ ~1: A | ~1: B }\nA + B ~> split(x){ ~1: A | ~1: B }"));
  EXPECT_THAT(message, testing::HasSubstr("2:1 "));
  EXPECT_THAT(message, testing::HasSubstr("is nested 1,000 shapes deep"));
}

constexpr const char* random_rules =
    "Lot --> split(x){ rand(0.5, 2): A | rand(0.5, 2): B | { ~rand(0.5, 2): A | ~1: B }* }\n"
    "A --> 50%: split(y){ ~1: a | ~2: b } else: split(z){ ~1: a | ~1: a }\nB --> b\n"
    "a + b ~> c  a + a ~> c  A + [B] : scope.sx < 1 ~> c\nc ~> report(\"m\", geometry.volume) d.\n";

TEST(LeftSides, KeepTheVolumeOfRandomSplits) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Json answer = derived(with(random_rules), seed);
    double volume = answer["reports"].contains("m") ? measured(answer) : 0;
    for (const Json& shape : answer["shapes"]) {
      const Json& size = shape["scope"]["size"];
      if (shape["active"] && shape["symbol"] != "d")
        volume += size[0].get<double>() * size[1].get<double>() * size[2].get<double>();
    }
    EXPECT_NEAR(volume, 1000, 1e-5) << seed;
  }
}

/// Symbols and scopes of the active shapes, sorted.
std::vector<std::string> figure(const Json& answer) {
  std::vector<std::string> out;
  for (const Json& shape : answer["shapes"]) {
    if (shape["active"]) out.push_back(shape["symbol"].get<std::string>() + shape["scope"].dump());
  }
  std::ranges::sort(out);
  return out;
}

TEST(LeftSides, OfSeveralShapesDoNotDependOnTheOrderOfTheDerivation) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<std::string> expected = figure(derived(with(random_rules), seed));
    for (const BuildingMode mode : {BuildingMode::parallel, BuildingMode::sequential}) {
      for (const BuildingOrder order : {BuildingOrder::breadth, BuildingOrder::depth}) {
        BuildingParams params = with(random_rules);
        params.iterations = 1'000;
        params.derivation.mode = mode;
        params.derivation.order = order;
        EXPECT_EQ(figure(derived(params, seed)), expected) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace seedmesh::building
