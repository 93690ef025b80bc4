#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/base/math.h"

#include "core/generators/world/ground.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/roads.h"
#include "core/generators/world/town.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

constexpr int height_cells = 64;

/// Lengths of maps are multiples of 1/64 m, the grid of plants. All 53 bits of a double would only make texts long.
/// The order of two lengths stays, so rivers still fall.
double rounded(double metres) { return std::floor(metres * 64 + 0.5) / 64; }

Json heights_of(const World& world, const Rectangle& box, Job& job) {
  const Ground ground = Ground::with_works(world, box, job);
  Json values = Json::array();
  for (int row = 0; row <= height_cells; ++row) {
    job.check();
    for (int column = 0; column <= height_cells; ++column) {
      values.push_back(rounded(ground.height(box.west + (box.east - box.west) * column / height_cells,
                                             box.south + (box.north - box.south) * row / height_cells)));
    }
  }
  return {{"columns", height_cells + 1}, {"rows", height_cells + 1}, {"values", std::move(values)}};
}

/// The parts of a map around a box.
class MapWriter {
 public:
  MapWriter(const World& world, const Rectangle& box, Job& job) : world_(world), box_(box), job_(job) {}

  void add_water(Json& map) const {
    for (const CellKey& key : regions_near(world_, box_.west, box_.south, box_.east, box_.north, 0)) {
      job_.check();
      const auto region = region_at(world_, key, job_);
      const std::set<std::string> waters = waters_of(*region);
      for (const River& river : region->rivers) {
        if (waters.contains(river.id)) map["rivers"].push_back(river_json(river));
      }
      for (const Lake& lake : region->lakes) {
        if (waters.contains(lake.id)) map["lakes"].push_back(lake_json(lake));
      }
    }
  }

  void add_plants(Json& map) const {
    const bool has_places = has_details(most_places_side);
    for (std::size_t k = 0; has_places && k < world_.params.plants.size(); ++k) {
      const WorldClass& plant = world_.params.plants[k];
      Json places = Json::array();
      for (double south = box_.south; south < box_.north; south += block) {
        for (double west = box_.west; west < box_.east; west += block) {
          const Rectangle part{west, south, std::min(west + block, box_.east),
                               std::min(south + block, box_.north)};
          const Ground ground = Ground::with_works(world_, part, job_);
          for (const Plant& p : plants_in(world_, static_cast<int>(k), part, ground, job_)) {
            places.push_back(position(p.east, p.north, p.height));
          }
        }
      }
      const std::size_t count = places.size();
      map["plants"].push_back({{"class", plant.class_name},
                               {"spacing", plant.spacing},
                               {"count", count},
                               {"places", std::move(places)}});
    }
  }

  void add_settlements(Json& map) const {
    for (const auto& site : sites_near(world_, box_, 0, job_)) {
      Json settlement = {{"id", name_of(*site)},
                         {"position", position(site->east, site->north, site->height)},
                         {"radius", rounded(site->radius)}};
      if (has_details(most_streets_side)) add_plan(settlement, *site);
      map["settlements"].push_back(std::move(settlement));
    }
  }

  void add_roads(Json& map) const {
    for (const auto& road : roads_near(world_, box_, world_.params.roads.width / 2, job_)) {
      Json points = Json::array();
      for (const RoadPoint& p : road->points) points.push_back(position(p.east, p.north, p.height));
      map["roads"].push_back({{"id", road->id}, {"width", road->width}, {"points", std::move(points)}});
    }
  }

 private:
  static constexpr std::size_t most_fountain_parts = 2;
  static constexpr double most_places_side = 2048, most_streets_side = 8192, block = 256;

  bool has_details(double most_side) const {
    return std::max(box_.east - box_.west, box_.north - box_.south) <= most_side;
  }

  /// What is known of a settlement only after it is planned.
  void add_plan(Json& settlement, const Site& site) const {
    const auto town = town_of(world_, site, job_);
    settlement["class"] = town->is_built() ? "town" : "village";
    settlement["houses"] = plan_of(world_, site, job_)->houses.size();
    Json outline = Json::array(), streets = Json::array();
    for (const auto& p : town->outline) outline.push_back(plan_position(p));
    if (town->is_built()) settlement["outline"] = std::move(outline);
    if (town->is_built()) settlement["has_wall"] = has_wall(*plan_of(world_, site, job_));
    if (town->is_built() && town->has_square) {
      Json square = Json::array();
      for (const auto& p : square_of(*town)) square.push_back(plan_position(p));
      settlement["square"] = std::move(square);
    }
    for (const Lane& lane : lanes_of(world_, site, job_)->lanes) {
      Json points = Json::array();
      for (const RoadPoint& p : lane.points) points.push_back(position(p.east, p.north, p.height));
      const char* kind = lane.is_street ? "street" : lane.leads_to_farm ? "farm" : "lane";
      streets.push_back({{"class", kind}, {"width", rounded(lane.width)}, {"points", std::move(points)}});
    }
    settlement["streets"] = std::move(streets);
  }

