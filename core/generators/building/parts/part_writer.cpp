#include "core/generators/building/parts/part_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/model/empty_mesh.h"

namespace seedmesh::building {
namespace {

using glm::dvec2;
using glm::dvec3;

// Profiles are smooth at angles below 40 degrees (as a cosine).
constexpr double smooth = 0.766;

dvec3 placed(ExtrusionAxis along, const dvec2& p, double depth) {
  switch (along) {
    case ExtrusionAxis::x:
      return {depth, p.y, -p.x};
    case ExtrusionAxis::y:
      return {p.x, depth, -p.y};
    default:
      return {p.x, p.y, depth};
  }
}

dvec3 axis_of(ExtrusionAxis along) {
  return along == ExtrusionAxis::x   ? dvec3{1, 0, 0}
         : along == ExtrusionAxis::y ? dvec3{0, 1, 0}
                                     : dvec3{0, 0, 1};
}

/// Texture coordinates in metres: v is the height unless the face is horizontal.
dvec2 texture(const dvec3& p, const dvec3& normal) {
  if (std::abs(normal.y) > 0.99) return {p.x, -p.z};
  const dvec3 right = math::unit(glm::cross(dvec3(0, 1, 0), normal), {1, 0, 0});
  return {glm::dot(p, right), glm::dot(p, glm::cross(normal, right))};
}

}  // namespace

PlanRing rectangle(const dvec2& low, const dvec2& high) {
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

Mesh& PartWriter::mesh_of(std::string_view role) {
  for (PartPiece& piece : pieces_) {
    if (piece.role == role) return piece.mesh;
  }
  PartPiece piece;
  piece.role = role;
  piece.mesh = empty_mesh(job_);
  piece.mesh.uv[0] = Array<glm::vec2>(job_);
  pieces_.push_back(std::move(piece));
  return pieces_.back().mesh;
}

void PartWriter::flat(std::string_view role, const std::vector<dvec3>& points,
                      std::span<const std::uint32_t> triangles, const dvec3& normal) {
  job_.spend(Resource::triangles, triangles.size() / 3);
  Mesh& mesh = mesh_of(role);
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  for (const dvec3& p : points) {
    mesh.position.push_back(glm::vec3(p) + 0.0F);
    mesh.normal.push_back(glm::vec3(normal) + 0.0F);
    mesh.uv[0].push_back(glm::vec2(texture(p, normal)) + 0.0F);
  }
  for (const std::uint32_t i : triangles) mesh.index.wide.push_back(first + i);
}

void PartWriter::face(std::string_view role, const std::vector<dvec3>& corners) {
  const dvec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.insert(triangles.end(), {0, i, i + 1});
  flat(role, corners, triangles, math::unit(across, {0, 1, 0}));
}

void PartWriter::box(std::string_view role, const dvec3& low, const dvec3& high) {
  extrude(role, Plan{{rectangle({low.x, low.y}, {high.x, high.y})}}, {ExtrusionAxis::z, low.z, high.z});
}

void PartWriter::picture_box(std::string_view role, const dvec3& low, const dvec3& high,
                             const PictureWindow& window) {
  Mesh& mesh = mesh_of(role);
  const std::size_t first = mesh.position.size();
  box(role, low, high);
  constexpr double by_depth =
      0.5;  // shares of the picture for each metre, so that sides have texture coordinates
  for (std::size_t i = first; i < mesh.position.size(); ++i) {
    const dvec3 at(mesh.position[i]);
    const dvec2 share = (dvec2(at) - dvec2(low)) / (dvec2(high) - dvec2(low));
    const double behind = by_depth * std::max(high.z - at.z - 1e-7, 0.0);
    const dvec2 shown = window.corner + window.size * dvec2(share.x + behind, 1 - share.y + behind);
    mesh.uv[0][i] = glm::vec2(shown.x, -shown.y) + 0.0F;  // v runs up in parts, and down in pictures
  }
}

void PartWriter::extrude(std::string_view role, const Plan& outline, const Extrusion& extrusion) {
  const dvec3 axis = axis_of(extrusion.along);
  std::vector<dvec3> near_end, far_end;
  for (const PlanRing& ring : outline.rings) {
    for (const dvec2& p : ring) {
      near_end.push_back(placed(extrusion.along, p, extrusion.from));
      far_end.push_back(placed(extrusion.along, p, extrusion.to));
    }
  }
  std::vector<std::uint32_t> triangles = triangulate(outline, ThinTriangles::keep, &job_);
  flat(role, far_end, triangles, axis);
  for (std::size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i], triangles[i + 1]);
  flat(role, near_end, triangles, -axis);
  std::uint32_t first = 0;
  for (const PlanRing& ring : outline.rings) {
    const auto count = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % count;
      face(extrusion.side ? extrusion.side(a) : role, {near_end[a], near_end[b], far_end[b], far_end[a]});
    }
    first += count;
  }
}

