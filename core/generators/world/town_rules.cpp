/// What towns take from a request of the generator city.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "core/generators/world/town.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::world {
namespace {

constexpr char pointer[] = "/settlements/towns/city";

/// Rows of houses that touch in the middle, and single houses outside.
std::vector<CityBuildingRule> built_in_rules() {
  CityBuildingRule row;
  row.blueprint = CityBlueprint::terraced_house;
  row.density = {0.5, 1};
  row.floors = {2, 3};
  row.front = 0.6;
  row.shared_walls = true;
  row.rear = 3;
  row.width = {4.5, 16};
  row.depth = {7, 11};
  row.share = 0.85;
  CityBuildingRule house;
  house.density = {0, 0.75};
  house.floors = {1, 2};
  house.front = 2.5;
  house.side = 1.5;
  house.rear = 3;
  house.width = {5, 13};
  house.depth = {6, 10};
  house.share = 0.6;
  return {row, house};
}

CityParams built_in() {
  CityParams params;
  params.streets.major_spacing = 170;
  params.streets.length = 58;
  params.streets.classes.major.width = 7;
  params.streets.classes.major.sidewalk = 2;
  params.streets.classes.minor.width = 5;
  params.streets.classes.minor.sidewalk = 1.4;
  params.lots.area = {120, 440};
  params.lots.width = 7;
  return params;
}

CityParams read(const Child& child) {
  IssueList ignored;  // those of the child were found when the request was read
  return read_city(Json::parse(child.parameters), "", ignored);
}

template <class T>
void refuse(const T& found, const T& usual, const char* key, const char* why, std::vector<Issue>& issues) {
  if (found == usual) return;
  issues.emplace_back(IssueKind::not_available, std::string(pointer) + "/parameters/" + key, why);
}

}  // namespace

CityParams town_rules(const WorldParams& params) {
  const std::optional<Child>& child = params.settlements.towns.city;
  CityParams rules = child ? read(*child) : built_in();
  rules.streets.centre = {0, 0};
  if (!rules.buildings.rules) rules.buildings.rules = built_in_rules();
  return rules;
}

void check_towns(const WorldParams& params, std::vector<Issue>& issues) {
  const std::optional<Child>& child = params.settlements.towns.city;
  if (!child || child->generator.empty()) return;
  if (child->generator != "city") {
    issues.emplace_back(conflict_with({}), std::string(pointer) + "/generator",
                        "found \"" + child->generator + "\", expected \"city\"");
    return;
  }
  const CityParams usual, found = read(*child);
  constexpr char ground[] = "the world gives the ground of its towns",
                 area[] = "the world gives the area of its towns";
  constexpr char streets[] = "the roads of the world are the given streets of its towns";
  constexpr char unknown[] = "towns of a world do not have it";
  refuse(found.area, usual.area, "area", area, issues);
  refuse(found.terrain, usual.terrain, "terrain", ground, issues);
  refuse(found.maps, usual.maps, "maps", "the world gives the maps of its towns", issues);
  refuse(found.given, usual.given, "given", streets, issues);
  refuse(found.buildings.landmarks, usual.buildings.landmarks, "buildings/landmarks", unknown, issues);
  refuse(found.buildings.variants, usual.buildings.variants, "buildings/variants", unknown, issues);
  refuse(found.buildings.detail, usual.buildings.detail, "buildings/detail", unknown, issues);
  refuse(found.surfaces, usual.surfaces, "surfaces", unknown, issues);
  refuse(found.furniture, usual.furniture, "furniture", unknown, issues);
  refuse(found.parks, usual.parks, "parks", unknown, issues);
  refuse(found.yards, usual.yards, "yards", unknown, issues);
  refuse(found.chunks, usual.chunks, "chunks", unknown, issues);
  refuse(found.camera, usual.camera, "camera", unknown, issues);
  refuse(found.streets.tunnel_length, usual.streets.tunnel_length, "streets/tunnel_length", unknown, issues);
  refuse(found.streets.centre, usual.streets.centre, "streets/centre",
         "the centre of a town is the middle of its settlement", issues);
  if (found.streets.method == CityMethod::wards && found.streets.wards.wall_height > 0) {
    issues.emplace_back(IssueKind::not_available,
                        std::string(pointer) + "/parameters/streets/wards/wall_height",
                        "towns of a world have no walls; expected 0");
  }
}

int most_floors(const World& world) {
  int most = 1;
  for (const CityBuildingRule& rule : *world.town_rules->buildings.rules)
    most = std::max(most, static_cast<int>(rule.floors[1]));
  return most;
}

}  // namespace seedmesh::world
