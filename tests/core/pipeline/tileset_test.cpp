/// Files of 3D Tiles 1.1, checked against the text of the specification (OGC 22-025r4, "Implicit tiling").
#include "core/pipeline/tileset.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace seedmesh::tiles {
namespace {

using nlohmann::json;
using testing::ElementsAre;

constexpr double extent = 1'024;

/// Boxes of a level have equal heights, so that each tile can be computed again here.
Bounds bounds_of(const Address& at) {
  const double width = extent / std::exp2(at.level);
  Bounds b;
  b.west = static_cast<double>(at.x) * width - extent / 2;
  b.south = static_cast<double>(at.y) * width - extent / 2;
  b.east = b.west + width;
  b.north = b.south + width;
  b.low = -1.5 / (1 + at.level);
  b.high = 3.3 / (1 + at.level);
  b.geometric_error = at.level == 9 ? 0 : width / 128;
  return b;
}

json chunk_of(const std::string& file) {
  std::uint64_t size = 0;
  std::memcpy(&size, file.data() + 8, sizeof size);
  return json::parse(file.substr(24, size));
}

std::string bytes_of(const std::string& file) {
  std::uint64_t size = 0;
  std::memcpy(&size, file.data() + 8, sizeof size);
  return file.substr(24 + size);
}

/// The Morton index of a tile within its level: bits of x at even positions, bits of y at odd ones.
std::uint32_t morton(std::uint32_t x, std::uint32_t y) {
  std::uint32_t bits = 0;
  for (std::uint32_t k = 0; k < 16; ++k) bits |= (x >> k & 1U) << (2 * k) | (y >> k & 1U) << (2 * k + 1);
  return bits;
}

TEST(Subtree, HasAllTilesOfItsLevels) {
  EXPECT_EQ(tiles_of(5), 341U);
  for (const int level : {0, 5, 10}) {
    const std::string file = subtree({level, 0, 0}, 15, bounds_of);
    EXPECT_EQ(file.substr(0, 4), "subt");
    EXPECT_EQ(file.substr(4, 4), std::string("\1\0\0\0", 4));
    const json chunk = chunk_of(file);
    EXPECT_EQ(chunk["tileAvailability"]["constant"], 1);
    EXPECT_EQ(chunk["contentAvailability"], json::parse(R"([{"constant":1}])"));
    EXPECT_EQ(chunk["childSubtreeAvailability"]["constant"], level == 10 ? 0 : 1);
  }
}

TEST(Subtree, SetsTheBitsOfItsLevelsAlone) {
  const std::string file = subtree({5, 3, 4}, 7, bounds_of);  // two of five levels
  const json chunk = chunk_of(file);
  EXPECT_EQ(chunk["tileAvailability"]["availableCount"], 5);
  EXPECT_EQ(chunk["childSubtreeAvailability"]["constant"], 0);
  const json& view = chunk["bufferViews"][chunk["tileAvailability"]["bitstream"].get<std::size_t>()];
  EXPECT_EQ(view["byteLength"], 43);  // 341 bits
  const std::string bits = bytes_of(file).substr(view["byteOffset"].get<std::size_t>(), 43);
  EXPECT_EQ(bits[0], '\x1f');
  EXPECT_EQ(bits.substr(1), std::string(42, '\0'));
  EXPECT_EQ(bytes_of(file).size() % 8, 0U);
}

TEST(Subtree, ListsBoxesAndErrorsByRisingBit) {
  const Address root{5, 7, 30};
  const std::string file = subtree(root, 10, bounds_of);
  const json chunk = chunk_of(file);
  const json& table = chunk["propertyTables"][chunk["tileMetadata"].get<std::size_t>()];
  EXPECT_EQ(table["count"], 341);
  const std::string bytes = bytes_of(file);
  const auto value = [&](const char* name, std::size_t number) {
    const json& view = chunk["bufferViews"][table["properties"][name]["values"].get<std::size_t>()];
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 8, 0U);
    double read = 0;
    std::memcpy(&read, bytes.data() + view["byteOffset"].get<std::size_t>() + 8 * number, sizeof read);
    return read;
  };
  std::uint32_t first = 0;
  for (int down = 0; down < 5; ++down) {
    for (std::uint32_t x = 0; x < 1U << down; ++x) {
      for (std::uint32_t y = 0; y < 1U << down; ++y) {
        const Bounds own = bounds_of({5 + down, (root.x << down) + x, (root.y << down) + y});
        const std::size_t row = first + morton(x, y);
        EXPECT_EQ(value("box", 12 * row), (own.west + own.east) / 2);
        EXPECT_EQ(value("box", 12 * row + 1), (own.south + own.north) / 2);
        EXPECT_EQ(value("box", 12 * row + 3), (own.east - own.west) / 2);
        EXPECT_LE(value("box", 12 * row + 2) - value("box", 12 * row + 11), own.low);
        EXPECT_GE(value("box", 12 * row + 2) + value("box", 12 * row + 11), own.high);
        EXPECT_EQ(value("error", row), own.geometric_error);
      }
    }
    first += 1U << (2 * down);
  }
}

/// Tiles of an explicit tileset: all of its levels, and the links below.
struct Count {
  int tiles = 0, links = 0;
};

