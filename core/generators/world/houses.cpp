#include "core/generators/world/houses.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {
namespace {

constexpr double lot = 23;         ///< metres along a road for a house
constexpr double most_uneven = 3;  ///< metres that the ground below a house may rise

/// Places houses one after the other, each apart from those before.
class Planner {
 public:
  Planner(const World& world, const Site& site, Job& job)
      : world_(world),
        site_(site),
        box_{site.east - site.radius - 40, site.north - site.radius - 40, site.east + site.radius + 40,
             site.north + site.radius + 40},
        ground_(Ground::with_roads(world, box_, job)),
        roads_(roads_near(world, box_, 0, job)) {}

  Plan make() {
    for (const auto& road : roads_) {
      Rng rng = Rng(cell_key(world_.key ^ 0x484F555345U, site_.cell.x, site_.cell.y)).at(road->id);
      double along = 0.6 * lot, walked = 0;
      for (std::size_t k = 1; k < road->points.size(); ++k) {
        const RoadPoint &a = road->points[k - 1], &b = road->points[k];
        const double x = b.east - a.east, y = b.north - a.north, length = std::sqrt(x * x + y * y);
        for (; along < walked + length; along += lot * rng.uniform(0.85, 1.3)) {
          const double t = (along - walked) / length;
          for (const double side : {-1.0, 1.0})
            try_house(a.east + t * x, a.north + t * y, x / length, y / length, side, rng);
        }
        walked += length;
      }
    }
    return std::move(plan_);
  }

 private:
  void try_house(double east, double north, double x, double y, double side, Rng& rng) {
    House house;
    house.length = rng.uniform(4.5, 8);
    house.depth = rng.uniform(3.5, 5);
    const double away = world_.params.roads.width / 2 + house.depth + rng.uniform(2.5, 7);
    const double walls = rng.uniform(2.8, 5.5), roof = house.depth * rng.uniform(0.7, 1.1);
    const double share = rng.unit();
    house.x = x;
    house.y = y;
    house.east = east - side * y * away;
    house.north = north + side * x * away;
    const double dx = house.east - site_.east, dy = house.north - site_.north,
                 out = std::sqrt(dx * dx + dy * dy);
    if (out > site_.radius || share < 0.5 * out / site_.radius || !is_apart(house)) return;
    const GroundSample middle = ground_.at(house.east, house.north);
    if (middle.shore < 18 || middle.road < house.depth + 1) return;
    if (world_.params.relief.sea && middle.height < world_.params.relief.sea_level + 2) return;
    double low = middle.height, high = low;
    for (const double u : {-1.0, 1.0}) {
      for (const double v : {-1.0, 1.0}) {
        const double px = house.east + u * house.length * x - v * house.depth * y;
        const double py = house.north + u * house.length * y + v * house.depth * x;
        const GroundSample corner = ground_.at(px, py);
        if (corner.road < 1) return;
        low = std::min(low, corner.height);
        high = std::max(high, corner.height);
      }
    }
    if (high - low > most_uneven) return;
    house.low = low - 0.6;
    house.eaves = high + walls;
    house.ridge = house.eaves + roof;
    plan_.houses.push_back(house);
  }

  bool is_apart(const House& house) const {
    return std::none_of(plan_.houses.begin(), plan_.houses.end(), [&](const House& other) {
      const double x = house.east - other.east, y = house.north - other.north;
      const double least = house.length + other.length + 1.5;
      return x * x + y * y < least * least;
    });
  }

  const World& world_;
  const Site& site_;
  Rectangle box_;
  Ground ground_;
  std::vector<std::shared_ptr<const Road>> roads_;
  Plan plan_;
};

using Point = glm::dvec3;

class HouseMesh {
 public:
  HouseMesh(const World& world, const TileFrame& frame, double base)
      : frame_(frame),
        base_(base),
        wall_(linear_color(world.params.settlements.wall)),
        roof_(linear_color(world.params.settlements.roof)) {}

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

}  // namespace

std::shared_ptr<const Plan> plan_of(const World& world, const Site& site, Job& job) {
  return world.store->get<Plan>({world.id, Store::Layer::plan, site.cell.x, site.cell.y, 0}, job, [&] {
    return std::make_shared<const Plan>(Planner(world, site, job).make());
  });
}

std::vector<House> houses_near(const World& world, const Rectangle& box, double reach, Job& job) {
  std::vector<House> found;
  for (const auto& site : sites_near(world, box, reach + world.params.settlements.radius, job)) {
    for (const House& house : plan_of(world, *site, job)->houses) {
      if (house.east >= box.west - reach && house.east < box.east + reach &&
          house.north >= box.south - reach && house.north < box.north + reach) {
        found.push_back(house);
      }
    }
  }
  return found;
}

TileMesh house_mesh(const World& world, const TileFrame& frame, const std::vector<House>& houses,
                    double base) {
  HouseMesh mesh(world, frame, base);
  for (const House& house : houses) {
    if (house.east >= frame.west && house.east < frame.west + frame.side && house.north >= frame.south &&
        house.north < frame.south + frame.side) {
      mesh.add(house);
    }
  }
  return mesh.take();
}

}  // namespace seedmesh::world
