#include <algorithm>
#include <cmath>

#include "core/generators/world/canopy.h"
#include "core/generators/world/flat_mesh.h"
#include "core/generators/world/glb.h"
#include "core/generators/world/ground_cover.h"
#include "core/generators/world/ground_texture.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/lanes.h"
#include "core/generators/world/leaf_texture.h"
#include "core/generators/world/openings.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/plant_layer.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/terrain_indices.h"
#include "core/generators/world/terrain_mesh.h"
#include "core/generators/world/tile_frame.h"
#include "core/generators/world/town.h"
#include "core/generators/world/water_mesh.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

constexpr double widest_road_spacing = 16;

void add_mesh(Glb& glb, const Surface& surface, const TileMesh& mesh, const TileFrame& frame, double base,
              Job& job) {
  if (mesh.indices.empty()) return;
  job.spend(Resource::triangles, mesh.indices.size() / 3);
  glb.add_mesh(surface.name, mesh, glb.add_material(surface.name, surface.roughness), frame.step, base);
}

/// The kinds of ground of the triangles of a terrain: that of two corners, or else of the first. If one is by far the most
/// frequent, all have it, since indices of their own make a tile larger.
std::vector<GroundKind> kinds_of(const TerrainMesh& terrain, const std::vector<std::uint16_t>& corners,
                                 bool has_one_kind) {
  constexpr double most_share = 0.66, least_share = 0.02;
  std::vector<GroundKind> kinds;
  std::array<std::size_t, ground_kinds> counts{};
  const auto number = [](GroundKind kind) { return static_cast<std::size_t>(kind); };
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const GroundKind a = terrain.kinds[corners[k]], b = terrain.kinds[corners[k + 1]],
                     c = terrain.kinds[corners[k + 2]];
    kinds.push_back(b == c ? b : a);
    ++counts[number(kinds.back())];
  }
  const auto first = std::max_element(counts.begin(), counts.end());
  const double all = static_cast<double>(kinds.size());
  const double least =
      has_one_kind || static_cast<double>(*first) > most_share * all ? all : least_share * all;
  for (GroundKind& kind : kinds) {
    if (static_cast<double>(counts[number(kind)]) < least)
      kind = static_cast<GroundKind>(first - counts.begin());
  }
  return kinds;
}

int add_ground_material(Glb& glb, const World& world, GroundKind kind, Job& job) {
  const auto [name, roughness] = ground_surface;
  return glb.add_material(name, roughness, shared_files + ground_texture(world, kind, job)->hash + ".png");
}

/// Whether a leaf tile has houses. Its ground then has one kind, because houses and the triangles of two kinds take more
/// than 40 KB.
bool has_houses(const World& world, const TileFrame& frame, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  return world.has(Layer::buildings) && !houses_near(world, box, 0, job).empty();
}

