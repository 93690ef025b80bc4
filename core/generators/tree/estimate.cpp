#include "core/generators/tree/estimate.h"

#include "core/base/math.h"
#include "core/generators/tree/dress.h"
#include "core/generators/tree/leaves.h"
#include "core/generators/tree/looks.h"
#include "core/geom/graft_count.h"

namespace seedmesh::tree {
namespace {

// Of a GLB: position, normal, texture coordinate of a vertex; its tangent where it wears a picture; the
// colour of a leaf's; JSON.
constexpr std::uint64_t vertex_bytes = 32, tangent_bytes = 16, color_bytes = 4, file_bytes = 4600;
// Of bark, vertices by triangles, as measured.
constexpr double vertices_a_triangle = 0.71;
// PNG files of bark and leaves (colour, normal, surface), bytes by texel, in the mean of all kinds.
constexpr double bark_picture = 3.8, leaf_picture = 2.3;

std::uint64_t index_bytes(std::uint64_t vertices, std::uint64_t triangles) {
  return 3 * triangles * (vertices > 65'535 ? 4 : 2);
}

}  // namespace

Estimate estimate_of(Skeleton skeleton, const TreeParams& params, Job& job) {
  Estimate estimate;
  const std::uint64_t bark = graft_triangles(skeleton.limbs, bark_options(params), job);
  const auto vertices =
      static_cast<std::uint64_t>(math::to_int64(vertices_a_triangle * static_cast<double>(bark)));
  const double texels = static_cast<double>(job.demand().textures) * job.demand().textures;
  const std::uint64_t tangent = texels > 0 ? tangent_bytes : 0;
  const bool is_plain = params.bark == TreeBark::none;
  double pictures = is_plain ? 0 : bark_picture * texels;
  estimate.triangles = bark;
  estimate.bytes =
      file_bytes + vertices * (vertex_bytes + (is_plain ? 0 : tangent)) + index_bytes(vertices, bark);
  if (has_leaves(params)) {
    const Mesh leaf = leaf_of(params, 0, job);
    fit_leaves(skeleton.organs, params, leaf, job);
    const std::uint64_t count = skeleton.organs.organ.size(), leaves = count * leaf.elements(),
                        corners = count * leaf.position.size();
    estimate.triangles += leaves;
    const bool has_picture = wears_picture(params);
    estimate.bytes +=
        corners * (vertex_bytes + color_bytes + (has_picture ? tangent : 0)) + index_bytes(corners, leaves);
    if (has_picture) pictures += leaf_picture * texels;
  }
  estimate.bytes += static_cast<std::uint64_t>(math::to_int64(pictures));
  return estimate;
}

}  // namespace seedmesh::tree
