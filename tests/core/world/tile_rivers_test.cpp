/// The water and the beds of rivers in tiles of all levels, against the lines of the map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "core/generators/world/river_mesh.h"
#include "tests/core/world/world_support.h"

namespace seedmesh::world {
namespace {

using Triangle = std::array<glm::dvec3, 3>;  ///< east, north, up

WorldParams wet_land() {
  WorldParams params;
  params.relief.sea = false;
  params.relief.land = 1;
  params.relief.mountains = 900;
  params.water.rivers = 0.9;
  params.water.width = 30;
  params.settlements.density = 0;
  return params;
}

/// A point of a river of the map, which is no end of it.
struct MapPoint {
  double east = 0, north = 0, water = 0, width = 0;
};

std::vector<MapPoint> points_of(const Json& rivers) {
  std::vector<MapPoint> points;
  for (const Json& river : rivers) {
    const Json &line = river["points"], &widths = river["widths"];
    for (std::size_t k = 2; k + 2 < line.size(); k += 7)
      points.push_back({line[k][0], line[k][1], line[k][2], widths[k]});
  }
  return points;
}

/// The triangles of the water of a tile, with all nodes applied.
std::vector<Triangle> water_of_tile(const std::string& glb) {
  const GlbParts parts = parts_of(glb);
  const Json &nodes = parts.json["nodes"], &accessors = parts.json["accessors"],
             &views = parts.json["bufferViews"];
  std::vector<Triangle> found;
  for (const Json& node : nodes) {
    if (node["name"] != "water") continue;
    const Json& primitive = parts.json["meshes"][node["mesh"].get<int>()]["primitives"][0];
    const Json &positions = accessors[primitive["attributes"]["POSITION"].get<int>()],
               &order = accessors[primitive["indices"].get<int>()];
    const char* const vertices =
        parts.bytes.data() + views[positions["bufferView"].get<int>()].value("byteOffset", 0);
    const char* const corners =
        parts.bytes.data() + views[order["bufferView"].get<int>()].value("byteOffset", 0);
    const bool is_wide = order["componentType"] == 5125;
    const double step = node["scale"][0], height = node["translation"][1];
    const auto corner = [&](int n) {
      std::uint32_t wide = 0;
      std::uint16_t narrow = 0;
      if (is_wide) std::memcpy(&wide, corners + 4 * n, 4);
      if (!is_wide) std::memcpy(&narrow, corners + 2 * n, 2);
      std::int16_t p[3];
      std::memcpy(p, vertices + 16 * (is_wide ? wide : narrow), sizeof p);
      return glm::dvec3(nodes[0]["translation"][0].get<double>() + step * p[0],
                        -(nodes[0]["translation"][2].get<double>() + step * p[2]), height + step * p[1]);
    };
    for (int n = 0; n + 2 < order["count"].get<int>(); n += 3)
      found.push_back({corner(n), corner(n + 1), corner(n + 2)});
  }
  return found;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The distance in plan from a triangle, 0 inside.
double distance_from(const Triangle& t, const glm::dvec2& p) {
  double least = 1e12;
  int left = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 a(t[k]), b(t[(k + 1) % 3]), along = b - a;
    left += cross(along, p - a) >= 0 ? 1 : -1;
    const double square = glm::dot(along, along);
    const double share = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
    least = std::min(least, glm::length(p - a - share * along));
  }
  return std::abs(left) == 3 ? 0 : least;
}

double height_in(const Triangle& t, const glm::dvec2& p) {
  const glm::dvec2 a(t[0]), b = glm::dvec2(t[1]) - a, c = glm::dvec2(t[2]) - a;
  const double area = cross(b, c);
  if (area == 0) return t[0].z;
  const double u = cross(p - a, c) / area, v = cross(b, p - a) / area;
  return t[0].z + u * (t[1].z - t[0].z) + v * (t[2].z - t[0].z);
}

/// The height of the triangles of a tile.
double ground_in(const Terrain& terrain, const TileFrame& frame, const World& world, const MapPoint& p) {
  const double west = frame.west - static_cast<double>(world.east),
               south = frame.south - static_cast<double>(world.north);
  const double i = std::floor((p.east - west) / frame.spacing),
               j = std::floor((p.north - south) / frame.spacing);
  const double x = west + i * frame.spacing, y = south + j * frame.spacing;
  const double u = (p.east - x) / frame.spacing, v = (p.north - y) / frame.spacing;
  const auto top = [&](double e, double n) { return terrain.at({e, n}).top; };
  const double sw = top(x, y), ne = top(x + frame.spacing, y + frame.spacing);
  const double corner = u >= v ? top(x + frame.spacing, y) : top(x, y + frame.spacing);
  return u >= v ? sw + u * (corner - sw) + v * (ne - corner) : sw + u * (ne - corner) + v * (corner - sw);
}

struct Found {
  int seen = 0, resolved = 0;
};

void look_at_point(const World& world, const MapPoint& p, int level, Job& job, Found& found) {
  const double side = world.extent / std::ldexp(1, level);
  const auto tile = [&](double at) {
    return static_cast<std::int64_t>(std::floor((at + world.extent / 2) / side));
  };
  const TileKey key{level, tile(p.east), tile(p.north)};
  const TileFrame frame = frame_of(world, key);
  if (p.width < frame.spacing / 48) return;  // half as wide as the least that tiles show
  const std::string glb = tile_glb(world, key, job);
  const glm::dvec2 at(p.east, p.north);
  double away = 1e12, water = -1e12;
  for (const Triangle& t : water_of_tile(glb)) {
    const double here = distance_from(t, at);
    if (here == 0) water = std::max(water, height_in(t, at));
    away = std::min(away, here);
  }
  ++found.seen;
  const std::string where =
      std::to_string(level) + ": " + std::to_string(p.east) + ", " + std::to_string(p.north);
  EXPECT_LE(away, 0.1 * frame.spacing + 2 * frame.step) << "no water at a river of the map, level " << where;
  const double ground = ground_in(terrain_of(glb), frame, world, p);
  if (p.width < 3 * frame.spacing || away > 0) return;
  ++found.resolved;
  const double lift = std::min(2.0, 0.02 * frame.spacing), rounding = 2 * frame.step + 1.0 / 64;
  EXPECT_NEAR(water, p.water, lift + rounding + 0.05 * frame.spacing) << "level " << where;
  EXPECT_LT(ground, water) << "the bed is not below the water, level " << where;
}

/// Rivers of a square of 65 km, at a point of each second kilometre or so.
TEST(WorldRivers, LieInTilesOfEachLevelWhereTheMapHasThem) {
  const World world = world_of(wet_land());
  Job job = test_job();
  const Json map = map_json(world, {-32768, -32768, 32768, 32768}, MapHeights::none, job);
  const std::vector<MapPoint> points = points_of(map["rivers"]);
  ASSERT_GT(points.size(), 300U);
  for (int level = 4; level < world.levels; ++level) {
    Found found;
    const std::size_t stride = std::max<std::size_t>(1, points.size() / 40);
    for (std::size_t k = 0; k < points.size(); k += stride)
      look_at_point(world, points[k], level, job, found);
    if (level > 6) {
      EXPECT_GT(found.seen, 10) << "level " << level;
    }
    if (level > 11) {
      EXPECT_GE(found.resolved, 5) << "level " << level;
    }
  }
}

}  // namespace
}  // namespace seedmesh::world