void add_terrain(Glb& glb, const World& world, const TileFrame& frame, const TerrainMesh& terrain,
                 bool is_leaf, Job& job) {
  const auto shared = terrain_file(world, job);
  const int buffer = glb.add_shared_buffer(shared->hash + ".bin", shared->file.size());
  const bool is_dense = frame.cells == dense_cells;
  const FilePart& indices = is_dense ? shared->dense_indices : shared->indices;
  job.spend(Resource::triangles, indices.count / 3);
  Glb::Parts parts;
  if (frame.spacing <= widest_textured_spacing) {
    const FilePart& coordinates = is_dense ? shared->dense_coordinates : shared->coordinates;
    parts.coordinates = glb.add_shared_coordinates(buffer, coordinates.offset, coordinates.count);
  }
  const auto add_all = [&](int material) {
    parts.parts.push_back({glb.add_shared_indices(buffer, indices.offset, indices.count), material});
  };
  if (frame.spacing > widest_textured_spacing) {
    add_all(glb.add_material(ground_surface.name, ground_surface.roughness));
  } else if (frame.spacing > widest_kind_spacing) {
    add_all(add_ground_material(glb, world, GroundKind::land, job));
  } else {
    const std::vector<std::uint16_t> corners = terrain_indices(frame.cells + 1);
    const std::vector<GroundKind> kinds =
        kinds_of(terrain, corners, is_leaf && has_houses(world, frame, job));
    for (std::size_t k = 0; k < ground_kinds; ++k) {
      const auto kind = static_cast<GroundKind>(k);
      const auto count = static_cast<std::size_t>(std::count(kinds.begin(), kinds.end(), kind));
      if (count == 0) continue;
      if (count == kinds.size()) {
        add_all(add_ground_material(glb, world, kind, job));
        break;
      }
      std::vector<std::uint32_t> own;
      own.reserve(3 * count);
      for (std::size_t t = 0; t < kinds.size(); ++t) {
        if (kinds[t] == kind) own.insert(own.end(), {corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]});
      }
      parts.parts.push_back(
          {glb.add_indices(own, terrain.vertices.size()), add_ground_material(glb, world, kind, job)});
    }
  }
  glb.add_mesh("terrain", terrain.vertices, parts, frame.step, terrain.height);
}

/// Whether a piece of a road can have a part in a rectangle.
bool is_near(const Rectangle& box, const RoadPoint& a, const RoadPoint& b, double width) {
  return std::min(a.east, b.east) <= box.east + width && std::max(a.east, b.east) >= box.west - width &&
         std::min(a.north, b.north) <= box.north + width && std::max(a.north, b.north) >= box.south - width;
}

/// The points of a street that passes its ends by half its width, which closes the corners between streets.
std::vector<RoadPoint> extended(const Lane& street) {
  std::vector<RoadPoint> points = street.points;
  const auto move = [&street](RoadPoint& end, const RoadPoint& before, double share) {
    const double x = end.east - before.east, y = end.north - before.north;
    const double by = share * street.width / std::max(0.01, std::sqrt(x * x + y * y));
    end.east += by * x;
    end.north += by * y;
  };
  constexpr double start_share = 0.5, end_share = 0.3;  ///< ribbons pass their end by a fifth
  move(points.front(), street.points[1], start_share);
  move(points.back(), street.points[points.size() - 2], end_share);
  return points;
}

/// The paved squares of towns, which lie on the ground.
void add_squares(FlatMesh& roads, const World& world, const Rectangle& box, const TerrainGrid& grid,
                 Job& job) {
  for (const auto& site : sites_near(world, box, greatest_radius(world), job)) {
    const auto town = town_of(world, *site, job);
    if (!town->has_square || !town->is_built()) continue;
    std::vector<FlatMesh::Point> corners;
    for (const auto& [east, north] : square_of(*town)) corners.emplace_back(east, north, 0);
    roads.add_draped(std::move(corners), grid, 0.08 + 0.01 * grid.spacing);
  }
}

/// Roads and houses of small tiles.
void add_works(Glb& glb, const World& world, const TileFrame& frame, const TileGround& ground, Job& job) {
  const double base = ground.base;
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  if (frame.spacing <= widest_road_spacing && world.has(Layer::roads)) {
    FlatMesh roads(frame, base, linear_color(world.params.roads.color));
    const double lift = 0.1 + 0.03 * frame.spacing;
    const auto add = [&](const std::vector<RoadPoint>& points, double width, double above) {
      for (std::size_t k = 1; k < points.size(); ++k) {
        const RoadPoint &a = points[k - 1], &b = points[k];
        if (!is_near(box, a, b, width)) continue;
        roads.add_ribbon({a.east, a.north, a.height + above}, width, {b.east, b.north, b.height + above},
                         width);
      }
    };
    for (const auto& road : roads_near(world, box, world.params.roads.width, job))
      add(road->points, road->width, lift);
    add_squares(roads, world, box, ground.grid, job);
    for (const auto& lanes : lanes_near(world, box, world.params.roads.width, job)) {
      for (const Lane& lane : lanes->lanes)
        add(lane.is_street ? extended(lane) : lane.points, lane.width, 0.9 * lift);
    }
    add_mesh(glb, {"roads", 0.95}, roads.take(), frame, base, job);
  }
  if (world.has(Layer::buildings)) add_houses(glb, world, frame, base, job);
}

}  // namespace

