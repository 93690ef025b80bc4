#include "core/generators/terrain/ground_classes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/generators/terrain/surface.h"
#include "core/texture/ground.h"
#include "tests/core/terrain/support.h"

namespace seedmesh::terrain {
namespace {

/// Hills with cliffs of up to 75 degrees.
Field cliffs() {
  Field field = field_from(129, 129, [](int x, int z) {
    return 30 * std::sin(x * 0.11) * std::cos(z * 0.07) + 12 * std::tanh(3 * std::sin(z * 0.2 + x * 0.02));
  });
  field.cell = 2;
  return field;
}

struct Divided {
  Model model;
  Mesh whole;
  std::vector<Primitive> parts;
};

Divided divided(PaletteName palette, Job& job) {
  const Field field = cliffs();
  const Sites sites(field, {0, 0, field.width, field.depth}, Rng(3), job);
  const GroundColors colors(palette, range_of(field, job), -1000);
  Divided made;
  made.model.nodes.emplace_back();
  const GroundClasses classes(field, {0, 0, field.width, field.depth}, sites, colors, {}, made.model);
  made.whole = grid_mesh(field, {0, 0, field.width, field.depth}, vertex_colors(field, sites, colors, job),
                         Shading::smooth, job);
  made.parts = classes.divide(made.whole, sites, job);
  return made;
}

glm::dvec3 across(const Mesh& mesh, std::size_t i) {
  const glm::dvec3 a = mesh.position[mesh.index.at(i)];
  return glm::cross(glm::dvec3(mesh.position[mesh.index.at(i + 1)]) - a,
                    glm::dvec3(mesh.position[mesh.index.at(i + 2)]) - a);
}

TEST(GroundClasses, ShareOutAllTriangles) {
  Job job = any_job();
  const Divided made = divided(PaletteName::alpine, job);
  std::size_t triangles = 0;
  double area = 0, whole = 0;
  for (const Primitive& part : made.parts) {
    triangles += part.mesh.elements();
    for (std::size_t i = 0; i < part.mesh.index.size(); i += 3) area += glm::length(across(part.mesh, i));
  }
  for (std::size_t i = 0; i < made.whole.index.size(); i += 3) whole += glm::length(across(made.whole, i));
  EXPECT_EQ(triangles, made.whole.elements());
  EXPECT_NEAR(area, whole, 1e-6 * whole);
  EXPECT_GE(made.parts.size(), 3U) << "grass, rock and scree at least";
}

TEST(GroundClasses, HaveMaterialsOfTheirPalette) {
  Job job = any_job();
  const auto kinds = [&](PaletteName palette) {
    std::set<std::string> names;
    for (const Material& material : divided(palette, job).model.materials) names.insert(material.recipe.kind);
    return names;
  };
  EXPECT_TRUE(kinds(PaletteName::alpine).contains("grass_ground"));
  EXPECT_TRUE(kinds(PaletteName::desert).contains("sand_ground"));
  EXPECT_TRUE(kinds(PaletteName::arctic).contains("snow_ground"));
  EXPECT_TRUE(kinds(PaletteName::moon).contains("soil_ground"));
  EXPECT_TRUE(kinds(PaletteName::forest).contains("litter_ground"));
  EXPECT_TRUE(kinds(PaletteName::forest).contains("grass_ground"));
  EXPECT_FALSE(kinds(PaletteName::alpine).contains("litter_ground"));
  for (const PaletteName palette :
       {PaletteName::alpine, PaletteName::desert, PaletteName::arctic, PaletteName::forest})
    EXPECT_TRUE(kinds(palette).contains("rock_ground"));
}

/// The singular values of the map from a triangle in metres to its texture, times the size of the texture: 1 where
/// nothing is stretched.
TEST(GroundClasses, StretchNoTextureByMoreThanTwo) {
  Job job = any_job();
  const Divided made = divided(PaletteName::alpine, job);
  for (const Primitive& part : made.parts) {
    const Mesh& mesh = part.mesh;
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      const std::uint32_t v[] = {mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
      const glm::dvec3 e1 = glm::dvec3(mesh.position[v[1]]) - glm::dvec3(mesh.position[v[0]]),
                       e2 = glm::dvec3(mesh.position[v[2]]) - glm::dvec3(mesh.position[v[0]]);
      const glm::dvec3 x = glm::normalize(e1), y = glm::normalize(glm::cross(across(mesh, i), x));
      const glm::dmat2 flat(glm::dvec2(glm::dot(e1, x), 0), glm::dvec2(glm::dot(e2, x), glm::dot(e2, y)));
      const glm::dmat2 uv(glm::dvec2(mesh.uv[1][v[1]]) - glm::dvec2(mesh.uv[1][v[0]]),
                          glm::dvec2(mesh.uv[1][v[2]]) - glm::dvec2(mesh.uv[1][v[0]]));
      const glm::dmat2 map = texture::ground_tile * uv * glm::inverse(flat);
      const glm::dmat2 square = glm::transpose(map) * map;
      const double half = (square[0][0] + square[1][1]) / 2,
                   root = std::sqrt(std::max(0.0, half * half - glm::determinant(square)));
      ASSERT_LE(half + root, 1.001);
      ASSERT_GE(half - root, 0.25);
    }
  }
}

/// u grows along the tangent, and v against normal x tangent times its sign, for the sum over the faces of a vertex.
TEST(GroundClasses, HaveTangentsAlongTheirTextures) {
  Job job = any_job();
  const Divided made = divided(PaletteName::alpine, job);
  for (const Primitive& part : made.parts) {
    const Mesh& mesh = part.mesh;
    std::vector<glm::dvec3> along_u(mesh.position.size()), along_v(mesh.position.size());
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      const std::uint32_t v[] = {mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
      const glm::dvec3 e1 = glm::dvec3(mesh.position[v[1]]) - glm::dvec3(mesh.position[v[0]]),
                       e2 = glm::dvec3(mesh.position[v[2]]) - glm::dvec3(mesh.position[v[0]]);
      const glm::dvec2 d1 = glm::dvec2(mesh.uv[1][v[1]]) - glm::dvec2(mesh.uv[1][v[0]]),
                       d2 = glm::dvec2(mesh.uv[1][v[2]]) - glm::dvec2(mesh.uv[1][v[0]]);
      const double area = d1.x * d2.y - d2.x * d1.y;
      for (const std::uint32_t corner : v) {
        along_u[corner] += glm::normalize((e1 * d2.y - e2 * d1.y) / area);
        along_v[corner] += glm::normalize((e2 * d1.x - e1 * d2.x) / area);
      }
    }
    for (std::size_t i = 0; i < mesh.position.size(); ++i) {
      const glm::dvec3 normal = mesh.normal[i], tangent = glm::dvec3(mesh.tangent[i]);
      ASSERT_NEAR(glm::length(tangent), 1, 1e-3);
      ASSERT_NEAR(glm::dot(tangent, normal), 0, 1e-3);
      ASSERT_GT(glm::dot(tangent, along_u[i]), 0);
      ASSERT_LT(glm::dot(glm::cross(normal, tangent) * static_cast<double>(mesh.tangent[i].w), along_v[i]),
                0);
    }
  }
}

}  // namespace
}  // namespace seedmesh::terrain
