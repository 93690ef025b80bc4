#include "core/generators/world/town.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/city.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::world {
namespace {

constexpr std::size_t directions = 48;  ///< number of directions of the outline
constexpr double step = 12;             ///< metres between positions that are tested for the outline
constexpr double least_shore = 24, above_sea = 3;
constexpr double steepest = 0.22;  ///< rise over run of the ground between two positions
constexpr double least_share =
    0.5;                           ///< share of the mean square radius below which a settlement is a village
constexpr double apart = 30;       ///< metres between given streets
constexpr double pin_radius = 42;  ///< metres; earthworks keep away from samples of coarse tiles
constexpr double green_radius = 25;     ///< metres, around the church
constexpr double green_distance = 62;   ///< metres from the middle of the town
constexpr double square_distance = 34;  ///< metres from the middle of the town
constexpr double inner_square = 0.9 * square_radius;
constexpr double least_apart = 52;     ///< metres from the square to the church
constexpr double level_enough = 0.08;  ///< metres that points of a street may leave a straight line
constexpr double pavement = 2;         ///< metres beside a road within a town

using Point = std::array<double, 2>;
using Line = std::vector<Point>;

double distance_to(const Point& p, const Point& a, const Point& b) {
  const double x = b[0] - a[0], y = b[1] - a[1], px = p[0] - a[0], py = p[1] - a[1], square = x * x + y * y;
  const double t = square > 0 ? std::clamp((px * x + py * y) / square, 0.0, 1.0) : 0;
  const double dx = px - t * x, dy = py - t * y;
  return std::sqrt(dx * dx + dy * dy);
}

double distance_to(const Point& p, const Line& line) {
  double nearest = 1e12;
  for (std::size_t k = 1; k < line.size(); ++k)
    nearest = std::min(nearest, distance_to(p, line[k - 1], line[k]));
  return nearest;
}

class TownPlanner {
 public:
  TownPlanner(const World& world, const Site& site, Job& job)
      : world_(world),
        site_(site),
        job_(job),
        around_(world.reach(LayerInput::towns, site.radius + town_margin)),
        box_{site.east - around_, site.north - around_, site.east + around_, site.north + around_},
        ground_(Ground::with_main_roads(world, box_, job)),
        rng_(cell_key(world.key ^ 0x544F574EU, site.cell.x, site.cell.y)) {}

  Town make() {
    const Result<city::CityPlan> planned = plan();
    if (!planned) return {};
    add_streets(*planned);
    if (is_square_crossed()) town_.has_square = false;
    add_houses(*planned);
    for (Point& p : outline_) p = {p[0] + site_.east, p[1] + site_.north};
    town_.outline = std::move(outline_);
    return std::move(town_);
  }

  Result<city::CityPlan> plan() {
    outline_ = find_outline();
    if (outline_.empty()) return Error{Code::invalid, {}};
    const std::vector<Line> roads = roads_in();
    has_roads_ = !roads.empty();
    CityParams params = *world_.town_rules;
    params.area.polygon = {outline_};
    params.maps.density = "1-sqrt(x*x+y*y)/" + std::to_string(math::to_int32(std::ceil(1.2 * site_.radius)));
    place_church(roads);
    place_square(roads);
    if (Json polygons = obstacles(); !polygons.empty())
      params.maps.obstacles = geojson("MultiPolygon", std::move(polygons));
    if (has_roads_) params.given.given_streets = features_of(roads);
    // the plan is kept for other requests, so it spends nothing of this one
    Job own = job_.for_estimate().for_child(rng_.at("plan").key(), "/settlements/towns");
    return city::plan_on(params, std::make_shared<const city::Landform>(landform()), own);
  }

