#pragma once
/// Drainage of a region with sides of about 32 km: lakes, and rivers that end in the sea, in a lake or in
/// another river. A region depends on the land alone, and no water crosses its border, so regions do not
/// depend on each other.
///
///   jittered nodes, 2 km apart -> flood from the sea or the lowest node -> flow -> rivers with falling water
///
/// The flood is the priority flood of Barnes, Lehman and Mulla 2014 ("Priority-flood"), on a planar graph of
/// nodes instead of a grid. Rivers and lakes stay away from positions whose coordinates are multiples of
/// 16,384 m. The samples of the widest tiles have such coordinates, so these tiles need no drainage. Noise
/// displaces the borders of regions, so that they are not straight lines.
#include <compare>
#include <memory>
#include <string>
#include <vector>

#include "core/generators/world/land.h"

namespace seedmesh::world {

constexpr double drain_cell = 2048;  ///< metres; one node a cell
constexpr int region_cells = 16;     ///< cells along a side of a region
/// In metres. No water reaches positions whose coordinates are multiples of this.
constexpr double dry_spacing = 8 * drain_cell;

/// Column (eastward) and row (northward) of a cell in a grid from the absolute origin: of nodes, sites or regions.
struct CellKey {
  std::int64_t x = 0, y = 0;
  auto operator<=>(const CellKey&) const = default;
};

/// Returns the key of the random choices of regions for one purpose.
inline std::uint64_t region_key(const World& world, std::uint64_t purpose) {
  return key_at(world.key ^ 0x52454749U, purpose);
}

/// Returns the region that a cell belongs to.
CellKey region_of(const World& world, const CellKey& cell);

struct RiverPoint {
  double east = 0, north = 0;  ///< absolute
  double water = 0;            ///< height of the water; never rises along a river
  double width = 0;            ///< metres
  double cut = 0;              ///< height of the uncut land above the water, at least 0, metres
};
struct River {
  std::string id;
  std::string into;                                               ///< "sea", or the id of a lake or river
  std::vector<RiverPoint> points;                                 ///< source to mouth
  double west = 1e12, south = 1e12, east = -1e12, north = -1e12;  ///< bounds of the points

  void add_to_bounds(const RiverPoint& p);
};

/// A lake. Its shore is at `radius` times a factor that depends on the direction (shore_distance()).
struct Lake {
  std::string id;
  double east = 0, north = 0, level = 0, radius = 0;
  double depth = 0;
  std::uint64_t key = 0;
};
/// Returns the distance of the shore from the middle of a lake in the direction of a position. `away` is the
/// distance of the position from the middle.
double shore_distance(const Lake& lake, double east, double north, double away);

struct Region {
  std::vector<River> rivers;
  std::vector<Lake> lakes;
  std::uint64_t size = 0;
  std::uint64_t bytes() const { return size; }
};

/// Returns the drainage of a region, from the store or computed in about 1 ms.
std::shared_ptr<const Region> region_at(const World& world, const CellKey& region, Job& job);

/// Returns the regions whose water can lie within `reach` of a rectangle.
std::vector<CellKey> regions_near(const World& world, double west, double south, double east, double north,
                                  double reach);

}  // namespace seedmesh::world
