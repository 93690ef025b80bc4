#include "core/generators/tree/estimate.h"

#include "core/base/math.h"
#include "core/generators/tree/build_model.h"
#include "core/generators/tree/leaves.h"
#include "core/generators/tree/materials.h"
#include "core/geom/plant/graft/triangle_estimate.h"

namespace seedmesh::tree {
namespace {

// Bytes in a GLB: a vertex with position, normal and texture coordinates; wind weights; the tangent of a vertex with a
// texture; the colour of a vertex of a leaf; JSON.
constexpr std::uint64_t plain_bytes = 32, wind_bytes = 16, tangent_bytes = 16, color_bytes = 4,
                        file_bytes = 4600;
// Vertices of bark per triangle, measured.
constexpr double vertices_a_triangle = 0.71;

std::uint64_t index_bytes(std::uint64_t vertices, std::uint64_t triangles) {
  return 3 * triangles * (vertices > 65'535 ? 4 : 2);
}

}  // namespace

Estimate estimate_of(Skeleton skeleton, const TreeParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Estimate estimate;
  const std::uint64_t bark = graft_triangles(skeleton.limbs, bark_options(params), job);
  const auto vertices =
      static_cast<std::uint64_t>(math::to_int64(vertices_a_triangle * static_cast<double>(bark)));
  const std::uint64_t tangent = context.demand.textures > 0 && context.demand.tangents ? tangent_bytes : 0;
  const std::uint64_t vertex_bytes = plain_bytes + (context.demand.wind ? wind_bytes : 0);
  Model model;  // of materials alone
  add_bark_material(model, params, job);
  estimate.triangles = bark;
  estimate.bytes = file_bytes + vertices * (vertex_bytes + (has_bark_relief(params) ? tangent : 0)) +
                   index_bytes(vertices, bark);
  if (has_leaves(params)) {
    const Mesh leaf = drawn_leaf(params, 0, context);
    fit_leaves(skeleton.organs, params, leaf, job);
    const std::uint64_t count = skeleton.organs.organ.size(), leaves = count * leaf.elements(),
                        corners = count * leaf.position.size();
    estimate.triangles += leaves;
    const bool has_relief = has_leaf_relief(params, context.demand);
    add_leaf_materials(model, params, context);
    estimate.bytes +=
        corners * (vertex_bytes + color_bytes + (has_relief ? tangent : 0)) + index_bytes(corners, leaves);
  }
  add_images_of(estimate, model, context.demand.textures);
  return estimate;
}

}  // namespace seedmesh::tree
