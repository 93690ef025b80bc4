#pragma once
/// Streets across large cells. They depend on the outline alone, so that a change on one side of them hardly affects
/// the other side.
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/rng.h"
#include "core/generators/city/network.h"

namespace seedmesh::city {

/// The rings of nodes around a cell: the outer one counter-clockwise, then holes.
using CellRings = std::vector<std::vector<std::uint32_t>>;

struct DivisionRules {
  double largest = 0;  ///< area of a part that is not divided, square centimetres
  double bend = 0;     ///< greatest turn of a street between its ends, degrees
  Rng rng{0};          ///< the random choices depend on it and on positions
  /// Returns the direction of the pattern that is nearest to a direction at a position (cm).
  std::function<glm::dvec2(const glm::dvec2& direction, const glm::dvec2& at)> aligned;
  /// Whether a street may start or end at a node of a street.
  std::function<bool(std::uint32_t node)> may_end;
  /// Whether a street may run along a segment (cm).
  std::function<bool(const glm::dvec2& from, const glm::dvec2& to)> may_pass;
};

/// Divides a cell, and its parts, by minor streets from a node of the outer ring to another one or to the border, until no part is larger than
/// `rules.largest` or no street fits. Returns the nodes of each street. Cost: for each street 16 times the rings.
std::vector<std::vector<std::uint32_t>> divide_cell(Network& network, const CellRings& rings,
                                                    const DivisionRules& rules);

/// The direction into a cell that halves the angle at `node`. The neighbours stand in the order of a ring around the
/// cell.
glm::dvec2 inward_at(const Network& network, std::uint32_t before, std::uint32_t node, std::uint32_t after);

}  // namespace seedmesh::city
