#include "core/generators/world/lanes.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/town.h"

namespace seedmesh::world {
namespace {

constexpr double step = 12;   ///< metres between points
constexpr double apart = 34;  ///< metres between a lane and others, so that houses stand between them
constexpr double most_lane_works = 1.4;
constexpr double steepest = 0.13;    ///< rise over run of the ground along a lane
constexpr double most_turn = 22;     ///< degrees from a right angle with the road
constexpr double pin_distance = 46;  ///< metres; earthworks keep away from samples of coarse tiles
constexpr std::size_t least_points = 4;

struct Direction {
  double east = 0, north = 0;
};

class LaneFinder {
 public:
  LaneFinder(const World& world, const Site& site, Job& job)
      : world_(world),
        site_(site),
        job_(job),
        reach_(farm_reach * site.radius),
        box_{site.east - reach_, site.north - reach_, site.east + reach_, site.north + reach_},
        ground_(world, box_, job),
        roads_(roads_near(world, box_, 0, job)),
        town_(town_of(world, site, job)),
        rng_(cell_key(world.key ^ 0x4C414E45U, site.cell.x, site.cell.y)) {}

  Lanes find() {
    found_.lanes = town_->streets;
    if (roads_.empty() && !town_->is_built()) add_street();
    for (const auto& road : roads_) {
      Rng rng = rng_.at(road->id);
      walk(*road, rng);
    }
    return std::move(found_);
  }

 private:
  double away(double east, double north) const {
    const double x = east - site_.east, y = north - site_.north;
    return std::sqrt(x * x + y * y);
  }

  /// The street of a settlement without roads.
  void add_street() {
    const math::SinCos turn = math::sincos_degrees(360 * rng_.unit());
    for (const double sign : {-1.0, 1.0}) {
      const RoadPoint from{site_.east, site_.north, ground_.height(site_.east, site_.north), false, 0};
      add_lane(from, {sign * turn.cos, sign * turn.sin}, 0.9 * site_.radius, false, nullptr);
    }
  }

  /// Lanes leave a road to both sides in turn, farther apart outside of the settlement.
  void walk(const Road& road, Rng& rng) {
    double next = rng.uniform(30, 60), walked = 0, side = rng.unit() < 0.5 ? -1 : 1;
    for (std::size_t k = 1; k < road.points.size(); ++k) {
      job_.check();
      const RoadPoint &a = road.points[k - 1], &b = road.points[k];
      const double x = b.east - a.east, y = b.north - a.north, length = std::sqrt(x * x + y * y);
      while (next < walked + length) {
        const double t = (next - walked) / length;
        const RoadPoint from{a.east + t * x, a.north + t * y, a.height + t * (b.height - a.height), false, 0};
        const double out = away(from.east, from.north);
        const bool is_farm = out > 1.15 * site_.radius;
        next += is_farm ? rng.uniform(120, 260) : rng.uniform(48, 84);
        const math::SinCos turn = math::sincos_degrees(rng.uniform(-most_turn, most_turn));
        const double most = is_farm ? rng.uniform(70, 170) : site_.radius * rng.uniform(0.3, 0.75);
        const double u = -side * y / length, v = side * x / length;
        side = -side;
        if (out > (farm_reach - 0.5) * site_.radius || a.is_bridge || b.is_bridge) continue;
        if (town_->is_built() && !is_farm) continue;
        add_lane(from, {u * turn.cos - v * turn.sin, u * turn.sin + v * turn.cos}, most, is_farm, &road);
      }
      walked += length;
    }
  }

