#include "core/generators/world/houses.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/lanes.h"
#include "core/generators/world/town.h"

namespace seedmesh::world {
namespace {

constexpr double lot = 17;                             ///< metres along a road for a house
constexpr double plain_reach = 15, plain_height = 23;  ///< metres, for houses without a model
constexpr double model_reach = 20, model_height = 30;
constexpr double most_uneven = 3;   ///< metres that the ground below a house may rise
constexpr double least_gap = 1.8;   ///< metres between houses
constexpr double least_town = 150;  ///< metres; the radius of settlements with higher houses in their middle
constexpr double storey = 2.7;      ///< metres
constexpr double town_storey = 2.9;
constexpr double widest_town_house = 11.5, deepest_town_house = 7.5;  ///< half; without a model
constexpr double least_fit = 0.55;                                    ///< least scale of a model on its lot
constexpr double town_road = 0.3;                                     ///< metres from a house to a street
constexpr double fountain = 3.2;                                      ///< metres; the side of its basin
constexpr double least_church = 90;  ///< metres; the radius of settlements with a church

/// Places houses one after the other, each apart from those before.
class Planner {
 public:
  Planner(const World& world, const Site& site, Job& job)
      : world_(world),
        site_(site),
        job_(job),
        reach_(farm_reach * site.radius + 30),
        box_{site.east - reach_, site.north - reach_, site.east + reach_, site.north + reach_},
        ground_(Ground::with_roads(world, box_, job)),
        roads_(roads_near(world, box_, 0, job)),
        lanes_(lanes_of(world, site, job)),
        town_(town_of(world, site, job)) {
    for (std::size_t k = 0; world.make_asset && k < world.params.settlements.houses.size(); ++k)
      models_.push_back(house_asset(world, static_cast<int>(k), job));
  }

  Plan make() {
    const Rng rng(cell_key(world_.key ^ 0x484F555345U, site_.cell.x, site_.cell.y));
    if (town_->is_built()) {
      add_town();
      plan_.walls = town_walls(world_, site_, *town_, ground_);
      if (town_->has_square) add_fountain();
    } else {
      if (models_.empty() && site_.radius >= least_church) add_church(rng.at("church"));
      for (const auto& road : roads_) add_rows(road->points, road->width, rng.at(road->id));
    }
    for (std::size_t k = 0; k < lanes_->lanes.size(); ++k) {
      const Lane& lane = lanes_->lanes[k];
      if (lane.leads_to_farm) {
        add_farm(lane, rng.at("farm").at(k));
      } else if (!lane.is_street) {
        add_rows(lane.points, lane.width, rng.at("lane").at(k));
      }
    }
    return std::move(plan_);
  }

 private:
  /// Where a house stands beside a road: a position on its middle, the direction of the road, and the side.
  struct Lot {
    double east = 0, north = 0, x = 1, y = 0, side = 1, width = 0;
  };

  /// Houses on both sides of a road.
  void add_rows(const std::vector<RoadPoint>& points, double width, Rng rng) {
    double along = 0.5 * lot, walked = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const RoadPoint &a = points[k - 1], &b = points[k];
      const double x = b.east - a.east, y = b.north - a.north, length = std::sqrt(x * x + y * y);
      for (; along < walked + length; along += lot * rng.uniform(0.8, 1.25)) {
        const double t = (along - walked) / length;
        for (const double side : {-1.0, 1.0})
          try_lot({a.east + t * x, a.north + t * y, x / length, y / length, side, width}, rng);
      }
      walked += length;
    }
  }

  double away(const House& house) const {
    const double x = house.east - site_.east, y = house.north - site_.north;
    return std::sqrt(x * x + y * y);
  }

  void try_lot(const Lot& lot_of_house, Rng& rng) {
    House house;
    house.length = rng.uniform(5, 8);
    house.depth = rng.uniform(3.6, 5);
    const double tall = models_.empty() ? 0 : choose_model(house, rng);
    const bool shows_gable = models_.empty() && rng.unit() < 0.35;
    const double setback = rng.uniform(1.5, 5), share = rng.unit();
    style(house, rng);
    double walls = rng.uniform(3, 5.6);
    const double roof = house.depth * rng.uniform(0.85, 1.25);
    const auto [east, north, x, y, side, width] = lot_of_house;
    const double off = width / 2 + (shows_gable ? house.length : house.depth) + setback;
    house.x = shows_gable ? -y : x;
    house.y = shows_gable ? x : y;
    house.front = shows_gable ? 0 : side < 0 ? 1 : -1;
    house.east = east - side * y * off;
    house.north = north + side * x * off;
    const double out = away(house);
    if (out > site_.radius || share < 0.75 * out / site_.radius - 0.25) return;
    if (site_.radius > least_town && rng.unit() > 1.6 * out / site_.radius) walls += storey;
    if (!place(house, walls, roof, tall)) return;
    turn_to(plan_.houses.back(), side * y, -side * x);
    if (!models_.empty() || rng.unit() > 0.4) return;
    // a shed or a small barn behind the house
    const double behind = off + (shows_gable ? house.length : house.depth) + rng.uniform(5, 9);
    House shed;
    shed.kind = House::barn;
    shed.length = rng.uniform(3, 5.5);
    shed.depth = rng.uniform(2.2, 3.4);
    style(shed, rng);
    shed.x = shows_gable ? x : -y;
    shed.y = shows_gable ? y : x;
    shed.east = east - side * y * behind;
    shed.north = north + side * x * behind;
    place(shed, rng.uniform(2.2, 3), shed.depth * 0.8, 0);
  }

