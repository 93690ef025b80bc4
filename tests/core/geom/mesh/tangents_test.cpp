#include "core/geom/mesh/tangents.h"

#include <gtest/gtest.h>

#include "core/geom/plant/skin.h"
#include "tests/core/geom/skeletons.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

Job job_of() { return Job(1, Job::Options{}); }

Model model_of(Mesh mesh) {
  Model model;
  model.textures.push_back(std::make_shared<Image>());
  model.materials.resize(1);
  model.materials[0].normal_texture.texture = 0;
  model.meshes.resize(1);
  model.meshes[0].primitives.push_back({std::move(mesh), 0, {}});
  return model;
}

/// A square in the xy plane, seen from +z, with its picture upright: v grows down.
Mesh square(const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job, 4, glm::vec3(0, 0, 1));
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    mesh.position.push_back({at, 0});
    mesh.uv[0].push_back({at.x, 1 - at.y});
  }
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(i);
  return mesh;
}

TEST(Tangents, FollowUWithTheBitangentUpTheTexture) {
  const Job job = job_of();
  Model model = model_of(square(job));
  add_tangents(model, job);
  for (const glm::vec4& tangent : model.meshes[0].primitives[0].mesh.tangent)
    EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
}

TEST(Tangents, AreMirroredWithTheTexture) {
  const Job job = job_of();
  Model model = model_of(square(job));
  for (glm::vec2& uv : model.meshes[0].primitives[0].mesh.uv[0]) uv.x = 1 - uv.x;
  add_tangents(model, job);
  for (const glm::vec4& tangent : model.meshes[0].primitives[0].mesh.tangent)
    EXPECT_EQ(tangent, glm::vec4(-1, 0, 0, -1));
}

/// Strips of a bumpy surface, far more than are made at once, each with vertices of its own.
Mesh strips(const Job& job, std::uint32_t count, std::uint32_t squares) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job, count * 2 * (squares + 1), glm::vec3(0, 0, 1));
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  Rng rng(5);
  for (std::uint32_t strip = 0; strip < count; ++strip) {
    const std::uint32_t first = strip * 2 * (squares + 1);
    for (std::uint32_t i = 0; i < 2 * (squares + 1); ++i) {
      const auto chance = [&] { return static_cast<float>(rng.uniform(0, 0.3)); };
      mesh.position.push_back({static_cast<float>(i / 2) + chance(), static_cast<float>(i % 2), chance()});
      mesh.uv[0].push_back({static_cast<float>(i / 2) + chance(), static_cast<float>(i % 2) + chance()});
    }
    for (std::uint32_t i = 0; i < squares; ++i) {
      for (const std::uint32_t corner : {0U, 2U, 1U, 1U, 2U, 3U})
        mesh.index.wide.push_back(first + 2 * i + corner);
    }
  }
  return mesh;
}

TEST(Tangents, OfPartsAreThoseOfTheWhole) {
  for (const bool reaches_back : {false, true}) {
    const Job job(1, {.threads = 2});
    const auto tangents = [&](bool is_small) {
      Mesh mesh = strips(job, 9, 1500);
      mesh.index.wide.push_back(3);  // no strip is like another
      mesh.index.wide.push_back(1);
      mesh.index.wide.push_back(0);
      if (!reaches_back) mesh.index.wide.resize(mesh.index.wide.size() - 3);
      mesh.index.wide[0] = 3;
      if (is_small) {
        mesh.index.small = Array<std::uint16_t>(job, mesh.index.wide.size());
        for (std::size_t i = 0; i < mesh.index.wide.size(); ++i)
          mesh.index.small[i] = static_cast<std::uint16_t>(mesh.index.wide[i]);
        mesh.index.wide = Array<std::uint32_t>(job);
      }
      Model model = model_of(std::move(mesh));
      add_tangents(model, job);
      return std::move(model.meshes[0].primitives[0].mesh.tangent);
    };
    const Array<glm::vec4> whole = tangents(true), parts = tangents(false);
    ASSERT_EQ(whole.size(), 9U * 2 * 1501);
    for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_EQ(whole[i], parts[i]) << i;
  }
}

TEST(Tangents, AreMadeOnlyWhereANormalMapIs) {
  const Job job = job_of();
  Model model = model_of(square(job));
  model.materials[0].normal_texture.texture = -1;
  add_tangents(model, job);
  EXPECT_TRUE(model.meshes[0].primitives[0].mesh.tangent.empty());
}

TEST(Tangents, AreUnitAndAcrossTheNormalsOfATube) {
  Job job = job_of();
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.root({0, 0, 0});
  for (const glm::vec3 at : {glm::vec3(0, 1, 0), glm::vec3(0.3F, 2, 0), glm::vec3(0.9F, 2.5F, 0.4F)}) {
    joint = maker.grow(joint, at, {0.2F, 0.1F});
  }
  Model model = model_of(std::move(skin(maker.limbs, {.sides = 12, .wrap = true}, job)[0].mesh));
  add_tangents(model, job);
  const Mesh& mesh = model.meshes[0].primitives[0].mesh;
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    const glm::vec3 tangent(mesh.tangent[i]);
    EXPECT_NEAR(glm::dot(tangent, tangent), 1, 1e-5);
    EXPECT_NEAR(glm::dot(tangent, mesh.normal[i]), 0, 1e-5);
    EXPECT_EQ(std::abs(mesh.tangent[i].w), 1);
  }
}

TEST(Skin, RepeatsTexturesAWholeNumberOfTimesAround) {
  Job job = job_of();
  SkeletonMaker maker(job);
  maker.grow(maker.root({0, 0, 0}), {0, 4, 0}, {0.5F, 0.25F});
  const auto barks = skin(maker.limbs, {.sides = 12, .wrap = true}, job);
  float most = 0;
  for (const glm::vec2& uv : barks[0].mesh.uv[0]) most = std::max(most, uv.x);
  EXPECT_EQ(most, 3) << "the circumference is 3.14 m";
}

}  // namespace
}  // namespace seedmesh
