#pragma once
/// Courses of rivers between two nodes of a region, and the levels of their waters.
#include <string>
#include <vector>

#include "core/generators/world/region.h"

namespace seedmesh::world {

constexpr double shallow = 1;  ///< least depth of the water level below the land, metres

/// A river from a node to the node below, or to a shore.
struct Course {
  std::vector<RiverPoint> points;
  std::vector<double> ruggedness;  ///< ruggedness of the land at the points
  std::string into;                ///< id of the water where it ends before the node below
  int down = -1;                   ///< the course that it ends at
  int lake = -1;                   ///< the lake at its node
  int into_lake = -1;
};

/// Moves the points between the first and the last towards lower land to the sides, so that rivers follow valleys.
void settle_in_valleys(const World& world, std::vector<RiverPoint>& points);

/// Moves a bend of a river away from a dry position that it comes too near to. The coordinates of dry positions are
/// multiples of dry_spacing (region.h).
void keep_away(RiverPoint& p);

/// Returns the height of the lowest land across a river at a point, up to both banks and a little farther.
double lowest_across(const World& world, const std::vector<RiverPoint>& points, std::size_t k,
                     double half_width);

/// Lowers rivers and lakes to the valleys of lower waters nearby. A river still meets the water at its end and
/// never rises. `order`: courses from the outlets upwards.
void lower_to_valleys(std::vector<Course>& courses, const std::vector<int>& order, std::vector<Lake>& lakes);

}  // namespace seedmesh::world
