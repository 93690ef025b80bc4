#include "core/geom/piece_tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/wide.h"
#include "core/geom/four.h"

namespace seedmesh {
namespace {

constexpr std::size_t lanes = PieceTangents::lanes, most_vertices = 96;

using Row = std::array<float, lanes>;
struct Rows3 {
  Row x, y, z;
};
struct Corner {
  Rows3 position, normal, along_u, along_v, tangent;
  Row w;
};

void put(Rows3& out, std::size_t l, const glm::vec3& v) {
  out.x[l] = v.x;
  out.y[l] = v.y;
  out.z[l] = v.z;
}

/// Vectors `step` after each other, one a lane. Reads a float beyond each.
void fill(Rows3& out, const glm::vec3* from, std::size_t step) {
  for (std::size_t l = 0; l < lanes; l += Four::size) {
    const glm::vec3* at = from + l * step;
    const Four four = Four::of_rows(Four::row(at), Four::row(at + step), Four::row(at + 2 * step),
                                    Four::row(at + 3 * step));
    std::memcpy(out.x.data() + l, &four.x, sizeof(four.x));
    std::memcpy(out.y.data() + l, &four.y, sizeof(four.y));
    std::memcpy(out.z.data() + l, &four.z, sizeof(four.z));
  }
}

/// One a lane, to `out` and every `step` after it.
void write(const Corner& corner, glm::vec4* out, std::size_t step) {
  for (std::size_t l = 0; l < lanes; l += Four::size) {
    FourFloats x, y, z, w;
    std::memcpy(&x, corner.tangent.x.data() + l, sizeof(x));
    std::memcpy(&y, corner.tangent.y.data() + l, sizeof(y));
    std::memcpy(&z, corner.tangent.z.data() + l, sizeof(z));
    std::memcpy(&w, corner.w.data() + l, sizeof(w));
    const FourFloats xy[2] = {__builtin_shufflevector(x, y, 0, 4, 1, 5),
                              __builtin_shufflevector(x, y, 2, 6, 3, 7)},
                     zw[2] = {__builtin_shufflevector(z, w, 0, 4, 1, 5),
                              __builtin_shufflevector(z, w, 2, 6, 3, 7)};
    for (std::size_t k = 0; k < Four::size; ++k) {
      const FourFloats row = k % 2 == 0 ? __builtin_shufflevector(xy[k / 2], zw[k / 2], 0, 1, 4, 5)
                                        : __builtin_shufflevector(xy[k / 2], zw[k / 2], 2, 3, 6, 7);
      std::memcpy(static_cast<void*>(out + (l + k) * step), &row, sizeof(row));
    }
  }
}

glm::vec3 at(const Rows3& rows, std::size_t l) { return {rows.x[l], rows.y[l], rows.z[l]}; }

float product(const glm::vec3& a, const glm::vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// What a triangle gives to one of its corners.
SEEDMESH_WIDE void add_sides(const Rows3& p, const Rows3& q, const Rows3& r, const glm::vec2& s,
                             const glm::vec2& t, float sign, Rows3& __restrict along_u,
                             Rows3& __restrict along_v) {
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 a{q.x[l] - p.x[l], q.y[l] - p.y[l], q.z[l] - p.z[l]};
    const glm::vec3 b{r.x[l] - p.x[l], r.y[l] - p.y[l], r.z[l] - p.z[l]};
    put(along_u, l,
        {(a.x * t.y - b.x * s.y) * sign, (a.y * t.y - b.y * s.y) * sign, (a.z * t.y - b.z * s.y) * sign});
    put(along_v, l,
        {(b.x * s.x - a.x * t.x) * sign, (b.y * s.x - a.y * t.x) * sign, (b.z * s.x - a.z * t.x) * sign});
  }
}

SEEDMESH_WIDE void sum_up(const Rows3& more, Rows3& __restrict sum) {
  for (std::size_t l = 0; l < lanes; ++l) {
    sum.x[l] += more.x[l];
    sum.y[l] += more.y[l];
    sum.z[l] += more.z[l];
  }
}

/// tangent_of() of tangents.cpp; returns the number of lanes without a direction of their own.
SEEDMESH_WIDE std::uint32_t settle(Corner& c) {
  constexpr float most = std::numeric_limits<float>::max();
  std::uint32_t faults = 0;
  for (std::size_t l = 0; l < lanes; ++l) {
    const glm::vec3 n = at(c.normal, l), u = at(c.along_u, l);
    const float along = product(n, u);
    const glm::vec3 flat{u.x - n.x * along, u.y - n.y * along, u.z - n.z * along};
    const float x = std::abs(flat.x), y = std::abs(flat.y), z = std::abs(flat.z);
    const float more = x < y ? y : x, largest = more < z ? z : more;
    const float size = product(flat, flat), whole = product(u, u);
    const bool is_good = (size > 1e-8F * whole) & (largest > 0.0F) & (largest <= most);
    faults += is_good ? 0U : 1U;
    const glm::vec3 reduced{flat.x / largest, flat.y / largest, flat.z / largest};
    const float length = std::sqrt(product(reduced, reduced));
    const glm::vec3 t{reduced.x / length, reduced.y / length, reduced.z / length};
    put(c.tangent, l, t);
    const glm::vec3 across{n.y * t.z - t.y * n.z, n.z * t.x - t.z * n.x, n.x * t.y - t.x * n.y};
    c.w[l] = product(across, at(c.along_v, l)) > 0.0F ? -1.0F : 1.0F;
  }
  return faults;
}

}  // namespace

PieceTangents::PieceTangents(Mesh& mesh, const Array<glm::vec2>& uv, const Repeats& one)
    : mesh_(mesh), uv_(uv), one_(one) {
  if (one.vertices > most_vertices) return;
  for (std::size_t i = 0; i + 2 < one.corners; i += 3) {
    const std::uint32_t* corner = mesh.index.wide.data() + i;
    const glm::vec2 s = uv[corner[1]] - uv[corner[0]], t = uv[corner[2]] - uv[corner[0]];
    const float area = s.x * t.y - s.y * t.x;
    if (area != 0) triangles_.push_back({{corner[0], corner[1], corner[2]}, s, t, area < 0 ? -1.0F : 1.0F});
  }
}

bool PieceTangents::have_same_picture(std::size_t first_piece) const {
  for (std::size_t piece = first_piece; piece < first_piece + lanes; ++piece) {
    const glm::vec2* own = uv_.data() + piece * one_.vertices;
    if (std::memcmp(own, uv_.data(), one_.vertices * sizeof(glm::vec2)) != 0) return false;
  }
  return true;
}

bool PieceTangents::write_block(std::size_t first_piece) const {
  if (!have_same_picture(first_piece)) return false;
  Corner corners[most_vertices];
  const std::size_t vertices = one_.vertices, first = first_piece * vertices;
  const bool is_last = first + lanes * vertices == mesh_.position.size();
  for (std::size_t i = 0; i < vertices; ++i) {
    Corner& corner = corners[i];
    if (!is_last) {
      fill(corner.position, mesh_.position.data() + first + i, vertices);
      fill(corner.normal, mesh_.normal.data() + first + i, vertices);
    }
    for (std::size_t l = 0; is_last && l < lanes; ++l) {
      put(corner.position, l, mesh_.position[first + l * vertices + i]);
      put(corner.normal, l, mesh_.normal[first + l * vertices + i]);
    }
    corner.along_u = corner.along_v = {};
  }
  for (const Triangle& triangle : triangles_) {
    Rows3 along_u, along_v;
    add_sides(corners[triangle.corner[0]].position, corners[triangle.corner[1]].position,
              corners[triangle.corner[2]].position, triangle.s, triangle.t, triangle.sign, along_u, along_v);
    for (const std::uint32_t k : triangle.corner) {
      sum_up(along_u, corners[k].along_u);
      sum_up(along_v, corners[k].along_v);
    }
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    if (settle(corners[i]) > 0) return false;
  }
  for (std::size_t i = 0; i < vertices; ++i) write(corners[i], mesh_.tangent.data() + first + i, vertices);
  return true;
}

std::size_t PieceTangents::write_all(std::size_t begin, std::size_t end) const {
  std::size_t piece = begin;
  if (triangles_.empty()) return piece;
  while (piece + lanes <= end && write_block(piece)) piece += lanes;
  return piece;
}

}  // namespace seedmesh
