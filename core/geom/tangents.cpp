#include "core/geom/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/base/wide.h"
#include "core/geom/four.h"
#include "core/geom/piece_tangents.h"
#include "core/geom/repeats.h"

namespace seedmesh {
namespace {

/// Some direction at right angles to a unit vector.
glm::vec3 any_across(const glm::vec3& normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return math::unit(glm::cross(normal, axis), {0, 0, 1});
}

/// Along u and along v, summed over the triangles at a vertex; each in the first three lanes.
struct Sums {
  FourFloats u{}, v{};
};

glm::vec3 first_three(const FourFloats& v) { return {v[0], v[1], v[2]}; }

glm::vec4 tangent_of(const glm::vec3& normal, const Sums& sums) {
  const glm::vec3 u = first_three(sums.u);
  const glm::vec3 flat = u - normal * glm::dot(normal, u);
  const bool is_none = glm::dot(flat, flat) <= 1e-8F * glm::dot(u, u);
  const auto across = [&] { return any_across(normal); };
  const glm::vec3 tangent = is_none ? across() : math::unit_or(flat, across);
  // v grows down the picture, and the bitangent points up it.
  const float w = glm::dot(glm::cross(normal, tangent), first_three(sums.v)) > 0 ? -1.0F : 1.0F;
  return {tangent, w};
}

/// tangent_of() four vertices at once; false: one of them has no direction of its own.
SEEDMESH_WIDE bool write_four(const glm::vec3* normals, const Sums* sums, glm::vec4* out) {
  const Four n = Four::of(normals), u = Four::of_rows(sums[0].u, sums[1].u, sums[2].u, sums[3].u),
             v = Four::of_rows(sums[0].v, sums[1].v, sums[2].v, sums[3].v);
  const Four flat = difference(u, scaled(n, dot(n, u)));
  const Four sizes{magnitude(flat.x), magnitude(flat.y), magnitude(flat.z)};
  const FourFloats more = chosen(sizes.x < sizes.y, sizes.y, sizes.x);
  const FourFloats largest = chosen(more < sizes.z, sizes.z, more);
  const FourFlags good = (dot(flat, flat) > 1e-8F * dot(u, u)) & (largest > 0.0F) &
                         (largest <= std::numeric_limits<float>::max());
  if (!all_of(good)) return false;
  const Four reduced = divided(flat, largest), tangent = divided(reduced, root(dot(reduced, reduced)));
  const FourFloats one = four_times(1), side = chosen(dot(cross(n, tangent), v) > 0.0F, -one, one);
  const FourFloats xy[2] = {__builtin_shufflevector(tangent.x, tangent.y, 0, 4, 1, 5),
                            __builtin_shufflevector(tangent.x, tangent.y, 2, 6, 3, 7)},
                   zw[2] = {__builtin_shufflevector(tangent.z, side, 0, 4, 1, 5),
                            __builtin_shufflevector(tangent.z, side, 2, 6, 3, 7)};
  for (std::size_t k = 0; k < 2; ++k) {
    const FourFloats rows[2] = {__builtin_shufflevector(xy[k], zw[k], 0, 1, 4, 5),
                                __builtin_shufflevector(xy[k], zw[k], 2, 3, 6, 7)};
    std::memcpy(static_cast<void*>(out + 2 * k), rows, sizeof(rows));
  }
  return true;
}

/// Part of a mesh: its triangles, and its vertices from `first` on.
template <class Index>
struct Piece {
  std::span<const Index> index;
  std::size_t first = 0;
};

/// A vertex of a mesh in the first three lanes; of all but the last the next float is read too.
FourFloats vertex_of(const Mesh& mesh, std::size_t i) {
  const glm::vec3* from = mesh.position.data() + i;
  return i + 1 == mesh.position.size() ? spread_out(*from) : Four::row(from);
}

template <class Index>
void sum_all(const Mesh& mesh, const Piece<Index>& piece, const Array<glm::vec2>& uv, std::span<Sums> sums) {
  for (std::size_t i = 0; i + 2 < piece.index.size(); i += 3) {
    const Index corner[3] = {piece.index[i], piece.index[i + 1], piece.index[i + 2]};
    const glm::vec2 s = uv[corner[1]] - uv[corner[0]], t = uv[corner[2]] - uv[corner[0]];
    const float area = s.x * t.y - s.y * t.x;
    if (area == 0) continue;
    const FourFloats from = vertex_of(mesh, corner[0]), a = vertex_of(mesh, corner[1]) - from,
                     b = vertex_of(mesh, corner[2]) - from;
    // Not divided by the area in the picture but by its sign: large triangles count more.
    const float sign = area < 0 ? -1.0F : 1.0F;
    const FourFloats along_u = (a * t.y - b * s.y) * sign, along_v = (b * s.x - a * t.x) * sign;
    for (const Index k : corner) {
      sums[k - piece.first].u += along_u;
      sums[k - piece.first].v += along_v;
    }
  }
}

SEEDMESH_WIDE void sum_up(const Mesh& mesh, const Piece<std::uint16_t>& piece, const Array<glm::vec2>& uv,
                          std::span<Sums> sums) {
  sum_all(mesh, piece, uv, sums);
}
SEEDMESH_WIDE void sum_up(const Mesh& mesh, const Piece<std::uint32_t>& piece, const Array<glm::vec2>& uv,
                          std::span<Sums> sums) {
  sum_all(mesh, piece, uv, sums);
}

/// The tangents of `vertices` vertices that no triangle shares with others; `sums` has room for them.
template <class Index>
void add_tangents(Mesh& mesh, const Piece<Index>& piece, const Array<glm::vec2>& uv, std::span<Sums> sums) {
  std::fill(sums.begin(), sums.end(), Sums{});
  sum_up(mesh, piece, uv, sums);
  const glm::vec3* normal = mesh.normal.data() + piece.first;
  glm::vec4* tangent = mesh.tangent.data() + piece.first;
  for (std::size_t i = 0; i < sums.size(); i += Four::size) {
    if (i + Four::size <= sums.size() && write_four(normal + i, sums.data() + i, tangent + i)) continue;
    const std::size_t end = std::min(i + Four::size, sums.size());
    for (std::size_t k = i; k < end; ++k) tangent[k] = tangent_of(normal[k], sums[k]);
  }
}

void add_tangents(Mesh& mesh, const Array<glm::vec2>& uv, const Job& job) {
  const std::size_t vertices = mesh.position.size();
  if (!mesh.index.small.empty()) {
    Array<Sums> sums(job, vertices);
    return add_tangents(mesh, Piece<std::uint16_t>{mesh.index.small.span(), 0}, uv, sums.span());
  }
  // Leaf by leaf, so that the sums take no memory to speak of.
  Repeats one = repeats_of(mesh.index.wide, vertices);
  if (one.corners == 0) one = {vertices, mesh.index.wide.size()};
  Array<Sums> sums(job, one.vertices);
  const std::span<const std::uint32_t> index = mesh.index.wide.span();
  const PieceTangents pieces(mesh, uv, one);
  for (std::size_t piece = pieces.write_all(job); piece * one.vertices < vertices; ++piece) {
    if (piece % 256 == 0) job.check();
    add_tangents(mesh,
                 Piece<std::uint32_t>{index.subspan(piece * one.corners, one.corners), piece * one.vertices},
                 uv, sums.span());
  }
}

}  // namespace

void add_tangents(Model& model, const Job& job) {
  std::vector<std::pair<Mesh*, const Array<glm::vec2>*>> wanted;
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      Mesh& mesh = primitive.mesh;
      if (primitive.material < 0 || mesh.topology != Topology::triangles || mesh.normal.empty()) continue;
      const TextureUse& map = model.materials[static_cast<std::size_t>(primitive.material)].normal_texture;
      if (map.texture < 0 || !mesh.tangent.empty()) continue;
      const auto& uv = mesh.uv[static_cast<std::size_t>(map.uv_set)];
      if (!uv.empty()) wanted.emplace_back(&mesh, &uv);
    }
  }
  // By this thread, which has memory from the last time: another would have to get it from the kernel.
  for (const auto& [mesh, uv] : wanted) mesh->tangent = Array<glm::vec4>(job, mesh->position.size());
  parallel_for(job, wanted.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) add_tangents(*wanted[i].first, *wanted[i].second, job);
  });
}

}  // namespace seedmesh
