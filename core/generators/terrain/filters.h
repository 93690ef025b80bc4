#pragma once
/// Filters of whole fields. The result does not depend on the number of threads.
#include <optional>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// Applies the recursive low-pass filter that HeightMap Generator calls erosion (Kogovšek 2014, section
/// 5.3.1, after Polack). It is h[i] = k h[i-1] + (1 - k) h[i] with k = percent / 100, applied eastwards,
/// westwards, southwards and northwards. 0 changes nothing; 100 sets every sample to the height of the
/// north-west corner. Cost: about 3 ns for each sample.
void smooth(Field& field, double percent, const Job& job);

/// Returns the reach of smooth_by_position() in samples: the smallest r with k^r < 2^-24, the relative
/// precision of a float.
std::int32_t smooth_reach(double percent);

/// Applies the same low-pass to a window of an infinite field. The recursion starts smooth_reach() samples
/// before each sample, so the result depends only on samples within that distance and not on the window.
/// Samples nearer than that to the edge of the margin are inexact. Cost: about 0.5 ns for each sample and
/// sample of reach.
void smooth_by_position(Field& field, double percent, const Job& job);

/// Two heights, in metres.
struct Heights {
  double low = 0, high = 0;
};

/// Maps heights linearly so that `from` becomes `to`, including the margin. Other heights are extrapolated.
void stretch(Field& field, const Heights& from, const Heights& to, const Job& job);

/// Maps the heights linearly to [low, high]. A flat field becomes `low`. Requires margin 0.
void normalise(Field& field, double low, double high, const Job& job);

struct TerracePlan {
  int count = 8;         ///< steps between the lowest and the highest height
  double sharpness = 0;  ///< 0 keeps the heights, 1 makes sharp steps
  /// The `count` steps divide this range; beyond it the steps continue with the same height. Without it the
  /// range of the field is used, which needs margin 0.
  std::optional<Heights> from = {};
};
void terrace(Field& field, const TerracePlan& plan, const Job& job);

struct IslandPlan {
  double reach = 0.8;  ///< distance of the coast from the centre, as a share of half the smaller side
  /// depth of the rim below the lowest height, in metres; absent: a quarter of the range
  std::optional<double> depth = {};
  double roughness = 0;              ///< deviation of the coast from a circle, 0 to 1
  std::optional<double> floor = {};  ///< height of the rim instead of a depth; required with a margin
  /// `side` is the side in samples of the square that contains the whole island; 0: the island fills this
  /// field. `x` and `z` are the position of sample (0, 0) of the field in that square.
  std::int64_t side = 0, x = 0, z = 0;
};
void sink_rim(Field& field, const IslandPlan& plan, Rng rng, const Job& job);

struct ThermalPlan {
  int iterations = 0;
  double talus = 1;  ///< tangent of the steepest stable slope
  double rate = 0.5;
};

/// Applies thermal erosion (weathering) over eight neighbours, with all samples of a round at once. Source:
/// Musgrave, Kolb and Mace, "The synthesis and rendering of eroded fractal terrains", 1989. It conserves
/// material. A sample depends on samples at most `iterations` away, so tiles with a margin of that width
/// agree. Cost: about 3 ns for each sample and round.
void erode_thermally(Field& field, const ThermalPlan& plan, const Job& job);

struct DropletPlan {
  int droplets = 65'536;
  double lifetime = 32;  ///< lifetime in samples
  double inertia = 0.1, capacity = 4, erosion = 0.3, deposition = 0.3, evaporation = 0.02;
  double radius = 2;  ///< radius of the ground that a drop erodes, in samples; at most 8
};

/// Applies hydraulic erosion by drops after Beyer, "Implementation of a method for hydraulic erosion", 2015.
/// Drops fall in batches whose number and size depend on the field alone. The drops of a batch see the same
/// ground, and their changes are added in order. Cost: about 0.64 microseconds for a drop, with its share of the batches.
void erode_by_droplets(Field& field, const DropletPlan& plan, Rng rng, const Job& job);

struct StreamPlan {
  int iterations = 20;
  double strength = 0.5;
  double area_exponent = 0.5;
};

/// Cuts rivers by the stream power law, implicit in time. Source: Braun and Willett, "A very efficient O(n),
/// implicit and parallel method to solve the stream power equation", 2013. Water leaves every depression at
/// its lowest rim (flow.h). The border is fixed. Cost: about 250 ns for each sample and step.
void erode_by_streams(Field& field, const StreamPlan& plan, const Job& job);

}  // namespace seedmesh::terrain
