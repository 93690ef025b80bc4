#include "core/model/levels.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

TEST(Levels, EmptiesOnlyMeshesThatNoNodeShows) {
  Model model;
  for (int i = 0; i < 4; ++i) model.meshes.emplace_back().primitives.emplace_back();
  Node& shown = model.nodes.emplace_back();
  shown.mesh = 1;
  shown.lods = {3, -1};  // nothing is shown at the last level
  model.nodes.emplace_back();
  empty_hidden_meshes(model);
  const std::vector<std::size_t> expected = {0, 1, 0, 1};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(model.meshes[i].primitives.size(), expected[i]) << i;
}

}  // namespace
}  // namespace seedmesh