  static bool has_wall(const Plan& plan) { return plan.walls.size() > most_fountain_parts; }

  Json plan_position(const std::array<double, 2>& p) const {
    return {rounded(p[0] - static_cast<double>(world_.east)),
            rounded(p[1] - static_cast<double>(world_.north))};
  }
  Json position(double east, double north, double height) const {
    return {rounded(east - static_cast<double>(world_.east)),
            rounded(north - static_cast<double>(world_.north)), rounded(height)};
  }
  bool overlaps(double west, double south, double east, double north) const {
    return west <= box_.east && east >= box_.west && south <= box_.north && north >= box_.south;
  }
  bool touches(const River& river) const {
    for (std::size_t k = 1; k < river.points.size(); ++k) {
      const RiverPoint &a = river.points[k - 1], &b = river.points[k];
      const double wide = b.width / 2;
      if (overlaps(std::min(a.east, b.east) - wide, std::min(a.north, b.north) - wide,
                   std::max(a.east, b.east) + wide, std::max(a.north, b.north) + wide)) {
        return true;
      }
    }
    return false;
  }
  bool touches(const Lake& lake) const {
    const double far = 1.4 * lake.radius;
    return overlaps(lake.east - far, lake.north - far, lake.east + far, lake.north + far);
  }
  /// The ids of what touches the box, and of all that it flows into. No water leaves a region.
  std::set<std::string> waters_of(const Region& region) const {
    std::set<std::string> found;
    for (const Lake& lake : region.lakes) {
      if (touches(lake)) found.insert(lake.id);
    }
    std::map<std::string, const River*> rivers;
    for (const River& river : region.rivers) rivers[river.id] = &river;
    for (const River& river : region.rivers) {
      if (!touches(river)) continue;
      const River* here = &river;
      while (here != nullptr && found.insert(here->id).second) {
        const auto next = rivers.find(here->into);
        if (next == rivers.end() && here->into != "sea") found.insert(here->into);
        here = next == rivers.end() ? nullptr : next->second;
      }
    }
    return found;
  }
  Json river_json(const River& river) const {
    Json points = Json::array(), widths = Json::array();
    for (const RiverPoint& p : river.points) {
      points.push_back(position(p.east, p.north, p.water));
      widths.push_back(rounded(p.width));
    }
    return {
        {"id", river.id}, {"into", river.into}, {"points", std::move(points)}, {"widths", std::move(widths)}};
  }
  Json lake_json(const Lake& lake) const {
    constexpr int corners = 192;  // chords then lie within half a metre of the shore
    Json outline = Json::array();
    for (int k = 0; k < corners; ++k) {
      const math::SinCos turn = math::sincos_degrees(360.0 * k / corners);
      const double shore = shore_distance(lake, lake.east + turn.cos, lake.north + turn.sin, 1);
      outline.push_back({rounded(lake.east + shore * turn.cos - static_cast<double>(world_.east)),
                         rounded(lake.north + shore * turn.sin - static_cast<double>(world_.north))});
    }
    return {{"id", lake.id}, {"level", rounded(lake.level)}, {"outline", std::move(outline)}};
  }

  const World& world_;
  const Rectangle& box_;
  Job& job_;
};

}  // namespace

Json map_json(const World& world, const MapBox& box, MapHeights heights, Job& job) {
  const auto east = static_cast<double>(world.east), north = static_cast<double>(world.north);
  const Rectangle absolute{box.west + east, box.south + north, box.east + east, box.north + north};
  Json map = {{"box", {box.west, box.south, box.east, box.north}}};
  map["sea_level"] = world.params.relief.sea ? Json(world.params.relief.sea_level) : Json();
  if (heights == MapHeights::grid) map["heights"] = heights_of(world, absolute, job);
  for (const char* list : {"settlements", "rivers", "lakes", "roads", "plants"}) map[list] = Json::array();
  const MapWriter writer(world, absolute, job);
  writer.add_water(map);
  writer.add_settlements(map);
  writer.add_roads(map);
  if (world.has(Layer::plants)) writer.add_plants(map);
  return map;
}

}  // namespace seedmesh::world
