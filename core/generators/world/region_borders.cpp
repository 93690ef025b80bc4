/// Which region a cell belongs to: borders are displaced by noise.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/region.h"

namespace seedmesh::world {
namespace {

constexpr double displacement = 3;        ///< cells; noise is below 1
constexpr double stray = 2 * drain_cell;  ///< metres that a river can be away from its nodes

}  // namespace

CellKey region_of(const World& world, const CellKey& cell) {
  const auto x = static_cast<double>(cell.x), y = static_cast<double>(cell.y);
  const double east = x + displacement * noise(region_key(world, 7), x / 11, y / 11).value;
  const double north = y + displacement * noise(region_key(world, 8), x / 11, y / 11).value;
  return {math::to_int64(std::floor(east / region_cells)), math::to_int64(std::floor(north / region_cells))};
}

std::vector<CellKey> regions_near(const World& world, double west, double south, double east, double north,
                                  double reach) {
  const double around = reach + stray;
  const auto cell = [](double v) { return math::to_int64(std::floor(v / drain_cell)); };
  std::vector<CellKey> found;
  for (std::int64_t y = cell(south - around); y <= cell(north + around); ++y) {
    for (std::int64_t x = cell(west - around); x <= cell(east + around); ++x) {
      const CellKey region = region_of(world, {x, y});
      if (std::find(found.begin(), found.end(), region) == found.end()) found.push_back(region);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void River::add_to_bounds(const RiverPoint& p) {
  west = std::min(west, p.east);
  south = std::min(south, p.north);
  east = std::max(east, p.east);
  north = std::max(north, p.north);
}

}  // namespace seedmesh::world
