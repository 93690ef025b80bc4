#include "core/model/append.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

Model small(const char* name) {
  Model model;
  model.name = name;
  model.nodes.resize(2);
  model.nodes[0].name = "root";
  model.nodes[1].parent = 0;
  model.nodes[1].mesh = 0;
  model.meshes.push_back({"mesh", {}});
  model.meshes[0].primitives.emplace_back();
  model.meshes[0].primitives[0].material = 0;
  model.materials.emplace_back();
  Animation animation;
  animation.name = "growth";
  animation.times.push_back({0.0F, 1.0F});
  animation.channels.push_back({1, Path::scale, Interpolation::linear, 0, {0, 0, 0, 1, 1, 1}});
  model.animations.push_back(std::move(animation));
  return model;
}

TEST(Append, RenumbersWhatRefersToEachOther) {
  Model model = small("first");
  Transform at;
  at.translation = {3, 0, 0};
  append(model, small("second"), 0, at);
  ASSERT_EQ(model.nodes.size(), 5U);
  EXPECT_EQ(model.nodes[2].name, "second");
  EXPECT_EQ(model.nodes[2].transform.translation.x, 3);
  EXPECT_EQ(model.nodes[3].parent, 2);
  EXPECT_EQ(model.nodes[4].parent, 3);
  EXPECT_EQ(model.nodes[4].mesh, 1);
  EXPECT_EQ(model.meshes[1].primitives[0].material, 1);
}

TEST(Append, JoinsAnimationsOfOneName) {
  Model model = small("first");
  append(model, small("second"), 0, {});
  ASSERT_EQ(model.animations.size(), 1U);
  ASSERT_EQ(model.animations[0].channels.size(), 2U);
  EXPECT_EQ(model.animations[0].channels[1].node, 4);
  EXPECT_EQ(model.animations[0].channels[1].times, 1);
}

}  // namespace
}  // namespace seedmesh
