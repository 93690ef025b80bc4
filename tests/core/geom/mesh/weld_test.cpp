#include "core/geom/mesh/weld.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <map>
#include <vector>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

/// A mesh of triangles over `vertices` vertices whose coordinates are -1, -0, 0 or 1, so that many are equal.
Mesh mesh_with_equal_vertices(std::uint32_t vertices, Rng draw, const Job& job) {
  constexpr std::array<float, 4> values{-1.0F, -0.0F, 0.0F, 1.0F};
  const auto value = [&] { return values[draw.below(4)]; };
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    mesh.position.push_back({value(), value(), 0});
    mesh.uv[0].push_back({value(), 0});
    mesh.color.push_back({static_cast<std::uint8_t>(draw.below(2)), 0, 0, 255});
  }
  for (int corner = 0; corner < 60; ++corner) mesh.index.wide.push_back(draw.below(vertices));
  return mesh;
}

/// The bits of all attributes of a vertex, with -0 as 0.
std::vector<std::uint32_t> bits_of(const Mesh& mesh, std::size_t i) {
  std::vector<std::uint32_t> bits;
  for (const float value :
       {mesh.position[i].x, mesh.position[i].y, mesh.position[i].z, mesh.uv[0][i].x, mesh.uv[0][i].y})
    bits.push_back(value == 0 ? 0 : std::bit_cast<std::uint32_t>(value));
  bits.push_back(mesh.color[i].r);
  return bits;
}

/// Compares weld() with a map of whole vertices. Small meshes are welded pairwise, larger ones by a hash table.
void expect_that_weld_agrees_with_a_map(std::uint32_t vertices, std::uint64_t seed) {
  Job job(1, Job::Options{});
  Mesh mesh = mesh_with_equal_vertices(vertices, Rng(seed), job);
  std::map<std::vector<std::uint32_t>, std::uint32_t> number;
  std::vector<std::vector<std::uint32_t>> kept;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> new_number;
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto [at, is_new] = number.try_emplace(bits_of(mesh, i), static_cast<std::uint32_t>(kept.size()));
    if (is_new) kept.push_back(at->first);
    new_number.push_back(at->second);
  }
  for (const std::uint32_t corner : mesh.index.wide) corners.push_back(new_number[corner]);
  weld(mesh, job);
  ASSERT_EQ(mesh.position.size(), kept.size()) << vertices << " vertices, seed " << seed;
  ASSERT_EQ(mesh.uv[0].size(), kept.size());
  ASSERT_EQ(mesh.color.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) ASSERT_EQ(bits_of(mesh, i), kept[i]) << "vertex " << i;
  for (std::size_t i = 0; i < corners.size(); ++i)
    ASSERT_EQ(mesh.index.wide[i], corners[i]) << "corner " << i;
}

TEST(Weld, JoinsEqualVerticesAsAMapOfThemDoes) {
  for (std::uint32_t vertices = 1; vertices <= 120; ++vertices) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) expect_that_weld_agrees_with_a_map(vertices, seed);
  }
}

}  // namespace
}  // namespace seedmesh
