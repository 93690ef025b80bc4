#include "core/geom/mesh/solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

Solid solid(SolidShape shape, const glm::dvec3& size = {2, 2, 2}) {
  return {shape, {0, 0, 0}, size, nullptr};
}

double distance(const Solid& of, const glm::dvec3& point) { return surface_near(of, point).distance; }

TEST(Solid, StandsOnItsPosition) {
  for (const SolidShape shape : {SolidShape::box, SolidShape::cylinder, SolidShape::cone}) {
    EXPECT_NEAR(distance(solid(shape), {0, -0.5, 0}), 0.5, 1e-12);
    EXPECT_LE(distance(solid(shape), {0, 0.01, 0}), 0);
  }
}

TEST(Solid, ComputesDistancesToSimpleShapesExactly) {
  EXPECT_NEAR(distance(solid(SolidShape::sphere), {3, 1, 0}), 2, 1e-12);
  EXPECT_NEAR(distance(solid(SolidShape::sphere), {0, 1, 0.25}), -0.75, 1e-12);
  EXPECT_NEAR(distance(solid(SolidShape::box), {2, 1, 2}), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(distance(solid(SolidShape::box), {0.9, 1, 0}), -0.1, 1e-12);
  EXPECT_NEAR(distance(solid(SolidShape::cylinder), {0, 1, 4}), 3, 1e-12);
  EXPECT_NEAR(distance(solid(SolidShape::cylinder), {0.5, 1.9, 0}), -0.1, 1e-12);
  EXPECT_NEAR(distance(solid(SolidShape::cone), {0, 3, 0}), 1, 1e-12);
  EXPECT_NEAR(distance(solid(SolidShape::cone), {2, 1, 0}), 1.5 * 2 / std::sqrt(5.0), 1e-12);
}

TEST(Solid, FindsPointsOfItsSurface) {
  Rng rng(3);
  for (const SolidShape shape :
       {SolidShape::box, SolidShape::sphere, SolidShape::cylinder, SolidShape::cone}) {
    const Solid one = solid(shape, {2, 3, 2});
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 p{rng.uniform(-3, 3), rng.uniform(-2, 5), rng.uniform(-3, 3)};
      const SurfacePoint found = surface_near(one, p);
      EXPECT_NEAR(std::abs(distance(one, found.nearest)), 0, 1e-9) << "the nearest point is on the surface";
    }
  }
}

/// A cube of edge 2 around the origin.
Model cube(const Job& job) {
  Model model;
  model.nodes.emplace_back();
  model.nodes[0].mesh = 0;
  model.meshes.push_back({"cube", {}});
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (int i = 0; i < 8; ++i) mesh.position.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
  constexpr std::uint32_t corners[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  mesh.index.wide.append(corners);
  model.meshes[0].primitives.push_back({std::move(mesh), -1, {}});
  return model;
}

TEST(MeshField, AgreesWithTheBoxOfItsForm) {
  Job job(1, Job::Options{});
  const MeshField field(cube(job), {1, 1, 1}, {0, 1, 0}, job);
  const Solid box = solid(SolidShape::box);
  Rng rng(9);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec3 p{rng.uniform(-2, 2), rng.uniform(-1, 3), rng.uniform(-2, 2)};
    EXPECT_NEAR(field.nearest(p).distance, std::abs(distance(box, p)), 1e-9);
    EXPECT_EQ(field.contains(p), distance(box, p) < 0);
  }
}

TEST(MeshField, FindsTheSamePointWithEveryGuess) {
  Job job(1, Job::Options{});
  const MeshField field(cube(job), {1, 1, 1}, {0, 1, 0}, job);
  Rng rng(10);
  for (int i = 0; i < 200; ++i) {
    // Multiples of a half: often as near to several faces, edges and corners.
    const glm::dvec3 p{0.5 * rng.below(9) - 2, 0.5 * rng.below(9) - 1, 0.5 * rng.below(9) - 2};
    const MeshField::Nearest expected = field.nearest(p);
    for (std::uint32_t guess = 0; guess < field.triangles(); ++guess) {
      const MeshField::Nearest found = field.nearest(p, guess);
      EXPECT_EQ(found.point, expected.point) << guess;
      EXPECT_EQ(found.distance, expected.distance);
      EXPECT_EQ(found.triangle, expected.triangle);
    }
  }
}

TEST(Solid, ReportsSidesAsTheSignOfTheDistance) {
  Job job(1, Job::Options{});
  Solid mesh = solid(SolidShape::mesh);
  mesh.mesh = std::make_shared<const MeshField>(cube(job), glm::dvec3{1, 1, 1}, glm::dvec3{0, 1, 0}, job);
  Rng rng(5);
  for (const Solid& one : {solid(SolidShape::box), solid(SolidShape::sphere), solid(SolidShape::cylinder),
                           solid(SolidShape::cone), mesh}) {
    for (int i = 0; i < 300; ++i) {
      const glm::dvec3 p{rng.uniform(-2, 2), rng.uniform(-1, 3), rng.uniform(-2, 2)};
      EXPECT_EQ(lies_inside(one, p), distance(one, p) < 0);
      EXPECT_EQ(lies_outside(one, p), distance(one, p) > 0);
      EXPECT_EQ(nearest_on_surface(one, p), surface_near(one, p).nearest);
    }
  }
  for (const Solid& one : {solid(SolidShape::box), mesh}) {
    for (const glm::dvec3 on : {glm::dvec3{0.25, 0, 0.5}, {0.25, 2, 0.5}, {1, 0.75, 0.5}, {-1, 0.75, 0.5}}) {
      EXPECT_FALSE(lies_inside(one, on)) << "a point of the surface is on neither side";
      EXPECT_FALSE(lies_outside(one, on));
    }
  }
}

TEST(MeshField, IsStretchedThenMoved) {
  Job job(1, Job::Options{});
  const MeshField field(cube(job), {2, 1, 1}, {5, 0, 0}, job);
  EXPECT_TRUE(field.contains({6.9, 0, 0}));
  EXPECT_FALSE(field.contains({7.1, 0, 0}));
  EXPECT_NEAR(field.nearest({8, 0, 0}).distance, 1, 1e-9);
}

}  // namespace
}  // namespace seedmesh
