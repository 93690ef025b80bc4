#pragma once
/// What is measured of the ground and of the contents of a square; used for the boxes and the errors of tiles.
#include <algorithm>
#include <array>

#include "core/generators/world/error_model.h"
#include "core/generators/world/land_rows.h"

namespace seedmesh::world {

/// The measurements in a square. Arrays of four are of its west, south, east and north border.
struct Area {
  double low = 1e12, high = -1e12;
  std::array<double, 4> borders{1e12, 1e12, 1e12, 1e12};  ///< the lowest samples
  double lowest = 1e12, highest = -1e12;                  ///< height range of water, roads and houses
  /// The lowest to which water and roads can cut the ground.
  std::array<double, 4> border_cuts{1e12, 1e12, 1e12, 1e12};
  Roughness rough;
  std::array<Roughness, 4> border_rough;
  bool has_valleys = true;  ///< false where samples are of the land alone
  double plant_height = 0;  ///< height of the tallest class that may grow here
  double plant_top = 0;     ///< bound of the height of plants above the ground

  /// Adds a sample. `is_border`: the borders that it is on.
  void add(const GroundSample& sample, const std::array<bool, 4>& is_border);
  /// Adds the samples of a row. `row`: from area_of_row().
  void add(const Area& row, bool is_south_border, bool is_north_border);
  double border() const { return *std::min_element(borders.begin(), borders.end()); }
  double border_cut() const { return *std::min_element(border_cuts.begin(), border_cuts.end()); }
  /// Returns the roughness of all four borders. What samples lack is that of the whole square.
  Roughness rough_border() const;
};

/// Returns the measurements of the samples first to last of a row. Its west and its east border are those two samples.
Area area_of_row(const LandRow& land, std::size_t first, std::size_t last);

/// Returns the measurements of the square that four squares form.
Area joined(const Area& sw, const Area& se, const Area& nw, const Area& ne);

}  // namespace seedmesh::world
