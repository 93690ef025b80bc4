/// The look of the ground: its textures, their coordinates, and small plants and stones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/generators/world/ground_cover.h"
#include "core/generators/world/ground_texture.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/terrain_indices.h"
#include "core/texture/png.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

/// IEC 61966-2-1.
double linear_of(double g) { return g <= 0.04045 ? g / 12.92 : std::pow((g + 0.055) / 1.055, 2.4); }

/// The light of the texels of a texture: luminance, linear and as sRGB bytes.
struct Light {
  std::size_t side = 0;
  std::vector<double> linear, bytes;
};

Light light_of(GroundKind kind) {
  Job job = test_job();
  const auto made = ground_texture(world_of({}), kind, job);
  const std::vector<char> file(made->file.begin(), made->file.end());
  const auto picture = texture::decode_png(std::as_bytes(std::span(file)), {}, job);
  Light light;
  light.side = picture->width;
  EXPECT_EQ(picture->channels, 3);
  for (std::size_t k = 0; k < light.side * light.side; ++k) {
    const auto channel = [&](std::size_t n) { return picture->channel(3 * k + n); };
    light.linear.push_back(0.2126 * linear_of(channel(0) / 255.0) + 0.7152 * linear_of(channel(1) / 255.0) +
                           0.0722 * linear_of(channel(2) / 255.0));
    light.bytes.push_back(0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2));
  }
  return light;
}

double mean_of(const std::vector<double>& list) {
  double sum = 0;
  for (const double each : list) sum += each;
  return sum / static_cast<double>(list.size());
}

double deviation_of(const std::vector<double>& list) {
  const double mean = mean_of(list);
  double sum = 0;
  for (const double each : list) sum += (each - mean) * (each - mean);
  return std::sqrt(sum / static_cast<double>(list.size()));
}

/// The means of squares of 8 x 8 texels, as a camera farther away sees them.
std::vector<double> from_afar(const Light& light) {
  std::vector<double> means;
  for (std::size_t row = 0; row < light.side; row += 8) {
    for (std::size_t column = 0; column < light.side; column += 8) {
      double sum = 0;
      for (std::size_t k = 0; k < 64; ++k) sum += light.bytes[(row + k / 8) * light.side + column + k % 8];
      means.push_back(sum / 64);
    }
  }
  return means;
}

TEST(WorldGroundTextures, HaveTheStatedMeans) {
  for (std::size_t k = 0; k < ground_kinds; ++k) {
    const auto kind = static_cast<GroundKind>(k);
    EXPECT_NEAR(mean_of(light_of(kind).linear), mean_of(kind), 0.03) << k;
  }
}

TEST(WorldGroundTextures, HaveContrastNearAndFar) {
  for (const GroundKind kind : {GroundKind::grass, GroundKind::soil, GroundKind::rock, GroundKind::land}) {
    const Light light = light_of(kind);
    EXPECT_GT(deviation_of(light.bytes), 15) << static_cast<int>(kind);
    EXPECT_GT(deviation_of(from_afar(light)), 7) << static_cast<int>(kind);
  }
}

/// The step from the last column to the first is no greater than steps between others.
TEST(WorldGroundTextures, Repeat) {
  for (std::size_t k = 0; k < ground_kinds; ++k) {
    const Light light = light_of(static_cast<GroundKind>(k));
    const auto step = [&](std::size_t from) {
      double sum = 0;
      for (std::size_t row = 0; row < light.side; ++row) {
        sum += std::abs(light.bytes[row * light.side + (from + 1) % light.side] -
                        light.bytes[row * light.side + from]);
      }
      return sum / static_cast<double>(light.side);
    };
    double most = 0;
    for (std::size_t column = 0; column + 1 < light.side; ++column) most = std::max(most, step(column));
    EXPECT_LE(step(light.side - 1), 1.1 * most) << k;
  }
}

/// Vertices on opposite borders have coordinates that differ by whole repeats, so that tiles meet.
TEST(WorldGroundTextures, HaveCoordinatesThatMeetAtBorders) {
  Job job = test_job();
  const auto shared = terrain_file(world_of({}), job);
  for (const auto& [part, count] : {std::pair{shared->coordinates, 33}, {shared->dense_coordinates, 65}}) {
    const auto at = [&, &from = part](int column, int row) {
      std::array<float, 2> uv{};
      std::memcpy(uv.data(),
                  shared->file.data() + from.offset + 8 * static_cast<std::size_t>(row * count + column), 8);
      return uv;
    };
    const int last = count - 1;
    for (int k = 0; k <= last; ++k) {
      for (std::size_t n = 0; n < 2; ++n) {
        const double east = at(last, k)[n] - at(0, k)[n], north = at(k, last)[n] - at(k, 0)[n];
        EXPECT_NEAR(east, std::round(east), 2e-6) << k;
        EXPECT_NEAR(north, std::round(north), 2e-6) << k;
      }
    }
  }
}

