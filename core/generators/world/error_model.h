#pragma once
/// Estimates how far the ground can be from the triangles between samples of it. Each part of the ground
/// contributes by its amplitude at the position and by the ratio of the spacing of the samples to its wavelength.
///
/// The deviations of single octaves of noise were measured with 40 grids of 32 x 32 cells for each ratio. Parts do
/// not reach their greatest deviation at one position, so they are added with a norm of degree 1.5.
#include <array>

#include "core/generators/world/ground.h"

namespace seedmesh::world {

/// Greatest side, in metres, of a tile whose rivers are computed. In wider tiles the depths of valleys are estimated,
/// because the rivers of wide areas take too long.
constexpr double widest_known_rivers = 8192;

/// Returns an estimate, in metres, of the depth of valleys in land whose heights differ by `range` metres.
constexpr double guessed_valley(double range) { return 20 + 0.4 * range; }

/// Returns the greatest depth of valleys, in metres, for which skirts of tiles wider than `widest_known_rivers` allow. `range`: of
/// the heights of the land. Half of the borders of 640 such tiles have valleys less than a quarter as deep as guessed.
constexpr double valley_of_skirts(double range) { return guessed_valley(range) / 3; }

/// The measured distance of samples from the triangles of a tile.
struct MeshDeviation {
  double most = 0;           ///< metres
  double spacing = 0;        ///< spacing of the vertices of the tile; 0 if nothing was measured
  double finer_spacing = 0;  ///< spacing of the samples
  bool has_valleys = false, has_detail = false;  ///< whether the samples have them; detail includes roads
  bool is_estimate = false;  ///< estimated from cells twice as wide, because no samples lie inside the cells
};

constexpr double sea_floor_coast = 0.05;  ///< coast of Land below which the ground is the floor of the sea

/// The roughness of the ground of an area: the greatest values over the area.
struct Roughness {
  double ruggedness = 0;                       ///< ruggedness of Land
  std::array<double, range_octaves> ridges{};  ///< ridges of Land
  double slope = 0;                            ///< slope of the land
  bool has_sea_floor = false;
  double valley = 0;  ///< metres that rivers and lakes cut into the land; 0 without water nearby
  double river = 0;   ///< half of the width of the widest river, metres
  double works = 0;   ///< metres that roads are above or below the ground

  double measured = 0, measured_spacing = 1;  ///< measured deviation from triangles with this spacing

  MeshDeviation mesh_deviation;  ///< deviation of the triangles of this area

  void add(const GroundSample& sample);
  void add(const Roughness& other);
};

/// Returns the roughest ground that a world can have.
Roughness roughest(const World& world);

/// How far the ground can be below and above the heights that it is compared with, in metres.
struct Margins {
  double below = 0, above = 0;
};
/// Returns how far gullies and finer wavelengths lower and raise the ground of an area. The octaves of finer wavelengths
/// do not reach their greatest values at one position, so they are added with the same norm as deviations: 1.34 of the
/// widest amplitude, which is what areas of 32 km have. `land`: what is added to it with the same norm, in metres.
Margins detail_of(const World& world, const Roughness& roughness, double land = 0);

/// Returns the metres between the land, without valleys and detail, and triangles through samples `spacing` metres apart.
double land_deviation_of(const World& world, double spacing, const Roughness& roughness);

/// Returns the metres between the ground and triangles through samples `spacing` metres apart. It rises with `spacing`.
double deviation_of(const World& world, double spacing, const Roughness& roughness);

}  // namespace seedmesh::world
