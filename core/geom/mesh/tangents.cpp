#include "core/geom/mesh/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/base/wide.h"
#include "core/geom/mesh/negative_zero.h"
#include "core/geom/mesh/repeated_pieces.h"
#include "core/geom/mesh/vec3x4.h"

namespace seedmesh {
namespace {

using EightFloats = float __attribute__((vector_size(32)));

/// The directions of u and v, summed over the triangles at a vertex; each in the first three lanes. Both are
/// added to as eight floats.
struct Sums {
  Float4 u{}, v{};
};

glm::vec3 first_three(const Float4& v) { return {v[0], v[1], v[2]}; }

glm::vec4 tangent_of(const glm::vec3& normal, const Sums& sums) {
  const glm::vec3 u = first_three(sums.u);
  const glm::vec3 flat = u - normal * glm::dot(normal, u);
  const bool is_none = glm::dot(flat, flat) <= 1e-8F * glm::dot(u, u);
  const auto across = [&] { return any_perpendicular(normal); };
  const glm::vec3 tangent = is_none ? across() : math::unit_or(flat, across);
  // v grows down the texture, and the bitangent points up.
  const float w = glm::dot(glm::cross(normal, tangent), first_three(sums.v)) > 0 ? -1.0F : 1.0F;
  return {tangent, w};
}

/// Part of a mesh: its triangles, and its vertices from `first` on.
template <class Index>
struct Piece {
  std::span<const Index> index;
  std::size_t first = 0;
};

/// A vertex in the first three lanes. The float behind it is read too, except at the last vertex of the mesh.
template <bool has_last>
Float4 vertex_of(const Mesh& mesh, std::size_t i) {
  const glm::vec3* from = mesh.position.data() + i;
  return has_last && i + 1 == mesh.position.size() ? spread_out(*from) : Vec3x4::row(from);
}

template <bool has_last, class Index>
void sum_all(const Mesh& mesh, const Piece<Index>& piece, const Array<glm::vec2>& uv, std::span<Sums> sums) {
  for (std::size_t i = 0; i + 2 < piece.index.size(); i += 3) {
    const Index corner[3] = {piece.index[i], piece.index[i + 1], piece.index[i + 2]};
    const glm::vec2 s = uv[corner[1]] - uv[corner[0]], t = uv[corner[2]] - uv[corner[0]];
    const float area = s.x * t.y - s.y * t.x;
    if (area == 0) continue;
    const Float4 from = vertex_of<has_last>(mesh, corner[0]), a = vertex_of<has_last>(mesh, corner[1]) - from,
                 b = vertex_of<has_last>(mesh, corner[2]) - from;
    // Divided by the sign of the area in the texture, not by the area: large triangles count more.
    const float sign = area < 0 ? -1.0F : 1.0F;
    const EightFloats both_a = __builtin_shufflevector(a, a, 0, 1, 2, 3, 0, 1, 2, 3),
                      both_b = __builtin_shufflevector(b, b, 0, 1, 2, 3, 0, 1, 2, 3);
    const Float4 a_for_u = all_lanes(t.y), a_for_v = all_lanes(-t.x), b_for_u = all_lanes(-s.y),
                 b_for_v = all_lanes(s.x);
    // Along u: a t.y - b s.y; along v: b s.x - a t.x.
    const EightFloats along = (both_a * __builtin_shufflevector(a_for_u, a_for_v, 0, 1, 2, 3, 4, 5, 6, 7) +
                               both_b * __builtin_shufflevector(b_for_u, b_for_v, 0, 1, 2, 3, 4, 5, 6, 7)) *
                              sign;
    for (const Index k : corner) {
      static_assert(sizeof(Sums) == sizeof(EightFloats));
      Sums& at = sums[k - piece.first];
      EightFloats sum;
      std::memcpy(&sum, &at, sizeof(sum));
      sum += along;
      std::memcpy(static_cast<void*>(&at), &sum, sizeof(sum));
    }
  }
}

SEEDMESH_WIDE void sum_up(const Mesh& mesh, const Piece<std::uint16_t>& piece, const Array<glm::vec2>& uv,
                          std::span<Sums> sums) {
  sum_all<true>(mesh, piece, uv, sums);
}
SEEDMESH_WIDE void sum_up(const Mesh& mesh, const Piece<std::uint32_t>& piece, const Array<glm::vec2>& uv,
                          std::span<Sums> sums) {
  if (piece.first + sums.size() < mesh.position.size()) return sum_all<false>(mesh, piece, uv, sums);
  sum_all<true>(mesh, piece, uv, sums);
}

/// The tangents of a part of a mesh; `sums` has an element for each of its vertices.
template <class Index>
void add_tangents(Mesh& mesh, const Piece<Index>& piece, const Array<glm::vec2>& uv, std::span<Sums> sums) {
  std::fill(sums.begin(), sums.end(), Sums{});
  sum_up(mesh, piece, uv, sums);
  const glm::vec3* normal = mesh.normal.data() + piece.first;
  glm::vec4* tangent = mesh.tangent.data() + piece.first;
  for (std::size_t i = 0; i < sums.size(); ++i) tangent[i] = tangent_of(normal[i], sums[i]);
  clear_minus_zeros(mesh.tangent, piece.first, sums.size());
}

// Parts whose sums are still in the cache when their tangents are computed.
constexpr std::size_t vertices_a_part = 2048;
constexpr std::size_t corners_a_part = 3 * vertices_a_part;

/// Triangles from corner number `corner` on use vertices from `vertex` on; earlier triangles use none of
/// them.
struct Cut {
  std::size_t corner = 0, vertex = 0;
};

SEEDMESH_WIDE std::uint32_t largest_of(std::span<const std::uint32_t> index) {
  std::uint32_t most = 0;
  for (const std::uint32_t i : index) most = i > most ? i : most;
  return most;
}
SEEDMESH_WIDE std::uint32_t least_of(std::span<const std::uint32_t> index) {
  std::uint32_t least = 0xFFFFFFFFU;
  for (const std::uint32_t i : index) least = i < least ? i : least;
  return least;
}

/// Cuts a mesh into parts that share no vertices: the beginning, the cuts, the end.
std::vector<Cut> cuts_of(std::span<const std::uint32_t> index, std::size_t vertices, const Job& job) {
  std::vector<Cut> cuts(1);
  std::uint32_t most = 0;
  for (std::size_t at = 0; at < index.size();) {
    job.check();
    const std::size_t next = std::min(index.size(), at + corners_a_part);
    most = std::max(most, largest_of(index.subspan(at, next - at)));
    for (at = next; at < index.size(); at += 3) {
      const std::uint32_t* corner = index.data() + at;
      if (std::min({corner[0], corner[1], corner[2]}) > most) break;
      most = std::max({most, corner[0], corner[1], corner[2]});
    }
    if (at < index.size()) cuts.push_back({at, std::size_t{most} + 1});
  }
  // A cut is dropped where a later triangle uses a vertex before it.
  std::size_t least = vertices, end = index.size();
  std::vector<Cut> kept{{index.size(), vertices}};
  for (std::size_t i = cuts.size(); i-- > 1;) {
    least = std::min<std::size_t>(least, least_of(index.subspan(cuts[i].corner, end - cuts[i].corner)));
    end = cuts[i].corner;
    if (least >= cuts[i].vertex) kept.push_back(cuts[i]);
  }
  kept.emplace_back();
  std::reverse(kept.begin(), kept.end());
  return kept;
}

/// The tangents of one mesh, in parts that share no vertices.
class MeshTangents {
 public:
  MeshTangents(Mesh& mesh, const Array<glm::vec2>& uv, const Job& job) : mesh_(mesh), uv_(uv) {
    const std::size_t vertices = mesh.position.size();
    if (!mesh.index.small.empty()) return;
    if (const Repeats one = repeats_of(mesh.index.wide, vertices); one.corners > 0) {
      one_ = one;
    } else {
      cuts_ = cuts_of(mesh.index.wide.span(), vertices, job);
    }
  }

