/// Tiles of one terrain in quantized files have equal borders, read as clients do: in doubles, nodes applied.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using nlohmann::json;

constexpr int side = 64, samples = 33;

std::string glb_of(int x, const std::string& profile) {
  const std::string text =
      R"({"generator":"terrain","seed":11,"parameters":{"algorithm":"fbm","noise":"ridged","resolution":33,)"
      R"("size":64,"amplitude":120,"skirt":4,"tile":{"x":)" +
      std::to_string(x) + R"(,"z":-3}},"output":{"profile":")" + profile + R"("}})";
  const Result<Request> request = read_request(text, Limits{});
  EXPECT_TRUE(request) << request.error().issues.front().message;
  const Result<Product> product = produce(*request, {});
  EXPECT_TRUE(product);
  return product->payload.text();
}

json document_of(const std::string& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, sizeof size);
  return json::parse(glb.substr(20, size));
}

/// Heights by their number along a border, from north to south, the highest where a skirt hangs below.
using Border = std::map<double, double>;

/// The vertices of a file with x = `at`.
Border border_of(const std::string& glb, double at) {
  const json document = document_of(glb);
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, sizeof size);
  const std::size_t bin = 20 + size + 8;
  Border border;
  for (const json& node : document["nodes"]) {
    if (!node.contains("mesh")) continue;
    for (const json& primitive : document["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
      const json& row = document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
      EXPECT_EQ(row["componentType"], 5123);
      const json& view = document["bufferViews"][row["bufferView"].get<std::size_t>()];
      const std::size_t stride = view["byteStride"];
      std::size_t from =
          bin + view.value("byteOffset", std::size_t{0}) + row.value("byteOffset", std::size_t{0});
      for (std::size_t i = 0; i < row["count"]; ++i, from += stride) {
        std::array<std::uint16_t, 3> steps{};
        std::memcpy(steps.data(), glb.data() + from, sizeof steps);
        std::array<double, 3> p{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          p[axis] = node["translation"][axis].get<double>() + node["scale"][axis].get<double>() * steps[axis];
        if (p[0] != at) continue;
        const auto [known, is_new] = border.emplace(p[2], p[1]);
        if (!is_new) known->second = std::max(known->second, p[1]);
      }
    }
  }
  return border;
}

TEST(TerrainTiles, MeetToTheBitWithoutADecoder) {
  constexpr int tiles = 12;
  std::set<double> relief;
  std::string west = glb_of(0, "tiles");
  for (int x = 1; x < tiles; ++x) {
    const std::string east = glb_of(x, "tiles");
    const Border left = border_of(west, side / 2), right = border_of(east, -side / 2);
    EXPECT_EQ(left.size(), samples) << x;
    EXPECT_EQ(left, right) << "tiles " << x - 1 << " and " << x;
    for (const auto& [z, height] : left) relief.insert(height);
    west = east;
  }
  // Otherwise the extents of the tiles would have chosen equal steps by themselves.
  EXPECT_GT(*relief.rbegin() - *relief.begin(), side);
}

TEST(TerrainTiles, HaveOneStepInCompressedFiles) {
  std::set<double> steps;
  for (int x = 0; x < 12; ++x) {
    const json document = document_of(glb_of(x, "web"));
    for (const json& node : document["nodes"]) {
      if (!node.contains("scale")) continue;
      const auto step = node["scale"][0].get<double>();
      steps.insert(step);
      for (const json& number : node["translation"]) {
        const double count = number.get<double>() / step;
        EXPECT_EQ(count, std::round(count)) << "the origin of the grid is a multiple of its step";
      }
    }
  }
  EXPECT_EQ(steps.size(), 1U);
}

}  // namespace
}  // namespace seedmesh
