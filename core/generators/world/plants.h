#pragma once
/// Where plants stand. Candidates in cells of a grid compete by marks: "who has the lowest mark among the undecided
/// within the spacing stays, who is within the spacing of one that stays goes", in five rounds. So a plant depends on
/// candidates within five spacings and on nothing else, and any rectangle shows the same plants.
///
/// A finite form of the dependent thinning of Matérn 1960 ("Spatial variation").
#include <vector>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

constexpr int thinning_rounds = 5;

struct Plant {
  double east = 0, north = 0;  ///< absolute; multiples of 1/64 m
  double height = 0;           ///< of the foot
  double size = 1;             ///< 0.7 to 1.3
  double rank = 0;             ///< 0 to 1; coarse tiles show low ranks
};

/// The plants of a class in [west, east) x [south, north), which is inside the rectangle of `ground`. `reach`: how
/// many spacings of candidates around the rectangle compete; tests try other values than the default.
std::vector<Plant> plants_in(const World& world, int plant_class, const Rectangle& box, const Ground& ground,
                             Job& job, double reach = thinning_rounds);

/// How much of the ground around a position the class covers, 0 to 1.
double wood_cover(const World& world, int plant_class, const GroundSample& sample, double east, double north);

/// Whether the class can grow within `spacing` metres of a sample: its conditions with a tolerance.
bool may_grow(const World& world, const WorldClass& plant, const GroundSample& sample, double east,
              double north, double spacing);

}  // namespace seedmesh::world