  std::size_t parts() const {
    if (!mesh_.index.small.empty()) return 1;
    return one_.corners > 0 ? chunk_count(pieces(), pieces_a_part) : cuts_.size() - 1;
  }

  void write(std::size_t part, const Job& job) {
    job.check();
    if (!mesh_.index.small.empty()) {
      Array<Sums> sums(job, mesh_.position.size());
      return add_tangents(mesh_, Piece<std::uint16_t>{mesh_.index.small.span(), 0}, uv_, sums.span());
    }
    if (one_.corners > 0) return write_pieces(part, job);
    const Cut from = cuts_[part], to = cuts_[part + 1];
    Array<Sums> sums(job, to.vertex - from.vertex);
    const std::span<const std::uint32_t> index = mesh_.index.wide.span();
    add_tangents(mesh_,
                 Piece<std::uint32_t>{index.subspan(from.corner, to.corner - from.corner), from.vertex}, uv_,
                 sums.span());
  }

 private:
  static constexpr std::size_t pieces_a_part = 512;

  std::size_t pieces() const { return mesh_.position.size() / one_.vertices; }

  /// Piece by piece, so that the sums stay in the cache.
  void write_pieces(std::size_t part, const Job& job) {
    const std::size_t begin = part * pieces_a_part, end = std::min(pieces(), begin + pieces_a_part);
    const std::span<const std::uint32_t> index = mesh_.index.wide.span();
    Array<Sums> sums(job, one_.vertices);
    for (std::size_t piece = begin; piece < end; ++piece) {
      const std::size_t first = piece * one_.corners;
      add_tangents(mesh_, Piece<std::uint32_t>{index.subspan(first, one_.corners), piece * one_.vertices},
                   uv_, sums.span());
    }
  }

  Mesh& mesh_;
  const Array<glm::vec2>& uv_;
  Repeats one_;
  std::vector<Cut> cuts_;
};

}  // namespace

glm::vec3 any_perpendicular(const glm::vec3& normal) {
  const glm::vec3 axis = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  return math::unit(glm::cross(normal, axis), {0, 0, 1});
}

void add_tangents(Model& model, const Job& job) {
  std::vector<MeshTangents> wanted;
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      Mesh& mesh = primitive.mesh;
      if (primitive.material < 0 || mesh.topology != Topology::triangles || mesh.normal.empty()) continue;
      const TextureUse& map = model.materials[static_cast<std::size_t>(primitive.material)].normal_texture;
      if (map.texture < 0 || !mesh.tangent.empty()) continue;
      const auto& uv = mesh.uv[static_cast<std::size_t>(map.uv_set)];
      if (uv.empty()) continue;
      // Allocated by this thread, which can reuse memory; other threads would get new pages from the kernel.
      mesh.tangent = Array<glm::vec4>(job, mesh.position.size());
      wanted.emplace_back(mesh, uv, job);
    }
  }
  struct Part {
    std::size_t mesh, number;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    for (std::size_t part = 0; part < wanted[i].parts(); ++part) parts.push_back({i, part});
  }
  parallel_for(job, parts.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) wanted[parts[i].mesh].write(parts[i].number, job);
  });
}

}  // namespace seedmesh
