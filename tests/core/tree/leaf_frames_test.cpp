#include "core/generators/tree/leaf_frames.h"

#include <gtest/gtest.h>

#include <vector>

namespace seedmesh::tree {
namespace {

struct Wanted {
  Frame stem;
  glm::dvec3 position;
  double about, down;
  LeafFrames::Angles angles() const { return {about, down, 77}; }
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

std::vector<Organ> written(const std::vector<Wanted>& leaves, const LeafFrames::Options& options) {
  LeafFrames frames;
  std::uint32_t joint = 0;
  for (const Wanted& leaf : leaves) frames.add(quaternion(leaf.stem), leaf.position, joint++, leaf.angles());
  std::vector<Organ> organs(leaves.size());
  frames.write(options, scale, organs.data());
  EXPECT_EQ(frames.size(), leaves.size());
  frames.clear();
  EXPECT_EQ(frames.size(), 0U);
  return organs;
}

/// Of two rotations, near 0 where they are the same.
double between(const glm::quat& a, const glm::quat& b) {
  return 1 - std::abs(static_cast<double>(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z));
}

TEST(LeafFrames, EqualThoseOfSingleLeaves) {
  const Rng chance = Rng(77);  // of all leaves here
  for (const double vary : {0.0, 25.0, -40.0}) {
    for (const double bend : {0.0, 0.3, 1.0}) {
      const std::vector<Wanted> leaves = some(101);
      const std::vector<Organ> organs = written(leaves, {bend, vary, 0.5 * vary});
      for (std::size_t i = 0; i < leaves.size(); ++i) {
        const Wanted& leaf = leaves[i];
        const double about = leaf.about + spread(chance.at("rotate"), vary);
        const double down = leaf.down + spread(chance.at("down"), 0.5 * vary);
        Frame frame =
            pitch(roll(leaf.stem, math::quick_sincos_degrees(about)), math::quick_sincos_degrees(down));
        if (bend > 0) frame = turned_to_light(frame, leaf.position, bend);
        const glm::quat q = organs[i].frame;
        EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1, 2e-6);
        EXPECT_GE(q.w, 0);
        // On the axis of the trunk every side is outward, and a level leaf has no axis to be raised about.
        const bool is_plain = std::abs(frame.up.y) > 1e-5 && i >= 3;
        if (is_plain) {
          EXPECT_LT(between(q, quaternion(upper_side_up(frame))), 1e-6) << i << " bend " << bend;
        }
        EXPECT_EQ(organs[i].position, glm::vec3(leaf.position));
        EXPECT_EQ(organs[i].limb_joint, i);
        EXPECT_EQ(organs[i].key, 77U);
        EXPECT_EQ(organs[i].scale, scale);
      }
    }
  }
}

TEST(LeafFrames, DoNotDependOnTheOtherLeaves) {
  const LeafFrames::Options options{0.4, 20, 10};
  const std::vector<Wanted> leaves = some(101);
  const std::vector<Organ> all = written(leaves, options);
  for (const std::size_t i : {0U, 3U, 17U, 64U, 100U}) {
    const std::vector<Organ> one = written({leaves[i]}, options);
    EXPECT_EQ(one[0].frame, all[i].frame) << i;
  }
}

TEST(LeafFrames, TurnTheUpperSideUp) {
  const std::vector<Organ> organs = written(some(64), {1, 0, 0});
  for (std::size_t i = 3; i < organs.size(); ++i) {
    const glm::quat q = organs[i].frame;
    const float up = 2 * (q.y * q.z - q.w * q.x);  // of +Z turned by it, along +Y
    EXPECT_NEAR(up, 1, 1e-5) << i;
  }
}

}  // namespace
}  // namespace seedmesh::tree
