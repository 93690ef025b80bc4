#pragma once
/// Selects the positions of plants among random candidates in the cells of a grid. Each candidate has a random mark.
/// Five rounds alternate. Odd rounds keep each undecided candidate with the lowest mark within the spacing. Even rounds
/// remove undecided candidates near kept ones. A plant therefore depends only on candidates within five spacings, so
/// every rectangle that contains a position gives the same result there.
///
/// A finite form of the dependent thinning of Matérn 1960 ("Spatial variation").
#include <vector>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

constexpr int thinning_rounds = 5;

struct Plant {
  double east = 0, north = 0;  ///< absolute; multiples of 1/64 m
  double height = 0;           ///< height of the foot, slightly below the ground
  double size = 1;             ///< random scale factor of the class height, 0.7 to 1.3
  std::uint64_t key = 0;       ///< key of further random choices
};

/// Returns the plants of a class in [west, east) x [south, north), which is inside the rectangle of `ground`, whose
/// marks are below `share`. A plant depends on candidates with lower marks alone, so those of a lower share are a part
/// of those of a higher one, and take less time. `reach`: how many spacings of candidates around the rectangle
/// compete; tests try other values than the default.
std::vector<Plant> plants_in(const World& world, int plant_class, const Rectangle& box, const Ground& ground,
                             Job& job, double share = 1, double reach = thinning_rounds);

/// Returns the share of the ground at a position that the class covers, 0 to 1. Variations over less than
/// `spacing`, the metres between samples, are left out.
double wood_cover(const World& world, int plant_class, const GroundSample& sample, const Climate& climate,
                  double east, double north, double spacing);

/// Returns false only if moisture, temperature or the sea exclude the class within `spacing` metres of a sample.
bool may_grow(const World& world, const WorldClass& plant, const GroundSample& sample, double east,
              double north, double spacing);

}  // namespace seedmesh::world