 private:
  /// How far each direction is buildable, as a ring around the middle: without water, steep ground and beaches.
  Line find_outline() const {
    Rng rng = rng_.at("outline");
    const double first = 360 * rng.unit(), second = 360 * rng.unit();
    std::array<double, directions> far{};
    for (std::size_t k = 0; k < directions; ++k) {
      job_.check();
      const double angle = 360.0 * static_cast<double>(k) / directions;
      const math::SinCos way = math::sincos_degrees(angle);
      const double most = site_.radius * (0.83 + 0.1 * math::sincos_degrees(2 * angle + first).cos +
                                          0.07 * math::sincos_degrees(3 * angle + second).cos);
      double before = site_.height;
      for (double out = step; out <= most; out += step) {
        const GroundSample sample = ground_.at(site_.east + out * way.cos, site_.north + out * way.sin);
        if (!is_buildable(sample) || std::abs(sample.height - before) > steepest * step) break;
        before = sample.height;
        far[k] = std::min(most, out + step / 2);
      }
    }
    const std::array<double, directions> found = far;
    double squares = 0;
    for (std::size_t k = 0; k < directions; ++k) {
      // no narrow tongues
      for (const std::size_t n : {k + 1, k + directions - 1})
        far[k] = std::min(far[k], 24 + 1.12 * found[n % directions]);
      far[k] = std::max(far[k], 2 * step);
      squares += far[k] * far[k] / directions;
    }
    if (squares < least_share * site_.radius * site_.radius) return {};
    Line ring;
    for (std::size_t k = 0; k < directions; ++k) {
      const math::SinCos way = math::sincos_degrees(360.0 * static_cast<double>(k) / directions);
      ring.push_back({far[k] * way.cos, far[k] * way.sin});
    }
    return ring;
  }

  bool is_buildable(const GroundSample& sample) const {
    const WorldRelief& relief = world_.params.relief;
    return sample.shore > least_shore && !(relief.sea && sample.height < relief.sea_level + above_sea);
  }

  /// The roads inside the town as lines that do not cross. Where roads run side by side, only the first counts.
  std::vector<Line> roads_in() const {
    std::vector<Line> lines;
    const double most = 1.1 * site_.radius;
    const auto nearest_corner = [&lines](const Point& p) {
      Point found = p;
      double least = 1e12;
      for (const Line& line : lines) {
        for (const Point& q : line) {
          const double x = q[0] - p[0], y = q[1] - p[1];
          if (x * x + y * y < least) {
            least = x * x + y * y;
            found = q;
          }
        }
      }
      return found;
    };
    for (const auto& road : roads_near(world_, box_, 0, job_)) {
      std::vector<Line> runs;
      Line run;
      bool was_near = false;
      const auto end_run = [&] {
        if (run.size() > 1) runs.push_back(run);
        run.clear();
      };
      for (const RoadPoint& each : road->points) {
        const Point p{each.east - site_.east, each.north - site_.north};
        const bool is_near = std::any_of(lines.begin(), lines.end(),
                                         [&](const Line& line) { return distance_to(p, line) < apart; });
        if (p[0] * p[0] + p[1] * p[1] > most * most) {
          end_run();
        } else if (is_near) {
          if (!run.empty()) run.push_back(nearest_corner(p));
          end_run();
        } else {
          if (run.empty() && was_near) run.push_back(nearest_corner(p));
          run.push_back(p);
        }
        was_near = is_near;
      }
      end_run();
      lines.insert(lines.end(), runs.begin(), runs.end());
    }
    return lines;
  }

  static GeoJson geojson(const char* type, Json coordinates) {
    return {canonical_text({{"type", type}, {"coordinates", std::move(coordinates)}})};
  }

  GeoJson features_of(const std::vector<Line>& lines) const {
    Json features = Json::array();
    for (const Line& line : lines) {
      features.push_back({{"type", "Feature"},
                          {"properties", {{"width", world_.params.roads.width}, {"sidewalk", pavement}}},
                          {"geometry", {{"type", "LineString"}, {"coordinates", line}}}});
    }
    return {canonical_text({{"type", "FeatureCollection"}, {"features", std::move(features)}})};
  }

