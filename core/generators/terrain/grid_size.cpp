#include "core/generators/terrain/grid_size.h"

#include <algorithm>

#include "core/base/math.h"
#include "core/generators/estimate.h"
#include "core/generators/terrain/build_model.h"
#include "core/generators/terrain/plan.h"

namespace seedmesh::terrain {
namespace {

// Most samples along a side of a small version, and the rounds of a subdivision for these.
constexpr std::int32_t small_side = 129, small_rounds = 7;

/// A field with the same forms and fewer samples.
TerrainParams small_version(const TerrainParams& params) {
  TerrainParams made = params;
  made.hydraulic.reset();
  made.refine.reset();
  made.water_level.reset();
  made.base.reset();
  made.skirt = 0;
  if (made.resample) made.resample = std::min(*made.resample, small_side);
  if (is_subdivided(made)) {
    made.iterations = std::min(made.iterations.value_or(small_rounds), small_rounds);
    made.extra_iterations = 0;
  } else {
    made.resolution = std::min(made_side(made), static_cast<int>(small_side));
  }
  return made;
}

/// What the classes of ground of a field add.
struct GroundDetail {
  double several = 1;  ///< vertices for each one of the grid
  Estimate images;
};

GroundDetail ground_detail(const TerrainParams& params, const GenerateContext& context) {
  Job own = context.job.for_estimate();
  const TerrainParams small = small_version(params);
  const Result<Field> field = field_of(small, own);
  GroundDetail detail;
  if (!field) return detail;
  const Demand demand{.textures = context.demand.textures, .tangents = false};
  const Model model = build_field_model(small, *field, {own, demand, {}, {}});
  std::size_t vertices = 0;
  for (const Primitive& primitive : model.meshes[0].primitives) vertices += primitive.mesh.position.size();
  detail.several = static_cast<double>(vertices) / (static_cast<double>(field->width) * field->depth);
  add_images_of(detail.images, model, demand.textures);
  return detail;
}

}  // namespace

std::uint64_t bytes_of_grid(const TerrainParams& params, std::uint64_t triangles,
                            const GenerateContext& context) {
  const Demand& demand = context.demand;
  // Refined ground is one mesh, whose indices are wide.
  const std::uint64_t bytes_a_triangle = params.refine ? 12 : 6;
  const auto squares = static_cast<std::uint64_t>(finished_side(params) - 1);
  const auto vertices = static_cast<double>(triangles / 2 + 2 * squares + 1);
  GroundDetail detail;
  double of_vertex = bytes_a_vertex;
  if (params.detail && demand.textures > 0 && params.texture == 0) {
    detail = ground_detail(params, context);
    of_vertex += bytes_of_coordinates + (demand.tangents ? bytes_of_tangent : 0);
  }
  // A quarter, and the borders, which keep their vertices; measured on the presets.
  constexpr double share_of_next = 0.28;
  double levels = 1;
  for (int level = 1; level < demand.lods; ++level) levels += math::pow(share_of_next, level);
  const double bytes =
      levels * (vertices * detail.several * of_vertex + static_cast<double>(triangles * bytes_a_triangle));
  return document_bytes + detail.images.bytes + static_cast<std::uint64_t>(math::to_int64(bytes));
}

}  // namespace seedmesh::terrain
