#include "core/generators/tree/leaf_frames.h"

#include <gtest/gtest.h>

#include <vector>

namespace seedmesh::tree {
namespace {

struct Wanted {
  Frame stem;
  glm::dvec3 position;
  double about, down;
  LeafFrames::Stance stance() const { return {about, down, 77}; }
};

constexpr glm::vec3 scale{0.5F, 1, 1};

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

std::vector<Organ> reckoned(const std::vector<Wanted>& leaves, const LeafFrames::Habit& habit) {
  LeafFrames frames;
  std::uint32_t joint = 0;
  for (const Wanted& leaf : leaves) frames.add(leaf.stem, leaf.position, joint++, leaf.stance());
  std::vector<Organ> organs(leaves.size());
  frames.reckon(habit, scale, organs.data());
  EXPECT_EQ(frames.size(), leaves.size());
  frames.clear();
  EXPECT_EQ(frames.size(), 0U);
  return organs;
}

TEST(LeafFrames, AreToTheBitThoseOfEachLeafByItself) {
  const Rng chance = Rng(77);  // of all leaves here
  for (const double vary : {0.0, 25.0, -40.0}) {
    for (const double bend : {0.0, 0.3, 1.0}) {
      const std::vector<Wanted> leaves = some(101);
      const std::vector<Organ> organs = reckoned(leaves, {bend, vary, 0.5 * vary});
      for (std::size_t i = 0; i < leaves.size(); ++i) {
        const Wanted& leaf = leaves[i];
        const double about = leaf.about + spread(chance.at("rotate"), vary);
        const double down = leaf.down + spread(chance.at("down"), 0.5 * vary);
        Frame frame =
            pitch(roll(leaf.stem, math::quick_sincos_degrees(about)), math::quick_sincos_degrees(down));
        if (bend > 0) frame = to_light(frame, leaf.position, bend);
        EXPECT_EQ(organs[i].frame, quaternion(upper_side_up(frame))) << i << " bend " << bend;
        EXPECT_EQ(organs[i].position, glm::vec3(leaf.position));
        EXPECT_EQ(organs[i].limb_joint, i);
        EXPECT_EQ(organs[i].key, 77U);
        EXPECT_EQ(organs[i].scale, scale);
      }
    }
  }
}

TEST(LeafFrames, TurnTheUpperSideUp) {
  const std::vector<Organ> organs = reckoned(some(64), {1, 0, 0});
  for (std::size_t i = 3; i < organs.size(); ++i) {
    const glm::quat q = organs[i].frame;
    const float up = 2 * (q.y * q.z - q.w * q.x);  // of +Z turned by it, along +Y
    EXPECT_NEAR(up, 1, 1e-5) << i;
  }
}

}  // namespace
}  // namespace seedmesh::tree
