#include "core/generators/tree/leaf_frames.h"

#include <gtest/gtest.h>

#include <vector>

namespace seedmesh::tree {
namespace {

struct Wanted {
  Frame stem;
  glm::dvec3 position;
  double about, down;
};

std::vector<Wanted> some(std::size_t count) {
  std::vector<Wanted> leaves;
  Rng rng(21);
  for (std::size_t i = 0; i < count; ++i) {
    Frame stem = pitch(roll(Frame{}, math::quick_sincos_degrees(rng.uniform(0, 360))),
                       math::quick_sincos_degrees(rng.uniform(0, 170)));
    leaves.push_back({stem,
                      {rng.uniform(-4, 4), rng.uniform(0, 9), rng.uniform(-4, 4)},
                      rng.uniform(-400, 400),
                      rng.uniform(-90, 90)});
  }
  leaves[0] = {Frame{}, {0, 1, 0}, 0, 0};   // on the axis
  leaves[1] = {Frame{}, {0, 1, 0}, 0, 90};  // level already
  leaves[2] = {Frame{}, {0, 1, 0}, 90, -90};
  return leaves;
}

TEST(LeafFrames, AreToTheBitThoseOfEachLeafByItself) {
  for (const double bend : {0.0, 0.3, 1.0}) {
    const std::vector<Wanted> leaves = some(101);
    LeafFrames frames;
    for (const Wanted& leaf : leaves) frames.add(leaf.stem, leaf.position, leaf.about, leaf.down);
    frames.reckon(bend);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Wanted& leaf = leaves[i];
      Frame frame = pitch(roll(leaf.stem, math::quick_sincos_degrees(leaf.about)),
                          math::quick_sincos_degrees(leaf.down));
      if (bend > 0) frame = to_light(frame, leaf.position, bend);
      EXPECT_EQ(frames.frame(i), quaternion(upper_side_up(frame))) << i << " bend " << bend;
    }
  }
}

TEST(LeafFrames, TurnTheUpperSideUp) {
  LeafFrames frames;
  for (const Wanted& leaf : some(64)) frames.add(leaf.stem, leaf.position, leaf.about, leaf.down);
  frames.reckon(1);
  for (std::size_t i = 3; i < frames.size(); ++i) {
    const glm::quat q = frames.frame(i);
    const float up = 2 * (q.y * q.z - q.w * q.x);  // of +Z turned by it, along +Y
    EXPECT_NEAR(up, 1, 1e-5) << i;
  }
  frames.clear();
  EXPECT_EQ(frames.size(), 0U);
}

}  // namespace
}  // namespace seedmesh::tree
