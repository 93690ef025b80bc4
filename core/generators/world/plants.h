#pragma once
/// Selects the positions of plants among random candidates in the cells of a grid. Each candidate has a
/// random mark. Five rounds decide. Rounds 1, 3 and 5 keep an undecided candidate if no undecided one within
/// the spacing has a lower mark. Rounds 2 and 4 remove undecided candidates within the spacing of a kept one.
/// A plant therefore depends only on candidates within five spacings, so every rectangle that contains it
/// gives the same result.
///
/// A finite form of the dependent thinning of Matérn 1960 ("Spatial variation").
#include <glm/vec2.hpp>
#include <span>
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

/// The candidates that compete for space: those with a mark below `share`, within `reach` spacings of the rectangle.
/// Tests try other values of `reach` than the default.
struct Competitors {
  double share = 1, reach = thinning_rounds;
};

/// Returns the plants of a class in [west, east) x [south, north). The rectangle is inside that of `ground`. A plant
/// depends only on candidates with lower marks. A lower share therefore returns a part of the plants of a higher share,
/// in less time.
std::vector<Plant> plants_in(const World& world, int plant_class, const Rectangle& box, const Ground& ground,
                             Job& job, const Competitors& competitors = {});

/// Returns the share of the ground at a position, east and north in metres, that the class covers, 0 to 1. Variations shorter than
/// `spacing`, the distance between samples in metres, are left out.
double wood_cover(const World& world, int plant_class, const GroundSample& sample, const Climate& climate,
                  const glm::dvec2& at, double spacing);

/// Returns the height of the tallest class that density, moisture, temperature, biomes and the sea do not exclude within
/// `spacing` metres of a sample; 0 if they exclude all classes.
double tallest_growing(const World& world, const GroundSample& sample, double east, double north,
                       double spacing);

/// Bounds of the heights in a square, and of the heights of the plants that can grow there, in metres.
struct Growth {
  double low = 0, high = 0, tallest = 0;
  bool has_river = false;  ///< a river beside which `tallest` does not include the moist ground
};
/// Bounds of the plants in a square, in metres; 0 without plants.
struct PresentPlants {
  double height = 0;  ///< height of the tallest class
  double top = 0;     ///< height of the tallest plant above the ground
};
/// Returns the bounds of the classes that grow here, among those of at most `growth.tallest` metres. `tops`: from
/// plant_tops(). In squares of up to 256 m, a class must also have a candidate in [west, east) x [south, north).
PresentPlants plants_present(const World& world, const Growth& growth, std::span<const double> tops,
                             const Rectangle& box);

}  // namespace seedmesh::world
