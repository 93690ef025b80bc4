#include "core/geom/plant/grow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/geom/plant/skin.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

/// A trunk with side branches, each with two twigs.
Limbs tree(const Job& job) {
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.root({0, 0, 0});
  for (int i = 1; i <= 12; ++i) {
    const float height = 0.5F * static_cast<float>(i);
    joint = maker.grow(joint, {0.02F * height, height, 0}, {0.1F, 0.09F});
    const float side = i % 2 ? 1.0F : -1.0F;
    const auto branch = maker.branch(joint, {side, height + 0.6F, 0.3F * side}, {0.05F, 0.04F});
    maker.branch(branch, {side, height + 1.1F, 0.6F}, {0.02F, 0.01F});
    maker.branch(branch, {1.5F * side, height + 0.9F, -0.2F}, {0.02F, 0.01F});
  }
  return std::move(maker.limbs);
}

/// Size and position of every node at a time, computed as a player does.
struct Pose {
  glm::vec3 position{0};
  float size = 1;
};

std::vector<Pose> pose_at(const Model& model, float time) {
  std::vector<float> size(model.nodes.size(), 1.0F);
  const Animation& animation = model.animations.at(0);
  for (const Channel& channel : animation.channels) {
    const std::vector<float>& times = animation.times[static_cast<std::size_t>(channel.times)];
    std::size_t next = 0;
    while (next < times.size() && times[next] <= time) ++next;
    float value;
    if (next == 0 || next == times.size()) {
      value = channel.values[3 * (next == 0 ? 0 : times.size() - 1)];
    } else {
      const float share = (time - times[next - 1]) / (times[next] - times[next - 1]);
      value = channel.values[3 * (next - 1)] * (1 - share) + channel.values[3 * next] * share;
    }
    size[static_cast<std::size_t>(channel.node)] = value;
  }
  std::vector<Pose> poses(model.nodes.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Node& node = model.nodes[i];
    const Pose parent = node.parent < 0 ? Pose{} : poses[static_cast<std::size_t>(node.parent)];
    poses[i] = {parent.position + parent.size * node.transform.translation, parent.size * size[i]};
  }
  return poses;
}

class GrowTest : public testing::Test {
 protected:
  Model grown(const Limbs& limbs, GrowthOptions options = {}) {
    GrowthPlan plan = plan_growth(limbs, options, job);
    Model model;
    model.nodes.emplace_back();
    SkinOptions skinning;
    skinning.bones = plan.bone.span();
    std::vector<Bark> barks = skin(limbs, skinning, job);
    model.meshes.push_back({"bark", {}});
    model.meshes[0].primitives.push_back({std::move(barks[0].mesh), -1, {}});
    Node node;
    node.mesh = 0;
    node.parent = 0;
    model.nodes.push_back(std::move(node));
    add_growth(model, plan);
    return model;
  }

  /// The bark as it is drawn at a time.
  static Mesh posed(const Model& model, float time, const Job& job) {
    const Mesh& still = model.meshes[0].primitives[0].mesh;
    const std::vector<Pose> poses = pose_at(model, time);
    Mesh mesh;
    mesh.position = Array<glm::vec3>(job);
    mesh.normal = Array<glm::vec3>(job);
    mesh.index.wide = Array<std::uint32_t>(job);
    for (std::size_t i = 0; i < still.position.size(); ++i) {
      const Skin& skin = model.skins[0];
      const Pose& pose = poses[static_cast<std::size_t>(skin.joints[still.bone[i]])];
      const glm::vec3 bound = still.position[i] + glm::vec3(skin.inverse_bind[still.bone[i]][3]);
      mesh.position.push_back(pose.position + pose.size * bound);
      mesh.normal.push_back(still.normal[i]);
    }
    for (std::size_t i = 0; i < still.index.size(); ++i) mesh.index.wide.push_back(still.index.at(i));
    return mesh;
  }
  Job job{1, Job::Options{}};
};

TEST_F(GrowTest, EndsInTheStillModel) {
  const Model model = grown(tree(job));
  const Mesh& still = model.meshes[0].primitives[0].mesh;
  const Mesh last = posed(model, 8, job);
  for (std::size_t i = 0; i < still.position.size(); ++i) {
    EXPECT_LT(glm::dot(still.position[i] - last.position[i], still.position[i] - last.position[i]), 1e-10F);
  }
}

TEST_F(GrowTest, BeginsAsASeed) {
  const Mesh first = posed(grown(tree(job)), 0, job);
  const Box box = bounds_of(first.position.span());
  EXPECT_LT(box.max.y, 0.01F);
}