  /// A house, a barn and a shed around a yard at the end of a lane.
  void add_farm(const Lane& lane, Rng rng) {
    const RoadPoint &a = lane.points[lane.points.size() - 2], &b = lane.points.back();
    const double x0 = b.east - a.east, y0 = b.north - a.north, length = std::sqrt(x0 * x0 + y0 * y0);
    const double x = x0 / length, y = y0 / length, side = rng.unit() < 0.5 ? -1 : 1;
    const auto put = [&](double along, double across, House house, bool is_turned, double walls) {
      house.east = b.east + along * x - side * across * y;
      house.north = b.north + along * y + side * across * x;
      house.x = is_turned ? -y : x;
      house.y = is_turned ? x : y;
      const double tall = house.kind == House::dwelling && !models_.empty() ? choose_model(house, rng) : 0;
      if (place(house, walls, house.depth * rng.uniform(0.9, 1.1), tall))
        turn_to(plan_.houses.back(), side * y, -side * x);
    };
    House house, barn, shed;
    house.length = rng.uniform(6, 8);
    house.depth = rng.uniform(4, 5);
    barn.length = rng.uniform(8.5, 11.5);
    barn.depth = rng.uniform(4.8, 6);
    shed.length = rng.uniform(4, 7);
    shed.depth = rng.uniform(2.6, 3.6);
    barn.kind = shed.kind = House::barn;
    for (House* each : {&house, &barn, &shed}) style(*each, rng);
    put(4, 15, house, false, rng.uniform(3.2, 5.2));
    put(6, -15, barn, false, rng.uniform(3.8, 5));
    const double walls = rng.uniform(2.4, 3.2), aside = rng.uniform(-3, 3);
    put(24, aside, shed, true, walls);
  }

  /// The houses of the lots of a town, and its church.
  void add_town() {
    if (models_.empty() && town_->has_church) {
      House church = church_towards(math::sincos_degrees(90 * Rng(town_->houses.size()).unit()));
      church.east = town_->church_east;
      church.north = town_->church_north;
      place(church, 7.5, 5.6, 0);
    }
    for (const TownHouse& lot_house : town_->houses) {
      job_.check();
      add_town_house(lot_house);
    }
  }

  /// In the middle of the square.
  void add_fountain() {
    House basin;
    basin.kind = House::wall;
    basin.east = town_->square_east;
    basin.north = town_->square_north;
    basin.length = basin.depth = fountain / 2;
    const GroundSample ground = ground_.at(basin.east, basin.north);
    basin.low = ground.height - 1;
    basin.eaves = basin.ridge = basin.top = ground.height + 0.7;
    basin.wall_light = 0.8F;
    House column = basin;
    column.length = column.depth = fountain / 8;
    column.eaves = column.ridge = column.top = ground.height + 2.4;
    plan_.walls.push_back(basin);
    plan_.walls.push_back(column);
  }

  void add_town_house(const TownHouse& given) {
    Rng rng(given.key);
    const math::SinCos turn = math::sincos_degrees(given.turn);
    const double width = std::min(given.width / 2, widest_town_house),
                 depth = std::min(given.depth / 2, deepest_town_house);
    House house;
    house.east = given.east;
    house.north = given.north;
    double tall = 0;
    if (!models_.empty()) {
      tall = choose_model(house, rng);
      const double fit = std::min({1.0, width / house.length, depth / house.depth});
      house.scale *= fit;
      house.length *= fit;
      house.depth *= fit;
      tall *= fit;
      if (fit < least_fit) return;
    }
    style(house, rng);
    if (models_.empty()) {
      house.length = width;
      house.depth = depth;
    }
    house.is_on_lot = true;
    house.front = -1;
    house.x = turn.cos;
    house.y = turn.sin;
    const double walls = 0.5 + town_storey * given.floors + rng.uniform(0, 0.5);
    const double roof = std::min(4.8, house.depth * rng.uniform(0.75, 1));
    if (!stand(house, walls, roof, tall, town_road)) return;
    turn_to(plan_.houses.back(), turn.sin, 0 - turn.cos);
  }

