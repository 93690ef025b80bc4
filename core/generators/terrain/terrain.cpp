#include "core/generators/terrain/terrain.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "core/generators/terrain/build_model.h"
#include "core/generators/terrain/displacement.h"
#include "core/generators/terrain/game_engines.h"
#include "core/generators/terrain/grid_size.h"
#include "core/generators/terrain/image.h"
#include "core/generators/terrain/maps.h"
#include "core/generators/terrain/model_parts.h"
#include "core/generators/terrain/plan.h"
#include "core/generators/terrain/profile.h"
#include "core/generators/terrain/refinement.h"
#include "core/generators/terrain/triangulation.h"
#include "core/generators/terrain/voids.h"
#include "core/generators/unused.h"
#include "core/geom/mesh/box_uv.h"
#include "core/model/build.h"
#include "core/schema/warning_list.h"
#include "core/texture/file_size.h"
#include "generated/params/terrain.h"
#include "generated/params/terrain_unused.h"

namespace seedmesh::terrain {
namespace {

// derive() lists heights of fields with at most this number of samples along a side.
constexpr int longest_listed = 257;

/// The warnings about the source of a field.
std::vector<Warning> source_warnings(const Field& field) {
  std::vector<Warning> warnings = field.notes;
  if (field.voids > 0) warnings.push_back(void_warning(field));
  return warnings;
}

/// Adds the warnings about the source of a field to a model.
Result<Model> with_source_warnings(Result<Model> model, const Field& field) {
  if (!model) return model;
  for (Warning& each : source_warnings(field)) model->warnings.push_back(std::move(each));
  return model;
}

/// Returns the model with the field applied to it. Coarser levels have fewer rounds of subdivision.
Result<Model> model_with_field(const TerrainParams& params, const Field& field, int level,
                               const GenerateContext& context) {
  Job& job = context.job;
  constexpr std::int32_t usual_picture = 512;
  Result<Model> model = generate_child(params.onto->model, "/onto/model", job.rng().at("onto"), context);
  if (!model) return model;
  if (params.onto->mapping == TerrainMapping::displacement) {
    displace(*model, field, static_cast<int>(params.onto->subdivide) - level, job);
  } else {
    const auto side = static_cast<std::int32_t>(params.texture);
    add_normal_map(*model, field, side > 0 ? side : usual_picture, job);
  }
  return model;
}

/// Adds the meshes of `coarser`, which has the same nodes, as the next level of those of `model`.
void add_level(Model& model, Model coarser, int level) {
  std::vector<int> positions(coarser.meshes.size(), -1);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const int mesh = coarser.nodes[i].mesh;
    if (mesh < 0) continue;
    int& position = positions[static_cast<std::size_t>(mesh)];
    if (position < 0) {
      position = add_mesh(model, std::move(coarser.meshes[static_cast<std::size_t>(mesh)]));
      model.meshes.back().name += "_LOD" + std::to_string(level);
    }
    model.nodes[i].lods.push_back(position);
  }
}

Result<Model> covered_model(const TerrainParams& params, const Field& field, const GenerateContext& context) {
  Result<Model> model = model_with_field(params, field, 0, context);
  const bool moves = params.onto->mapping == TerrainMapping::displacement;
  const int levels = moves ? std::min(context.demand.lods, static_cast<int>(params.onto->subdivide) + 1) : 1;
  for (int level = 1; model && level < levels; ++level) {
    Result<Model> coarser = model_with_field(params, field, level, context);
    if (!coarser) return coarser;
    add_level(*model, std::move(*coarser), level);
  }
  return model;
}

std::optional<Error> refusal(const TerrainParams& params, const Limits& limits) {
  std::vector<Issue> issues = check(params, limits);
  if (issues.empty()) return std::nullopt;
  return Error{Code::invalid, std::move(issues)};
}

/// Returns the number of triangles of the whole grid, as far as it follows from the parameters.
std::uint64_t grid_triangles(const TerrainParams& params) {
  const auto squares = static_cast<std::uint64_t>(finished_side(params) - 1);
  if (params.shape == TerrainShape::profile) return 0;
  if (params.shape == TerrainShape::sphere) return 12 * squares * squares;
  std::uint64_t triangles = 2 * squares * squares;
  if (params.skirt > 0) triangles += 8 * squares;
  if (params.base) triangles += 12 * squares;
  return triangles;
}

/// Returns the refinement, with the sides of the field as far as they follow from the parameters.
Refinement planned_refinement(const TerrainParams& params) {
  const int side = finished_side(params);
  return refinement_of(*params.refine, side, side, params.size / (side - 1));
}

/// Called before the field is made, which may take seconds.
void refuse_large_grid(const TerrainParams& params, const Job& job) {
  if (params.algorithm == TerrainAlgorithm::image || params.onto || params.mesh != TerrainMesh::grid) return;
  const std::uint64_t triangles = grid_triangles(params), most = job.limits().triangles;
  if (triangles <= most) {
    if (params.refine) refuse_refinement(planned_refinement(params), triangles, job);
    return;
  }
  job.refuse(limit_issue({Resource::triangles, most, triangles},
                         "needs " + std::to_string(triangles) +
                             " triangles for the whole grid; the limit is " + std::to_string(most) +
                             "; use a reduced mesh (`mesh`) or a height map (`output.format`)",
                         is_subdivided(params) ? "/iterations" : "/resolution"));
}

Error no_rtin_of(const Field& field) {
  return Error{Code::invalid,
               {{conflict_with({"image", "resample"}), "/mesh",
                 "this image has " + std::to_string(field.width) + " x " + std::to_string(field.depth) +
                     " samples; rtin needs a square of 2^n + 1 along a side; resample it, or use greedy"}}};
}

double mean_of(const Array<float>& heights) {
  double sum = 0;
  for (const float height : heights) sum += static_cast<double>(height);
  return sum / static_cast<double>(heights.size());
}

}  // namespace

