/// The plain forms of plants and their texture.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

#include "core/generators/world/leaf_texture.h"
#include "core/generators/world/plant_mesh.h"
#include "core/texture/png.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

struct Vertex {
  glm::vec3 position, normal;
  glm::vec2 coordinates;
};

/// A file as a client decodes it.
struct Decoded {
  std::vector<Vertex> vertices;
  std::vector<std::uint16_t> indices;
};

Decoded decoded(const PlantFile& file) {
  Decoded out;
  for (std::uint32_t k = 0; k < file.vertices; ++k) {
    const char* from = file.bytes.data() + k * plant_vertex_bytes;
    Vertex vertex;
    std::int8_t normal[3];
    std::uint16_t coordinates[2];
    std::memcpy(&vertex.position, from, 12);
    std::memcpy(normal, from + 12, 3);
    std::memcpy(coordinates, from + 20, 4);
    vertex.normal = glm::vec3(normal[0], normal[1], normal[2]) / 127.0F;
    vertex.coordinates = glm::vec2(coordinates[0], coordinates[1]) / 65535.0F;
    out.vertices.push_back(vertex);
  }
  out.indices.resize(file.indices);
  std::memcpy(out.indices.data(), file.bytes.data() + file.vertices * plant_vertex_bytes, 2 * file.indices);
  return out;
}

class PlainPlant : public testing::TestWithParam<WorldForm> {
 protected:
  static World world() {
    WorldParams params;
    WorldClass plant;
    plant.class_name = "plant";
    plant.form = GetParam();
    plant.height = 10;
    params.plants = {plant};
    return world_of(params);
  }
};

TEST_P(PlainPlant, HasFewTriangles) {
  EXPECT_LT(plant_file(world(), 0, PlantForm::whole).indices / 3, 350U);
  EXPECT_LT(plant_file(world(), 0, PlantForm::simple).indices / 3, 60U);
}

TEST_P(PlainPlant, StaysWithinTheBoundsOfPlants) {
  const World own = world();
  const PlantExtent extent = plant_extent(10);
  constexpr double widest = 1.2 * 1.1 * 1.3;  // by level, by chance, and of the tallest plants
  for (const PlantForm form : {PlantForm::whole, PlantForm::simple}) {
    const double by = form == PlantForm::whole ? widest : widest * 1.45 / 1.2;
    for (const Vertex& v : decoded(plant_file(own, 0, form)).vertices) {
      EXPECT_LE(by * std::hypot(v.position.x, v.position.z), extent.across);
      EXPECT_GE(v.position.y, -deepest_root * 10);
    }
  }
}

TEST_P(PlainPlant, HasUnitNormalsBeforeItsClustersOfLeaves) {
  const Decoded plant = decoded(plant_file(world(), 0, PlantForm::whole));
  const auto is_in = [](const TextureCell& cell, const glm::vec2& at) {
    constexpr double near = 1e-4;
    return at.x >= cell.left - near && at.x <= cell.right + near && at.y >= cell.top - near &&
           at.y <= cell.bottom + near;
  };
  int clusters = 0;
  for (std::size_t k = 0; k < plant.indices.size(); k += 3) {
    const Vertex corners[] = {plant.vertices.at(plant.indices[k]), plant.vertices.at(plant.indices[k + 1]),
                              plant.vertices.at(plant.indices[k + 2])};
    const glm::vec3 face =
        glm::cross(corners[1].position - corners[0].position, corners[2].position - corners[0].position);
    ASSERT_GT(glm::length(face), 1e-5F) << "triangle " << k / 3;
    bool is_cluster = true, is_branch = true;
    for (const Vertex& corner : corners) {
      EXPECT_NEAR(glm::length(corner.normal), 1, 0.02);
      is_cluster &= is_in(leaf_cluster, corner.coordinates);
      is_branch &= is_in(conifer_branch, corner.coordinates);
    }
    if (!is_cluster && !is_branch) continue;
    ++clusters;
    for (const Vertex& corner : corners) EXPECT_GT(glm::dot(corner.normal, face), 0) << "triangle " << k / 3;
  }
  const bool has_clusters = GetParam() == WorldForm::conifer || GetParam() == WorldForm::broadleaf ||
                            GetParam() == WorldForm::shrub;
  EXPECT_EQ(clusters > 60, has_clusters);
}

INSTANTIATE_TEST_SUITE_P(Forms, PlainPlant,
                         testing::Values(WorldForm::conifer, WorldForm::broadleaf, WorldForm::palm,
                                         WorldForm::shrub, WorldForm::cactus, WorldForm::fungus));

