/// Houses in tiles, by level.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/instances.h"
#include "core/generators/world/openings.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {
namespace {

constexpr double widest_openings = 64, widest_models = 128, widest_roofs = 512, widest_boxes = 2048,
                 widest_prisms = 8192, widest_walls = 1024;  ///< metres
constexpr double prisms_along = 64;                          ///< cells along a tile, each with one prism
constexpr double widest_town_roofs = 256, widest_town_boxes = 512, narrow_prism = 40, wide_prism = 64;

using Point = glm::dvec3;

using Paint = std::array<std::uint8_t, 4>;

/// How much of a house is drawn.
enum class Finish { walls_and_roof, with_openings };

constexpr double overhang = 0.45;  ///< metres that a roof reaches beyond the walls
constexpr double storey = 2.7;     ///< metres between rows of windows
constexpr double window_spacing = 3.3, lot_window_spacing = 3.8;  ///< metres
constexpr double least_gable = 2.6;  ///< metres; half of the depth of houses with windows in their gables

/// What the colour of walls is multiplied by: lime, ochre, brick, stone and green. Half of the walls keep it.
constexpr std::array<double, 3> plasters[] = {
    {1.1, 1.1, 1.08}, {1.02, 0.85, 0.6}, {0.95, 0.66, 0.54}, {0.7, 0.69, 0.66}, {0.82, 0.92, 0.84}};

/// A colour made lighter, or darker, and warmer.
Paint tinted(const Paint& color, double light, double warmth) {
  const double by[3] = {light * (1 + 0.5 * warmth), light, light * (1 - warmth)};
  Paint out = color;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(math::to_int32(std::min(255.0, color[k] * by[k])));
  return out;
}

/// Houses as one mesh of flat faces.
class HouseMesh {
 public:
  HouseMesh(const World& world, const TileFrame& frame, double base)
      : frame_(frame),
        base_(base),
        openings_(frame),
        wall_(linear_color(world.params.settlements.wall)),
        roof_(linear_color(world.params.settlements.roof)) {}

  /// The plaster follows from the place, so that all tiles show the same.
  Paint wall_of(const House& h) const {
    Paint wall = wall_;
    if (h.kind == House::dwelling) {
      Rng rng(cell_key(0x57414C4CU, math::to_int64(std::floor(h.east * 16)),
                       math::to_int64(std::floor(h.north * 16))));
      const auto number = static_cast<std::size_t>(rng.unit() * 2 * std::size(plasters));
      if (number < std::size(plasters)) {
        for (std::size_t k = 0; k < 3; ++k)
          wall[k] = static_cast<std::uint8_t>(math::to_int32(std::min(255.0, wall[k] * plasters[number][k])));
      }
    }
    return tinted(wall, h.wall_light, h.warmth);
  }
  Paint roof_of(const House& h) const { return tinted(roof_, h.roof_light, 0.4 * h.warmth); }
  const Paint& roof() const { return roof_; }
  const TileFrame& frame() const { return frame_; }

  /// Walls up to a height, closed by a flat roof.
  void add_box(const House& h, double top, const Paint& roof) {
    add_block(h, {}, h.low, top, wall_of(h), roof);
  }

  void add(const House& h, Finish finish) {
    const auto at = [&](double u, double v, double z) { return position(h, u, v, z); };
    const Point along(h.x, h.y, 0), across(-h.y, h.x, 0);
    const Paint wall = wall_of(h), roof = roof_of(h);
    const double rise = (h.ridge - h.eaves) / h.depth, length = std::sqrt(1 + rise * rise);
    const double u = 1 + overhang / h.length, v = 1 + overhang / h.depth, low = h.eaves - rise * overhang;
    for (const double s : {-1.0, 1.0}) {
      add_face({at(-s, s, h.low), at(s, s, h.low), at(s, s, h.eaves), at(-s, s, h.eaves)}, across * s, wall);
      add_face({at(s, -s, h.low), at(s, s, h.low), at(s, s, h.eaves), at(s, 0, h.ridge), at(s, -s, h.eaves)},
               along * s, wall);
      add_face({at(-s * u, s * v, low), at(s * u, s * v, low), at(s * u, 0, h.ridge), at(-s * u, 0, h.ridge)},
               (across * s * rise + Point(0, 0, 1)) / length, roof);
    }
    if (h.kind == House::church) add_tower(h);
    if (finish != Finish::with_openings) return;
    if (h.kind == House::dwelling && (!h.is_on_lot || h.roof_light < 0.9F)) add_chimney(h);
    add_openings(h);
  }

