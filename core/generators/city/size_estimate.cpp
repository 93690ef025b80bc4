// An estimate before growth, so that requests far beyond the limits are refused early.
#include <algorithm>

#include "core/generators/city/growth.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

constexpr double least_density = 0.5;  // where the counts below were measured
constexpr double safety = 0.8;
constexpr double piece_of_a_major = 30;  // m
// Minor streets of usual lengths and clearances, which are cut into pieces, for each square kilometre.
constexpr double unbranched = 250, branched = 600, usual_branches = 0.4;
constexpr double usual_length = 75, usual_clearance = 32;  // m
constexpr double share_of_rings = 0.7;                     // of the pieces of a square net

/// Pieces of streets for each square kilometre of even, dense ground.
double pieces_on_dense_ground(const CityStreets& streets) {
  const bool is_raster = streets.method == CityMethod::growth && streets.pattern == CityPattern::raster;
  if (is_raster && (!streets.minor_pattern || *streets.minor_pattern == CityMinorPattern::raster))
    return 2 * (1000 / streets.block[0]) * (1000 / streets.block[1]) * streets.fill;
  const double fill = streets.method == CityMethod::growth ? streets.fill : 1;
  const bool is_radial = streets.method == CityMethod::growth && streets.pattern == CityPattern::radial;
  const double net = 2 * (1000 / streets.major_spacing) * (1000 / piece_of_a_major) * fill;
  const bool has_minors =
      !is_raster && streets.length <= usual_length && streets.clearance <= usual_clearance;
  const double minors = unbranched + branched * std::min(usual_branches, streets.branch_probability);
  return net * (is_radial ? share_of_rings : 1) + (has_minors ? minors : 0);
}

}  // namespace

double least_pieces(const GrowthInput& input) {
  const CityStreets& streets = input.streets;
  const bool is_usual = (streets.method == CityMethod::growth || streets.method == CityMethod::tensor) &&
                        streets.productions == CityStreets{}.productions;
  if (!is_usual || input.landform) return 0;
  double square_metres = 0;
  for (const CmRing& ring : input.region.rings)
    square_metres += static_cast<double>(doubled_area(ring)) / 2e4;
  const std::vector<glm::dvec2> lattice = lattice_of(input.region);
  const auto dense = std::count_if(lattice.begin(), lattice.end(), [&](const glm::dvec2& p) {
    return input.density.at(p / 100.0) >= least_density &&
           !(input.obstacles && input.obstacles->at(p / 100.0) >= 0.5);
  });
  if (lattice.empty()) return 0;
  const double share = static_cast<double>(dense) / static_cast<double>(lattice.size());
  return safety * share * square_metres / 1e6 * pieces_on_dense_ground(streets);
}

}  // namespace seedmesh::city
