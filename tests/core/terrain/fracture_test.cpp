#include "core/generators/terrain/fracture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "core/generators/terrain/terrain.h"
#include "tests/core/terrain/support.h"

namespace seedmesh::terrain {
namespace {

double radius_of(const Planet& planet, std::size_t i) {
  return planet.radius + static_cast<double>(planet.height[i]);
}

/// A planet of the given directions alone.
Planet at_directions(const std::vector<glm::dvec3>& directions, double radius) {
  const Job job = any_job();
  Planet planet;
  planet.radius = radius;
  planet.direction = Array<glm::vec3>(job, directions.size());
  planet.height = Array<float>(job, directions.size(), 0.0F);
  for (std::size_t i = 0; i < directions.size(); ++i)
    planet.direction[i] = glm::vec3(directions[i] / glm::length(directions[i]));
  return planet;
}

TEST(Fracture, LeavesTheEllipsoidWithoutPlanes) {
  const Job job = any_job();
  Planet planet = sphere_of(17, 5, job);
  fracture_sphere(planet, {.planes = 0, .axes = {1, 0.5, 0.8}}, Rng(1), job);
  for (std::size_t i = 0; i < planet.direction.size(); ++i) {
    const glm::dvec3 at = glm::dvec3(planet.direction[i]) * radius_of(planet, i) / 5.0;
    EXPECT_NEAR(at.x * at.x + at.y * at.y / 0.25 + at.z * at.z / 0.64, 1, 1e-5);
  }
}

TEST(Fracture, IsConvexBetweenWornEdges) {
  const Job job = any_job();
  const FracturePlan plan{.planes = 12, .bevel = 0};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Planet planet = sphere_of(9, 1, job);
    fracture_sphere(planet, plan, Rng(seed), job);
    std::vector<glm::dvec3> middles;
    for (std::size_t i = 0; i < planet.direction.size(); ++i) {
      const std::size_t k = (7 * i + 31) % planet.direction.size();
      const glm::dvec3 middle = 0.5 * (glm::dvec3(planet.direction[i]) * radius_of(planet, i) +
                                       glm::dvec3(planet.direction[k]) * radius_of(planet, k));
      if (glm::length(middle) > 0.05) middles.push_back(middle);
    }
    Planet there = at_directions(middles, 1);
    fracture_sphere(there, plan, Rng(seed), job);
    for (std::size_t i = 0; i < middles.size(); ++i)
      EXPECT_LE(glm::length(middles[i]), radius_of(there, i) + 1e-5) << "a chord leaves the rock";
  }
}

TEST(Fracture, MakesFlatFacets) {
  // Most neighbouring triangles of a broken sphere lie in one plane; those of a sphere less often, by the halves of its smallest squares.
  const Job job = any_job();
  const auto flat_share = [&](int planes) {
    Planet planet = sphere_of(33, 1, job);
    fracture_sphere(planet,
                    {.planes = planes, .axes = {1, 1, 1}, .nearest = 0.6, .farthest = 0.75, .bevel = 0},
                    Rng(4), job);
    Job work = any_job();
    const Mesh mesh = planet_mesh(planet, nullptr, UpDirection::outward, Rng(1), work);
    std::size_t flat = 0, all = 0;
    for (std::size_t i = 0; i + 3 < mesh.index.size(); i += 6, ++all) {
      const auto normal = [&](std::size_t first) {
        const glm::dvec3 a = mesh.position[mesh.index.at(first)];
        const glm::dvec3 across = glm::cross(glm::dvec3(mesh.position[mesh.index.at(first + 1)]) - a,
                                             glm::dvec3(mesh.position[mesh.index.at(first + 2)]) - a);
        return across / glm::length(across);
      };
      flat += glm::dot(normal(i), normal(i + 3)) > 0.99999 ? 1U : 0U;
    }
    return static_cast<double>(flat) / static_cast<double>(all);
  };
  EXPECT_GT(flat_share(30), 0.7);
  EXPECT_LT(flat_share(0), 0.5);
}

TEST(Fracture, LetsLayersRecedeByAtMostTheirShare) {
  const Job job = any_job();
  const FracturePlan whole{.planes = 10, .bevel = 0};
  FracturePlan layered = whole;
  layered.strata = 0.15;
  Planet before = sphere_of(33, 2, job), after = sphere_of(33, 2, job);
  fracture_sphere(before, whole, Rng(3), job);
  fracture_sphere(after, layered, Rng(3), job);
  double least = 1, most = 0;
  for (std::size_t i = 0; i < before.height.size(); ++i) {
    const double recess = (radius_of(before, i) - radius_of(after, i)) / 2;
    least = std::min(least, recess);
    most = std::max(most, recess);
  }
  EXPECT_GE(least, -1e-6);
  EXPECT_LE(most, 0.15 + 1e-6);
  EXPECT_GT(most - least, 0.08) << "hard layers stand out";
}

TEST(Fracture, ColoursMossOnUpperSides) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::fracture;
  params.shape = TerrainShape::sphere;
  params.size = 2;
  params.resolution = 33;
  params.palette = TerrainPalette::mossy;
  Job job = any_job();
  const Result<Model> model = generate(params, {job});
  ASSERT_TRUE(model);
  const Mesh& mesh = model->meshes.front().primitives.front().mesh;
  double above = 0, below = 0, upper = 0, lower = 0;
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    const double green = static_cast<double>(mesh.color[i].g) / std::max<double>(mesh.color[i].r, 1);
    if (mesh.normal[i].y > 0.9F) {
      above += green;
      ++upper;
    } else if (mesh.normal[i].y < 0) {
      below += green;
      ++lower;
    }
  }
  EXPECT_GT(above / upper, 1.1);
  EXPECT_LT(below / lower, 1);
}

TEST(Fracture, NeedsASphere) {
  TerrainParams params;
  params.algorithm = TerrainAlgorithm::fracture;
  Job job = any_job();
  const std::vector<Issue> issues = check(params, job.limits());
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues.front().pointer, "/shape");
  params.shape = TerrainShape::sphere;
  params.fracture = TerrainFracture{};
  params.fracture->depth = {0.9, 0.5};
  const std::vector<Issue> crossed = check(params, job.limits());
  ASSERT_EQ(crossed.size(), 1U);
  EXPECT_EQ(crossed.front().pointer, "/fracture/depth");
}

}  // namespace
}  // namespace seedmesh::terrain
