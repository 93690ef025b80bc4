/// The texture of the ground that repeats.
#include <gtest/gtest.h>

#include <cmath>

#include "core/generators/terrain/terrain.h"
#include "core/texture/ground.h"
#include "core/texture/paint.h"
#include "generated/params/terrain.h"
#include "tests/support/context.h"

namespace seedmesh::terrain {
namespace {

Model model_of(const TerrainParams& params, const Demand& demand = {}) {
  Job job(3, Job::Options{});
  Result<Model> model = generate(params, context_of(job, demand));
  EXPECT_TRUE(model);
  return std::move(*model);
}

TerrainParams small_land() {
  TerrainParams params;
  params.iterations = 5;
  params.detail = true;
  return params;
}

TEST(Detail, RepeatsOnThePlaneInTheSecondSetOfCoordinates) {
  const Model model = model_of(small_land());
  const Mesh& mesh = model.meshes.at(0).primitives.at(0).mesh;
  ASSERT_EQ(mesh.uv[1].size(), mesh.position.size());
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    ASSERT_NEAR(mesh.uv[1][i].x * texture::ground_tile, mesh.position[i].x, 1e-3);
    ASSERT_NEAR(mesh.uv[1][i].y * texture::ground_tile, mesh.position[i].z, 1e-3);
  }
}

TEST(Detail, ShowsTheGroundOfThePalette) {
  TerrainParams params = small_land();
  for (const auto& [palette, kind] :
       {std::pair(TerrainPalette::alpine, "soil_ground"), std::pair(TerrainPalette::desert, "sand_ground"),
        std::pair(TerrainPalette::arctic, "snow_ground"),
        std::pair(TerrainPalette::volcanic, "rock_ground")}) {
    params.palette = palette;
    Model model = model_of(params);
    EXPECT_EQ(model.materials.at(0).recipe.kind, kind);
    Job job(3, Job::Options{});
    texture::paint(model, 64, {}, nullptr, job);
    EXPECT_EQ(model.materials[0].base_color_texture.uv_set, 1);
    EXPECT_EQ(model.materials[0].normal_texture.uv_set, 1);
    EXPECT_GE(model.materials[0].base_color_texture.texture, 0);
  }
}

TEST(Detail, IsAbsentWithoutTexturesAndWithATextureOfTheWholeField) {
  TerrainParams params = small_land();
  EXPECT_TRUE(model_of(params, {.textures = 0}).meshes.at(0).primitives.at(0).mesh.uv[1].empty());
  params.texture = 64;
  EXPECT_TRUE(model_of(params).meshes.at(0).primitives.at(0).mesh.uv[1].empty());
}

/// The albedo of fresh snow is at most 0.9.
TEST(Detail, NoGroundIsBrighterThanSnow) {
  TerrainParams params = small_land();
  params.detail = false;
  for (const TerrainPalette palette :
       {TerrainPalette::alpine, TerrainPalette::arctic, TerrainPalette::moon}) {
    params.palette = palette;
    const Model model = model_of(params);
    const Mesh& mesh = model.meshes.at(0).primitives.at(0).mesh;
    for (const glm::u8vec4& color : mesh.color) ASSERT_LE(std::max({color.r, color.g, color.b}), 230);
  }
}

}  // namespace
}  // namespace seedmesh::terrain
