#include "core/model/row.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

Model plant(const Job& job, float width, std::uint64_t texture_seed, const char* season) {
  Model model;
  model.name = "plant";
  Material& bark = model.materials.emplace_back();
  bark.name = "bark";
  bark.recipe = {"oak_bark", texture_seed, {}};
  model.variants = {season};
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  for (const float x : {-width, width}) mesh.position.push_back({x, 0, 0});
  mesh.position.push_back({0, 1, 0});
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const std::uint32_t i : {0U, 1U, 2U}) mesh.index.wide.push_back(i);
  model.meshes.push_back({"leaf", {}});
  model.meshes[0].primitives.push_back({std::move(mesh), 0, {0}});
  model.nodes.emplace_back().mesh = 0;
  model.extras.push_back({"seed", std::to_string(texture_seed)});
  model.warnings.push_back({"/axiom", "it is short", 0, 0});
  return model;
}

TEST(Row, StandsModelsBesideEachOther) {
  const Job job(1, Job::Options{});
  std::vector<Model> models;
  for (int i = 0; i < 3; ++i)
    models.push_back(plant(job, static_cast<float>(1 + i), static_cast<std::uint64_t>(i), "summer"));
  const Model row = row_of(std::move(models));
  ASSERT_EQ(row.nodes.size(), 6U);
  EXPECT_EQ(row.nodes[0].transform.translation.x, 0);
  const float gap = 0.2F * 6;
  EXPECT_FLOAT_EQ(row.nodes[2].transform.translation.x, 1 + gap + 2);
  EXPECT_FLOAT_EQ(row.nodes[4].transform.translation.x, 1 + gap + 4 + gap + 3);
  EXPECT_EQ(row.nodes[4].extras[0].json, "2");
}

TEST(Row, SharesMaterialsAndGivesAWarningOnce) {
  const Job job(1, Job::Options{});
  std::vector<Model> models;
  models.push_back(plant(job, 1, 4, "summer"));
  models.push_back(plant(job, 1, 5, "summer"));
  const Model row = row_of(std::move(models));
  ASSERT_EQ(row.materials.size(), 1U);
  EXPECT_EQ(row.materials[0].recipe.seed, 4U);
  EXPECT_EQ(row.meshes[1].primitives[0].material, 0);
  EXPECT_EQ(row.warnings.size(), 1U);
}

TEST(Row, KeepsMaterialsThatLookDifferent) {
  const Job job(1, Job::Options{});
  std::vector<Model> models;
  models.push_back(plant(job, 1, 4, "summer"));
  models.push_back(plant(job, 1, 4, "summer"));
  models[1].materials[0].base_color = {1, 0, 0, 1};
  EXPECT_EQ(row_of(std::move(models)).materials.size(), 2U);
}

TEST(Row, JoinsVariantsByName) {
  const Job job(1, Job::Options{});
  std::vector<Model> models;
  models.push_back(plant(job, 1, 4, "summer"));
  models.push_back(plant(job, 1, 4, "winter"));
  const Model row = row_of(std::move(models));
  EXPECT_EQ(row.variants, (std::vector<std::string>{"summer", "winter"}));
  EXPECT_EQ(row.meshes[0].primitives[0].variant_materials.size(), 2U);
}

TEST(Row, SharesEqualImages) {
  const Job job(1, Job::Options{});
  std::vector<Model> models;
  for (int i = 0; i < 2; ++i) {
    models.push_back(plant(job, 1, 4, "summer"));
    auto image = std::make_shared<Image>();
    image->bytes = {1, 2, 3};
    models.back().textures.push_back(std::move(image));
    models.back().materials[0].base_color_texture.texture = 0;
  }
  const Model row = row_of(std::move(models));
  EXPECT_EQ(row.textures.size(), 1U);
  EXPECT_EQ(row.materials.size(), 1U);
}

}  // namespace
}  // namespace seedmesh
