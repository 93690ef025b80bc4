/// Hanging twigs against Salix babylonica in floras: alternate lanceolate leaves of 8 to 16 cm by 0.8 to 2 cm that point to
/// the ends of long thin shoots.
#include "core/geom/plant/leafy_twig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace seedmesh {
namespace {

double length_of(glm::dvec2 v) { return std::sqrt(v.x * v.x + v.y * v.y); }

LeafDrawing willow_twig() { return draw_leaf(LeafShape::willow, {}, 91); }

TEST(HangingTwig, HasTheNumberOfLeavesThatIsGiven) {
  for (const int count : {20, 57, 91})
    EXPECT_EQ(draw_leaf(LeafShape::willow, {}, count).blades.size(), static_cast<std::size_t>(count));
}

TEST(HangingTwig, HasLeavesAsLongAndNarrowAsThoseOfWeepingWillows) {
  // On a card of the preset, which is square.
  const LeafDrawing twig = willow_twig();
  const glm::dvec2 centimetres = 48.0 / (twig.high - twig.low);
  std::vector<double> lengths;
  for (const LeafBlade& blade : twig.blades) {
    lengths.push_back(length_of(centimetres * (blade.tip - blade.base)));
    EXPECT_LE(2 * blade.half_width * centimetres.x, 2);
  }
  std::sort(lengths.begin(), lengths.end());
  EXPECT_GE(lengths[lengths.size() / 2], 8);
  EXPECT_LE(lengths.back(), 16);
}

TEST(HangingTwig, HasLeavesThatPointToTheEndsOfTheirShoots) {
  const LeafDrawing twig = willow_twig();
  double down = 0;
  for (const LeafBlade& blade : twig.blades) {
    const glm::dvec2 way = (blade.tip - blade.base) / length_of(blade.tip - blade.base);
    down += way.y / static_cast<double>(twig.blades.size());
    EXPECT_GT(way.y, -0.2);
  }
  EXPECT_GE(down, 0.75);  // the cosine of 41 degrees
}

// core/generators/tree/far_leaves.cpp draws twigs on triangles with these sides, without the last tips beside the middle.
TEST(HangingTwig, EndsInAPointSoThatATriangleCoversIt) {
  const LeafDrawing twig = willow_twig();
  const glm::dvec2 extent = twig.high - twig.low;
  for (const LeafBlade& blade : twig.blades) {
    const double above = (blade.tip.y - twig.low.y) / extent.y, aside = (blade.tip.x - twig.low.x) / extent.x;
    EXPECT_LE(std::abs(aside - 0.5), 0.1 + 0.96 * (1.25 - above) / 1.25);
  }
}

}  // namespace
}  // namespace seedmesh