void PartWriter::revolve(std::string_view role, const std::vector<ProfilePoint>& profile,
                         const Revolution& revolution) {
  const int sides = std::max(4, (revolution.sides + 3) / 4 * 4);
  const auto columns = static_cast<std::uint32_t>(sides);
  job_.spend(Resource::triangles, 2 * columns * profile.size());
  Mesh& mesh = mesh_of(role);
  const double mean = 0.5 * (revolution.radius.x + revolution.radius.y);
  const auto direction = [&](std::size_t i) {
    const dvec2 d{(profile[i + 1].radius - profile[i].radius) * mean,
                  profile[i + 1].height - profile[i].height};
    return d / glm::length(d);
  };
  double v = 0;
  for (std::size_t s = 0; s + 1 < profile.size(); ++s) {
    const std::array<ProfilePoint, 2> ends{profile[s], profile[s + 1]};
    std::array<dvec2, 2> slope{direction(s), direction(s)};
    if (s > 0 && glm::dot(slope[0], direction(s - 1)) > smooth) slope[0] += direction(s - 1);
    if (s + 2 < profile.size() && glm::dot(slope[1], direction(s + 1)) > smooth) slope[1] += direction(s + 1);
    const double rise =
        glm::length(dvec2((ends[1].radius - ends[0].radius) * mean, ends[1].height - ends[0].height));
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    const bool has_low = ends[0].radius > 0, has_high = ends[1].radius > 0;
    // At an apex each side has its own point, with the normal of the middle of the side.
    for (std::uint32_t row = 0; row < 2; ++row) {
      for (std::uint32_t i = 0; i <= columns; ++i) {
        const bool is_apex = !(ends[row].radius > 0);
        if (is_apex && i == columns) continue;
        const math::SinCos at = math::sincos_degrees(360.0 * (i % columns + (is_apex ? 0.5 : 0)) / sides);
        const dvec3 normal{revolution.radius.y * slope[row].y * at.cos,
                           -revolution.radius.x * revolution.radius.y * slope[row].x / mean,
                           revolution.radius.x * slope[row].y * at.sin};
        mesh.position.push_back(
            glm::vec3(revolution.foot + dvec3(revolution.radius.x * ends[row].radius * at.cos,
                                              ends[row].height,
                                              revolution.radius.y * ends[row].radius * at.sin)) +
            0.0F);
        mesh.normal.push_back(glm::vec3(math::unit(normal, {0, 1, 0})) + 0.0F);
        mesh.uv[0].push_back({static_cast<float>(-2 * math::pi * mean * (i + (is_apex ? 0.5 : 0)) / sides),
                              static_cast<float>(v + row * rise)});
      }
    }
    v += rise;
    const std::uint32_t second = first + columns + (has_low ? 1 : 0);
    for (std::uint32_t i = 0; i < columns; ++i) {
      if (has_low) {
        for (const std::uint32_t corner : {first + i, second + i, first + i + 1})
          mesh.index.wide.push_back(corner);
      }
      if (has_high) {
        const std::uint32_t low = has_low ? first + i + 1 : first + i;
        for (const std::uint32_t corner : {low, second + i, second + i + 1})
          mesh.index.wide.push_back(corner);
      }
    }
  }
}

std::vector<PartPiece> PartWriter::take() { return std::move(pieces_); }

}  // namespace seedmesh::building
