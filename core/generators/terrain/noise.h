#pragma once
/// Fields as sums of octaves of gradient noise (Perlin, "Improving noise", 2002): fractal Brownian motion,
/// ridged multifractal (Musgrave, in Ebert et al., "Texturing and Modeling", 2003) and billow, with domain
/// warping (Quilez). A height is a function of the place in the world, so that any window agrees with any
/// other.
#include <glm/vec3.hpp>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

enum class NoiseKind { rolling, ridged, billow };

struct NoisePlan {
  NoiseKind kind = NoiseKind::rolling;
  int octaves = 8;
  double amplitude = 0;   ///< of the first octave, in metres
  double gain = 0.5;      ///< from octave to octave
  double wavelength = 1;  ///< of the first octave, in metres
  double lacunarity = 2;
  double warp = 0;          ///< how far places are moved, in metres
  std::int64_t repeat = 0;  ///< lattice cells of the first octave after which everything repeats; 0: never
};

/// Cost: about 2 ns an octave and sample; 12 ns where the ground is warped.
Field noisy(const NoisePlan& plan, const Window& window, double cell, Rng rng, const Job& job);

/// The same in space, for spheres: the height at a place in metres. About 20 ns an octave.
double noise_in_space(const NoisePlan& plan, const glm::dvec3& place, Rng rng);

}  // namespace seedmesh::terrain
