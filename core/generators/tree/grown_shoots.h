#pragma once
/// The growth of buds and branches in a year of the model `grown`: buds sense the light, grow shoots and die, branches
/// are shed, and wood thickens.
#include <array>

#include "core/generators/tree/grown_plant.h"
#include "core/geom/plant/shadow_grid.h"
#include "core/geom/plant/surroundings.h"

namespace seedmesh::tree {

/// A direction in which a bud samples the light: its angle from the heading, and its angle around the
/// heading.
struct LightSample {
  math::SinCos off{0, 1}, around{0, 1};
};
/// Number of samples in a ring. One sample is in the direction of the heading, and two rings are at half and
/// at all of the perception angle.
constexpr int samples_of_ring = 6;
using LightSamples = std::array<LightSample, 1 + 2 * samples_of_ring>;
/// Returns the samples for a perception angle in degrees.
LightSamples light_samples(double perception_angle);

/// The parameters and the surroundings of a growing plant. All members are borrowed, except `samples`.
struct GrownSite {
  const TreeGrown& grown;
  const RandomStreams& random;
  ShadowGrid& shadows;
  const Surroundings* obstacles;  ///< null: none
  Job& job;
  LightSamples samples;
};

/// Sets the exposure of each bud to light, 0 .. 1: 1 - shade + the shade of its own internode.
void sense_light(GrownPlant& plant, const GrownSite& site);

/// Grows the shoot of each bud whose vigour is at least 1, and removes buds that die. A shoot has
/// floor(vigour) internodes of the length vigour / floor(vigour), as a share of the length of an internode.
/// Returns the number of internodes that grew.
std::uint64_t grow_shoots(GrownPlant& plant, const GrownSite& site, std::uint16_t year);

/// Removes branches whose vigour by internode is below the threshold, and wood without living buds.
void shed_branches(GrownPlant& plant, const GrownSite& site, std::uint16_t year);

/// Pipe model: the area of each internode is the sum of those it carries. It never becomes smaller.
void thicken(GrownPlant& plant, const TreeGrown& grown);

}  // namespace seedmesh::tree
