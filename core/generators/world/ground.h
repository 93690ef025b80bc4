#pragma once
/// The ground around some positions: land, cut by rivers and lakes. A Ground holds the water within reach of a
/// rectangle; the height of a position is the same from each Ground whose rectangle contains it.
#include <limits>

#include "core/generators/world/land.h"
#include "core/generators/world/region.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {

/// Metres. Water that is farther away does not change the ground.
constexpr double valley_reach = 1400;

/// In absolute metres.
struct Rectangle {
  double west = 0, south = 0, east = 0, north = 0;
};

struct GroundSample {
  double height = 0;
  Land land;
  double shore =
      std::numeric_limits<double>::infinity();  ///< metres to the nearest bank of a river or lake; below
                                                ///< 0 in its water
};

/// A piece of a river.
struct Reach {
  RiverPoint from, to;
};

class Ground {
 public:
  Ground(const World& world, const Rectangle& rectangle, Job& job, double reach = valley_reach);
  GroundSample at(double east, double north) const;
  double height(double east, double north) const { return at(east, north).height; }

  const std::vector<Reach>& reaches() const { return reaches_; }
  const std::vector<Lake>& lakes() const { return lakes_; }

 private:
  const World* world_;
  std::vector<Reach> reaches_;
  std::vector<Lake> lakes_;
};

}  // namespace seedmesh::world