  const Openings& openings() const { return openings_; }
  TileMesh take() { return std::move(mesh_); }

 private:
  /// `u` along the ridge and `v` across it, from -1 to 1 on the plan.
  static Point position(const House& h, double u, double v, double z) {
    return {h.east + u * h.length * h.x - v * h.depth * h.y, h.north + u * h.length * h.y + v * h.depth * h.x,
            z};
  }

  /// A part of a plan, in shares of the half sides of a house: its middle and its half sides.
  struct Part {
    double u = 0, v = 0, du = 1, dv = 1;
  };

  void add_block(const House& h, const Part& part, double low, double top, const Paint& wall,
                 const Paint& cover) {
    const auto at = [&](double a, double b, double z) {
      return position(h, part.u + a * part.du, part.v + b * part.dv, z);
    };
    const Point along(h.x, h.y, 0), across(-h.y, h.x, 0);
    for (const double s : {-1.0, 1.0}) {
      add_face({at(-s, s, low), at(s, s, low), at(s, s, top), at(-s, s, top)}, across * s, wall);
      add_face({at(s, -s, low), at(s, s, low), at(s, s, top), at(s, -s, top)}, along * s, wall);
    }
    add_face({at(-1, -1, top), at(1, -1, top), at(1, 1, top), at(-1, 1, top)}, {0, 0, 1}, cover);
  }

  /// A square tower with a spire at one end of a church.
  void add_tower(const House& h) {
    const double half = 2.4, u = 1 - half / h.length, du = half / h.length, dv = half / h.depth;
    const double eaves = h.top - 5.5;
    const Paint roof = roof_of(h);
    add_block(h, {u, 0, du, dv}, h.low, eaves, wall_of(h), roof);
    const auto at = [&](double a, double b) {
      return position(h, u + 1.15 * a * du, 1.15 * b * dv, eaves - 0.2);
    };
    const Point top = position(h, u, 0, h.top);
    for (const auto& [a, b] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}}) {
      const Point out(a * h.x - b * h.y, a * h.y + b * h.x, 0.4);
      add_face({at(a - b, b + a), at(a + b, b - a), top}, math::unit(out, {0, 0, 1}), roof);
    }
  }

  /// Windows in rows on the walls, and a door to the road.
  void add_openings(const House& h) {
    const double foot = std::max(h.floor, h.low + 0.6);
    const bool is_barn = h.kind == House::barn, is_church = h.kind == House::church;
    for (const double side : {-1.0, 1.0}) {
      const bool is_rear = side * h.front < 0;  // with fewer windows, which few see
      if (!is_rear)
        openings_.add_door(on_wall(h, side, 0, foot, {is_barn ? 3.0 : 1.0, door_top(h, foot) - foot}));
      if (is_barn) continue;
      for (double sill = foot + 0.9; sill + 1.3 < h.eaves; sill += storey)
        add_windows(h, side, sill, sill < foot + 1 && !is_rear, is_rear);
      if (!is_church) add_gable_windows(h, side, foot);
    }
  }

  void add_chimney(const House& h) {
    const Point p = position(h, 0.45, 0.18, h.eaves);
    openings_.add_chimney({p.x, p.y, h.eaves, -h.y, h.x, 1, h.ridge + 0.7 - h.eaves});
  }

  static double door_top(const House& h, double foot) {
    return std::min(h.eaves - 0.3, foot + (h.kind == House::barn ? 2.9 : 2.1));
  }

  /// A row of windows on a long wall. `has_door`: leaves out the window at the door.
  void add_windows(const House& h, double side, double sill, bool has_door, bool is_rear) {
    const double high = std::min(h.kind == House::church ? 3.2 : 1.25, h.eaves - 0.3 - sill);
    const int columns = std::max(
        1, static_cast<int>(2 * (h.length - 0.9) / (h.is_on_lot ? lot_window_spacing : window_spacing)));
    for (int k = 0; k < columns; ++k) {
      const double middle = (k + 0.5 - 0.5 * columns) * window_spacing;
      if ((has_door && std::abs(middle) < 1.1) || (is_rear && k % 2 != 0)) continue;
      openings_.add_window(on_wall(h, side, middle, sill, {0.9, high}));
    }
  }

  /// One window for each storey of a gable, and one below the ridge.
  void add_gable_windows(const House& h, double side, double foot) {
    if (h.depth < least_gable) return;
    for (double sill = foot + 0.9; sill + 1.3 < h.eaves; sill += storey)
      openings_.add_window(on_gable(h, side, 0.4 * side * h.depth, sill, {0.9, 1.25}));
    if (h.ridge - h.eaves > 2.4) openings_.add_window(on_gable(h, side, 0, h.eaves + 0.35, {0.75, 1}));
  }

  struct Size {
    double width = 1, height = 1;
  };
  /// An opening in a long wall, `along` metres from its middle.
  static Opening on_wall(const House& h, double side, double along, double foot, const Size& size) {
    const Point p = position(h, along / h.length, side, foot);
    return {p.x, p.y, foot, -h.y * side, h.x * side, size.width, size.height};
  }
  /// An opening in a gable, `across` metres from its middle.
  static Opening on_gable(const House& h, double side, double across, double foot, const Size& size) {
    const Point p = position(h, side, across / h.depth, foot);
    return {p.x, p.y, foot, h.x * side, h.y * side, size.width, size.height};
  }

  /// A polygon that faces along `normal`; its corners are turned if they run the other way.
  void add_face(std::vector<Point> corners, const Point& normal, const Paint& color) {
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
  Openings openings_;
  Paint wall_, roof_;
  TileMesh mesh_;
};

