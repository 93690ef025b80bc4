// After Hoppe, "Progressive Meshes", 1996, section 3.1: a geomorph moves each vertex of a level to a point of the next
// one, so that a level can change without a visible step. His levels have the vertices in common. These levels are made
// one by one, so the point is found by texture coordinates or by distance.
#include "core/geom/lod/next_positions.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"
#include "core/geom/lod/sheet_pairs.h"
#include "core/geom/lod/thin.h"
#include "core/geom/mesh/mesh_field.h"

namespace seedmesh {
namespace {

constexpr std::size_t vertices_a_chunk = 512;
// Texture coordinates of leaves are 0 to 1; those of single triangles extend into the transparent margin.
constexpr float least_uv = -1, most_uv = 2;
constexpr float least_span = 0.5F;            ///< of the texture coordinates of a leaf, along one axis
constexpr std::size_t most_triangles = 1024;  ///< of a leaf: each vertex is compared with all of them

/// The larger side of the box of a sheet's texture coordinates.
float span_of(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  glm::vec2 low(most_uv), high(least_uv);
  for (const std::uint32_t t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec2& uv = mesh.uv[0][mesh.index.at(3 * std::size_t{t} + k)];
      low = glm::min(low, uv);
      high = glm::max(high, uv);
    }
  }
  return std::max(high.x - low.x, high.y - low.y);
}

/// True where no sheet is larger than a leaf, and nine tenths of the triangles are of sheets that span the texture. The
/// ground of a terrain, which is divided by its materials, has large sheets and fragments instead.
bool spans_leaves(const Mesh& mesh, const Job& job) {
  const Sheets sheets(mesh, job);
  std::size_t spanning = 0;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const std::span<const std::uint32_t> triangles = sheets.triangles(i);
    if (triangles.size() > most_triangles) return false;
    if (span_of(mesh, triangles) >= least_span) spanning += triangles.size();
  }
  return spanning * 10 >= mesh.index.size() / 3 * 9;
}

/// True for a mesh of leaves whose texture coordinates span each leaf.
bool has_sheets(const Mesh& mesh, const Job& job) {
  if (mesh.uv[0].empty() || mesh.index.size() == 0) return false;
  const bool spans = std::ranges::all_of(mesh.uv[0], [](const glm::vec2& uv) {
    return std::min(uv.x, uv.y) >= least_uv && std::max(uv.x, uv.y) <= most_uv;
  });
  return spans && spans_leaves(mesh, job) && is_foliage(mesh, job);
}

/// Shrinks a leaf to its vertex that is nearest to its stalk.
void shrink(Mesh& mesh, const Sheets& sheets, std::size_t sheet) {
  const glm::vec3 stalk = sheets.at(sheet, {0.5F, 1});
  glm::vec3 nearest = mesh.position[mesh.index.at(3 * std::size_t{sheets.triangles(sheet).front()})];
  const auto each_vertex = [&](const auto& visit) {
    for (const std::uint32_t t : sheets.triangles(sheet)) {
      for (std::size_t k = 0; k < 3; ++k) visit(mesh.index.at(3 * std::size_t{t} + k));
    }
  };
  each_vertex([&](std::uint32_t v) {
    if (glm::distance(mesh.position[v], stalk) < glm::distance(nearest, stalk)) nearest = mesh.position[v];
  });
  each_vertex([&](std::uint32_t v) { mesh.next_position[v] = nearest; });
}

void move_sheets(Mesh& mesh, const Mesh& next, const Job& job) {
  const Sheets fine(mesh, job), coarse(next, job);
  const std::vector<std::uint32_t> pair_of = paired_sheets(fine, coarse, job);
  parallel_for(job, fine.size(), vertices_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t i = begin; i < end; ++i) {
      if (pair_of[i] == coarse.size()) {
        shrink(mesh, fine, i);
        continue;
      }
      for (const std::uint32_t t : fine.triangles(i)) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t v = mesh.index.at(3 * std::size_t{t} + k);
          mesh.next_position[v] = coarse.at(pair_of[i], mesh.uv[0][v]);
        }
      }
    }
  });
}

void move_to_surface(Mesh& mesh, const MeshField& surface, const Job& job) {
  parallel_for(job, mesh.position.size(), vertices_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 MeshField::Nearest nearest;
                 for (std::size_t i = begin; i < end; ++i) {
                   nearest = surface.nearest(glm::dvec3(mesh.position[i]), nearest.triangle);
                   mesh.next_position[i] = glm::vec3(nearest.point) + 0.0F;
                 }
               });
}

void fill(MeshGroup& group, const MeshGroup* next, const Job& job) {
  std::vector<const Mesh*> leaves, surfaces;
  if (next) {
    for (const Primitive& each : next->primitives) {
      if (each.mesh.topology == Topology::triangles)
        (has_sheets(each.mesh, job) ? leaves : surfaces).push_back(&each.mesh);
    }
  }
  const MeshField surface(surfaces.empty() ? leaves : surfaces, job);
  std::size_t leaf = 0;
  for (Primitive& primitive : group.primitives) {
    Mesh& mesh = primitive.mesh;
    mesh.next_position = mesh.position.empty_array_of<glm::vec3>();
    mesh.next_position.append(mesh.position.span());
    if (!next || mesh.topology != Topology::triangles || surface.triangles() == 0) continue;
    if (leaf < leaves.size() && has_sheets(mesh, job)) {
      move_sheets(mesh, *leaves[leaf++], job);
    } else {
      move_to_surface(mesh, surface, job);
    }
  }
}

}  // namespace

void add_next_positions(Model& model, const Job& job) {
  std::vector<bool> is_filled(model.meshes.size(), false);
  for (const Node& node : model.nodes) {
    if (node.mesh < 0 || node.lods.empty() || node.collision != CollisionShape::none) continue;
    std::vector<int> levels{node.mesh};
    levels.insert(levels.end(), node.lods.begin(), node.lods.end());
    if (node.has_impostor) levels.pop_back();
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    for (std::size_t i = 0; i < levels.size(); ++i) {
      if (levels[i] < 0 || is_filled[static_cast<std::size_t>(levels[i])]) continue;
      is_filled[static_cast<std::size_t>(levels[i])] = true;
      const int next = i + 1 < levels.size() ? levels[i + 1] : -1;
      fill(model.meshes[static_cast<std::size_t>(levels[i])],
           next < 0 ? nullptr : &model.meshes[static_cast<std::size_t>(next)], job);
    }
  }
}

}  // namespace seedmesh
