#include "core/generators/world/error_model.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/gullies.h"
#include "core/generators/world/roads.h"

namespace seedmesh::world {
namespace {

constexpr double deviation_share = 0.95;  ///< fitted to walks through worlds with random parameters
constexpr double measured_share = 1.2;  ///< samples at half the spacing miss a part of the greatest deviation
constexpr double terrace_share =
    0.3;  ///< share of the terraces, whose edges also make the sides of valleys steeper

/// The deviation of an octave of noise of amplitude 1; `q` is the distance of samples by the wavelength.
double of_noise(double q) {
  const double square = q * q;
  return std::min(1.46, 2.75 * square / (1 + 1.35 * square));
}

/// The deviation of squared crests of amplitude 1 that are rounded within `k`.
double of_crest(double q, double k) {
  const double round = 3.1 * q * q / k, sharp = 3 * q;
  return std::min(0.97, round * sharp / std::sqrt(round * round + sharp * sharp));
}

/// A norm of degree 1.5.
class Sum {
 public:
  void add(double part) { sum_ += part * std::sqrt(part); }
  double value() const { return math::cbrt(sum_ * sum_); }

 private:
  double sum_ = 0;
};

void add_octaves(Sum& sum, double spacing, double wavelength, int count, double amplitude) {
  for (int n = 0; n < count; ++n, wavelength *= 0.5, amplitude *= 0.5)
    sum.add(amplitude * of_noise(spacing / wavelength));
}

void add_ranges(Sum& sum, const WorldRelief& relief, double spacing, const Roughness& rough) {
  const double k = 0.02 + 0.35 * (1 - relief.ridges);
  double total = 0, amplitude = 1;
  for (int n = 0; n < range_octaves; ++n, amplitude *= range_fall) total += amplitude;
  amplitude = 1.6 * relief.mountains / total;
  double wavelength = range_wavelength;
  for (const double ridge : rough.ridges) {
    sum.add(amplitude * ridge * of_crest(spacing / wavelength, k));
    amplitude *= range_fall;
    wavelength *= 0.5;
  }
  // the belts in which mountains stand
  sum.add(1.1 * relief.mountains * rough.ruggedness * of_noise(spacing / 32000));
}

/// Adds the deviations of the parts of the land.
void add_land(Sum& sum, const WorldRelief& relief, double spacing, const Roughness& rough) {
  const double coast = (rough.has_sea_floor ? sea_fall : land_rise) * 1.5 / 1.875;
  add_octaves(sum, spacing, relief.continents, 4, coast);
  if (rough.ruggedness > 0) add_ranges(sum, relief, spacing, rough);
  add_octaves(sum, spacing, hill_wavelength, hill_octaves, 1.5 / 1.75 * relief.hills);
  const double steps = spacing * rough.slope / terrace_step;
  sum.add(relief.terraces * terrace_step * std::min(0.22, 1.45 * steps * steps));
}

/// Returns the deviation of a sum of parts. A part stops growing where samples are farther apart than its wavelength.
double corrected(const Sum& sum, const WorldRelief& relief, double spacing) {
  const double far = spacing > 1024 ? 1 + 0.12 * (spacing / (spacing + 8192)) : 1;
  return (deviation_share + terrace_share * relief.terraces) * far * sum.value();
}

/// Returns the greatest strength of gullies on slopes of at most `slope`.
double strength_of_gullies(const WorldRelief& relief, double slope) {
  return relief.gullies * smooth_step(1.15 * slope + 0.02, 0.04, 0.45);
}

/// Stripes bend where the direction of the slope changes, so they deviate by half more than straight ones.
void add_gullies(Sum& sum, const WorldRelief& relief, double spacing, double slope) {
  const double strength = strength_of_gullies(relief, slope);
  double wavelength = widest_gully;
  for (int n = 0; n < gully_octaves; ++n, wavelength *= gully_fall)
    sum.add(2.1 * strength * gully_depth * wavelength * of_noise(spacing / wavelength));
}

/// The amplitude of the widest octave of detail. Terraces make its slopes steeper.
double amplitude_of_detail(const World& world, const Roughness& rough) {
  const double terraces = world.params.relief.terraces;
  return (1 + 0.6 * terraces) * detail_share(world, rough.ruggedness) * detail_wavelength;
}

/// Valley sides meet the land and the flat beside the water with an angle.
void add_valley(Sum& sum, double spacing, const Roughness& rough) {
  if (rough.valley <= 0) return;
  // sides are steeper the deeper the valley; where samples are far apart, both sides lie between two of them
  const double angle = 0.16 + 0.36 * rough.ruggedness + 0.0025 * rough.valley + 0.5 * rough.slope;
  const double bent = angle * spacing / 4 * (1 + spacing / (spacing + 300)), rounded = bent * bent / 6;
  sum.add(std::min(rough.valley, std::min(bent, rounded)));
  // the bed and its banks
  sum.add(std::min({0.12 * spacing, 0.35 * rough.valley, 4.5}));
}

}  // namespace

void Roughness::add(const GroundSample& sample) {
  ruggedness = std::max(ruggedness, sample.land.ruggedness);
  for (std::size_t n = 0; n < ridges.size(); ++n)
    ridges[n] = std::max(ridges[n], static_cast<double>(sample.land.ridges[n]));
  const Slope& h = sample.land.height;
  slope = std::max(slope, std::sqrt(h.east * h.east + h.north * h.north));
  has_sea_floor |= sample.land.coast < sea_floor_coast;
  valley = std::max(valley, sample.cut + (sample.shore < 60 ? 3 : 0));
  works = std::max(works, sample.works);
}

void Roughness::add(const Roughness& other) {
  ruggedness = std::max(ruggedness, other.ruggedness);
  for (std::size_t n = 0; n < ridges.size(); ++n) ridges[n] = std::max(ridges[n], other.ridges[n]);
  slope = std::max(slope, other.slope);
  has_sea_floor |= other.has_sea_floor;
  valley = std::max(valley, other.valley);
  river = std::max(river, other.river);
  works = std::max(works, other.works);
  measured = std::max(measured, other.measured);
  measured_spacing = std::max(measured_spacing, other.measured_spacing);
}

Roughness roughest(const World& world) {
  Roughness rough;
  rough.ruggedness = world.params.relief.mountains > 0 ? 1 : 0;
  rough.ridges.fill(rough.ruggedness);
  rough.slope = 2;
  rough.has_sea_floor = true;
  rough.valley =
      20 + 0.4 * (2 * sea_fall + 3 * world.params.relief.mountains + 3 * world.params.relief.hills);
  rough.works = most_works;
  return rough;
}

Margins detail_of(const World& world, const Roughness& rough, double land) {
  const WorldRelief& relief = world.params.relief;
  Sum below, above;
  below.add(land);
  above.add(land);
  double amplitude = amplitude_of_detail(world, rough);
  for (int n = 0; n < detail_octaves; ++n, amplitude *= 0.5) {
    below.add(amplitude);
    above.add(amplitude);
  }
  // gullies_at() gives -1.3 to 0.7 of their depths, which all of its octaves reach at one position
  double depths = 0, depth = 1.4 * strength_of_gullies(relief, rough.slope) * gully_depth * widest_gully;
  for (int n = 0; n < gully_octaves; ++n, depth *= gully_fall) depths += depth;
  below.add(1.3 * depths);
  above.add(0.7 * depths);
  return {below.value(), above.value()};
}

double land_deviation_of(const World& world, double spacing, const Roughness& rough) {
  Sum sum;
  add_land(sum, world.params.relief, spacing, rough);
  return corrected(sum, world.params.relief, spacing);
}

double deviation_of(const World& world, double spacing, const Roughness& rough) {
  const WorldRelief& relief = world.params.relief;
  Sum sum;
  // what was measured leaves to the model what lies between the samples
  const bool has_mesh_deviation = rough.mesh_deviation.spacing > 0 && rough.mesh_deviation.spacing == spacing;
  const double of_land = has_mesh_deviation ? rough.mesh_deviation.finer_spacing : spacing;
  const double of_valleys =
      has_mesh_deviation && rough.mesh_deviation.has_valleys ? rough.mesh_deviation.finer_spacing : spacing;
  const double of_ground =
      has_mesh_deviation && rough.mesh_deviation.has_detail ? rough.mesh_deviation.finer_spacing : spacing;
  if (has_mesh_deviation) sum.add(rough.mesh_deviation.most);
  add_land(sum, relief, of_land, rough);
  add_octaves(sum, of_ground, detail_wavelength, detail_octaves, amplitude_of_detail(world, rough));
  add_gullies(sum, relief, of_ground, rough.slope);
  add_valley(sum, of_valleys, rough);
  sum.add(std::min(rough.works, 0.2 * of_ground));
  // what was measured does not saturate
  const double modelled = corrected(sum, relief, has_mesh_deviation ? 0 : spacing);
  return std::max(modelled,
                  measured_share * rough.measured * std::min(1.0, spacing / rough.measured_spacing));
}

}  // namespace seedmesh::world
