#include "core/generators/world/houses.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::world {
namespace {

constexpr double lot = 23;                             ///< metres along a road for a house
constexpr double plain_reach = 13, plain_height = 14;  ///< of houses without a model
constexpr double model_reach = 20, model_height = 30;
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
        roads_(roads_near(world, box_, 0, job)) {
    for (std::size_t k = 0; world.make_asset && k < world.params.settlements.houses.size(); ++k)
      models_.push_back(house_asset(world, static_cast<int>(k), job));
  }

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
    double tall = 0;
    if (!models_.empty()) tall = choose_model(house, rng);
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
    house.eaves = high + (tall > 0 ? 0.7 * tall : walls);
    house.ridge = tall > 0 ? high + tall : house.eaves + roof;
    house.floor = high + 0.05;
    turn_to(house, side * y, -side * x);
    plan_.houses.push_back(house);
  }

  /// Takes a model and its size; returns its height.
  double choose_model(House& house, Rng& rng) const {
    double sum = 0;
    for (const WorldHouse& each : world_.params.settlements.houses) sum += each.share;
    double left = sum * rng.unit();
    std::size_t k = 0;
    for (; k + 1 < models_.size() && left >= world_.params.settlements.houses[k].share; ++k)
      left -= world_.params.settlements.houses[k].share;
    const Asset& model = *models_[k];
    const double wide = model.high[0] - model.low[0], deep = model.high[2] - model.low[2],
                 tall = model.high[1] - model.low[1];
    const HouseExtent most = house_extent(world_);
    house.model = static_cast<int>(k);
    house.scale = std::min({1.0, 2 * most.across / std::max(1e-6, std::sqrt(wide * wide + deep * deep)),
                            (most.up - most_uneven - 0.1) / std::max(1e-6, tall)});
    house.length = house.scale * wide / 2;
    house.depth = house.scale * deep / 2;
    return house.scale * tall;
  }

  /// Turns the front of the model, +Z, to a direction east and north.
  static void turn_to(House& house, double east, double north) {
    const double sine = east, cosine = -north;
    const double w = std::sqrt(std::max(0.0, (1 + cosine) / 2));
    const double y = w > 1e-4 ? sine / (2 * w) : 1;
    house.turn = {static_cast<float>(y), static_cast<float>(w)};
  }

  bool is_apart(const House& house) const {
    return std::none_of(plan_.houses.begin(), plan_.houses.end(), [&](const House& other) {
      const double x = house.east - other.east, y = house.north - other.north;
      const double least = std::max(house.length, house.depth) + std::max(other.length, other.depth) + 1.5;
      return x * x + y * y < least * least;
    });
  }

  const World& world_;
  const Site& site_;
  Rectangle box_;
  Ground ground_;
  std::vector<std::shared_ptr<const Road>> roads_;
  std::vector<std::shared_ptr<const Asset>> models_;
  Plan plan_;
};

}  // namespace

HouseExtent house_extent(const World& world) {
  if (world.params.settlements.density <= 0) return {};
  const bool has_models = world.make_asset && !world.params.settlements.houses.empty();
  return has_models ? HouseExtent{model_reach, model_height} : HouseExtent{plain_reach, plain_height};
}

std::shared_ptr<const Asset> house_asset(const World& world, int number, Job& job) {
  if (!world.make_asset) return nullptr;
  return world.store->get<Asset>({world.id, Store::Layer::file, number, 2, 0}, job, [&] {
    const std::uint64_t seed = key_at(world.key ^ 0x484F555345U, static_cast<std::uint64_t>(number));
    const Child& model = world.params.settlements.houses[static_cast<std::size_t>(number)].model;
    return std::make_shared<const Asset>(world.make_asset(
        model, AssetForm::near, seed, "/settlements/houses/" + std::to_string(number) + "/model", job));
  });
}

std::shared_ptr<const Plan> plan_of(const World& world, const Site& site, Job& job) {
  return world.store->get<Plan>({world.id, Store::Layer::plan, site.cell.x, site.cell.y, 0}, job, [&] {
    return std::make_shared<const Plan>(Planner(world, site, job).make());
  });
}

std::vector<House> houses_near(const World& world, const Rectangle& box, double reach, Job& job) {
  std::vector<House> found;
  const double around = reach + world.reach(Reads::houses, world.params.settlements.radius);
  for (const auto& site : sites_near(world, box, around, job)) {
    for (const House& house : plan_of(world, *site, job)->houses) {
      if (house.east >= box.west - reach && house.east < box.east + reach &&
          house.north >= box.south - reach && house.north < box.north + reach) {
        found.push_back(house);
      }
    }
  }
  return found;
}

}  // namespace seedmesh::world
