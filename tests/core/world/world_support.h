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

}  // namespace seedmesh::world