std::vector<Issue> check(const TerrainParams& params, const Limits& limits) {
  return errors_between(params, limits);
}

static Result<Model> generate_by_shape(const TerrainParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  refuse_large_grid(params, job);
  job.progress("derive", 0);
  if (params.shape == TerrainShape::sphere) return build_planet_model(params, context);
  if (params.shape == TerrainShape::profile) return profile_model(params, job);
  const Result<Field> field = field_of(params, job);
  if (!field) return field.error();
  if (params.onto) return with_source_warnings(covered_model(params, *field, context), *field);
  if (params.mesh == TerrainMesh::rtin && !fits_rtin(field->width, field->depth)) {
    return no_rtin_of(*field);
  }
  job.progress("mesh", 0);
  return with_source_warnings(build_field_model(params, *field, context), *field);
}

Result<Model> generate(const TerrainParams& params, const GenerateContext& context) {
  Result<Model> model = generate_by_shape(params, context);
  if (!model) return model;
  for (Warning& each : warnings_of(unused_parameters(params))) model->warnings.push_back(std::move(each));
  // `heightmap` belongs to formats that encode() writes.
  if (!(params.heightmap == TerrainHeightmap{}))
    model->warnings.push_back({"/heightmap", "`heightmap` has no effect on a model", 0, 0});
  return model;
}

Result<Model> dressed(const TerrainParams& params, const Field& field, const GenerateContext& context) {
  if (params.mesh == TerrainMesh::rtin && !fits_rtin(field.width, field.depth)) return no_rtin_of(field);
  return with_source_warnings(build_field_model(params, field, context), field);
}

Result<Json> derive(const TerrainParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  Json answer{{"width", nullptr},
              {"height", nullptr},
              {"heights", nullptr},
              {"engines", nullptr},
              {"warnings", Json::array()}};
  if (params.shape == TerrainShape::profile) {
    const Array<float> heights = profile_heights(params, job);
    const auto [low, high] = std::ranges::minmax(heights.span());
    Json list = Json::array();
    for (const float height : heights) list.push_back(height + 0.0F);
    answer.update({{"width", heights.size()},
                   {"height", 1},
                   {"min", low},
                   {"max", high},
                   {"mean", mean_of(heights)},
                   {"samples", heights.size()},
                   {"heights", std::move(list)}});
    return answer;
  }
  if (params.shape == TerrainShape::sphere) {
    const Planet planet = planet_of(params, 0, job);
    const Range range = range_of(planet);
    answer.update({{"min", range.low},
                   {"max", range.high},
                   {"mean", mean_of(planet.height)},
                   {"samples", planet.height.size()}});
    return answer;
  }
  Result<Field> made = field_of(params, job);
  if (!made) return made.error();
  if (made->voids > 0) answer["voids"] = made->voids;
  if (const std::vector<Warning> warnings = source_warnings(*made); !warnings.empty())
    answer["warnings"] = warning_list(warnings);
  const Field field = cropped(std::move(*made), 0, job);
  const Range range = range_of(field, job);
  answer.update({{"width", field.width},
                 {"height", field.depth},
                 {"min", range.low},
                 {"max", range.high},
                 {"mean", mean_of(field.heights)},
                 {"samples", field.heights.size()}});
  const TerrainHeightmap& map = params.heightmap;
  if (!params.tile || (map.low && map.high)) {
    answer["engines"] = engine_settings({field.width, field.depth, field.cell,
                                         map.low.value_or(static_cast<double>(range.low)),
                                         map.high.value_or(static_cast<double>(range.high))});
  }
  if (field.width <= longest_listed && field.depth <= longest_listed) {
    Json heights = Json::array();
    for (const float height : field.heights) heights.push_back(height + 0.0F);
    answer["heights"] = std::move(heights);
  }
  return answer;
}

/// What details add to a planet or a rock: tangents and the textures of its rock. Vertices between faces that
/// are mapped from different sides are duplicated, a fifth of those of the rocks among the presets.
static void add_rock(Estimate& estimate, std::uint64_t vertices, const Demand& demand) {
  constexpr std::uint64_t of_five = 6;
  Material material;
  material.recipe.kind = rock_kind;
  texture::TextureSizes sizes;
  sizes.add(material);
  const std::uint64_t of_vertex = bytes_a_vertex + (demand.tangents ? bytes_of_tangent : 0);
  estimate.bytes += vertices * of_five / 5 * of_vertex - vertices * bytes_a_vertex;
  add_images(estimate, sizes.images(demand.textures));
}

