/// Squares of a cell inside the disc around a position in a neighbouring cell, against distances to corners.
#include "core/generators/scene/covered_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/rng.h"

namespace seedmesh::scene {
namespace {

/// The distance in cells from `from` to the farthest corner of square `part` of the centre cell.
double to_farthest_corner(const glm::dvec2& from, int part) {
  double farthest = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const double x = (part % parts_a_side + corner % 2) / double{parts_a_side};
    const double z = (part / parts_a_side + corner / 2) / double{parts_a_side};
    farthest = std::max(farthest, std::hypot(x - from.x, z - from.y));
  }
  return farthest;
}

TEST(CoveredParts, AreInsideTheDiscAndMissOnlySquaresAtItsRim) {
  // A position and its box of 1/16 differ by at most the diagonal of the box.
  const double radius = std::sqrt(2.0), rounding = std::sqrt(2.0) / 16;
  Rng rng(1);
  int covered = 0, inside = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t offset = rng.below(cells_around.size());
    const double x = rng.unit();
    const glm::dvec2 at(x, rng.unit());
    const glm::dvec2 position = at + glm::dvec2(cells_around[offset].x, cells_around[offset].z);
    const CellParts parts = covered_parts().of(offset, glm::vec2(at));
    for (int part = 0; part < 64; ++part) {
      const double distance = to_farthest_corner(position, part);
      const bool is_covered = ((parts >> static_cast<unsigned>(part)) & 1U) != 0;
      covered += is_covered ? 1 : 0;
      inside += distance < radius ? 1 : 0;
      if (is_covered) {
        ASSERT_LT(distance, radius);
      } else {
        ASSERT_GE(distance, radius * (1 - 1e-6) - rounding);
      }
    }
  }
  EXPECT_GT(covered, inside * 8 / 10);
}

}  // namespace
}  // namespace seedmesh::scene
