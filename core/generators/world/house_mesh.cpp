/// Houses in tiles, by level.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/instances.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {
namespace {

constexpr double widest_models = 128, widest_roofs = 512, widest_boxes = 2048,
                 widest_prisms = 8192;  ///< metres
constexpr double prism_cell = 128;      ///< metres

using Point = glm::dvec3;

/// Houses as one mesh of flat faces.
class HouseMesh {
 public:
  HouseMesh(const World& world, const TileFrame& frame, double base)
      : frame_(frame),
        base_(base),
        wall_(linear_color(world.params.settlements.wall)),
        roof_(linear_color(world.params.settlements.roof)) {}

  /// Walls up to a height, closed by a flat roof.
  void add_box(const House& h, double top, const std::array<std::uint8_t, 4>& roof) {
    const auto at = [&](double u, double v, double z) {
      return Point(h.east + u * h.length * h.x - v * h.depth * h.y,
                   h.north + u * h.length * h.y + v * h.depth * h.x, z);
    };
    const Point along(h.x, h.y, 0), across(-h.y, h.x, 0);
    for (const double s : {-1.0, 1.0}) {
      add_face({at(-s, s, h.low), at(s, s, h.low), at(s, s, top), at(-s, s, top)}, across * s, wall_);
      add_face({at(s, -s, h.low), at(s, s, h.low), at(s, s, top), at(s, -s, top)}, along * s, wall_);
    }
    add_face({at(-1, -1, top), at(1, -1, top), at(1, 1, top), at(-1, 1, top)}, {0, 0, 1}, roof);
  }
  const std::array<std::uint8_t, 4>& wall() const { return wall_; }
  const std::array<std::uint8_t, 4>& roof() const { return roof_; }

  void add(const House& h) {
    const auto at = [&](double u, double v, double z) {
      return Point(h.east + u * h.length * h.x - v * h.depth * h.y,
                   h.north + u * h.length * h.y + v * h.depth * h.x, z);
    };
    const Point along(h.x, h.y, 0), across(-h.y, h.x, 0);
    for (const double s : {-1.0, 1.0}) {
      add_face({at(-s, s, h.low), at(s, s, h.low), at(s, s, h.eaves), at(-s, s, h.eaves)}, across * s, wall_);
      add_face({at(s, -s, h.low), at(s, s, h.low), at(s, s, h.eaves), at(s, 0, h.ridge), at(s, -s, h.eaves)},
               along * s, wall_);
      const double rise = (h.ridge - h.eaves) / h.depth, length = std::sqrt(1 + rise * rise);
      add_face({at(-s, s, h.eaves), at(s, s, h.eaves), at(s, 0, h.ridge), at(-s, 0, h.ridge)},
               (across * s * rise + Point(0, 0, 1)) / length, roof_);
    }
  }

  TileMesh take() { return std::move(mesh_); }

 private:
  /// A polygon that faces along `normal`; its corners are turned if they run the other way.
  void add_face(std::vector<Point> corners, const Point& normal, const std::array<std::uint8_t, 4>& color) {
    const Point area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (glm::dot(area, normal) < 0) std::reverse(corners.begin(), corners.end());
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto steps = [&](double metres) {
      return static_cast<std::int16_t>(math::to_int32(std::floor(metres / frame_.step + 0.5)));
    };
    const auto byte = [](double v) {
      return static_cast<std::int8_t>(math::to_int32(std::floor(v * 127 + 0.5)));
    };
    for (const Point& p : corners) {
      TileVertex vertex;
      vertex.x = steps(p.x - frame_.middle_east);
      vertex.y = steps_of(p.z, base_, frame_.step);
      vertex.z = steps(frame_.middle_north - p.y);
      vertex.normal[0] = byte(normal.x);
      vertex.normal[1] = byte(normal.z);
      vertex.normal[2] = byte(-normal.y);
      std::copy(color.begin(), color.end(), vertex.color);
      mesh_.vertices.push_back(vertex);
    }
    for (std::uint32_t k = 2; k < corners.size(); ++k) {
      for (const std::uint32_t corner : {first, first + k - 1, first + k}) mesh_.indices.push_back(corner);
    }
  }