  /// Finds a position at a distance from the middle that is `free` metres from roads, on buildable ground.
  std::optional<Point> free_position(const std::vector<Line>& roads, double first, double distance,
                                     double free) const {
    for (int k = 0; k < 12; ++k) {
      const math::SinCos way = math::sincos_degrees(first + 30.0 * k);
      const Point p{distance * way.cos, distance * way.sin};
      const bool is_free = std::all_of(roads.begin(), roads.end(),
                                       [&](const Line& line) { return distance_to(p, line) > free; });
      const double x = site_.east + p[0] - town_.church_east, y = site_.north + p[1] - town_.church_north;
      const bool is_apart = !town_.has_church || x * x + y * y > least_apart * least_apart;
      if (is_free && is_apart && is_buildable(ground_.at(site_.east + p[0], site_.north + p[1]))) return p;
    }
    return std::nullopt;
  }

  /// The church stands on a green of its own, away from roads.
  void place_church(const std::vector<Line>& roads) {
    Rng rng = rng_.at("church");
    const auto found = free_position(roads, 360 * rng.unit(), green_distance, green_radius + 14);
    if (!found) return;
    town_.church_east = site_.east + (*found)[0];
    town_.church_north = site_.north + (*found)[1];
    town_.has_church = true;
  }

  /// A paved square beside the middle, away from the church.
  void place_square(const std::vector<Line>& roads) {
    Rng rng = rng_.at("square");
    const auto found = free_position(roads, 360 * rng.unit(), square_distance, square_radius + 8);
    if (!found) return;
    town_.has_square = true;
    town_.square_east = site_.east + (*found)[0];
    town_.square_north = site_.north + (*found)[1];
  }

  /// The green of the church, and where earthworks must not be.
  Json obstacles() const {
    Json polygons = Json::array();
    const auto add = [&](double east, double north, double radius) {
      Json ring = Json::array();
      for (int k = 0; k < 8; ++k) {
        const math::SinCos way = math::sincos_degrees(45.0 * k);
        ring.push_back({east - site_.east + radius * way.cos, north - site_.north + radius * way.sin});
      }
      polygons.push_back(Json::array({std::move(ring)}));
    };
    const auto first = [](double v) { return works_spacing * std::ceil(v / works_spacing); };
    for (double north = first(site_.north - site_.radius); north <= site_.north + site_.radius;
         north += works_spacing) {
      for (double east = first(site_.east - site_.radius); east <= site_.east + site_.radius;
           east += works_spacing)
        add(east, north, pin_radius);
    }
    if (town_.has_church) add(town_.church_east, town_.church_north, green_radius);
    if (town_.has_square) add(town_.square_east, town_.square_north, square_radius);
    return polygons;
  }

  city::Landform landform() const {
    const int half = math::to_int32(std::ceil(around_ / town_lattice)), count = 2 * half + 1;
    terrain::Field field(job_, count, count, 0);
    field.cell = town_lattice;
    for (int row = 0; row < count; ++row) {
      job_.check();
      for (int column = 0; column < count; ++column) {
        field.at(column, row) = static_cast<float>(ground_.height(site_.east + town_lattice * (column - half),
                                                                  site_.north + town_lattice * (half - row)));
      }
    }
    return city::Landform(std::move(field));
  }

  void add_streets(const city::CityPlan& plan) {
    for (std::uint32_t edge = 0; edge < plan.graph.edges.size(); ++edge) {
      if (!plan.graph.is_street(edge)) continue;
      if (has_roads_ && plan.graph.edges[edge].tag == city::first_given) continue;  // a road of the world
      Lane street;
      street.width = plan.class_of(edge).width;
      street.is_street = true;
      std::vector<RoadPoint> points;
      for (std::uint32_t k = plan.heights.first[edge]; k < plan.heights.first[edge + 1]; ++k) {
        const city::ProfilePoint& p = plan.heights.points[k];
        RoadPoint point{site_.east + p.at.x / 100.0, site_.north + p.at.y / 100.0, p.height, false, 0};
        point.works = std::abs(p.height - plan.landform->at({p.at.x / 100.0, p.at.y / 100.0}));
        points.push_back(point);
      }
      street.points = straightened(points);
      if (street.points.size() > 1) town_.streets.push_back(std::move(street));
    }
  }

