#include "core/generators/tree/weber_penn_bends.h"

#include <gtest/gtest.h>

#include <vector>

namespace seedmesh::tree {
namespace {

TEST(WeberPennBends, TurnsManyStemsAsOne) {
  WeberPennLevel level{};
  level.curve_res = 5;
  level.curve = 40;
  level.curve_back = -25;
  level.curve_v = 90;
  WeberPennBends bends;
  std::vector<Frame> frames;
  for (int i = 0; i < 19; ++i) {
    frames.push_back(pitch(Frame{}, math::quick_sincos_degrees(9.0 * i)));
    bends.add(frames.back(), static_cast<std::uint64_t>(100 + i));
  }
  bends.reckon(level, 0.5);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Frame frame = frames[i];
    for (int segment = 1; segment < level.curve_res; ++segment) {
      const Rng chance = Rng(100 + i).at("curve").at(static_cast<std::uint64_t>(segment));
      const double curve = curve_before(level, segment) + spread(chance, level.curve_v) / level.curve_res -
                           lift(frame, 0.5, level.curve_res);
      frame = pitch(frame, math::quick_sincos_degrees(curve));
      const Frame bent = bends.frame(i, segment);
      EXPECT_EQ(bent.heading, frame.heading) << i;
      EXPECT_EQ(bent.up, frame.up) << i;
    }
  }
}

TEST(WeberPennBends, KnowsTheInverseCosineRoughly) {
  for (double angle = 0; angle < math::pi; angle += 0.01)
    EXPECT_NEAR(rough_acos(math::quick_sincos(angle).cos), angle, 1e-7);
}

}  // namespace
}  // namespace seedmesh::tree
