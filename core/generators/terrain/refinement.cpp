#include "core/generators/terrain/refinement.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/math.h"
#include "core/schema/json.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

/// Distance of a coordinate from an interval.
double outside(double value, double from, double to) { return std::max({from - value, value - to, 0.0}); }

/// Returns the number of halvings after which a length is at most `most`.
int halvings_of(double length, double most) {
  int count = 0;
  for (double side = length; side > most; side /= 2) ++count;
  return count;
}

/// Returns the triangles of a square of 2^level by 2^level squares; `edges`: the segments of its four sides.
std::uint64_t triangles_of(int level, std::uint64_t edges) {
  const std::uint64_t inner = (std::uint64_t{1} << static_cast<unsigned>(level)) - 2;
  return 2 * inner * inner + 4 * inner + edges;
}

}  // namespace

double Refinement::reach() const {
  double far = halvings > 0 ? radius : 0;
  for (int i = 1; i < halvings; ++i) far *= 2;
  return far;
}

int Refinement::level(std::int32_t i, std::int32_t j) const {
  if (i < 0 || j < 0 || i >= width - 1 || j >= depth - 1) return 0;
  const double x = outside(east, i * cell, (i + 1) * cell), z = outside(south, j * cell, (j + 1) * cell);
  const double squared = x * x + z * z;
  int level = halvings;
  for (double limit = radius; level > 0 && squared >= limit * limit; limit *= 2) --level;
  return level;
}

Window Refinement::squares() const {
  const auto square = [&](double at, std::int32_t count) {
    return std::clamp(math::to_int32(std::floor(at / cell)), 0, count - 1);
  };
  const std::int32_t west = square(east - reach(), width - 1), last_x = square(east + reach(), width - 1),
                     north = square(south - reach(), depth - 1), last_z = square(south + reach(), depth - 1);
  return {west, north, last_x - west + 1, last_z - north + 1};
}

Refinement refinement_of(const TerrainRefine& given, std::int32_t width, std::int32_t depth, double cell) {
  Refinement made;
  made.east = given.center[0] + (width - 1) / 2.0 * cell;
  made.south = given.center[1] + (depth - 1) / 2.0 * cell;
  made.radius = given.radius;
  made.step = given.step;
  made.relief = given.relief;
  made.cell = cell;
  made.width = width;
  made.depth = depth;
  made.halvings = halvings_of(cell, given.step);
  return made;
}

std::uint64_t added_triangles(const Refinement& refinement, std::uint64_t most) {
  const Window all = refinement.squares();
  std::uint64_t sum = 0;
  for (std::int32_t b = 0; b < all.depth && sum <= most; ++b) {
    const std::int32_t j = static_cast<std::int32_t>(all.z) + b;
    for (std::int32_t a = 0; a < all.width; ++a) {
      const std::int32_t i = static_cast<std::int32_t>(all.x) + a;
      const int own = refinement.level(i, j);
      if (own == 0) continue;
      std::uint64_t edges = 0;
      for (const int other : {refinement.level(i - 1, j), refinement.level(i + 1, j),
                              refinement.level(i, j - 1), refinement.level(i, j + 1)})
        edges += std::uint64_t{1} << static_cast<unsigned>(std::min(own, other));
      sum += triangles_of(own, edges) - 2;
    }
  }
  return sum;
}

void refuse_refinement(const Refinement& refinement, std::uint64_t others, const Job& job) {
  const double wide = (refinement.width - 1) * refinement.cell,
               deep = (refinement.depth - 1) * refinement.cell;
  if (outside(refinement.east, 0, wide) > 0 || outside(refinement.south, 0, deep) > 0) {
    job.refuse({IssueKind::out_of_range, "/refine/center",
                "found (" + number_text(refinement.east - wide / 2) + ", " +
                    number_text(refinement.south - deep / 2) + "); expected a point within " +
                    number_text(wide / 2) + " m of the middle to the east and west, and " +
                    number_text(deep / 2) + " m to the north and south"});
  }
  if (refinement.halvings == 0) {
    job.refuse({IssueKind::out_of_range, "/refine/step",
                "found " + number_text(refinement.step) + " m; the squares of the grid have sides of " +
                    number_text(refinement.cell) + " m, expected less"});
  }
  const std::uint64_t most = job.limits().triangles, added = added_triangles(refinement, most);
  if (others + added <= most) return;
  job.refuse(limit_issue({Resource::triangles, most, others + added},
                         "needs more than " + std::to_string(most) +
                             " triangles, which is the limit; expected a smaller radius or a larger step",
                         "/refine/radius"));
}

}  // namespace seedmesh::terrain
