#include "core/model/index_width.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

TEST(Widen, TurnsNarrowIndicesBackAndLeavesWideOnes) {
  const Job job(0, Job::Options{});
  Model model;
  model.meshes.resize(2);
  for (MeshGroup& group : model.meshes) group.primitives.emplace_back();
  Indices& narrow_ones = model.meshes[0].primitives[0].mesh.index;
  narrow_ones.small = Array<std::uint16_t>(job);
  for (const int corner : {0, 1, 65'534}) narrow_ones.small.push_back(static_cast<std::uint16_t>(corner));
  Indices& wide_ones = model.meshes[1].primitives[0].mesh.index;
  wide_ones.wide = Array<std::uint32_t>(job, 3, 70'000U);

  widen(model, job);
  EXPECT_TRUE(narrow_ones.small.empty());
  ASSERT_EQ(narrow_ones.wide.size(), 3U);
  EXPECT_EQ(narrow_ones.wide[2], 65'534U);
  EXPECT_EQ(wide_ones.wide[0], 70'000U);
}

}  // namespace
}  // namespace seedmesh