std::string tile_glb(const World& world, const TileKey& key, Job& job) {
  const TileFrame frame = frame_of(world, key);
  Glb glb({frame.middle_east - static_cast<double>(world.east), 0.0,
           0.0 - (frame.middle_north - static_cast<double>(world.north))});
  const TerrainGrid grid = sample_grid(world, frame, frame.cells, 1, job);
  const TerrainMesh terrain = terrain_mesh(world, frame, grid, skirt_depth(world, key.level, grid));
  const bool is_leaf = key.level == world.levels - 1;
  if (world.has(Layer::terrain)) add_terrain(glb, world, frame, terrain, is_leaf, job);
  if (world.has(Layer::water)) {
    const WaterMesh water = water_of(world, frame, {grid, terrain.height}, job);
    add_mesh(glb, water_surface, water.mesh, frame, terrain.height, job);
  }
  add_works(glb, world, frame, {grid, terrain.height}, job);
  if (world.has(Layer::plants)) add_plants(glb, world, key, {grid, terrain.height}, job);
  if (is_leaf && has_ground_cover(world)) add_ground_cover(glb, world, frame, grid, terrain, job);
  return std::move(glb).text();
}

namespace {

SharedFile binary(std::string bytes) { return {std::move(bytes), "application/octet-stream", "bin"}; }

}  // namespace

std::optional<SharedFile> shared_file(const World& world, std::string_view hash, Job& job) {
  if (world.has(Layer::terrain)) {
    const auto terrain = terrain_file(world, job);
    if (terrain->hash == hash) return binary(terrain->file);
    for (std::size_t k = 0; k < ground_kinds; ++k) {
      const auto texture = ground_texture(world, static_cast<GroundKind>(k), job);
      if (texture->hash == hash) return SharedFile{texture->file, "image/png", "png"};
    }
  }
  for (std::size_t k = 0; world.has(Layer::plants) && k < world.params.plants.size(); ++k) {
    const int number = static_cast<int>(k);
    for (const PlantForm form : {PlantForm::whole, PlantForm::simple}) {
      PlantFile file = plant_file(world, number, form);
      if (file.hash == hash) return binary(std::move(file.bytes));
    }
  }
  if (has_ground_cover(world)) {
    PlantFile cover = cover_file(world).file;
    if (cover.hash == hash) return binary(std::move(cover.bytes));
  }
  if (world.has(Layer::plants) && !world.params.plants.empty()) {
    const auto canopy = canopy_texture(world, job);
    if (canopy->hash == hash) return SharedFile{canopy->file, "image/png", "png"};
    const auto leaves = leaf_texture(world, job);
    if (leaves->hash == hash) return SharedFile{leaves->file, "image/png", "png"};
  }
  for (std::size_t k = 0; world.has(Layer::plants) && k < world.params.plants.size(); ++k) {
    for (const AssetForm form : {AssetForm::near, AssetForm::far}) {
      const auto asset = plant_asset(world, static_cast<int>(k), form, job);
      if (asset && asset->hash == hash) return binary(asset->file);
    }
  }
  if (world.has(Layer::buildings) && world.params.settlements.density > 0) {
    const auto openings = opening_asset(world, job);
    if (openings->hash == hash) return binary(openings->file);
  }
  for (std::size_t k = 0; world.has(Layer::buildings) && k < world.params.settlements.houses.size(); ++k) {
    const auto asset = house_asset(world, static_cast<int>(k), job);
    if (asset && asset->hash == hash) return binary(asset->file);
  }
  return std::nullopt;
}

}  // namespace seedmesh::world
