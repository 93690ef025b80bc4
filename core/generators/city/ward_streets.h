#pragma once
/// Streets along the cells of a town of wards; see wards.h.
#include <cstdint>
#include <vector>

#include "core/generators/city/wards.h"

namespace seedmesh {
struct CityStreets;
}

namespace seedmesh::city {

constexpr double wall_width = 3;  // m

/// Cells with common corners, in centimetres. Rings are counter-clockwise lists of corners.
struct WardCells {
  std::vector<CmPoint> corner;
  std::vector<std::vector<std::uint32_t>> rings;
  std::vector<glm::dvec2> middle;

  /// Returns the first corner within `reach` (cm) of `p`. Adds a corner if there is none.
  std::uint32_t corner_near(const glm::dvec2& p, double reach);
  CmRing ring_of(std::uint32_t cell) const;
};

/// Returns the corners around a set of cells, counter-clockwise. Returns an empty list unless the cells have one
/// outline, which does not touch itself.
std::vector<std::uint32_t> outline_of(const WardCells& cells, const std::vector<std::uint32_t>& chosen);

struct WardStreetInput {
  const CityStreets& streets;
  const WardGround& ground;
  std::uint32_t wall_tag = 0;  ///< tag of streets along the wall, whose right side is outside
  Rng rng;
};

/// Adds gates, the streets between the cells, and the roads out of the gates to the plan. The first cell is the square.
void add_ward_streets(WardPlan& plan, const WardCells& cells, const std::vector<std::uint32_t>& chosen,
                      const std::vector<std::uint32_t>& outline, const WardStreetInput& input);

}  // namespace seedmesh::city
