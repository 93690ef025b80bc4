#include "core/generators/city/solid_builder.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/mesh/weld.h"

namespace seedmesh::city {
namespace {

using glm::vec3;

constexpr int blob_rows = 5, blob_columns = 8;

vec3 unit(const vec3& v) { return v / static_cast<float>(std::sqrt(static_cast<double>(glm::dot(v, v)))); }

math::SinCos part_of_turn(int i, int count) { return math::sincos_degrees(360.0 * i / count); }

}  // namespace

Material material_of(const SolidMaterial& look) {
  Material material;
  material.name = look.name;
  material.base_color = {linear_of_srgb(look.color[0]), linear_of_srgb(look.color[1]),
                         linear_of_srgb(look.color[2]), 1};
  material.roughness = look.roughness;
  material.metallic = look.metallic;
  return material;
}

SolidBuilder::SolidBuilder(const Job& job) {
  mesh_.position = Array<vec3>(job);
  mesh_.normal = Array<vec3>(job);
  mesh_.index.wide = Array<std::uint32_t>(job);
}

Mesh SolidBuilder::take(Job& job) {
  weld(mesh_, job);
  return std::move(mesh_);
}

void SolidBuilder::add_face(std::span<const vec3> corners) {
  const vec3 normal = unit(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) + 0.0F;
  const auto first = static_cast<std::uint32_t>(mesh_.position.size());
  for (const vec3& each : corners) {
    mesh_.position.push_back(each + 0.0F);
    mesh_.normal.push_back(normal);
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    for (const std::uint32_t corner : {0U, i - 1, i}) mesh_.index.wide.push_back(first + corner);
  }
}

void SolidBuilder::add_slab(const std::array<glm::vec2, 4>& plan, const std::array<float, 4>& low,
                            const std::array<float, 4>& high) {
  // z runs south, so that counter-clockwise from above is clockwise in x and z.
  const auto at = [&](std::size_t i, const std::array<float, 4>& height) {
    return vec3(plan[i].x, height[i], plan[i].y);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    const std::array<vec3, 4> side = {at(i, low), at(next, low), at(next, high), at(i, high)};
    add_face(side);
  }
  const std::array<vec3, 3> tops[] = {{at(0, high), at(1, high), at(2, high)},
                                      {at(0, high), at(2, high), at(3, high)},
                                      {at(0, low), at(2, low), at(1, low)},
                                      {at(0, low), at(3, low), at(2, low)}};
  for (const auto& each : tops) add_face(each);
}

void SolidBuilder::add_box(const vec3& low, const vec3& high) {
  add_slab({{{low.x, high.z}, {high.x, high.z}, {high.x, low.z}, {low.x, low.z}}},
           {low.y, low.y, low.y, low.y}, {high.y, high.y, high.y, high.y});
}

void SolidBuilder::add_prism(const vec3& foot, float height, std::array<float, 2> radii, int sides) {
  std::vector<vec3> lower, upper;
  for (int i = 0; i < sides; ++i) {
    const math::SinCos turn = part_of_turn(i, sides);
    const vec3 out(static_cast<float>(turn.cos), 0, static_cast<float>(0 - turn.sin));
    lower.push_back(foot + out * radii[0]);
    upper.push_back(foot + vec3(0, height, 0) + out * radii[1]);
  }
  for (int i = 0; i < sides; ++i) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>((i + 1) % sides);
    if (radii[1] == 0) {
      add_face(std::array<vec3, 3>{lower[a], lower[b], upper[a]});
    } else {
      add_face(std::array<vec3, 4>{lower[a], lower[b], upper[b], upper[a]});
    }
  }
  std::reverse(lower.begin(), lower.end());
  add_face(lower);
  if (radii[1] > 0) add_face(upper);
}

void SolidBuilder::add_extrusion(std::span<const glm::vec2> outline, float from_z, float to_z) {
  std::vector<vec3> front, back;
  for (const glm::vec2& p : outline) {
    front.emplace_back(p.x, p.y, to_z);
    back.emplace_back(p.x, p.y, from_z);
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = (i + 1) % outline.size();
    add_face(std::array<vec3, 4>{back[i], back[next], front[next], front[i]});
  }
  add_face(front);
  std::reverse(back.begin(), back.end());
  add_face(back);
}

void SolidBuilder::add_blob(const vec3& centre, const vec3& radii, float roughness, std::uint64_t key) {
  const auto first = static_cast<std::uint32_t>(mesh_.position.size());
  Rng draw(key);
  const auto add = [&](const vec3& direction) {
    const float share = 1 - roughness * static_cast<float>(draw.unit());
    mesh_.position.push_back(centre + radii * direction * share + 0.0F);
    mesh_.normal.push_back(unit(direction / radii) + 0.0F);
  };
  add({0, -1, 0});
  for (int row = 1; row <= blob_rows; ++row) {
    const math::SinCos tilt = math::sincos_degrees(180.0 * row / (blob_rows + 1));
    for (int i = 0; i < blob_columns; ++i) {
      const math::SinCos turn = math::sincos_degrees(360.0 * (i + 0.5 * (row % 2)) / blob_columns);
      add({static_cast<float>(tilt.sin * turn.cos), static_cast<float>(0 - tilt.cos),
           static_cast<float>(0 - tilt.sin * turn.sin)});
    }
  }
  add({0, 1, 0});
  const auto vertex = [&](int row, int i) {
    return first + 1 +
           static_cast<std::uint32_t>((row - 1) * blob_columns + (i + blob_columns) % blob_columns);
  };
  const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t corner : {a, b, c}) mesh_.index.wide.push_back(corner);
  };
  const std::uint32_t last = first + 1 + blob_rows * blob_columns;
  for (int i = 0; i < blob_columns; ++i) {
    add_triangle(first, vertex(1, i + 1), vertex(1, i));
    add_triangle(last, vertex(blob_rows, i), vertex(blob_rows, i + 1));
    for (int row = 1; row < blob_rows; ++row) {
      // Odd rows are turned by half a column against even ones.
      const int shift = row % 2;
      add_triangle(vertex(row, i), vertex(row, i + 1), vertex(row + 1, i + shift));
      add_triangle(vertex(row + 1, i + shift), vertex(row, i + 1), vertex(row + 1, i + 1 + shift));
    }
  }
}

}  // namespace seedmesh::city
