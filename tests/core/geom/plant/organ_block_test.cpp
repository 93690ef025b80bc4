#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/mesh/tangents.h"
#include "core/geom/plant/leaf_mesh.h"
#include "core/geom/plant/organs.h"

namespace seedmesh {
namespace {

Job job_of() { return Job(1, Job::Options{}); }

Organs organs_of(int count, const Job& job) {
  Organs organs(job);
  Rng rng(12);
  for (int i = 0; i < count; ++i) {
    Organ organ;
    const auto number = [&](double low, double high) { return static_cast<float>(rng.uniform(low, high)); };
    const glm::vec4 q{number(-1, 1), number(-1, 1), number(-1, 1), number(0.1, 1)};
    const float size = std::sqrt(glm::dot(q, q));
    organ.frame = glm::quat(q.w / size, q.x / size, q.y / size, q.z / size);
    organ.position = {number(-3, 3), number(0, 5), number(-3, 3)};
    const float length = number(0.05, 0.2);
    organ.scale = i % 5 == 0 ? glm::vec3(length) : glm::vec3(number(0.02, 0.1), length, length);
    organ.key = rng.next();
    organs.organ.push_back(organ);
  }
  return organs;
}

FoliageOptions options_of(const Mesh& surface) {
  FoliageOptions options;
  options.surfaces = std::span(&surface, 1);
  options.model_size = 8;
  options.crown = glm::vec3(0, 2, 0);
  options.tint = 0.2F;
  return options;
}

Mesh leaf_of(LeafBuild build, const Job& job) {
  LeafForm form;
  form.build = build;
  form.fold = 0.3;
  form.droop = 0.4;
  return leaf_mesh(form, job);
}

/// Positions by a rotation matrix in double precision, normals by the inverse transpose.
TEST(OrganBlock, RotatesScalesAndMovesASurface) {
  for (const LeafBuild build : {LeafBuild::card, LeafBuild::cross, LeafBuild::curved, LeafBuild::mesh}) {
    Job job = job_of();
    const Mesh leaf = leaf_of(build, job);
    const Organs organs = organs_of(45, job);
    FoliageOptions options = options_of(leaf);
    options.crown = std::nullopt;
    const Mesh mesh = std::move(place_organs(organs, options, job)[0].mesh);
    const std::size_t vertices = leaf.position.size();
    ASSERT_EQ(mesh.position.size(), 45 * vertices);
    for (std::size_t i = 0; i < mesh.position.size(); ++i) {
      const Organ& organ = organs.organ[i / vertices];
      const glm::dmat3 turn = glm::mat3_cast(glm::dquat(organ.frame));
      const glm::dvec3 scale(organ.scale), from(leaf.position[i % vertices]);
      const glm::dvec3 position = glm::dvec3(organ.position) + turn * (scale * from);
      const glm::dvec3 normal = glm::normalize(turn * (glm::dvec3(leaf.normal[i % vertices]) / scale));
      ASSERT_LT(glm::distance(glm::dvec3(mesh.position[i]), position), 2e-6) << i;
      ASSERT_LT(glm::distance(glm::dvec3(mesh.normal[i]), normal), 2e-6) << i;
    }
  }
}

/// m = normalize(share unit(0.32 unit((p - c) / e^2) + 0.68 up) + (1 - share) f); where m f < 0.03, n has the
/// direction of m beside f and n f = 0.05, in double precision.
TEST(OrganBlock, TurnsNormalsOutwardAsFarAsTheyStayOnTheSideOfTheirFaces) {
  Job job = job_of();
  const Mesh leaf = leaf_of(LeafBuild::card, job);
  const Organs organs = organs_of(45, job);
  FoliageOptions options = options_of(leaf);
  options.outward = true;
  options.crown_share = 0.65F;
  options.crown_axes = {3, 2.5F, 3};
  const Mesh mesh = std::move(place_organs(organs, options, job)[0].mesh);
  const std::size_t vertices = leaf.position.size();
  std::size_t turned = 0;
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    const Organ& organ = organs.organ[i / vertices];
    const glm::dmat3 turn = glm::mat3_cast(glm::dquat(organ.frame));
    const glm::dvec3 own =
        glm::normalize(turn * (glm::dvec3(leaf.normal[i % vertices]) / glm::dvec3(organ.scale)));
    const glm::dvec3 axes(options.crown_axes);
    const glm::dvec3 away =
        glm::normalize((glm::dvec3(mesh.position[i]) - glm::dvec3(*options.crown)) / (axes * axes));
    const glm::dvec3 light = glm::normalize(0.32 * away + glm::dvec3(0, 0.68, 0));
    glm::dvec3 wanted = glm::normalize(0.65 * light + 0.35 * own);
    const double over = glm::dot(wanted, own);
    if (over < 0.03) wanted = std::sqrt(1 - 0.05 * 0.05) * glm::normalize(wanted - over * own) + 0.05 * own;
    turned += over < 0.03 ? 1 : 0;
    ASSERT_LT(glm::distance(glm::dvec3(mesh.normal[i]), wanted), 1e-4) << i;
    ASSERT_GT(glm::dot(glm::dvec3(mesh.normal[i]), own), 0.029) << i;
  }
  EXPECT_GT(turned, vertices) << "some leaves face the inside of the crown";
}

TEST(OrganBlock, KeepsNormalsThatFollowACrownOnTheSideOfTheirFaces) {
  Job job = job_of();
  const Mesh leaf = leaf_of(LeafBuild::curved, job);
  const Mesh mesh = std::move(place_organs(organs_of(45, job), options_of(leaf), job)[0].mesh);
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const glm::dvec3 a(mesh.position[mesh.index.at(i)]), b(mesh.position[mesh.index.at(i + 1)]),
        c(mesh.position[mesh.index.at(i + 2)]);
    const glm::dvec3 face = glm::normalize(glm::cross(b - a, c - a));
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 normal(mesh.normal[mesh.index.at(i + k)]);
      EXPECT_NEAR(glm::length(normal), 1, 1e-6);
      EXPECT_GT(glm::dot(normal, face), 0);
    }
  }
}

