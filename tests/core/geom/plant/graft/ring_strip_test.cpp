#include "core/geom/plant/graft/ring_strip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <set>
#include <utility>

#include "core/base/math.h"

namespace seedmesh {
namespace {

/// A regular polygon around the y axis: its corners, the first one again at the end, in `position`.
RingCorners polygon(int sides, double radius, double height, std::vector<glm::vec3>& position) {
  RingCorners ring;
  for (int i = 0; i <= sides; ++i) {
    const double angle = 2 * math::pi * i / sides;
    const math::SinCos at = math::sincos(angle);
    ring.push_back({static_cast<float>(angle), static_cast<std::uint32_t>(position.size())});
    position.emplace_back(radius * at.cos, height, -radius * at.sin);
  }
  return ring;
}

/// The corners of a closed solid between two polygons and their centres.
std::vector<std::uint32_t> solid(int below, int above, double radius_below, double radius_above,
                                 std::vector<glm::vec3>& position) {
  const RingCorners low = polygon(below, radius_below, 0, position);
  const RingCorners high = polygon(above, radius_above, 1, position);
  const auto floor = static_cast<std::uint32_t>(position.size());
  position.emplace_back(0, 0, 0);
  position.emplace_back(0, 1, 0);
  position.emplace_back(0, 0, 0);  // a float behind the last position is read
  const std::size_t strip = strip_triangles(low, high);
  std::vector<std::uint32_t> index(3 * (strip + static_cast<std::size_t>(below + above)));
  write_strip(low, high, 0.3F, position.data(), index.data());
  write_fan(low, floor, true, index.data() + 3 * strip);
  write_fan(high, floor + 1, false, index.data() + 3 * (strip + static_cast<std::size_t>(below)));
  return index;
}

double volume_of(const std::vector<std::uint32_t>& index, const std::vector<glm::vec3>& position) {
  double six = 0;
  for (std::size_t i = 0; i < index.size(); i += 3) {
    const glm::dvec3 a(position[index[i]]), b(position[index[i + 1]]), c(position[index[i + 2]]);
    six += glm::dot(a, glm::cross(b, c));
  }
  return six / 6;
}

TEST(RingStrip, HasTheVolumeOfAPrismOrAFrustum) {
  for (const int sides : {3, 4, 7, 24, 64}) {
    std::vector<glm::vec3> position;
    const auto index = solid(sides, sides, 1, 0.5, position);
    // A frustum: (A + B + sqrt(A B)) h / 3. Its flanks are flat, whichever diagonal is taken.
    const double area = 0.5 * sides * math::sin(2 * math::pi / sides);
    EXPECT_NEAR(volume_of(index, position), area * (1 + 0.25 + 0.5) / 3, 2e-6) << sides;
  }
}

TEST(RingStrip, JoinsAnyTwoRingsToAClosedSurfaceOfGenusZero) {
  for (int below = 3; below <= 20; ++below) {
    for (int above = 3; above <= 20; above += 3) {
      std::vector<glm::vec3> position;
      auto index = solid(below, above, 1, 0.8, position);
      const auto first_of_high = static_cast<std::uint32_t>(below) + 1;
      for (std::uint32_t& vertex : index) {  // the seam is welded
        if (vertex == static_cast<std::uint32_t>(below)) vertex = 0;
        if (vertex == first_of_high + static_cast<std::uint32_t>(above)) vertex = first_of_high;
      }
      std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
      for (std::size_t i = 0; i < index.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_TRUE(edges.emplace(index[i + k], index[i + (k + 1) % 3]).second) << "an edge twice";
      }
      for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a})) << "an open edge";
      const auto vertices = static_cast<std::size_t>(below + above + 2);
      EXPECT_EQ(vertices + index.size() / 3 - edges.size() / 2, 2U) << "Euler characteristic";
    }
  }
}

}  // namespace
}  // namespace seedmesh
