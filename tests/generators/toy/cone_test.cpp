#include "tests/generators/toy/cone.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "core/geom/mesh/finish.h"
#include "core/schema/issue_list.h"
#include "core/schema/json.h"
#include "generated/params/cone.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::IsEmpty;

Model cone_of(std::uint64_t seed, const ConeParams& params = {}) {
  Job job(seed, Job::Options{});
  Result<Model> model = cone::generate(params, {job});
  EXPECT_TRUE(model);
  finish(*model, job);  // as the pipeline does
  return *std::move(model);
}

const Mesh& mesh_of(const Model& model) { return model.meshes[0].primitives[0].mesh; }

TEST(Cone, IsOneClosedMeshWithoutDefects) {
  for (int sides : {3, 4, 24, 1000}) {
    ConeParams params;
    params.sides = sides;
    const Model model = cone_of(1, params);
    EXPECT_THAT(faults(model), IsEmpty()) << sides;
    const MeshMeasures measures = measure({&mesh_of(model)});
    EXPECT_EQ(measures.open_edges, 0U);
    EXPECT_GT(measures.volume, 0) << "inside out";
  }
}

TEST(Cone, HasTheVolumeOfACone) {
  ConeParams params;
  params.height = 3;
  params.radius = 1;
  params.sides = 1000;
  EXPECT_NEAR(measure({&mesh_of(cone_of(0, params))}).volume, 3.14159, 0.0001);
}

TEST(Cone, MovesItsTipWithTheSeedOnly) {
  const auto tip = [](const Model& model) { return mesh_of(model).position[2]; };
  EXPECT_EQ(tip(cone_of(7)), tip(cone_of(7)));
  EXPECT_NE(tip(cone_of(7)), tip(cone_of(8)));
}

TEST(Cone, RefusesATipOutsideItsBase) {
  ConeParams params;
  params.radius = 1;
  params.lean = 1;
  Job job(0, Job::Options{});
  const Result<Model> model = cone::generate(params, {job});
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().issues.front().pointer, "/lean");
}

TEST(Cone, SpendsItsTrianglesBeforeItMakesThem) {
  Job::Options options;
  options.limits.triangles = 47;
  Job job(0, options);
  EXPECT_THROW((void)cone::generate(ConeParams{}, {job}), Stop);
}

TEST(Cone, IsReadByCodeGeneratedFromItsSchema) {
  const Result<Json> json = parse_json(R"({"height": -1, "colour": "red"})");
  ASSERT_TRUE(json);
  IssueList errors;
  read_cone(*json, "/parameters", errors);
  std::vector<std::string> pointers;
  for (const Issue& issue : errors.issues()) pointers.push_back(issue.pointer);
  EXPECT_THAT(pointers, testing::UnorderedElementsAre("/parameters/height", "/parameters/colour"));
}

/// The preset that docs/add-a-generator.md shows.
TEST(Cone, MakesItsPreset) {
  std::ifstream file(SEEDMESH_SOURCE_DIR "/tests/generators/toy/leaning.json");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const Result<Json> preset = parse_json(text);
  ASSERT_TRUE(preset);
  IssueList errors;
  const ConeParams params = read_cone(preset->at("parameters"), "/parameters", errors);
  ASSERT_TRUE(errors.empty());
  const Model model = cone_of(1, params);
  EXPECT_THAT(faults(model), IsEmpty());
  EXPECT_EQ(mesh_of(model).bounds.max.y, 2);
}

}  // namespace
}  // namespace seedmesh
