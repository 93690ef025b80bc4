#include "tests/generators/toy/cone.h"

#include <cmath>

#include "core/base/math.h"
#include "generated/params/cone.h"

namespace seedmesh::cone {
namespace {

/// Drawn by key: a draw with another key does not change it.
glm::vec3 tip_of(const ConeParams& params, const Job& job) {
  Rng rng = job.rng().at("tip");
  const math::SinCos toward = math::sincos_degrees(rng.uniform(0, 360));
  const double away = params.lean * std::sqrt(rng.unit());
  return {away * toward.cos, params.height, away * toward.sin};
}

/// The corner of the base circle after `turn` of `sides` steps; the last has exactly the coordinates of the first.
glm::vec3 corner(const ConeParams& params, int turn) {
  const math::SinCos at = math::sincos_degrees(360.0 * (turn % params.sides) / params.sides);
  return {params.radius * at.cos, 0, -params.radius * at.sin};
}

void add_vertex(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv) {
  mesh.position.push_back(position);
  mesh.normal.push_back(normal);
  mesh.uv[0].push_back(uv);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  for (std::uint32_t corner : {a, b, c}) mesh.index.wide.push_back(corner);
}

/// One flat side with its own vertices: u around the base, v up the side, both in metres.
void add_side(Mesh& mesh, const ConeParams& params, const glm::vec3& tip, int side) {
  const glm::vec3 left = corner(params, side), right = corner(params, side + 1);
  const glm::vec3 out = math::unit(glm::cross(right - left, tip - left), {0, 1, 0});
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  const float width = glm::length(right - left), start = width * static_cast<float>(side);
  add_vertex(mesh, left, out, {start, 0});
  add_vertex(mesh, right, out, {start + width, 0});
  add_vertex(mesh, tip, out, {start + width / 2, glm::length(tip - (left + right) / 2.0F)});
  add_triangle(mesh, first, first + 1, first + 2);
}

void add_base(Mesh& mesh, const ConeParams& params) {
  const auto centre = static_cast<std::uint32_t>(mesh.position.size());
  add_vertex(mesh, {0, 0, 0}, {0, -1, 0}, {0, 0});
  for (int side = 0; side < params.sides; ++side) {
    const glm::vec3 at = corner(params, side);
    add_vertex(mesh, at, {0, -1, 0}, {at.x, at.z});
  }
  for (int side = 0; side < params.sides; ++side) {
    const auto here = centre + 1 + static_cast<std::uint32_t>(side);
    add_triangle(mesh, centre, side + 1 < params.sides ? here + 1 : centre + 1, here);
  }
}

Mesh empty_mesh(const Job& job, std::size_t vertices, std::size_t triangles) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  mesh.position.reserve(vertices);
  mesh.normal.reserve(vertices);
  mesh.uv[0].reserve(vertices);
  mesh.index.wide.reserve(3 * triangles);
  return mesh;
}

}  // namespace

std::vector<Issue> check(const ConeParams& params) {
  if (params.lean < params.radius) return {};
  return {{IssueKind::out_of_range, "/lean",
           "the tip may lean by less than the radius, " + std::to_string(params.radius) + " m"}};
}

Result<Model> generate(const ConeParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (std::vector<Issue> issues = check(params); !issues.empty())
    return Error{Code::invalid, std::move(issues)};
  const auto sides = static_cast<std::size_t>(params.sides);
  job.progress("mesh", 0);
  job.spend(Resource::triangles, 2 * sides);

  Mesh mesh = empty_mesh(job, 4 * sides + 1, 2 * sides);
  const glm::vec3 tip = tip_of(params, job);
  for (int side = 0; side < params.sides; ++side) add_side(mesh, params, tip, side);
  add_base(mesh, params);

  Model model;
  model.name = "cone";
  model.materials.emplace_back().name = "clay";
  MeshGroup& group = model.meshes.emplace_back();
  group.name = "cone";
  group.primitives.push_back({std::move(mesh), 0, {}});
  Node& node = model.nodes.emplace_back();
  node.name = "cone";
  node.mesh = 0;
  return model;
}

}  // namespace seedmesh::cone
