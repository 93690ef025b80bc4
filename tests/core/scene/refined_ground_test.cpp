/// Scenes on refined ground, and rules by class of ground.
#include <algorithm>
#include <cmath>

#include "tests/core/scene/support.h"

namespace seedmesh {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Json refined_hills() {
  return {{"generator", "terrain"},
          {"seed", 4},
          {"parameters",
           {{"iterations", 6},
            {"size", 200},
            {"amplitude", 30},
            {"hurst", 0.9},
            {"refine", {{"center", {10, -20}}, {"radius", 15}, {"step", 0.4}}}}}};
}

/// Level grass in the west, a slope of 63 degrees of rock in the east.
Json meadow_below_a_cliff() {
  return {
      {"generator", "terrain"},
      {"parameters",
       {{"algorithm", "expression"}, {"expression", "max(0, 2 * x)"}, {"size", 100}, {"resolution", 65}}}};
}

/// The height of the first triangle of a model that covers a position, seen from above.
double mesh_height(const Model& model, const glm::dvec2& at) {
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) {
      const Mesh& mesh = primitive.mesh;
      for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
        const glm::dvec3 a = mesh.position[mesh.index.at(i)], b = mesh.position[mesh.index.at(i + 1)],
                         c = mesh.position[mesh.index.at(i + 2)];
        const double whole = (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
        const double u = ((at.x - a.x) * (c.z - a.z) - (at.y - a.z) * (c.x - a.x)) / whole,
                     v = ((b.x - a.x) * (at.y - a.z) - (b.z - a.z) * (at.x - a.x)) / whole;
        if (u >= 0 && v >= 0 && u + v <= 1) return a.y + u * (b.y - a.y) + v * (c.y - a.y);
      }
    }
  }
  return 1e9;
}

Json layer(const Json& place) {
  return {{"name", "a"}, {"model", cube()}, {"variants", 1}, {"place", place}};
}

TEST(RefinedGround, CarriesModelsOnItsSurface) {
  const Json json = {{"terrain", refined_hills()},
                     {"layers", {layer({{"method", "scatter"}, {"count", 400}})}}};
  const Generator::Params params = read_scene_params(json);
  const Planted made = planted(json);
  Job job = job_of(1);
  const Result<Model> ground = made.ground.model(own(params), context_of(job));
  ASSERT_TRUE(ground);
  int near = 0;
  for (const scene::Placement& placement : made.layer(0)) {
    const double distance = glm::length(placement.at - glm::dvec2(10, -20));
    const double off = std::abs(made.ground.height(placement.at) - mesh_height(*ground, placement.at));
    // Between the corners of triangles of 0.4 m, the surface bends by centimetres.
    EXPECT_LE(off, distance < 15 ? 0.12 : distance < 60 + 5 ? 0.6 : 1e-4) << distance;
    near += distance < 15 ? 1 : 0;
  }
  EXPECT_GE(near, 3);
}

TEST(RefinedGround, DiffersFromTheGridBelowTheModels) {
  Json plain = refined_hills();
  plain["parameters"].erase("refine");
  const Planted with = planted({{"terrain", refined_hills()}, {"layers", Json::array()}}),
                without = planted({{"terrain", plain}, {"layers", Json::array()}});
  double most = 0;
  for (int i = -10; i <= 10; ++i) {
    const glm::dvec2 p(10 + i, -20 + 0.3 * i);
    most = std::max(most, std::abs(with.ground.height(p) - without.ground.height(p)));
  }
  EXPECT_GT(most, 0.1);
  EXPECT_EQ(with.ground.height({-90, 80}), without.ground.height({-90, 80}));
}

TEST(RefinedGround, IsRefusedBelowPathsAndFoundations) {
  const Json path = {{"points", {{-9, 0}, {9, 9}}}, {"width", 1}};
  const char* const message = "/terrain/parameters/refine: paths, buildings and foundations";
  EXPECT_THAT(scene_errors({{"terrain", refined_hills()}, {"paths", {path}}}), Contains(HasSubstr(message)));
  Json house = layer({{"method", "scatter"}, {"count", 1}});
  house["footprint"] = 2;
  house["foundation"] = Json::object();
  EXPECT_THAT(scene_errors({{"terrain", refined_hills()}, {"layers", {house}}}),
              Contains(HasSubstr(message)));
  EXPECT_THAT(scene_errors({{"terrain", meadow_below_a_cliff()}, {"paths", {path}}}),
              Not(Contains(HasSubstr(message))));
}

TEST(GroundRule, PlacesModelsOnTheirClassAlone) {
  for (const bool on_rock : {false, true}) {
    const Json place = {{"method", "poisson"}, {"distance", 3}, {"ground", {on_rock ? "rock" : "grass"}}};
    const Planted made = planted({{"terrain", meadow_below_a_cliff()}, {"layers", {layer(place)}}});
    EXPECT_GT(made.layer(0).size(), 100U);
    for (const scene::Placement& placement : made.layer(0)) {
      if (on_rock) {
        EXPECT_GT(placement.at.x, -3);
      } else {
        EXPECT_LT(placement.at.x, 3);
      }
    }
  }
}

TEST(GroundRule, NeedsATerrainAndAPattern) {
  const Json rule = {"grass"};
  EXPECT_THAT(scene_errors({{"layers", {layer({{"method", "poisson"}, {"distance", 3}, {"ground", rule}})}}}),
              Contains(HasSubstr("/layers/0/place/ground: there are no classes of ground")));
  const Json positions = {{{"at", {0, 0}}}};
  EXPECT_THAT(
      scene_errors(
          {{"terrain", meadow_below_a_cliff()},
           {"layers", {layer({{"method", "positions"}, {"positions", positions}, {"ground", rule}})}}}),
      Contains(HasSubstr("/layers/0/place/ground: has no effect with the method positions")));
}

}  // namespace
}  // namespace seedmesh