TEST_F(GrowTest, RisesAtAllTimes) {
  const Model model = grown(tree(job));
  float last = 0;
  for (float time = 0.25F; time <= 8; time += 0.25F) {
    const float height = bounds_of(posed(model, time, job).position.span()).max.y;
    EXPECT_GT(height, last) << time;
    last = height;
  }
}

TEST_F(GrowTest, KeepsEveryLimbOnItsParent) {
  const Limbs limbs = tree(job);
  const GrowthPlan plan = plan_growth(limbs, {}, job);
  const Model model = grown(limbs);
  for (const float time : {0.5F, 1.3F, 2.9F, 4.0F, 6.6F}) {
    const std::vector<Pose> poses = pose_at(model, time);
    const auto pose = [&](std::uint16_t bone) { return poses[2 + std::size_t{bone}]; };
    const auto moved = [&](std::uint16_t bone, const glm::vec3& point) {
      return pose(bone).position + pose(bone).size * (point - plan.bones[bone].position);
    };
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      const std::uint32_t parent = limbs.parent[i];
      if (parent == Limbs::none || plan.bone[parent] == plan.bone[i]) continue;
      const glm::vec3 apart =
          moved(plan.bone[i], limbs.position[parent]) - moved(plan.bone[parent], limbs.position[parent]);
      EXPECT_LT(std::sqrt(glm::dot(apart, apart)), 1e-5F) << "joint " << i << " at " << time << " s";
    }
  }
}

TEST_F(GrowTest, KeepsTheBarkClosedAndOutsideOut) {
  const Model model = grown(tree(job));
  const Mesh& still = model.meshes[0].primitives[0].mesh;
  for (const float time : {0.4F, 2.0F, 5.0F, 7.5F}) {
    const Mesh mesh = posed(model, time, job);
    double volume = 0;
    int inward = 0;
    for (std::size_t t = 0; t < mesh.index.size(); t += 3) {
      const glm::dvec3 a = mesh.position[mesh.index.at(t)], b = mesh.position[mesh.index.at(t + 1)],
                       c = mesh.position[mesh.index.at(t + 2)];
      const glm::dvec3 normal = glm::cross(b - a, c - a);
      volume += glm::dot(a, glm::cross(b, c)) / 6;
      const std::uint16_t bones[] = {still.bone[mesh.index.at(t)], still.bone[mesh.index.at(t + 1)],
                                     still.bone[mesh.index.at(t + 2)]};
      const bool is_rigid = bones[0] == bones[1] && bones[1] == bones[2];
      if (glm::dot(normal, normal) < 1e-12)
        continue;  // not born yet: as large as the rounding of its position
      if (is_rigid && glm::dot(normal, glm::dvec3(mesh.normal[mesh.index.at(t)])) < 0) ++inward;
    }
    EXPECT_GT(volume, 0) << time;
    EXPECT_EQ(inward, 0) << time;
  }
}

TEST_F(GrowTest, GivesTheBonesToWhatCarriesMost) {
  const Limbs limbs = tree(job);
  const GrowthPlan few = plan_growth(limbs, {.most_bones = 8}, job);
  EXPECT_LE(few.bones.size(), 8U);
  EXPECT_EQ(few.bones[1].position, (glm::vec3{0, 0, 0}));
  for (std::size_t i = 1; i < few.bones.size(); ++i) EXPECT_LT(few.bones[i].parent, static_cast<int>(i));
  const GrowthPlan all = plan_growth(limbs, {}, job);
  EXPECT_GT(all.bones.size(), 36U) << "12 branches and 24 twigs have one each";
}

TEST_F(GrowTest, FollowsBirthsWhereThereAreSome) {
  Limbs limbs = tree(job);
  for (std::size_t i = 0; i < limbs.size(); ++i) limbs.birth.push_back(static_cast<float>(limbs.size() - i));
  const GrowthPlan plan = plan_growth(limbs, {}, job);
  EXPECT_EQ(plan.bones[1].born, GrowthPlan::birth_classes - 1) << "the root is the youngest here";
}

TEST_F(GrowTest, ScalesTheGroundWhereThereAreMorePlantsThanBones) {
  SkeletonMaker maker(job);
  for (int i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(i);
    maker.grow(maker.root({x, 0, 0}), {x, 1, 0}, {0.1F, 0.1F});
  }
  const GrowthPlan plan = plan_growth(maker.limbs, {}, job);
  EXPECT_TRUE(plan.ground_grows);
  EXPECT_EQ(plan.bones.size(), 1U);
}

}  // namespace
}  // namespace seedmesh
