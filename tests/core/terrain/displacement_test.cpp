#include "core/generators/terrain/displacement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/generators/child.h"
#include "core/geom/mesh/finish.h"
#include "core/registry/registry.h"
#include "tests/core/terrain/support.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::terrain {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// As the pipeline does it, requests inside included.
Result<Model> made(const std::string& parameters, int threads = 1) {
  IssueList faults;
  const Generator* generator = find_generator("terrain");
  const Generator::Params params = read_parameters(*generator, Json::parse(parameters), "",
                                                   {Job(0, Job::Options{}), generators()}, faults);
  if (!faults.empty()) return Error{Code::invalid, faults.take()};
  Job job = any_job(threads);
  Result<Model> model = generator->generate(params, context_of(job));
  if (model) finish(*model, job);
  return model;
}

std::string onto(const std::string& element, const std::string& more, int rounds = 0) {
  return R"({"algorithm": "fbm", "resolution": 65, "size": 0.7, "amplitude": 0.04, "onto": {"model": {"generator": "fractal", "parameters": {"element": ")" +
         element + R"(", "iterations": )" + std::to_string(rounds) + "}}" + more + "}}";
}

MeshMeasures measured(const Model& model) {
  std::vector<const Mesh*> meshes;
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& each : group.primitives) meshes.push_back(&each.mesh);
  }
  return measure(meshes);
}

TEST(MirroredHeight, IsTheFieldAtItsSamplesAndIsMirroredOutside) {
  const Field field = field_from(5, 3, [](int x, int z) { return 10 * x + z; });
  EXPECT_DOUBLE_EQ(mirrored_height(field, 3, 1), 31);
  EXPECT_DOUBLE_EQ(mirrored_height(field, 2.5, 0.5), 25.5);
  EXPECT_DOUBLE_EQ(mirrored_height(field, 5, 0), 30);  // one beyond the edge is one before it
  EXPECT_DOUBLE_EQ(mirrored_height(field, -1, 0), 10);
  EXPECT_DOUBLE_EQ(mirrored_height(field, 8 + 1, 4 + 1), 11);  // after both periods
}

TEST(Displacement, KeepsASurfaceClosedAndCutsEachTriangleIntoFour) {
  for (const char* element : {"cube", "sphere", "pyramid"}) {
    const Result<Model> plain = made(onto(element, "")), fine = made(onto(element, R"(, "subdivide": 3)"));
    ASSERT_TRUE(plain && fine) << element;
    EXPECT_EQ(measured(*fine).triangles, 64 * measured(*plain).triangles) << element;
    EXPECT_EQ(measured(*fine).open_edges, 0U) << element;
    EXPECT_THAT(faults(*fine), IsEmpty()) << element;
  }
}

TEST(Displacement, LiftsASurfaceByTheHeightOfAFlatField) {
  const std::string flat =
      R"({"algorithm": "fbm", "resolution": 9, "size": 1, "normalise": {"low": 0.1, "high": 0.1}, "onto": {"model": {"generator": "fractal", "parameters": {"element": "sphere", "iterations": 0}}}})";
  const Result<Model> model = made(flat);
  ASSERT_TRUE(model);
  const Box box = bounds_of(*model);
  EXPECT_NEAR(box.max.y, 0.6, 1e-3);
  EXPECT_NEAR(box.min.y, -0.6, 1e-3);
}

TEST(Displacement, KeepsNormalsOnTheSideOfTheirFacesForAnyField) {
  for (const char* amplitude : {"0.3", "2"}) {
    const std::string wild = R"({"algorithm": "fbm", "resolution": 129, "size": 0.7, "amplitude": )" +
                             std::string(amplitude) +
                             R"(, "onto": {"model": {"generator": "fractal", "parameters": {"element": )" +
                             R"("cube", "iterations": 0}}, "subdivide": 5}})";
    const Result<Model> model = made(wild);
    ASSERT_TRUE(model);
    for (const MeshGroup& group : model->meshes) {
      for (const Primitive& each : group.primitives) {
        const Mesh& mesh = each.mesh;
        std::size_t inward = 0;
        for (std::size_t i = 0; i < mesh.index.size(); ++i) {
          const std::size_t first = i / 3 * 3;
          const glm::vec3 a = mesh.position[mesh.index.at(first)];
          const glm::vec3 face = glm::cross(mesh.position[mesh.index.at(first + 1)] - a,
                                            mesh.position[mesh.index.at(first + 2)] - a);
          inward += glm::dot(face, mesh.normal[mesh.index.at(i)]) < 0 ? 1U : 0U;
        }
        EXPECT_EQ(inward, 0U) << amplitude;
      }
    }
    EXPECT_EQ(measured(*model).open_edges, 0U);
  }
}

TEST(NormalMap, AddsATextureAndKeepsTheSurface) {
  const Result<Model> model = made(onto("cube", R"(, "mapping": "normal_map")", 1));
  ASSERT_TRUE(model);
  ASSERT_EQ(model->textures.size(), 1U);
  const Primitive& cube = model->meshes[0].primitives[0];
  EXPECT_EQ(cube.mesh.uv[1].size(), cube.mesh.position.size());
  const Material& material = model->materials.at(static_cast<std::size_t>(cube.material));
  EXPECT_EQ(material.normal_texture.texture, 0);
  EXPECT_EQ(material.normal_texture.uv_set, 1);
  EXPECT_THAT(faults(*model), IsEmpty());
  const Box box = bounds_of(*model);
  EXPECT_FLOAT_EQ(box.max.x, 0.5F);
}

TEST(Onto, IsTheSameOnAnyNumberOfThreads) {
  const std::string request = onto("sphere", R"(, "subdivide": 3)");
  const Result<Model> one = made(request), eight = made(request, 8);
  ASSERT_TRUE(one && eight);
  const Mesh &a = one->meshes[0].primitives[0].mesh, &b = eight->meshes[0].primitives[0].mesh;
  EXPECT_TRUE(std::equal(a.position.begin(), a.position.end(), b.position.begin(), b.position.end()));
  EXPECT_TRUE(std::equal(a.normal.begin(), a.normal.end(), b.normal.begin(), b.normal.end()));
}

TEST(Onto, RefusesOptionsOfAGround) {
  const auto refusal = [](const std::string& more) {
    const Result<Model> model = made(
        R"({"algorithm": "fbm", "onto": {"model": {"generator": "fractal"}, "mapping": "normal_map", "subdivide": 1}, )" +
        more + "}");
    std::string text;
    if (!model) {
      for (const Issue& issue : model.error().issues) text += issue.pointer + ": " + issue.message + "\n";
    }
    return text;
  };
  const std::string text = refusal(R"("skirt": 3, "water_level": 1, "mesh": "greedy")");
  EXPECT_THAT(text, HasSubstr("/skirt: "));
  EXPECT_THAT(text, HasSubstr("/water_level: "));
  EXPECT_THAT(text, HasSubstr("/mesh: "));
  EXPECT_THAT(text, HasSubstr("/onto/subdivide: "));
}

TEST(Onto, PointsIntoTheModelThatCannotBeMade) {
  const Result<Model> model = made(
      R"({"algorithm": "fbm", "onto": {"model": {"generator": "fractal", "parameters": {"iterations": 2000}}}})");
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().issues.front().pointer, StartsWith("/onto/model/parameters"));
}

}  // namespace
}  // namespace seedmesh::terrain