  void add_lane(const RoadPoint& from, Direction way, double most, bool is_farm, const Road* road) {
    Lane lane{std::max(2.4, 0.66 * world_.params.roads.width), is_farm, {from}};
    for (double gone = step; gone <= most; gone += step) {
      const RoadPoint& last = lane.points.back();
      RoadPoint p{last.east + step * way.east, last.north + step * way.north, 0, false, 0};
      if (!is_free(p, is_farm, road == nullptr ? 0 : gone)) break;
      const double height = ground_.height(p.east, p.north);
      if (std::abs(height - last.height) > steepest * step && gone > step) break;
      p.height = std::clamp(height, last.height - most_grade * step, last.height + most_grade * step);
      p.works = std::abs(p.height - height);
      if (p.works > most_lane_works) break;
      lane.points.push_back(p);
    }
    if (lane.points.size() >= least_points) found_.lanes.push_back(std::move(lane));
  }

  /// Whether a lane may pass, `gone` metres from its road; 0 where it has none.
  bool is_free(const RoadPoint& p, bool is_farm, double gone) const {
    const double out = away(p.east, p.north);
    if (out > (is_farm ? farm_reach - 0.1 : 1) * site_.radius || (is_farm && out < 1.1 * site_.radius))
      return false;
    const double x = p.east - works_spacing * std::floor(p.east / works_spacing + 0.5),
                 y = p.north - works_spacing * std::floor(p.north / works_spacing + 0.5);
    if (x * x + y * y < pin_distance * pin_distance) return false;
    const GroundSample sample = ground_.at(p.east, p.north);
    if (sample.shore < 26) return false;
    if (world_.params.relief.sea && sample.height < world_.params.relief.sea_level + 2.5) return false;
    const double least = gone > 0 ? std::min(apart, 0.75 * gone) : 0;
    return is_apart(p, least);
  }

  bool is_apart(const RoadPoint& p, double least) const {
    const auto is_near = [&](const std::vector<RoadPoint>& points) {
      for (std::size_t k = 1; k < points.size(); ++k) {
        const RoadPoint &a = points[k - 1], &b = points[k];
        const double x = b.east - a.east, y = b.north - a.north, px = p.east - a.east, py = p.north - a.north;
        const double square = x * x + y * y;
        const double t = square > 0 ? std::clamp((px * x + py * y) / square, 0.0, 1.0) : 0;
        const double dx = px - t * x, dy = py - t * y;
        if (dx * dx + dy * dy < least * least) return true;
      }
      return false;
    };
    return std::none_of(roads_.begin(), roads_.end(),
                        [&](const auto& road) { return is_near(road->points); }) &&
           std::none_of(found_.lanes.begin(), found_.lanes.end(),
                        [&](const Lane& lane) { return is_near(lane.points); });
  }

  const World& world_;
  const Site& site_;
  Job& job_;
  double reach_;
  Rectangle box_;
  Ground ground_;
  std::vector<std::shared_ptr<const Road>> roads_;
  std::shared_ptr<const Town> town_;
  Rng rng_;
  Lanes found_;
};

}  // namespace

std::uint64_t Lanes::bytes() const {
  std::uint64_t sum = sizeof(Lanes);
  for (const Lane& lane : lanes) sum += sizeof(Lane) + lane.points.size() * sizeof(RoadPoint);
  return sum;
}

std::shared_ptr<const Lanes> lanes_of(const World& world, const Site& site, Job& job) {
  return world.store->get<Lanes>({world.id, Store::Layer::plan, site.cell.x, site.cell.y, 1}, job, [&] {
    return std::make_shared<const Lanes>(LaneFinder(world, site, job).find());
  });
}

std::vector<std::shared_ptr<const Lanes>> lanes_near(const World& world, const Rectangle& box, double reach,
                                                     Job& job) {
  std::vector<std::shared_ptr<const Lanes>> found;
  const double most = farm_reach * greatest_radius(world);
  for (const auto& site : sites_near(world, box, reach + most, job)) {
    const double far = reach + farm_reach * site->radius;
    if (site->east < box.west - far || site->east > box.east + far || site->north < box.south - far ||
        site->north > box.north + far) {
      continue;
    }
    found.push_back(lanes_of(world, *site, job));
  }
  return found;
}

}  // namespace seedmesh::world
