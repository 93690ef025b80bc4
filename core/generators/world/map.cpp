#include <nlohmann/json.hpp>

#include "core/generators/world/ground.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {
namespace {

constexpr int height_cells = 64;

Json heights_of(const World& world, const Rectangle& box, Job& job) {
  const Ground ground(world, box, job);
  Json values = Json::array();
  for (int row = 0; row <= height_cells; ++row) {
    job.check();
    for (int column = 0; column <= height_cells; ++column) {
      values.push_back(ground.height(box.west + (box.east - box.west) * column / height_cells,
                                     box.south + (box.north - box.south) * row / height_cells));
    }
  }
  return {{"columns", height_cells + 1}, {"rows", height_cells + 1}, {"values", std::move(values)}};
}

}  // namespace

Json map_json(const World& world, const MapBox& box, MapHeights heights, Job& job) {
  const auto east = static_cast<double>(world.east), north = static_cast<double>(world.north);
  const Rectangle absolute{box.west + east, box.south + north, box.east + east, box.north + north};
  Json map = {{"box", {box.west, box.south, box.east, box.north}}};
  map["sea_level"] = world.params.relief.sea ? Json(world.params.relief.sea_level) : Json();
  if (heights == MapHeights::grid) map["heights"] = heights_of(world, absolute, job);
  for (const char* list : {"settlements", "rivers", "lakes", "roads", "plants"}) map[list] = Json::array();
  return map;
}

}  // namespace seedmesh::world
