#pragma once
/// Heights along one line from west to east, as a graph.
///
/// Fractional Brownian motion is a Gaussian process. The difference of two values at the distance d has the
/// variance d^(2 H). Source: Mandelbrot and Van Ness, "Fractional Brownian motions, fractional noises and
/// applications", 1968.
#include "core/base/array.h"
#include "core/base/rng.h"
#include "core/model/model.h"

namespace seedmesh {
struct TerrainParams;
}

namespace seedmesh::terrain {

/// Greatest number of samples of a profile by fractional Brownian motion, because the cost grows with the
/// square of this number.
constexpr int longest_brownian = 4097;

/// Returns `count` heights, of which the first is 0. The last has the standard deviation `amplitude`. The process
/// is exact: each step is drawn from its distribution given all steps before it (Hosking, "Modeling persistence
/// in hydrological time series using fractional differencing", 1984). 0 < hurst < 1. About 1 ns for each pair of
/// samples.
Array<float> brownian_heights(int count, double hurst, double amplitude, Rng rng, const Job& job);

/// Returns the heights of a request with the shape `profile`.
Array<float> profile_heights(const TerrainParams& params, const Job& job);

/// Returns the graph as lines in the plane z = 0, centred on x = 0.
Model profile_model(const TerrainParams& params, Job& job);

}  // namespace seedmesh::terrain
