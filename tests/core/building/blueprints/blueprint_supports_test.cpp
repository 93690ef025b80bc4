/// Parts of blueprints stand on what carries them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "core/registry/registry.h"
#include "generated/params/building.h"
#include "tests/core/building/blueprints/blueprint_shapes.h"
#include "tests/support/context.h"

namespace seedmesh::building {
namespace {

/// Their boxes fill the roof of a triangle whose scope is twice as large as it.
TEST(BlueprintSupports, OfficeTowerHasItsPlantOnTheRoof) {
  const Json triangle = Json::parse("[[[-15,-13],[15,-13],[0,13]]]");
  const Json shapes = shapes_of({{"blueprint", "office_tower"}, {"footprint", triangle}}, 1);
  int plants = 0, units = 0;
  for (const Json& shape : shapes) {
    if (shape["symbol"] != "Plant" && shape["symbol"] != "Unit") continue;
    plants += shape["symbol"] == "Plant" && !shape["active"].get<bool>() ? 1 : 0;
    units += shape["symbol"] == "Unit" && !shape["active"].get<bool>() ? 1 : 0;
    const Json &scope = shape["scope"], &axes = scope["axes"];
    for (int corner = 0; corner < 4; ++corner) {
      const int along = corner / 2, across = corner % 2;
      const auto at = [&](int axis) {
        return scope["origin"][axis].get<double>() +
               along * scope["size"][0].get<double>() * axes[0][axis].get<double>() +
               across * scope["size"][2].get<double>() * axes[2][axis].get<double>();
      };
      const double x = at(0), z = at(2);
      EXPECT_GE(z, -13 - 1e-3);
      EXPECT_LE(std::abs(x), 15 * (13 - z) / 26 + 1e-2);
    }
  }
  EXPECT_EQ(plants, 1);
  EXPECT_GE(units, 2);
}

TEST(BlueprintSupports, TempleHasTheColumnsOfItsFrontAndCarriesItsRoofOnTheSmallestLot) {
  const auto columns = [](const Json& parameters) {
    std::map<double, int> rows;  // by z
    for (const Json& shape : shapes_of(parameters, 1)) {
      if (shape["symbol"] != "Column" || shape["active"].get<bool>()) continue;
      EXPECT_GT(shape["scope"]["size"][0].get<double>(), 0.2);
      ++rows[shape["scope"]["origin"][2].get<double>()];
    }
    return rows;
  };
  for (const int front : {4, 6, 8, 10}) {
    const auto rows =
        columns({{"blueprint", "temple"}, {"size", {16, 0, 32}}, {"attributes", {{"columns", front}}}});
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.begin()->second, front);
    EXPECT_EQ(rows.rbegin()->second, front);
  }
  const auto smallest = columns({{"blueprint", "temple"}, {"size", {3, 0, 3}}});
  ASSERT_GE(smallest.size(), 2U);
  EXPECT_GE(smallest.begin()->second, 2);
}

}  // namespace
}  // namespace seedmesh::building
