/// Convex bodies of L-systems, for physics engines.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "core/generators/limb_bodies/limb_bodies.h"
#include "tests/core/lsystem/support.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::lsystem {
namespace {

using ::testing::IsEmpty;

Model made(const LsystemParams& params, CollisionNames names) {
  Job job = job_of(1);
  GenerateContext context = context_of(job);
  context.demand.collision = names;
  Result<Model> model = generate(params, context);
  EXPECT_TRUE(model);
  return model ? std::move(*model) : Model{};
}

std::vector<const Mesh*> bodies(const Model& model, const std::string& prefix) {
  std::vector<const Mesh*> found;
  for (const Node& node : model.nodes) {
    if (node.name.starts_with(prefix))
      found.push_back(&model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].mesh);
  }
  return found;
}

TEST(LsystemCollision, EnclosesTheTrunkAndThickLimbs) {
  LsystemParams params = grammar_of("!(0.4)FF[+(60)!(0.2)F][-(60)!(0.1)F]", {}, 0);
  const Model model = made(params, CollisionNames::plain);
  const std::vector<const Mesh*> found = bodies(model, "collision_");
  ASSERT_EQ(found.size(), 2U) << "the limb of a quarter of the width has none";
  for (const Mesh* body : found) {
    EXPECT_TRUE(faults(*body).empty());
    const MeshMeasures measures = measure({body});
    EXPECT_EQ(measures.open_edges, 0U);
    EXPECT_GT(measures.volume, 0);
  }
  // A prism with eight sides of radius 0.2 m over 2 m: 4 sqrt(2) r^2 / 2 * h.
  EXPECT_NEAR(measure({found[0]}).volume, 2 * std::sqrt(2.0) * 0.2 * 0.2 * 2, 1e-4);
  EXPECT_THAT(model.warnings, IsEmpty());
}

TEST(LsystemCollision, IsNamedForEachEngine) {
  const LsystemParams params = grammar_of("!(0.2)F", {}, 0);
  EXPECT_EQ(bodies(made(params, CollisionNames::unreal), "UCX_bark_01").size(), 1U);
  EXPECT_EQ(bodies(made(params, CollisionNames::godot), "collision_01-convcolonly").size(), 1U);
  EXPECT_EQ(bodies(made(params, CollisionNames::none), "collision").size(), 0U);
}

TEST(LsystemCollision, WarnsOfLinesWhichHaveNoThickness) {
  LsystemParams params = grammar_of("F", {}, 0);
  params.style = LsystemParams::Style::lines;
  const Model model = made(params, CollisionNames::plain);
  EXPECT_TRUE(bodies(model, "collision").empty());
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_EQ(model.warnings[0].pointer, "/output/collision");
}

}  // namespace
}  // namespace seedmesh::lsystem