  static House church_towards(const math::SinCos& turn) {
    House house;
    house.kind = House::church;
    house.length = 9.5;
    house.depth = 4.6;
    house.x = turn.cos;
    house.y = turn.sin;
    house.wall_light = 1.1F;
    house.roof_light = 0.6F;
    return house;
  }

  /// Beside the middle of the settlement.
  void add_church(Rng rng) {
    const math::SinCos turn = math::sincos_degrees(360 * rng.unit());
    for (int k = 0; k < 8; ++k) {
      House house = church_towards(turn);
      const math::SinCos way = math::sincos_degrees(45.0 * k);
      house.east = site_.east + 26 * way.cos;
      house.north = site_.north + 26 * way.sin;
      if (place(house, 6.2, 5.2, 0)) return;
    }
  }

  static void style(House& house, Rng& rng) {
    house.wall_light =
        static_cast<float>(house.kind == House::barn ? rng.uniform(0.4, 0.6) : rng.uniform(0.78, 1.12));
    house.roof_light = static_cast<float>(rng.uniform(0.62, 1.15));
    house.warmth =
        static_cast<float>(house.kind == House::barn ? rng.uniform(0.1, 0.25) : rng.uniform(-0.1, 0.12));
  }

  /// Adds a house where it can stand apart from others. `tall`: the height of its model, or 0.
  bool place(const House& house, double walls, double roof, double tall) {
    return is_apart(house) && stand(house, walls, roof, tall, 0.7);
  }

  /// Sets the heights of a house and adds it where the ground allows it, `from_road` metres away from roads.
  bool stand(House house, double walls, double roof, double tall, double from_road) {
    const GroundSample middle = ground_.at(house.east, house.north);
    if (middle.shore < 18 || middle.road < from_road + 0.3) return false;
    if (world_.params.relief.sea && middle.height < world_.params.relief.sea_level + 2) return false;
    double low = middle.height, high = low;
    for (const double u : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      for (const double v : {-1.0, 0.0, 1.0}) {
        const double px = house.east + u * house.length * house.x - v * house.depth * house.y;
        const double py = house.north + u * house.length * house.y + v * house.depth * house.x;
        const GroundSample corner = ground_.at(px, py);
        if (corner.road < from_road) return false;
        low = std::min(low, corner.height);
        high = std::max(high, corner.height);
      }
    }
    if (high - low > most_uneven) return false;
    house.low = low - 0.6;
    house.eaves = high + (tall > 0 ? 0.7 * tall : walls);
    house.ridge = tall > 0 ? high + tall : house.eaves + roof;
    house.floor = high + 0.05;
    house.top = house.kind == House::church ? house.eaves + 13 : house.ridge + (tall > 0 ? 0 : 1);
    plan_.houses.push_back(house);
    return true;
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

  /// Whether the plan of a house, with the gap around it, meets no other: by the axes of both.
  bool is_apart(const House& house) const {
    return std::none_of(plan_.houses.begin(), plan_.houses.end(), [&](const House& other) {
      const double x = other.east - house.east, y = other.north - house.north;
      for (const auto& [u, v] :
           {std::pair{house.x, house.y}, {-house.y, house.x}, {other.x, other.y}, {-other.y, other.x}}) {
        const auto reach = [u = u, v = v](const House& h) {
          return h.length * std::abs(h.x * u + h.y * v) + h.depth * std::abs(h.x * v - h.y * u);
        };
        if (std::abs(x * u + y * v) >= reach(house) + reach(other) + least_gap) return false;
      }
      return true;
    });
  }

  const World& world_;
  const Site& site_;
  Job& job_;
  double reach_;
  Rectangle box_;
  Ground ground_;
  std::vector<std::shared_ptr<const Road>> roads_;
  std::shared_ptr<const Lanes> lanes_;
  std::shared_ptr<const Town> town_;
  std::vector<std::shared_ptr<const Asset>> models_;
  Plan plan_;
};

}  // namespace

HouseExtent house_extent(const World& world) {
  if (world.params.settlements.density <= 0) return {};
  const bool has_models = world.make_asset && !world.params.settlements.houses.empty();
  HouseExtent extent =
      has_models ? HouseExtent{model_reach, model_height} : HouseExtent{plain_reach, plain_height};
  if (!has_models && world.params.settlements.towns.share > 0)
    extent.up = std::max(extent.up, most_uneven + 1 + town_storey * most_floors(world) + 6);
  return extent;
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
  const double around = reach + world.reach(LayerInput::houses, farm_reach * greatest_radius(world) + 30);
  for (const auto& site : sites_near(world, box, around, job)) {
    const auto plan = plan_of(world, *site, job);
    for (const std::vector<House>* all : {&plan->houses, &plan->walls}) {
      for (const House& house : *all) {
        if (house.east >= box.west - reach && house.east < box.east + reach &&
            house.north >= box.south - reach && house.north < box.north + reach) {
          found.push_back(house);
        }
      }
    }
  }
  return found;
}

}  // namespace seedmesh::world