/// The vertices of a planet for each point of its cube. Those between triangles that face along different axes are doubled
/// for their texture coordinates; how many these are depends on the heights, and is measured at few points.
static double vertices_a_point(const TerrainParams& params, const Job& job) {
  constexpr std::int32_t finest = 65;
  Job own = job.for_estimate();
  int level = 0;
  while (planet_side(params, level) > finest) ++level;
  const Planet planet = planet_of(params, level, own);
  Model model;
  add_mesh(model, "planet", planet_mesh(planet, nullptr, UpDirection::outward, own.rng(), own),
           add_material(model, Material{}));
  add_box_coordinates(model, own);
  return static_cast<double>(model.meshes[0].primitives[0].mesh.position.size()) /
         static_cast<double>(planet.direction.size());
}

static std::uint64_t sea_triangles(const TerrainParams& params) {
  if (!params.water_level) return 0;
  const auto squares = static_cast<std::uint64_t>(sea_side(params, 0) - 1);
  return 12 * squares * squares;
}

/// The bytes of the vertices and indices of a mesh.
static std::uint64_t bytes_of_mesh(std::uint64_t vertices, std::uint64_t of_vertex, std::uint64_t triangles) {
  return vertices * of_vertex + 3 * triangles * (vertices > 65'535 ? 4 : 2);
}

/// Sets the bytes of the file of a planetoid.
static void size_planetoid(Estimate& estimate, const TerrainParams& params, const GenerateContext& context) {
  constexpr std::uint64_t bytes_without_color = 32;
  const std::uint64_t triangles = estimate.triangles, points = triangles / 2 + 2, sea = sea_triangles(params);
  const std::uint64_t with_sea = document_bytes + bytes_of_mesh(sea / 2, bytes_without_color, sea);
  if (params.detail && context.demand.textures > 0) {
    estimate.bytes = with_sea + bytes_of_mesh(points, bytes_a_vertex, triangles);
    return add_rock(estimate, points, context.demand);
  }
  const double vertices = static_cast<double>(points) * vertices_a_point(params, context.job);
  const bool has_colors = params.palette != TerrainPalette::none;
  estimate.bytes = with_sea + bytes_of_mesh(static_cast<std::uint64_t>(math::to_int64(vertices)),
                                            has_colors ? bytes_a_vertex : bytes_without_color, triangles);
}

Result<Appraisal> appraise(const TerrainParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  if (params.shape != TerrainShape::profile) try_expressions(params, job);
  Appraisal appraisal;
  if (params.onto) {
    Result<Appraisal> child =
        appraise_child(params.onto->model, "/onto/model", job.rng().at("onto"), context);
    if (!child) return child;
    child->estimate.reset();
    for (Warning& each : warnings_of(unused_parameters(params))) child->warnings.push_back(std::move(each));
    return child;
  }
  appraisal.warnings = warnings_of(unused_parameters(params));
  const bool sphere = params.shape == TerrainShape::sphere;
  if (params.algorithm == TerrainAlgorithm::image) {
    const Result<Field> field = field_of_image(*params.image, job);
    if (!field) return field.error();
    for (Warning& each : source_warnings(*field)) appraisal.warnings.push_back(std::move(each));
    return appraisal;
  }
  if (!sphere && params.mesh != TerrainMesh::grid) return appraisal;
  const auto squares = static_cast<std::uint64_t>(finished_side(params) - 1);
  if (params.shape == TerrainShape::profile) {
    appraisal.estimate = Estimate{0, 1200 + (squares + 1) * 20, true};
    return appraisal;
  }
  Estimate estimate;
  estimate.triangles = grid_triangles(params);
  refuse_large_grid(params, job);
  if (params.refine && !sphere) {
    const std::uint64_t added = added_triangles(planned_refinement(params), job.limits().triangles);
    estimate.triangles += added;
  }
  estimate.exact = !params.water_level;
  if (sphere) {
    size_planetoid(estimate, params, context);
    estimate.triangles += sea_triangles(params);
  } else {
    estimate.bytes = bytes_of_grid(params, estimate.triangles, context);
  }
  appraisal.estimate = estimate;
  return appraisal;
}

Json vocabulary() { return Json::object(); }

Result<Array<std::uint8_t>> encode(const TerrainParams& params, const WantedFormat& form,
                                   const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  return map_file(params, form, job);
}

std::vector<Issue> check_format(const TerrainParams& params, const WantedFormat& form) {
  return format_errors(params, form);
}

float tile_extent(const TerrainParams& params) {
  if (!params.tile) return 0;
  // A field may leave the nominal range, which is that of its colours.
  constexpr float spare = 2;
  const Range range = nominal_range(params);
  const float heights = spare * (range.high - range.low) + static_cast<float>(params.skirt);
  return std::max(static_cast<float>(params.size), heights);
}

}  // namespace seedmesh::terrain
