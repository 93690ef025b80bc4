#pragma once
/// Lanes of a settlement: those that leave the roads of a village, the streets of a town, and lanes to farms
/// outside. They follow the ground.
#include <memory>
#include <vector>

#include "core/generators/world/roads.h"

namespace seedmesh::world {

struct Lane {
  double width = 0;
  bool leads_to_farm = false;
  std::vector<RoadPoint> points;  ///< from the road outwards; none is a bridge
  bool is_street = false;         ///< whether it is a street of a town, whose houses have lots
};
struct Lanes {
  std::vector<Lane> lanes;
  std::uint64_t bytes() const;
};

/// Greatest distance of lanes and houses from the middle of a settlement, divided by its radius.
constexpr double farm_reach = 2.8;

/// Returns the lanes of a settlement from the store. If the store has none, makes them in some milliseconds, after the
/// roads of the settlement.
std::shared_ptr<const Lanes> lanes_of(const World& world, const Site& site, Job& job);
/// Returns the lanes of settlements whose lanes can be within `reach` of a rectangle.
std::vector<std::shared_ptr<const Lanes>> lanes_near(const World& world, const Rectangle& box, double reach,
                                                     Job& job);

}  // namespace seedmesh::world