  /// Without points that are on the straight line between others; greedily from the start.
  static std::vector<RoadPoint> straightened(const std::vector<RoadPoint>& points) {
    std::vector<RoadPoint> kept;
    for (std::size_t from = 0; from < points.size();) {
      kept.push_back(points[from]);
      std::size_t to = from + 1;
      while (to + 1 < points.size() && is_straight(points, from, to + 1)) ++to;
      from = to;
    }
    return kept;
  }

  static bool is_straight(const std::vector<RoadPoint>& points, std::size_t from, std::size_t to) {
    const RoadPoint &a = points[from], &b = points[to];
    const double x = b.east - a.east, y = b.north - a.north, square = x * x + y * y;
    if (square <= 0) return false;
    for (std::size_t k = from + 1; k < to; ++k) {
      const RoadPoint& p = points[k];
      const double t = ((p.east - a.east) * x + (p.north - a.north) * y) / square;
      const double off = ((p.east - a.east) * y - (p.north - a.north) * x) / std::sqrt(square);
      if (std::abs(p.height - a.height - t * (b.height - a.height)) > level_enough || std::abs(off) > 0.05)
        return false;
    }
    return true;
  }

  /// Whether a street cuts through the square: growth ends streets near obstacles, not always before them.
  bool is_square_crossed() const {
    const Point middle{town_.square_east, town_.square_north};
    return std::any_of(town_.streets.begin(), town_.streets.end(), [&](const Lane& street) {
      for (std::size_t k = 1; k < street.points.size(); ++k) {
        const RoadPoint &a = street.points[k - 1], &b = street.points[k];
        if (distance_to(middle, {a.east, a.north}, {b.east, b.north}) < inner_square) return true;
      }
      return false;
    });
  }

  void add_houses(const city::CityPlan& plan) {
    for (const city::Lot& lot : plan.lots) {
      if (!lot.house) continue;
      const city::House& house = *lot.house;
      town_.houses.push_back({site_.east + house.position.x, site_.north + house.position.y, house.turn,
                              house.width, house.depth, house.floors, lot.key});
    }
  }

  const World& world_;
  const Site& site_;
  Job& job_;
  double around_;
  Rectangle box_;
  Ground ground_;
  Rng rng_;
  Line outline_;  ///< around the middle
  bool has_roads_ = false;
  Town town_;
};

}  // namespace

std::uint64_t Town::bytes() const {
  std::uint64_t sum = sizeof(Town) + houses.size() * sizeof(TownHouse) + outline.size() * sizeof(Point);
  for (const Lane& street : streets) sum += sizeof(Lane) + street.points.size() * sizeof(RoadPoint);
  return sum;
}

std::vector<std::array<double, 2>> square_of(const Town& town) {
  std::vector<std::array<double, 2>> corners;
  for (int k = 0; k < 8; ++k) {
    const math::SinCos way = math::sincos_degrees(45.0 * k);
    corners.push_back(
        {town.square_east + square_radius * way.cos, town.square_north + square_radius * way.sin});
  }
  return corners;
}

Result<city::CityPlan> town_plan(const World& world, const Site& site, Job& job) {
  return TownPlanner(world, site, job).plan();
}

std::shared_ptr<const Town> town_of(const World& world, const Site& site, Job& job) {
  if (!site.is_town) return std::make_shared<const Town>();
  return world.store->get<Town>({world.id, Store::Layer::plan, site.cell.x, site.cell.y, 2}, job, [&] {
    return std::make_shared<const Town>(TownPlanner(world, site, job).make());
  });
}

}  // namespace seedmesh::world