void visit(const json& tile, const Address& at, const std::string& prefix, Count& count) {
  const std::string number =
      std::to_string(at.level) + "/" + std::to_string(at.x) + "/" + std::to_string(at.y);
  const std::string uri = tile["content"]["uri"];
  const bool is_link = uri.ends_with(".json");
  EXPECT_EQ(uri, prefix + (is_link ? "e/" + number + ".json" : "c/" + number + ".glb"));
  const Bounds own = bounds_of(at);
  EXPECT_EQ(tile["geometricError"], own.geometric_error);
  EXPECT_EQ(tile["boundingVolume"]["box"][0], (own.west + own.east) / 2);
  ++(is_link ? count.links : count.tiles);
  if (!tile.contains("children")) return;
  EXPECT_FALSE(is_link);
  std::int64_t k = 0;
  for (const json& child : tile["children"]) {
    visit(child, {at.level + 1, 2 * at.x + k % 2, 2 * at.y + k / 2}, prefix, count);
    ++k;
  }
  EXPECT_EQ(k, 4);
}

TEST(ExplicitTileset, HasFourLevelsAndLinksBelow) {
  const json file = json::parse(explicit_tileset({0, 0, 0}, {"../t/", 10}, bounds_of));
  EXPECT_EQ(file["asset"], json::parse(R"({"version":"1.1"})"));
  EXPECT_EQ(file["root"]["refine"], "REPLACE");
  EXPECT_GE(file["geometricError"].get<double>(), file["root"]["geometricError"].get<double>());
  Count count;
  visit(file["root"], {0, 0, 0}, "../t/", count);
  EXPECT_EQ(count.tiles, 85);
  EXPECT_EQ(count.links, 256);
}

TEST(ExplicitTileset, EndsWithTheWorld) {
  const json file = json::parse(explicit_tileset({8, 255, 3}, {"../../../", 10}, bounds_of));
  Count count;
  visit(file["root"], {8, 255, 3}, "../../../", count);
  EXPECT_EQ(count.tiles, 5);
  EXPECT_EQ(count.links, 0);
}

TEST(ExplicitTileset, RepeatsBoxAndErrorOfTheTileThatPointsToIt) {
  const json above = json::parse(explicit_tileset({0, 0, 0}, {"", 10}, bounds_of));
  const json below = json::parse(explicit_tileset({4, 1, 1}, {"", 10}, bounds_of));
  const json& link = above["root"]["children"][0]["children"][0]["children"][0]["children"][3];
  EXPECT_EQ(link["content"]["uri"], "e/4/1/1.json");
  EXPECT_EQ(link["boundingVolume"], below["root"]["boundingVolume"]);
  EXPECT_EQ(link["geometricError"], below["root"]["geometricError"]);
}

TEST(ExplicitTileset, OfAPartLeavesOutTheOtherTiles) {
  Naming naming{"", 7};
  naming.first_content = 2;
  naming.has_tile = [](const Address& at) { return at.x == 0; };
  const json file = json::parse(explicit_tileset({0, 0, 0}, naming, bounds_of));
  EXPECT_FALSE(file["root"].contains("content"));
  ASSERT_EQ(file["root"]["children"].size(), 2U);
  const json& north = file["root"]["children"][1];
  EXPECT_FALSE(north.contains("content"));
  EXPECT_EQ(north["children"][0]["content"]["uri"], "c/2/0/2.glb");
  const json end = json::parse(explicit_tileset({4, 0, 0}, naming, bounds_of));
  const json& leaf = end["root"]["children"][0]["children"][1];
  EXPECT_EQ(leaf["content"]["uri"], "c/6/0/1.glb");
  EXPECT_FALSE(leaf.contains("children"));
}

TEST(ImplicitTileset, HalvesToTheSquaresOfTheTiles) {
  const json file = json::parse(implicit_tileset(extent, 8, {"../t/", 10}, bounds_of));
  const json& root = file["root"];
  EXPECT_THAT(root["implicitTiling"]["subdivisionScheme"], "QUADTREE");
  EXPECT_EQ(root["implicitTiling"]["availableLevels"], 10);
  EXPECT_EQ(root["implicitTiling"]["subtreeLevels"], 5);
  EXPECT_EQ(root["implicitTiling"]["subtrees"]["uri"], "../t/s/{level}/{x}/{y}.subtree");
  EXPECT_EQ(root["content"]["uri"], "../t/c/{level}/{x}/{y}.glb");
  EXPECT_EQ(root["boundingVolume"]["box"][0], 0);
  EXPECT_EQ(root["boundingVolume"]["box"][3], extent / 2);
  EXPECT_EQ(root["boundingVolume"]["box"][7], extent / 2);
  for (const char* absent : {"children", "metadata", "contents", "transform"})
    EXPECT_FALSE(root.contains(absent)) << absent;
  std::vector<std::string> semantics;
  for (const json& property : file["schema"]["classes"]["tile"]["properties"])
    semantics.push_back(property["semantic"]);
  EXPECT_THAT(semantics, ElementsAre("TILE_BOUNDING_BOX", "TILE_GEOMETRIC_ERROR"));
}

}  // namespace
}  // namespace seedmesh::tiles