double luminance_of(const std::array<std::uint8_t, 4>& color) {
  return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

/// Beer 1852: light falls with depth. Foam at the shore is left out by a spacing that does not show it.
TEST(WorldSea, IsDarkerWhereItIsDeeper) {
  const World world = world_of(mountains_with_woods());
  const GroundColors colors(world);
  double before = 255;
  for (const double depth : {0.0, 3.0, 8.0, 30.0, 120.0}) {
    double mean = 0;
    for (int k = 0; k < 100; ++k)
      mean += luminance_of(sea_color(world, colors, depth, {733.0 * k, 1291.0 * k}, 64)) / 100;
    EXPECT_LT(mean, before) << depth;
    before = mean;
  }
}

class GroundCoverTest : public testing::Test {
 protected:
  static constexpr TileKey key{14, 8361, 8119};
  /// Feet of the pieces of a tile: east, height, south of the middle of the tile.
  static std::vector<std::array<float, 3>> feet_of(const std::string& glb) {
    const GlbParts parts = parts_of(glb);
    std::vector<std::array<float, 3>> feet;
    for (const Json& node : parts.json["nodes"]) {
      if (!node["name"].get<std::string>().starts_with("terrain_")) continue;
      const Json& copies = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
      const Json& accessor = parts.json["accessors"][copies["TRANSLATION"].get<int>()];
      const Json& view = parts.json["bufferViews"][accessor["bufferView"].get<int>()];
      const std::size_t first = feet.size(), count = accessor["count"];
      feet.resize(first + count);
      std::memcpy(feet[first].data(), parts.bytes.data() + view.value("byteOffset", 0), 12 * count);
    }
    return feet;
  }
};

TEST_F(GroundCoverTest, StandsOnTheTrianglesOfLeafTiles) {
  WorldParams params = mountains_with_woods();
  const World world = world_of(params);
  Job job = test_job();
  const std::string glb = tile_glb(world, key, job);
  const Terrain terrain = terrain_of(glb);
  const GlbParts parts = parts_of(glb);
  const double middle_east = parts.json["nodes"][0]["translation"][0],
               middle_north = -parts.json["nodes"][0]["translation"][2].get<double>();
  const auto feet = feet_of(glb);
  ASSERT_GT(feet.size(), 60U);
  EXPECT_LT(feet.size(), 500U);
  for (const auto& foot : feet) {
    const double east = middle_east + static_cast<double>(foot[0]),
                 north = middle_north - static_cast<double>(foot[2]);
    const double west = std::floor(east / 2) * 2, south = std::floor(north / 2) * 2;
    const double u = (east - west) / 2, v = (north - south) / 2;
    const auto height = [&](double x, double y) { return terrain.at({west + x, south + y}).top; };
    // barycentric coordinates in the triangle on this side of the diagonal
    const double ground = u > v ? (1 - u) * height(0, 0) + (u - v) * height(2, 0) + v * height(2, 2)
                                : (1 - v) * height(0, 0) + (v - u) * height(0, 2) + u * height(2, 2);
    EXPECT_NEAR(static_cast<double>(foot[1]), ground, 0.01);
  }
}

TEST_F(GroundCoverTest, IsOnLeavesWithPlantsOnly) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  EXPECT_TRUE(feet_of(tile_glb(world, {13, key.x / 2, key.y / 2}, job)).empty());
  WorldParams bare = mountains_with_woods();
  bare.layers = {WorldLayersItem::terrain};
  EXPECT_TRUE(feet_of(tile_glb(world_of(bare), key, job)).empty());
}

/// Tiles with several kinds of ground have indices of their own, and pieces add to their bytes. Clients load twenty and more
/// leaves at eye level.
TEST_F(GroundCoverTest, KeepsLeavesSmall) {
  const World world = world_of(mountains_with_woods());
  Job job = test_job();
  std::vector<std::size_t> bytes;
  for (int k = 0; k < 49; ++k)
    bytes.push_back(tile_glb(world, {14, key.x + 3 * (k % 7), key.y + 3 * (k / 7)}, job).size());
  std::sort(bytes.begin(), bytes.end());
  EXPECT_LE(bytes[24], 40'000U);
  EXPECT_LE(bytes[48], 60'000U);
}

/// Shared files of all pieces have the bounds that boxes of tiles include, at the greatest size of 2.
TEST_F(GroundCoverTest, StaysWithinItsBounds) {
  const CoverFile made = cover_file(world_of(mountains_with_woods()));
  EXPECT_LE(2 * made.file.high[1], cover_height);
  EXPECT_GE(2 * made.file.low[1], -cover_depth);
  for (const int axis : {0, 2}) {
    EXPECT_LE(2 * made.file.high[axis], 1);
    EXPECT_GE(2 * made.file.low[axis], -1);
  }
}

}  // namespace
}  // namespace seedmesh::world