  const TileFrame& frame_;
  double base_;
  std::array<std::uint8_t, 4> wall_, roof_;
  TileMesh mesh_;
};

std::vector<House> houses_of(const World& world, const TileFrame& frame, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  return houses_near(world, box, 0, job);
}

/// One box around the houses of a cell, as high as their mean.
void add_prisms(HouseMesh& mesh, const std::vector<House>& houses) {
  struct Block {
    double west = 1e12, south = 1e12, east = -1e12, north = -1e12, low = 1e12, ridges = 0;
    int count = 0;
  };
  std::map<std::pair<std::int64_t, std::int64_t>, Block> blocks;
  for (const House& house : houses) {
    Block& block = blocks[{math::to_int64(std::floor(house.east / prism_cell)),
                           math::to_int64(std::floor(house.north / prism_cell))}];
    block.west = std::min(block.west, house.east - house.depth);
    block.south = std::min(block.south, house.north - house.depth);
    block.east = std::max(block.east, house.east + house.depth);
    block.north = std::max(block.north, house.north + house.depth);
    block.low = std::min(block.low, house.low);
    block.ridges += house.ridge;
    ++block.count;
  }
  for (const auto& [cell, block] : blocks) {
    House all;
    all.east = (block.west + block.east) / 2;
    all.north = (block.south + block.north) / 2;
    all.length = (block.east - block.west) / 2;
    all.depth = (block.north - block.south) / 2;
    all.low = block.low;
    mesh.add_box(all, block.ridges / block.count - 1.5, mesh.roof());
  }
}

/// The models of houses, on plinths that reach down to the ground.
void add_models(Glb& glb, const World& world, const TileFrame& frame, const std::vector<House>& houses,
                HouseMesh& plinths, Job& job, std::string_view folder) {
  const std::size_t kinds = world.params.settlements.houses.size();
  for (std::size_t k = 0; k < kinds; ++k) {
    Instances copies;
    std::shared_ptr<const Asset> asset;
    for (const House& house : houses) {
      if (house.model != static_cast<int>(k)) continue;
      if (!asset) asset = house_asset(world, house.model, job);
      plinths.add_box(house, house.floor, plinths.wall());
      const double s = house.scale;
      const double x = s * (asset->low[0] + asset->high[0]) / 2, z = s * (asset->low[2] + asset->high[2]) / 2;
      const double y = house.turn[0], w = house.turn[1], sine = 2 * y * w, cosine = w * w - y * y;
      const auto size = static_cast<float>(s);
      copies.add({house.east - frame.middle_east - (x * cosine + z * sine), house.floor - s * asset->low[1],
                  frame.middle_north - house.north - (z * cosine - x * sine)},
                 {size, size, size}, house.turn);
    }
    if (!asset) continue;
    job.spend(Resource::triangles, copies.count() * asset->triangles);
    copies.add_to(glb, "buildings_" + std::to_string(k), glb.add_asset(*asset, folder));
  }
}

}  // namespace

void add_houses(Glb& glb, const World& world, const TileFrame& frame, double base, Job& job,
                std::string_view folder) {
  if (frame.side > widest_prisms) return;
  const std::vector<House> houses = houses_of(world, frame, job);
  if (houses.empty()) return;
  HouseMesh mesh(world, frame, base);
  if (frame.side > widest_boxes) {
    add_prisms(mesh, houses);
  } else {
    for (const House& house : houses) {
      if (frame.side > widest_roofs) {
        mesh.add_box(house, (house.eaves + house.ridge) / 2, mesh.roof());
      } else if (frame.side > widest_models || house.model < 0) {
        mesh.add(house);
      }
    }
    if (frame.side <= widest_models) add_models(glb, world, frame, houses, mesh, job, folder);
  }
  const TileMesh made = mesh.take();
  job.spend(Resource::triangles, made.indices.size() / 3);
  glb.add_mesh("buildings", made, glb.add_material("buildings", 0.9), frame.step, base);
}

}  // namespace seedmesh::world