TEST(OrganBlock, TakesADirectionOfItsOwnWhereASurfaceHasNone) {
  Job job = job_of();
  Mesh leaf = leaf_of(LeafBuild::card, job);
  for (glm::vec3& normal : leaf.normal) normal = glm::vec3(0);
  FoliageOptions options = options_of(leaf);
  options.crown = std::nullopt;
  const Mesh mesh = std::move(place_organs(organs_of(20, job), options, job)[0].mesh);
  for (const glm::vec3& normal : mesh.normal) EXPECT_EQ(normal, glm::vec3(0, 1, 0));
}

/// Of one surface: as they come, and by add_tangents().
std::array<Mesh, 2> with_tangents(const Mesh& surface, const Organs& organs, Job& job);

TEST(OrganTangents, AreThoseThatAreMadeOfTheWholeMesh) {
  for (const LeafBuild build : {LeafBuild::card, LeafBuild::cross, LeafBuild::curved, LeafBuild::mesh}) {
    Job job = job_of();
    const Mesh leaf = leaf_of(build, job);
    const auto [placed, summed] = with_tangents(leaf, organs_of(53, job), job);
    ASSERT_EQ(placed.tangent.size(), 53 * leaf.position.size());
    ASSERT_EQ(summed.tangent.size(), placed.tangent.size());
    for (std::size_t i = 0; i < placed.tangent.size(); ++i) {
      const glm::vec3 own(placed.tangent[i]), other(summed.tangent[i]);
      EXPECT_NEAR(glm::length(own), 1, 1e-6) << i;
      EXPECT_NEAR(glm::dot(own, placed.normal[i]), 0, 2e-6) << i;
      EXPECT_LT(glm::distance(own, other), 2e-3F) << i;
      EXPECT_EQ(placed.tangent[i].w, summed.tangent[i].w) << i;
    }
  }
}