std::vector<House> houses_of(const World& world, const TileFrame& frame, Job& job) {
  const Rectangle box{frame.west, frame.south, frame.west + frame.side, frame.south + frame.side};
  return houses_near(world, box, 0, job);
}

std::vector<House> on_lots(std::vector<House> houses) {
  std::erase_if(houses, [](const House& house) { return !house.is_on_lot; });
  return houses;
}

/// One box around the houses of a cell, as high as their mean.
void add_prisms(HouseMesh& mesh, const std::vector<House>& houses, double prism_cell) {
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
    all.kind = House::wall;  // without a plaster of its own
    all.east = (block.west + block.east) / 2;
    all.north = (block.south + block.north) / 2;
    all.length = (block.east - block.west) / 2;
    all.depth = (block.north - block.south) / 2;
    all.low = block.low;
    mesh.add_box(all, block.ridges / block.count - 1.5, mesh.roof());
  }
}

/// The models of houses, on plinths that reach down to the ground.
void add_models(Glb& glb, const World& world, const std::vector<House>& houses, HouseMesh& plinths,
                Job& job) {
  const TileFrame& frame = plinths.frame();
  const std::size_t kinds = world.params.settlements.houses.size();
  for (std::size_t k = 0; k < kinds; ++k) {
    Instances copies;
    std::shared_ptr<const Asset> asset;
    for (const House& house : houses) {
      if (house.model != static_cast<int>(k)) continue;
      if (!asset) asset = house_asset(world, house.model, job);
      plinths.add_box(house, house.floor, plinths.wall_of(house));
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
    copies.add_to(glb, "buildings_" + std::to_string(k), glb.add_asset(*asset));
  }
}

}  // namespace

void add_houses(Glb& glb, const World& world, const TileFrame& frame, double base, Job& job) {
  if (frame.side > widest_prisms) return;
  std::vector<House> houses = houses_of(world, frame, job);
  if (frame.side > widest_walls)
    std::erase_if(houses, [](const House& house) { return house.kind == House::wall; });
  if (houses.empty()) return;
  HouseMesh mesh(world, frame, base);
  if (frame.side > widest_boxes) {
    add_prisms(mesh, houses, frame.side / prisms_along);
  } else {
    if (frame.side > widest_town_boxes)
      add_prisms(mesh, on_lots(houses), frame.side > 2 * widest_town_boxes ? wide_prism : narrow_prism);
    for (const House& house : houses) {
      if (house.is_on_lot && frame.side > widest_town_boxes) continue;
      if (house.kind == House::wall) {
        mesh.add_box(house, house.top, mesh.wall_of(house));
      } else if (frame.side > (house.is_on_lot ? widest_town_roofs : widest_roofs)) {
        mesh.add_box(house, (house.eaves + house.ridge) / 2, mesh.roof_of(house));
      } else if (frame.side > widest_models || house.model < 0) {
        mesh.add(house, frame.side <= widest_openings ? Finish::with_openings : Finish::walls_and_roof);
      }
    }
    if (frame.side <= widest_models) add_models(glb, world, houses, mesh, job);
  }
  mesh.openings().add_to(glb, world, job);
  const TileMesh made = mesh.take();
  job.spend(Resource::triangles, made.indices.size() / 3);
  glb.add_mesh("buildings", made, glb.add_material("buildings", 0.9), frame.step, base);
}

}  // namespace seedmesh::world
