#include <gmock/gmock.h>

#include "tests/core/building/rules.h"

namespace seedmesh::building {
namespace {

TEST(LeftSides, OfSeveralShapesJoinNeighbours) {
  const Json wide =
      derived(with("Lot --> split(x){ 2: pane | 2: pane | 2: pane | ~1: wall. }\npane + pane ~> wide."));
  EXPECT_EQ(active(wide), "pane wall wide");
  EXPECT_THAT(sizes(wide, 0), testing::ElementsAre(2, 4, 4));
  EXPECT_EQ(leaves("Lot --> split(x){ 2: a | 3: b | ~1: a }\na + b ~> c."), "a c");
  EXPECT_EQ(leaves("Lot --> split(x){ 2: b | 3: a | ~1: b }\na + b ~> c."), "b c");
}

TEST(LeftSides, JoinOnlyShapesThatFillOneBox) {
  EXPECT_EQ(leaves("Lot --> split(x){ 2: a | 1: wall. | ~1: a }\na + a ~> c."), "a wall a");
  EXPECT_EQ(leaves("Lot --> split(x){ 5: a | 5: split(y){ 4: a | ~1: wall. } }\na + a ~> c."), "a a wall");
  EXPECT_EQ(leaves("Lot --> split(x){ 5: a | 5: split(y){ 4: a | ~1: a } }\na + a ~> c."), "a c");
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

TEST(LeftSides, KeepTheVolumeOfRandomSplits) {
  for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
    const Json answer =
        derived(with("Lot --> split(x){ rand(0.5, 2): A | rand(0.5, 2): B | { ~rand(0.5, 2): A | ~1: B }* }\n"
                     "A --> 50%: split(y){ ~1: a | ~2: b } else: split(z){ ~1: a | ~1: a }\nB --> b\na + b "
                     "~> c.  a + a ~> d.  A + B : scope.sx < 3 ~> e."),
                seed);
    double volume = 0;
    for (const Json& shape : answer["shapes"]) {
      const Json& size = shape["scope"]["size"];
      if (shape["active"]) volume += size[0].get<double>() * size[1].get<double>() * size[2].get<double>();
    }
    EXPECT_NEAR(volume, 1000, 1e-6) << seed;
  }
}

}  // namespace
}  // namespace seedmesh::building
