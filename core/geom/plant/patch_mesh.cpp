/// Fruits and patches of leaf_mesh.h.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/mesh/sheet.h"
#include "core/geom/plant/leaf_mesh.h"

namespace seedmesh {
namespace {

using glm::dvec3;

glm::dvec4 weights(PatchBasis basis, double t) {
  const double s = 1 - t;
  if (basis == PatchBasis::bezier) return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  return glm::dvec4(s * s * s, 3 * t * t * t - 6 * t * t + 4, 1 + 3 * t + 3 * t * t - 3 * t * t * t,
                    t * t * t) /
         6.0;
}

glm::dvec4 slopes(PatchBasis basis, double t) {
  const double s = 1 - t;
  if (basis == PatchBasis::bezier)
    return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
  return glm::dvec4(-3 * s * s, 9 * t * t - 12 * t, 3 + 6 * t - 9 * t * t, 3 * t * t) / 6.0;
}

dvec3 blend(const glm::vec3* points, const glm::dvec4& along_u, const glm::dvec4& along_v) {
  dvec3 sum{0};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      sum += dvec3(points[4 * row + column]) * (along_v[row] * along_u[column]);
  }
  return sum;
}

/// Where u or v does not change, as at a side that is a point, the normal is evaluated a little further
/// inside.
dvec3 patch_normal(const glm::vec3* points, PatchBasis basis, double u, double v) {
  for (const double inward : {0.0, 1e-3, 1e-2}) {
    const double a = u + (0.5 - u) * inward, b = v + (0.5 - v) * inward;
    const dvec3 du = blend(points, slopes(basis, a), weights(basis, b));
    const dvec3 dv = blend(points, weights(basis, a), slopes(basis, b));
    const dvec3 normal = glm::cross(du, dv);
    if (glm::dot(normal, normal) > 1e-12 * glm::dot(du, du) * glm::dot(dv, dv) &&
        glm::dot(normal, normal) > 0)
      return math::unit(normal, {0, 0, 1});
  }
  return {0, 0, 1};
}

}  // namespace

Mesh fruit_mesh(const FruitForm& form, const Job& job) {
  Mesh mesh = empty_sheet(job);
  const int sides = std::max(form.sides, 3), rows = std::max(sides / 2 + 1, 3);
  for (int row = 0; row <= rows; ++row) {
    const math::SinCos lift = math::sincos(math::pi * row / rows);
    const double share = static_cast<double>(row) / rows, thin = 1 - form.pointed * share * share * 0.7;
    const double radius = 0.5 * form.width * lift.sin * thin, y = 0.5 - 0.5 * lift.cos;
    for (int i = 0; i <= sides; ++i) {
      const math::SinCos round = math::sincos(2 * math::pi * (i % sides) / sides);
      const dvec3 out{round.cos, 0, -round.sin};
      mesh.position.push_back(glm::vec3(dvec3(0, y, 0) + out * radius) + 0.0F);
      const dvec3 normal =
          math::unit(out * (lift.sin + 1e-9) +
                         dvec3(0, -lift.cos * form.width + form.pointed * 0.5 * lift.sin * share, 0),
                     {0, 1, 0});
      mesh.normal.push_back(glm::vec3(row == 0      ? dvec3(0, -1, 0)
                                      : row == rows ? dvec3(0, 1, 0)
                                                    : normal) +
                            0.0F);
      mesh.uv[0].push_back({static_cast<float>(i + (row % rows == 0 ? 0.5 : 0)) / static_cast<float>(sides),
                            static_cast<float>(share)});
    }
  }
  const auto width = static_cast<std::uint32_t>(sides + 1);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
      const std::uint32_t a = row * width + i;
      const bool first = row == 0, last = row + 1 == static_cast<std::uint32_t>(rows);
      if (!first) {
        for (const std::uint32_t k : {a, a + 1, last ? a + width : a + width + 1})
          mesh.index.wide.push_back(k);
      }
      if (!last) {
        for (const std::uint32_t k : {a, a + width + 1, a + width}) mesh.index.wide.push_back(k);
      }
    }
  }
  drop_unused(mesh, job);
  settle_normals(mesh);
  return mesh;
}

Mesh ball_mesh(int sides, const Job& job) {
  Mesh mesh = fruit_mesh({.width = 1, .pointed = 0, .sides = sides}, job);
  for (glm::vec3& point : mesh.position) point.y -= 0.5F;
  return mesh;
}

Mesh disc_mesh(int sides, const Job& job) {
  Mesh mesh = empty_sheet(job);
  const auto corners = static_cast<std::uint32_t>(std::max(sides, 3));
  for (std::uint32_t i = 0; i < corners; ++i) {
    const math::SinCos at = math::sincos(2 * math::pi * i / corners);
    const glm::vec2 point(0.5 * at.cos, 0.5 * at.sin);
    mesh.position.push_back(glm::vec3(point, 0.0F) + 0.0F);
    mesh.normal.push_back({0, 0, 1});
    mesh.uv[0].push_back(point + 0.5F);
    if (i < 2) continue;
    for (const std::uint32_t k : {0U, i - 1, i}) mesh.index.wide.push_back(k);
  }
  return mesh;
}

Mesh patch_mesh(const PatchForm& form, const Job& job) {
  Mesh mesh = empty_sheet(job);
  const int divisions = std::max(form.divisions, 1);
  const auto width = static_cast<std::uint32_t>(divisions + 1);
  for (std::size_t patch = 0; patch + 16 <= form.points.size(); patch += 16) {
    job.check();
    const glm::vec3* points = form.points.data() + patch;
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (int row = 0; row <= divisions; ++row) {
      for (int column = 0; column <= divisions; ++column) {
        const double u = static_cast<double>(column) / divisions, v = static_cast<double>(row) / divisions;
        mesh.position.push_back(glm::vec3(blend(points, weights(form.basis, u), weights(form.basis, v))) +
                                0.0F);
        mesh.normal.push_back(glm::vec3(patch_normal(points, form.basis, u, v)) + 0.0F);
        mesh.uv[0].push_back({static_cast<float>(u), static_cast<float>(1 - v)});
      }
    }
    for (std::uint32_t row = 0; row + 1 < width; ++row) {
      for (std::uint32_t column = 0; column + 1 < width; ++column) {
        const std::uint32_t a = first + row * width + column;
        for (const std::uint32_t k : {a, a + 1, a + width + 1, a, a + width + 1, a + width})
          mesh.index.wide.push_back(k);
      }
    }
  }
  drop_unused(mesh, job);
  settle_normals(mesh);
  return mesh;
}

}  // namespace seedmesh
