#pragma once
/// What changes a whole field after it was made. All of these give the same heights with any number of
/// threads.
#include <optional>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// The recursive low-pass of HeightMap Generator (Kogovšek 2014, section 5.3.1, after Polack), there called
/// erosion: h[i] = k h[i-1] + (1 - k) h[i] with k = percent / 100, once in each direction: eastwards,
/// westwards, southwards, northwards. 0 changes nothing, 100 gives every sample the north-western height.
/// About 3 ns a sample.
void smooth(Field& field, double percent, const Job& job);

/// Stretches the heights to [low, high]; a field that is even becomes `low`.
void normalise(Field& field, double low, double high, const Job& job);

/// `count` steps between lowest and highest height. sharpness 0 leaves the heights, 1 makes them steps.
void terrace(Field& field, int count, double sharpness, const Job& job);

struct IslandPlan {
  double reach = 0.8;                ///< of half the smaller side: where the coast lies
  std::optional<double> depth = {};  ///< of the rim below the lowest height; none: a quarter of the range
  double roughness = 0;              ///< how much the coast leaves the circle, 0 to 1
};
void sink_rim(Field& field, const IslandPlan& plan, Rng rng, const Job& job);

struct ThermalPlan {
  int iterations = 0;
  double talus = 1;  ///< tangent of the steepest slope that stays
  double rate = 0.5;
};

/// Thermal weathering after Musgrave, Kolb and Mace, "The synthesis and rendering of eroded fractal
/// terrains", 1989, over eight neighbours, all samples of a round at once; no ground is lost or gained. A
/// sample depends on those at most `iterations` away, so a margin of that width is what neighbours agree on.
/// About 3 ns a sample and round.
void slip(Field& field, const ThermalPlan& plan, const Job& job);

struct DropletPlan {
  int droplets = 65'536;
  double lifetime = 32;  ///< in samples
  double inertia = 0.1, capacity = 4, erosion = 0.3, deposition = 0.3, evaporation = 0.02;
  double radius = 2;  ///< of what a drop carves, in samples; at most 8
};

/// Hydraulic erosion by drops after Beyer, "Implementation of a method for hydraulic erosion", 2015. Drops
/// fall in batches whose number and size follow from the field alone: those of a batch see the same ground,
/// and what they did is added up in their order. About 1 microsecond a drop of 30 steps.
void erode(Field& field, const DropletPlan& plan, Rng rng, const Job& job);

struct StreamPlan {
  int iterations = 20;
  double strength = 0.5;
  double area_exponent = 0.5;
};

/// Rivers by the stream power law, implicit in time (Braun and Willett, "A very efficient O(n), implicit and
/// parallel method to solve the stream power equation", 2013), over flow that leaves every hollow at its
/// lowest rim (flow.h). The border stays. About 250 ns a sample and step.
void cut_rivers(Field& field, const StreamPlan& plan, const Job& job);

}  // namespace seedmesh::terrain