class LeafTextureTest : public testing::Test {
 protected:
  void SetUp() override {
    Job job = test_job();
    const auto made = leaf_texture(world_of({}), job);
    size_ = made->file.size();
    const std::span<const char> file(made->file);
    auto picture = texture::decode_png(std::as_bytes(file), {}, job);
    ASSERT_TRUE(picture);
    ASSERT_EQ(picture->channels, 2);
    side_ = picture->width;
    for (std::size_t k = 0; k < std::size_t{side_} * side_; ++k) {
      grey_.push_back(picture->channel(2 * k) / 255.0);
      alpha_.push_back(picture->channel(2 * k + 1) / 255.0);
    }
  }

  /// The means of squares of texels, as in mipmaps.
  std::vector<double> halved(const std::vector<double>& values, std::size_t side) const {
    std::vector<double> out;
    for (std::size_t row = 0; row < side; row += 2) {
      for (std::size_t column = 0; column < side; column += 2) {
        const double* at = values.data() + row * side + column;
        out.push_back((at[0] + at[1] + at[side] + at[side + 1]) / 4);
      }
    }
    return out;
  }

  static double opaque_share(const std::vector<double>& alpha, std::size_t side, const TextureCell& cell) {
    double opaque = 0, all = 0;
    for (std::size_t row = 0; row < side; ++row) {
      for (std::size_t column = 0; column < side; ++column) {
        const double u = (static_cast<double>(column) + 0.5) / static_cast<double>(side),
                     v = (static_cast<double>(row) + 0.5) / static_cast<double>(side);
        if (u < cell.left || u > cell.right || v < cell.top || v > cell.bottom) continue;
        all += 1;
        opaque += alpha[row * side + column] >= 0.5 ? 1 : 0;
      }
    }
    return opaque / all;
  }

  std::size_t size_ = 0, side_ = 0;
  std::vector<double> grey_, alpha_;
};

TEST_F(LeafTextureTest, IsSmall) { EXPECT_LT(size_, 48'000U); }

TEST_F(LeafTextureTest, KeepsItsCoverageOverFiveMipLevels) {
  const double clusters = opaque_share(alpha_, side_, leaf_cluster),
               branches = opaque_share(alpha_, side_, conifer_branch);
  EXPECT_GT(clusters, 0.3);
  EXPECT_LT(clusters, 0.6);
  EXPECT_GT(branches, 0.25);
  EXPECT_LT(branches, 0.6);
  std::vector<double> alpha = alpha_;
  for (std::size_t side = side_; side > 8; side /= 2) {
    alpha = halved(alpha, side);
    EXPECT_NEAR(opaque_share(alpha, side / 2, leaf_cluster), clusters, 0.2) << "side " << side / 2;
    EXPECT_NEAR(opaque_share(alpha, side / 2, conifer_branch), branches, 0.2) << "side " << side / 2;
    EXPECT_EQ(opaque_share(alpha, side / 2, dense_leaves), 1);
  }
}

/// A filter reads texels up to half a texel of its mip level beyond a cell.
TEST_F(LeafTextureTest, HasCellsApartFromOpaqueNeighbours) {
  constexpr double widest_filter = 4;  // texels: level 3
  for (const TextureCell& cell : {leaf_cluster, conifer_branch, palm_leaf}) {
    const double by = widest_filter / static_cast<double>(side_);
    for (const auto& [u, v] :
         {std::pair{cell.left - by, cell.top - by}, {cell.right + by, cell.bottom + by}}) {
      EXPECT_GE(u, cell.left < 0.5 ? 0 : 0.5);
      EXPECT_LE(u, cell.left < 0.5 ? 0.5 : 1);
      EXPECT_GE(v, cell.top < 0.5 ? 0 : 0.5);
      EXPECT_LE(v, cell.top < 0.5 ? 0.5 : 1);
    }
  }
}

TEST_F(LeafTextureTest, HasTheStatedMean) {
  double light = 0, opaque = 0;
  for (std::size_t k = 0; k < grey_.size(); ++k) {
    const std::size_t row = k / side_;
    if (row >= side_ / 2 || alpha_[k] < 0.5) continue;  // the upper half has leaves
    const double g = grey_[k];
    light += g <= 0.04045 ? g / 12.92 : std::pow((g + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
    opaque += 1;
  }
  EXPECT_NEAR(light / opaque, leaf_texture_mean, 0.03);
}

}  // namespace
}  // namespace seedmesh::world
