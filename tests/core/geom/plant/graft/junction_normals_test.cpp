#include "core/geom/plant/graft/junction_normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/plant/graft/face_check.h"

namespace seedmesh {
namespace {

glm::vec3 random_point(Rng& rng) { return {rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)}; }

TEST(JunctionNormals, WeighFacesByTheirAngles) {
  Rng rng(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<glm::vec3> position;
    for (std::size_t i = 0; i <= 3 * FaceBlock::most; ++i) position.push_back(random_point(rng));
    FaceBlock block;
    for (std::uint32_t i = 0; i < 3 * FaceBlock::most; ++i) block.corner[i] = i;
    measure_faces(block, position.data());
    for (std::size_t face = 0; face < FaceBlock::most; ++face) {
      const glm::dvec3 p[3] = {glm::dvec3(position[3 * face]), glm::dvec3(position[3 * face + 1]),
                               glm::dvec3(position[3 * face + 2])};
      const double twice_area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
      EXPECT_NEAR(block.size[face], twice_area, 1e-5);
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 a = glm::normalize(p[(k + 1) % 3] - p[k]), b = glm::normalize(p[(k + 2) % 3] - p[k]);
        const double angle = static_cast<double>(block.weight[k][face] * block.size[face]);
        EXPECT_NEAR(angle, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)), 4e-5);
        sum += angle;
      }
      EXPECT_NEAR(sum, math::pi, 1e-4);
    }
  }
}

/// Faces around one vertex whose normals lie on a cone about y, all in one group.
std::vector<LoopFace> cone(double degrees_off_y) {
  std::vector<LoopFace> faces;
  const math::SinCos off = math::sincos_degrees(degrees_off_y);
  for (int i = 0; i < 12; ++i) {
    const math::SinCos around = math::sincos_degrees(30.0 * i);
    faces.push_back({glm::vec3(around.cos * off.sin, off.cos, around.sin * off.sin), {0, 1, Limbs::none}});
  }
  return faces;
}

TEST(JunctionNormals, TurnInFrontOfAllTheirFaces) {
  const std::vector<LoopFace> faces = cone(80);
  std::vector<GroupNormal> normals(2);
  normals[0].set({1, 0, 0});  // behind half of the faces
  relax_normals(faces, normals);
  const glm::vec3 normal = normals[0].get();
  EXPECT_NEAR(glm::length(normal), 1, 1e-5);
  for (const LoopFace& face : faces) EXPECT_GE(glm::dot(normal, face.normal), 0.03F);
}

TEST(JunctionNormals, StayWhereTheyAreInFrontAlready) {
  const std::vector<LoopFace> faces = cone(60);
  std::vector<GroupNormal> normals(2);
  normals[0].set({0, 1, 0});
  relax_normals(faces, normals);
  EXPECT_EQ(normals[0].get(), glm::vec3(0, 1, 0));
}

TEST(FaceCheck, FindsTheFacesThatFaceAwayFromANormalOrHaveNoArea) {
  Rng rng(9);
  std::vector<glm::vec3> position, normal;
  std::vector<std::uint32_t> index;
  for (std::uint32_t i = 0; i < 3 * 1001; ++i) {
    position.push_back(i % 90 == 2 ? position[i - 1] : random_point(rng));
    normal.push_back(glm::normalize(random_point(rng)));
    index.push_back(i);
  }
  for (std::size_t i = 0; i < index.size(); i += 3) {  // most normals are the face's own
    const glm::vec3 face = glm::cross(position[i + 1] - position[i], position[i + 2] - position[i]);
    if (i % 7 != 0 && glm::length(face) > 0) normal[i] = normal[i + 1] = normal[i + 2] = glm::normalize(face);
  }
  position.emplace_back(0);  // a float behind the last is read
  std::vector<std::uint32_t> expected, found;
  for (std::uint32_t t = 3; t < 1000; ++t) {
    const glm::dvec3 a(position[3 * t]), b(position[3 * t + 1]), c(position[3 * t + 2]);
    const glm::dvec3 face = glm::cross(b - a, c - a);
    bool is_bad = glm::length(face) < 1e-9;
    for (std::size_t k = 0; k < 3; ++k)
      is_bad = is_bad || glm::dot(face, glm::dvec3(normal[3 * t + k])) < 1e-4 * glm::length(face);
    if (is_bad) expected.push_back(t);
  }
  find_bad_faces({position.data(), normal.data(), least_face_square(1)}, index.data(), 3, 1000, found);
  EXPECT_GT(expected.size(), 100U);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace seedmesh
