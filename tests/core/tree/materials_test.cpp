#include "core/generators/tree/materials.h"

#include <gtest/gtest.h>

#include "core/generators/tree/tree.h"

namespace seedmesh::tree {
namespace {

constexpr const char* with_alpha =
    "data:image/"
    "png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGMwOmHDAAADnQE3dmMj8wAAAABJRU5ErkJggg==";
constexpr const char* without_alpha =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGMwOmEDAAJmATdXu5wqAAAAAElFTkSuQmCC";

Material leaf_with(const char* picture) {
  TreeParams params;
  params.leaf.images.color = picture;
  Job job(0, Job::Options{});
  Model model;
  const LeafMaterials look = add_leaf_materials(model, params, job);
  return model.materials[static_cast<std::size_t>(look.material)];
}

TEST(Materials, CutLeavesOutOfAnImageWithAlpha) {
  const Material cut = leaf_with(with_alpha), whole = leaf_with(without_alpha);
  EXPECT_EQ(cut.alpha_mode, AlphaMode::mask);
  EXPECT_FALSE(cut.base_color_texture.repeat) << "the far edge would be seen at this one";
  EXPECT_TRUE(cut.double_sided);
  EXPECT_EQ(whole.alpha_mode, AlphaMode::opaque);
}

TEST(Materials, NameTexturesAfterTheLeafWhenOnlyNormalsAreGiven) {
  TreeParams params;
  params.leaf.images.normal = without_alpha;
  Job job(0, Job::Options{});
  Model model;
  add_leaf_materials(model, params, job);
  ASSERT_EQ(model.textures.size(), 1U);
  EXPECT_EQ(model.textures[0]->name, "leaf_normal");
}

TEST(Materials, ReportThatLeavesOfOneMeshDoNotMoveInTheWind) {
  TreeParams params;
  params.Levels = 2;
  for (const bool shares : {false, true}) {
    Job job(0, Job::Options{});
    const Result<Model> model = generate(params, {job, {.share_organs = shares, .wind = true}});
    ASSERT_TRUE(model);
    ASSERT_EQ(model->warnings.size(), shares ? 1U : 0U);
    for (const Warning& warning : model->warnings) EXPECT_EQ(warning.pointer, "/output/wind");
  }
}

}  // namespace
}  // namespace seedmesh::tree
