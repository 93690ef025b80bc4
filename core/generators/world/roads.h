#pragma once
/// Settlements and the roads between them.
///
/// Two settlements are joined if no third one is nearer to both than they are to each other (relative neighbourhood
/// graph, Toussaint 1980). They must also be at most WorldRoads::longest apart. A road is the cheapest path on a grid
/// of 128 m within an ellipse around its ends. Costs depend on the grade, as in Galin et al. 2010 ("Procedural
/// generation of roads"). Its height follows the ground with a grade of at most 10 %: the mean of the highest road
/// below the ground and the lowest above it.
///
/// The nodes of the grid keep 64 m away from positions whose coordinates are multiples of 512 m, and so do earthworks:
/// coarse tiles, whose samples have such coordinates, need no roads.
#include <memory>
#include <string>
#include <vector>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

constexpr double site_cell = 6144;     ///< metres; at most one settlement a cell
constexpr double works_spacing = 512;  ///< metres; samples this far apart have no earthworks
constexpr double most_grade = 0.1;
constexpr double most_works = 9;  ///< metres; a road that needs deeper cuttings is not built

struct Site {
  CellKey cell;
  bool is_settled = false, is_town = false;
  double east = 0, north = 0, height = 0, radius = 0;  ///< absolute
  double waterside = 0;                                ///< 1 beside a river or a coast, 0 far from both
  static std::uint64_t bytes() { return sizeof(Site); }
};

struct RoadPoint {
  double east = 0, north = 0, height = 0;  ///< position of the carriageway
  bool is_bridge = false;
  double works = 0;  ///< absolute difference of height from the ground, metres
};
struct Road {
  std::string id;
  double width = 0;
  std::vector<RoadPoint> points;  ///< empty where no path exists
  std::uint64_t bytes() const { return sizeof(Road) + points.size() * sizeof(RoadPoint); }
};

/// Returns the greatest radius that a settlement can have.
double greatest_radius(const World& world);

/// Returns the id of a settlement, such as "s3_-2". It follows from the cell of the settlement.
std::string name_of(const Site& site);
/// Returns the site of a cell from the store; makes it if the store has none. Site::is_settled can be false.
std::shared_ptr<const Site> site_at(const World& world, const CellKey& cell, Job& job);
/// Returns the settlements within `reach` of a rectangle.
std::vector<std::shared_ptr<const Site>> sites_near(const World& world, const Rectangle& box, double reach,
                                                    Job& job);
/// Returns the roads that have a piece within `reach` of a rectangle. A new road takes about 10 ms.
std::vector<std::shared_ptr<const Road>> roads_near(const World& world, const Rectangle& box, double reach,
                                                    Job& job);

/// Returns the heights of a road with a grade of at most `most_grade` along a line, which begins and ends on the
/// ground. `along`: the distances from the start. Returns an empty list if the grade between the ends is too
/// steep.
std::vector<double> graded(const std::vector<double>& along, const std::vector<double>& ground);

}  // namespace seedmesh::world
