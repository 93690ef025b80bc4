#pragma once
/// Fields as sums of octaves of gradient noise (Perlin, "Improving noise", 2002): fractal Brownian motion,
/// ridged multifractal (Musgrave, in Ebert et al., "Texturing and Modeling", 2003) and billow, with domain
/// warping (Quilez). A height depends only on the position in the world, so all windows agree.
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/generators/terrain/field.h"
#include "core/generators/terrain/octave.h"

namespace seedmesh::terrain {

enum class NoiseKind { rolling, ridged, billow };

struct NoisePlan {
  NoiseKind kind = NoiseKind::rolling;
  int octaves = 8;
  double amplitude = 0;   ///< amplitude of the first octave, in metres
  double gain = 0.5;      ///< factor from octave to octave
  double wavelength = 1;  ///< wavelength of the first octave, in metres
  double lacunarity = 2;
  double warp = 0;          ///< largest displacement by domain warping, in metres
  std::int64_t repeat = 0;  ///< period in lattice cells of the first octave; 0: no period
};

/// Returns the field of a window. Cost: about 2 ns for each octave and sample, 12 ns with warping.
Field noisy(const NoisePlan& plan, const Window& window, double cell, Rng rng, const Job& job);

/// Writes the heights of the same noise without warp at points of the plane, in metres. Cost: about 27 ns for each
/// octave and point.
void noise_in_plane(const NoisePlan& plan, std::span<const double> x, std::span<const double> z, Rng rng,
                    double* out);

/// The same noise for points that follow one another closely. It keeps the last cell of each octave. For one
/// thread.
class PlaneNoise {
 public:
  PlaneNoise(const NoisePlan& plan, Rng rng);
  float at(double x, double z);

 private:
  NoiseKind kind_;
  float amplitude_, gain_;
  std::vector<OctavePath> octaves_;
};

/// The same noise in space, for spheres. The gradients of the last cells are kept, for points that follow one another.
class SpaceNoise {
 public:
  SpaceNoise(const NoisePlan& plan, Rng rng);

  /// Returns the height at a point, in metres. Cost: about 12 ns for each octave in a known cell, 25 ns in a new one.
  double at(const glm::dvec3& position);

 private:
  struct Cell {
    std::array<std::int64_t, 3> low{};
    std::array<glm::dvec3, 8> gradients{};
    bool is_known = false;
  };
  struct Octave {
    std::uint64_t key;
    double frequency;
    float amplitude;
    std::array<Cell, 8> cells;

    const std::array<glm::dvec3, 8>& gradients_of(const std::array<std::int64_t, 3>& low);
    double value(const glm::dvec3& position);
  };

  NoiseKind kind_;
  std::vector<Octave> octaves_;
  std::vector<SpaceNoise> warp_;  ///< of the three axes, or empty
};

}  // namespace seedmesh::terrain
