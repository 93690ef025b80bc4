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
  const LeafMaterials look = add_leaf_materials(model, params, {job, {}});
  return model.materials[static_cast<std::size_t>(look.material)];
}

TEST(Materials, CutLeavesOutOfAnImageWithAlpha) {
  const Material cut = leaf_with(with_alpha), whole = leaf_with(without_alpha);
  EXPECT_EQ(cut.alpha_mode, AlphaMode::mask);
  EXPECT_FALSE(cut.base_color_texture.repeat) << "the far edge would be seen at this one";
  EXPECT_FALSE(cut.double_sided) << "leaves have faces on both sides";
  EXPECT_EQ(whole.alpha_mode, AlphaMode::opaque);
}

TEST(Materials, NameTexturesAfterTheLeafWhenOnlyNormalsAreGiven) {
  TreeParams params;
  params.leaf.images.normal = without_alpha;
  Job job(0, Job::Options{});
  Model model;
  add_leaf_materials(model, params, {job, {}});
  ASSERT_EQ(model.textures.size(), 1U);
  EXPECT_EQ(model.textures[0]->name, "leaf_normal");
}

/// The materials of leaves in a mode of leaf.faces.
std::vector<Material> leaves_with(TreeLeafFaces faces, const Demand& demand) {
  TreeParams params;
  params.leaf.leaf_faces = faces;
  Job job(0, Job::Options{});
  Model model;
  const LeafMaterials made = add_leaf_materials(model, params, {job, demand});
  std::vector<Material> materials;
  for (const int each : made.variants) materials.push_back(model.materials[static_cast<std::size_t>(each)]);
  return materials;
}

TEST(Materials, ShowLeavesFromBothSidesUnlessTheirFacesAreOutward) {
  const Demand core, engine{.two_sided_leaves = true}, shared{.share_organs = true};
  const auto is_two_sided = [](TreeLeafFaces faces, const Demand& demand) {
    return leaves_with(faces, demand).front().double_sided;
  };
  EXPECT_FALSE(is_two_sided(TreeLeafFaces::auto_, core));
  EXPECT_TRUE(is_two_sided(TreeLeafFaces::auto_, engine));
  EXPECT_TRUE(is_two_sided(TreeLeafFaces::auto_, shared));
  EXPECT_FALSE(is_two_sided(TreeLeafFaces::outward, engine));
  EXPECT_TRUE(is_two_sided(TreeLeafFaces::outward, shared))
      << "copies of one mesh cannot have normals of their own";
  EXPECT_TRUE(is_two_sided(TreeLeafFaces::two_sided, core));
}

/// R + T + A = 1: no colour channel lets more through than reaches it. The bounds are those of fresh leaves in
/// the PROSPECT model.
TEST(Materials, LetLightThroughLeaves) {
  for (const Material& leaf : leaves_with(TreeLeafFaces::auto_, {})) {
    EXPECT_GE(leaf.transmission, 0.2F);
    EXPECT_LE(leaf.transmission, 0.5F);
    EXPECT_GE(leaf.specular, 0.3F);
    EXPECT_LE(leaf.specular, 0.5F);
    for (int i = 0; i < 3; ++i) EXPECT_LE(leaf.transmission_color[i] * leaf.base_color[i], 0.9F);
    EXPECT_LT(leaf.transmission_color.z, leaf.transmission_color.y) << "light that passes is more yellow";
  }
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
