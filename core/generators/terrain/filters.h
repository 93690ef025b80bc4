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

/// How many samples away smooth_by_place() looks: where k^reach falls below 2^-24, the last bit of a float.
std::int32_t smooth_reach(double percent);

/// The same low-pass for a piece of an endless field: the recursion starts smooth_reach() samples before each
/// sample, so that it depends on those at most so far away along either axis, and not on where the piece
/// begins. Samples nearer than that to the rim of the margin are not what they would be. About 0.5 ns a
/// sample and sample of reach.
void smooth_by_place(Field& field, double percent, const Job& job);

/// Two heights.
struct Heights {
  double low = 0, high = 0;
};

/// Stretches the heights, margin too, so that `from` becomes `to`; what lies outside goes on in the same
/// line.
void stretch(Field& field, const Heights& from, const Heights& to, const Job& job);

/// Stretches the heights to [low, high]; a field that is even becomes `low`. Margin 0.
void normalise(Field& field, double low, double high, const Job& job);

struct TerracePlan {
  int count = 8;         ///< steps between the lowest and the highest height
  double sharpness = 0;  ///< 0 leaves the heights, 1 makes them steps
  /// Counted between these heights, with more steps of the same height outside; none: those of the field,
  /// whose margin is 0 then.
  std::optional<Heights> from = {};
};
void terrace(Field& field, const TerracePlan& plan, const Job& job);

struct IslandPlan {
  double reach = 0.8;                ///< of half the smaller side: where the coast lies
  std::optional<double> depth = {};  ///< of the rim below the lowest height; none: a quarter of the range
  double roughness = 0;              ///< how much the coast leaves the circle, 0 to 1
  std::optional<double> floor = {};  ///< the height of the rim, in place of a depth; a margin needs it
  /// Samples a side of the ground that the island fills, and where in it sample (0, 0) lies; 0: the field.
  std::int64_t side = 0, x = 0, z = 0;
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
