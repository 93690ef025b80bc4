/// Needles against measured ones: those of Norway spruces are single and 1 to 2.5 cm long, those of Scots pines grow in
/// pairs and are 3 to 7 cm long.
#include "core/geom/plant/needle_twig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace seedmesh {
namespace {

/// The lengths of needles of a twig of some length, in centimetres.
std::vector<double> lengths_of(const LeafDrawing& twig, double centimetres) {
  std::vector<double> lengths;
  for (std::size_t i = twig.woody; i < twig.stalks.size(); ++i) {
    const glm::dvec2 way = twig.stalks[i].to - twig.stalks[i].from;
    lengths.push_back(centimetres * std::sqrt(way.x * way.x + way.y * way.y));
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

/// The mean number of needles that begin at the same point of a shoot.
double needles_at_a_point(const LeafDrawing& twig) {
  std::map<std::pair<double, double>, int> at;
  for (std::size_t i = twig.woody; i < twig.stalks.size(); ++i)
    ++at[{twig.stalks[i].from.x, twig.stalks[i].from.y}];
  return static_cast<double>(twig.stalks.size() - twig.woody) / static_cast<double>(at.size());
}

TEST(NeedleTwig, HasNeedlesOfTheLengthsOfSprucesAndPines) {
  // Some needles point to the viewer and look shorter, so the longer half counts. Twigs of the presets are 29 and 38 cm long.
  const std::vector<double> spruce = lengths_of(needle_twig(NeedleKind::single, 13), 29);
  const std::vector<double> pine = lengths_of(needle_twig(NeedleKind::paired, 7), 38);
  EXPECT_GE(spruce[spruce.size() / 2], 1);
  EXPECT_LE(spruce.back(), 2.6);
  EXPECT_GE(pine[pine.size() / 2], 3);
  EXPECT_LE(pine.back(), 7);
}

TEST(NeedleTwig, HasPairsOfNeedlesOnPinesAlone) {
  // One needle on each side of a point, or one pair.
  EXPECT_NEAR(needles_at_a_point(needle_twig(NeedleKind::single, 13)), 2, 0.1);
  EXPECT_NEAR(needles_at_a_point(needle_twig(NeedleKind::paired, 7)), 4, 0.4);
}

}  // namespace
}  // namespace seedmesh
