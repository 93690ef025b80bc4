#pragma once
/// Worlds for tests, and a reader of the terrain in tiles that decodes as a client does.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/generators/world/tile_frame.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {

inline WorldParams mountains_with_woods() {
  WorldParams params;
  params.relief.mountains = 1600;
  params.relief.gullies = 0.8;
  params.relief.land = 0.75;
  params.water.rivers = 0.8;
  WorldClass oak;
  oak.class_name = "oak";
  oak.moisture = {0, 1};
  oak.temperature = {-20, 40};
  oak.density = 0.8;
  params.plants = {oak};
  return params;
}

inline World world_of(const WorldParams& params, std::uint64_t seed = 7) {
  const Result<World> world = read_world(params, seed);
  EXPECT_TRUE(world);
  return *world;
}

inline Job test_job() { return Job(0, Job::Options{}); }

struct GlbParts {
  Json json;
  std::string bytes;
};
inline GlbParts parts_of(const std::string& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return {Json::parse(glb.substr(20, size)), glb.substr(28 + size)};
}

/// A border vertex and, if it has a skirt, how far that hangs down.
struct TerrainVertex {
  double top = -1e12, low = 1e12;
  std::array<int, 3> normal{};
};
using Terrain = std::map<std::pair<double, double>, TerrainVertex>;  ///< by east and north

/// Vertices by their position in plan, with all nodes applied, relative to the middle of the world.
inline Terrain terrain_of(const std::string& glb) {
  const GlbParts parts = parts_of(glb);
  const Json& nodes = parts.json["nodes"];
  Terrain terrain;
  for (const Json& node : nodes) {
    if (node["name"] != "terrain") continue;
    const double step = node["scale"][0], height = node["translation"][1];
    const Json& attributes = parts.json["meshes"][node["mesh"].get<int>()]["primitives"][0]["attributes"];
    const Json& accessor = parts.json["accessors"][attributes["POSITION"].get<int>()];
    const Json& view = parts.json["bufferViews"][accessor["bufferView"].get<int>()];
    const char* from = parts.bytes.data() + view.value("byteOffset", 0);
    for (int k = 0; k < accessor["count"].get<int>(); ++k) {
      std::int16_t p[3];
      std::int8_t n[3];
      std::memcpy(p, from + 16 * k, 6);
      std::memcpy(n, from + 16 * k + 8, 3);
      const double east = nodes[0]["translation"][0].get<double>() + step * p[0];
      const double north = -(nodes[0]["translation"][2].get<double>() + step * p[2]);
      TerrainVertex& vertex = terrain[{east, north}];
      const double up = height + step * p[1];
      if (up > vertex.top) vertex.normal = {n[0], n[1], n[2]};
      vertex.top = std::max(vertex.top, up);
      vertex.low = std::min(vertex.low, up);
    }
  }
  return terrain;
}

/// The least and the greatest coordinates of all vertices, instances included: east, north, up.
struct ContentBox {
  std::array<double, 3> low{1e12, 1e12, 1e12}, high{-1e12, -1e12, -1e12};
  void add(double x, double y, double z) {
    const double place[3] = {x, -z, y};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], place[k]);
      high[k] = std::max(high[k], place[k]);
    }
  }
};
inline ContentBox content_of(const std::string& glb) {
  const GlbParts parts = parts_of(glb);
  const Json &nodes = parts.json["nodes"], &accessors = parts.json["accessors"];
  const auto values = [&](int accessor) {
    const Json& view = parts.json["bufferViews"][accessors[accessor]["bufferView"].get<int>()];
    std::vector<float> found(accessors[accessor]["count"].get<std::size_t>() * 3);
    std::memcpy(found.data(), parts.bytes.data() + view.value("byteOffset", 0), found.size() * sizeof(float));
    return found;
  };
  ContentBox box;
  for (const Json& node : nodes) {
    if (!node.contains("mesh")) continue;
    for (const Json& primitive : parts.json["meshes"][node["mesh"].get<int>()]["primitives"]) {
      const Json& p = accessors[primitive["attributes"]["POSITION"].get<int>()];
      std::vector<float> at(3, 0.0F), size(3, 1.0F);
      if (node.contains("extensions")) {
        const Json& copies = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        at = values(copies["TRANSLATION"].get<int>());
        size = values(copies["SCALE"].get<int>());
      }
      const std::vector<double> one{1, 1, 1}, zero{0, 0, 0};
      const auto scale = node.value("scale", one), move = node.value("translation", zero);
      const auto root = nodes[0].value("translation", zero);
      for (std::size_t n = 0; n < at.size(); n += 3) {
        for (const char* end : {"min", "max"}) {
          std::array<double, 3> q{};
          for (std::size_t k = 0; k < 3; ++k)
            q[k] = p[end][k].get<double>() * scale[k] * size[n + k] + at[n + k] + move[k] + root[k];
          box.add(q[0], q[1], q[2]);
        }
      }
    }
  }
  return box;
}

}  // namespace seedmesh::world