TEST(OrganTangents, AreAnyDirectionInTheSurfaceWhereTheTextureHasNone) {
  Job job = job_of();
  Mesh leaf = leaf_of(LeafBuild::card, job);
  for (glm::vec2& uv : leaf.uv[0]) uv = {0.5F, 0.5F};
  FoliageOptions options = options_of(leaf);
  options.tangents = true;
  const Mesh mesh = std::move(place_organs(organs_of(20, job), options, job)[0].mesh);
  for (std::size_t i = 0; i < mesh.tangent.size(); ++i) {
    EXPECT_NEAR(glm::length(glm::vec3(mesh.tangent[i])), 1, 1e-6);
    EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangent[i]), mesh.normal[i]), 0, 2e-6);
    EXPECT_EQ(std::abs(mesh.tangent[i].w), 1);
  }
}

TEST(OrganTangents, AreToTheBitThoseOfEachLeafByItself) {
  Job job = job_of();
  const Mesh leaf = leaf_of(LeafBuild::curved, job);
  const Organs organs = organs_of(45, job);
  FoliageOptions options = options_of(leaf);
  options.tangents = true;
  const Mesh all = std::move(place_organs(organs, options, job)[0].mesh);
  for (std::size_t i = 0; i < 45; ++i) {
    Organs one(job);
    one.organ.push_back(organs.organ[i]);
    const Mesh own = std::move(place_organs(one, options, job)[0].mesh);
    const std::size_t first = i * own.tangent.size();
    EXPECT_EQ(std::memcmp(own.tangent.data(), all.tangent.data() + first, own.tangent.bytes()), 0) << i;
    EXPECT_EQ(std::memcmp(own.normal.data(), all.normal.data() + first, own.normal.bytes()), 0) << i;
  }
}

TEST(OrganBlock, SkipsOrgansAtThePositionOfAnother) {
  Job job = job_of();
  const Mesh leaf = leaf_of(LeafBuild::card, job);
  Organs organs = organs_of(40, job);
  organs.organ.push_back(organs.organ[7]);
  Organ turned = organs.organ[9];
  turned.frame = organs.organ[10].frame;
  organs.organ.push_back(turned);  // in the same place, but another way
  const auto foliage = place_organs(organs, options_of(leaf), job);
  EXPECT_EQ(foliage[0].mesh.position.size(), 41 * leaf.position.size());
}

Model model_of(Mesh mesh) {
  Model model;
  model.textures.push_back(std::make_shared<Image>());
  model.materials.resize(1);
  model.materials[0].normal_texture.texture = 0;
  model.meshes.resize(1);
  model.meshes[0].primitives.push_back({std::move(mesh), 0, {}});
  return model;
}

std::array<Mesh, 2> with_tangents(const Mesh& surface, const Organs& organs, Job& job) {
  FoliageOptions options = options_of(surface);
  Model model = model_of(std::move(place_organs(organs, options, job)[0].mesh));
  add_tangents(model, job);
  options.tangents = true;
  return {std::move(place_organs(organs, options, job)[0].mesh),
          std::move(model.meshes[0].primitives[0].mesh)};
}

TEST(Tangents, AreToTheBitThoseOfEachLeafByItself) {
  Job job = job_of();
  const Mesh leaf = leaf_of(LeafBuild::curved, job);
  Organs organs = organs_of(50, job);
  Model all = model_of(std::move(place_organs(organs, options_of(leaf), job)[0].mesh));
  add_tangents(all, job);
  const Array<glm::vec4>& tangents = all.meshes[0].primitives[0].mesh.tangent;
  ASSERT_EQ(tangents.size(), 50 * leaf.position.size());
  for (std::size_t i = 0; i < 50; ++i) {
    Organs one(job);
    one.organ.push_back(organs.organ[i]);
    Model model = model_of(std::move(place_organs(one, options_of(leaf), job)[0].mesh));
    add_tangents(model, job);
    const Array<glm::vec4>& own = model.meshes[0].primitives[0].mesh.tangent;
    EXPECT_EQ(std::memcmp(own.data(), tangents.data() + i * own.size(), own.bytes()), 0) << i;
  }
}

}  // namespace
}  // namespace seedmesh
