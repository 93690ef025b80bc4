/// Buildings and areas of a scene, as maps have them.
#include "core/generators/scene/buildings.h"

#include <gmock/gmock.h>

#include "tests/core/scene/support.h"

namespace seedmesh {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Json square(double x, double z, double side) {
  return {{{x, z}, {x + side, z}, {x + side, z + side}, {x, z + side}}};
}

Json town(Json buildings) { return {{"ground", {{"outline", "none"}}}, {"buildings", std::move(buildings)}}; }

const Node* node_of(const Model& model, const std::string& name) {
  for (const Node& node : model.nodes) {
    if (node.name == name) return &node;
  }
  return nullptr;
}

MeshMeasures measured(const Model& model, const std::string& name) {
  const Node* node = node_of(model, name);
  if (!node || node->mesh < 0) return {};
  return measure({&model.meshes[static_cast<std::size_t>(node->mesh)].primitives.front().mesh});
}

TEST(SceneBuildings, StandWhereTheyAreGivenAsClosedMeshes) {
  const Result<Model> model = scene_of(town({{{"name", "hall"},
                                              {"footprint", square(10, -30, 8)},
                                              {"height", 9},
                                              {"base", 1},
                                              {"roof", {{"shape", "gabled"}, {"height", 3}}}}}));
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  const Node* node = node_of(*model, "hall");
  ASSERT_NE(node, nullptr);
  EXPECT_EQ(node->transform.translation, glm::vec3(14, 0, -26));
  const MeshMeasures measures = measured(*model, "hall");
  EXPECT_EQ(measures.open_edges, 0U);
  EXPECT_NEAR(measures.volume, 8 * 8 * 5 + 8 * 8 * 3 / 2.0, 1e-3);
  const Box box = bounds_of(model->meshes[static_cast<std::size_t>(node->mesh)].primitives.front().mesh);
  EXPECT_EQ(box.min, glm::vec3(-4, 1, -4));
  EXPECT_EQ(box.max, glm::vec3(4, 9, 4));
}

TEST(SceneBuildings, AreClosedWithEveryRoof) {
  Json buildings = Json::array();
  for (const char* shape : mass_roof_names)
    buildings.push_back({{"name", shape}, {"footprint", square(0, 0, 10)}, {"roof", {{"shape", shape}}}});
  const Result<Model> model = scene_of(town(buildings));
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  for (const char* shape : mass_roof_names) {
    const MeshMeasures measures = measured(*model, shape);
    EXPECT_EQ(measures.open_edges, 0U) << shape;
    EXPECT_GT(measures.volume, 290) << shape;
    EXPECT_EQ(measures.inconsistent_edges, 0U) << shape;
  }
}

TEST(SceneBuildings, BeyondTwoThousandAreMerged) {
  Json buildings = Json::array();
  for (int i = 0; i < 2001; ++i)
    buildings.push_back({{"footprint", square(20.0 * (i % 50), 20.0 * (i / 50), 9)}});
  const Result<Model> model = scene_of(town(buildings));
  ASSERT_TRUE(model);
  EXPECT_LT(model->meshes.size(), 4U);
  EXPECT_EQ(count(*model).triangles, 2001U * 12);
}

TEST(SceneBuildings, AreRefusedByPointer) {
  const Json crossing = {{{0, 0}, {10, 10}, {10, 0}, {0, 7}}};
  EXPECT_THAT(scene_errors(town({{{"footprint", crossing}}})),
              Contains(AllOf(HasSubstr("/buildings/0/footprint/0: "), HasSubstr("crosses"))));
  EXPECT_THAT(scene_errors(town({{{"footprint", square(0, 0, 5)}, {"base", 7}}})),
              ElementsAre("/buildings/0/base: found 7; expected less than the height, 6"));
  EXPECT_THAT(scene_errors(town({{{"footprint", square(0, 0, 5)}, {"roof", {{"height", 2}}}}})),
              ElementsAre("/buildings/0/roof/height: has no effect on a flat roof"));
  EXPECT_THAT(
      scene_errors(town({{{"footprint", square(0, 0, 5)}, {"roof", {{"shape", "hipped"}, {"height", 7}}}}})),
      ElementsAre("/buildings/0/roof/height: found 7; expected at most the height of the building, 6"));
}

TEST(SceneBuildings, KeepPlantsAway) {
  const Json json = {{"ground", {{"size", 100}}},
                     {"buildings", {{{"footprint", square(-20, -20, 40)}}}},
                     {"layers", {{{"model", cube()}, {"place", {{"distance", 3}}}}}}};
  const Planted grown = planted(json);
  EXPECT_GT(grown.layer(0).size(), 300U);
  for (const scene::Placement& placement : grown.layer(0))
    EXPECT_FALSE(std::abs(placement.at.x) < 20 && std::abs(placement.at.y) < 20);
}

TEST(SceneBuildings, StandOnTheLowestGroundBelowThem) {
  const Json json = {{"terrain",
                      {{"generator", "terrain"},
                       {"seed", 4},
                       {"parameters", {{"iterations", 4}, {"size", 200}, {"amplitude", 30}}}}},
                     {"buildings", {{{"name", "hut"}, {"footprint", square(20, 20, 12)}}}}};
  const Result<Model> model = scene_of(json);
  ASSERT_TRUE(model);
  const Planted grown = planted(json);
  double low = 1e9;
  for (const glm::dvec2& p : {glm::dvec2(20, 20), {32, 20}, {32, 32}, {20, 32}})
    low = std::min(low, grown.ground.height(p));
  EXPECT_NEAR(static_cast<double>(node_of(*model, "hut")->transform.translation.y), low, 1e-4);
}

TEST(SceneAreas, LieOnTheGroundWithTheirHoles) {
  Json json = town(Json::array());
  json["areas"] = {
      {{"name", "lake"}, {"outline", {square(0, 0, 30)[0], square(10, 10, 5)[0]}}, {"color", "#3f74a3"}},
      {{"name", "lake"}, {"outline", square(100, 0, 10)}, {"color", "#3f74a3"}}};
  const Result<Model> model = scene_of(json);
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  EXPECT_NEAR(measured(*model, "lake").area, 900 - 25 + 100, 1e-3);
}

TEST(SceneGeoreference, IsRepeatedInTheFile) {
  Json json = town(Json::array());
  json["georeference"] = {{"latitude", 48.1}, {"longitude", 11.5}};
  const Result<Model> model = scene_of(json);
  ASSERT_TRUE(model);
  EXPECT_THAT(model->extras, Contains(testing::Field(&Extra::json, R"({"latitude":48.1,"longitude":11.5})")));
}

}  // namespace
}  // namespace seedmesh
