#include "core/pipeline/make_model.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/geom/mesh/box_uv.h"
#include "core/geom/mesh/copies.h"
#include "core/model/levels.h"
#include "core/model/row.h"
#include "core/model/trim.h"
#include "core/pipeline/fit.h"
#include "core/pipeline/guarded.h"
#include "core/pipeline/level_list.h"
#include "core/pipeline/profiles.h"
#include "core/texture/impostor.h"
#include "core/texture/paint.h"

namespace seedmesh {
namespace {

static_assert(static_cast<int>(OutputCollision::godot) == static_cast<int>(CollisionNames::godot));

constexpr int linked_texture_size = 512;

texture::ImageStyle style_of(const OutputParams& output) {
  return {image_form_of(output), has_links(output), "/v1/textures/" + std::string(engine_version()) + "."};
}

static_assert(static_cast<int>(OutputInstancing::merge) == static_cast<int>(CopyForm::merge));

/// The model of one seed.
Result<Model> generate(const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  const Generator& generator = *request.body().generator;
  Result<Model> model =
      generator.generate(request.body().params, {job, demand_of(output, generator), generators()});
  if (!model) return in_request(std::move(model).error());
  return model;
}

/// One model, or the models of output.variants seeds side by side.
Result<Model> generate_all(const Request& request, Job& job) {
  const int variants = request.body().output.variants;
  if (variants == 1) return generate(request, job);
  std::vector<Model> models;
  for (int i = 0; i < variants; ++i) {
    job.progress("derive", static_cast<double>(i) / variants);
    const std::uint64_t seed = request.seed() + static_cast<std::uint64_t>(i);
    Job own = job.for_child(seed);
    Result<Model> model = generate(request, own);
    if (!model) return std::move(model).error();
    model->name += "_seed_" + std::to_string(seed);
    model->extras.push_back({"seed", seed_json(seed).dump()});
    models.push_back(*std::move(model));
  }
  return row_of(std::move(models));
}

/// Merges copies into meshes where the output requires it, or where there are too many parts.
void merge_where_wanted(Model& model, const Request& request, Job& job) {
  const OutputInstancing instancing = request.body().output.instancing;
  const bool has_too_many = instancing == OutputInstancing::auto_ &&
                            request.body().generator->repeats_parts && count_copies(model) > most_parts;
  if (instancing == OutputInstancing::merge || has_too_many) merge_copies(model, job);
}

bool is_empty(const Model& model) {
  return std::ranges::all_of(model.meshes, [](const MeshGroup& group) {
    return std::ranges::all_of(group.primitives,
                               [](const Primitive& each) { return each.mesh.elements() == 0; });
  });
}

/// Adds impostors as the coarsest level where the output has them, and draws those of a scene.
std::optional<Issue> add_impostors(Model& model, const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  const int size = texture_size(output);
  const bool is_scene = request.body().generator->keeps_budget;
  if (output.impostor && !is_scene && is_empty(model)) {
    return Issue{IssueKind::not_available, "/output/impostor",
                 "the model is empty, and an empty model has no impostor"};
  }
  if (output.impostor && !is_scene && texture::add_impostor_levels(model, job) == 0) {
    return Issue{
        IssueKind::not_available, "/output/impostor",
        "the model has no static mesh of its own that an impostor could replace; expected `instancing` auto"};
  }
  texture::draw_impostors(model, is_scene ? std::max(size / 2, 64) : size, job);
  return std::nullopt;
}

/// Walls are sheets too, and must not be thinned out like leaves.
SimplifyLimits simplify_limits(const Generator& generator) {
  constexpr double detail = 0.004;
  return generator.repeats_parts ? SimplifyLimits{.leaves = false, .detail = detail} : SimplifyLimits{};
}

/// Adds how a request gets more levels to a message about a model that has one.
std::string with_hint(std::string message, const Generator& generator) {
  if (!generator.own_levels.empty()) message.append("; ").append(generator.own_levels);
  return message;
}

/// Gives the model the levels that output.lods lists.
std::optional<Error> make_listed_levels(Model& model, const Request& request, const SimplifyLimits& limits,
                                        Job& job) {
  const OutputParams& output = request.body().output;
  std::vector<std::uint64_t> wanted = listed_triangles(output, drawn_at(model, 0));
  if (output.max_triangles)
    wanted.front() = std::min(wanted.front(), static_cast<std::uint64_t>(*output.max_triangles));
  std::optional<Issue> issue = fit_levels(model, wanted, limits, job);
  if (!issue) return std::nullopt;
  const Code code = issue->pointer == "/output/lods/0" ? Code::limit : Code::invalid;
  issue->message = with_hint(std::move(issue->message), *request.body().generator);
  return Error{code, {*std::move(issue)}};
}

/// Gives the model the requested levels of detail within the budget; an error where that is impossible.
std::optional<Error> make_levels(Model& model, const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  const Generator& generator = *request.body().generator;
  const SimplifyLimits limits = simplify_limits(generator);
  const bool has_one = levels_of(model) == 1;
  const auto refused = [&](Code code, Issue issue) {
    if (has_one) issue.message = with_hint(std::move(issue.message), generator);
    return Error{code, {std::move(issue)}};
  };
  if (has_listed_levels(output)) return make_listed_levels(model, request, limits, job);
  if (output.max_triangles) {
    const auto most = static_cast<std::uint64_t>(*output.max_triangles);
    const int pictures = output.impostor && generator.keeps_budget ? 1 : 0;
    if (std::optional<Issue> issue = fit(model, most, level_count(output) + pictures, limits, job))
      return refused(Code::limit, *std::move(issue));
  }
  if (level_count(output) < 2) return std::nullopt;
  const std::size_t before = model.warnings.size();
  if (std::optional<Issue> issue = add_levels(model, level_count(output), limits, job))
    return refused(Code::invalid, *std::move(issue));
  if (has_one && model.warnings.size() > before)
    model.warnings.back().message = with_hint(std::move(model.warnings.back().message), generator);
  return std::nullopt;
}

}  // namespace

texture::ImageForm image_form_of(const OutputParams& output) {
  switch (output.image_format) {
    case OutputImageFormat::png:
      return texture::ImageForm::png;
    case OutputImageFormat::webp:
      return texture::ImageForm::webp;
    case OutputImageFormat::both:
      return texture::ImageForm::both;
    case OutputImageFormat::auto_:
      break;
  }
  return has_links(output) || !profile_of(output.profile).prefers_webp ? texture::ImageForm::png
                                                                       : texture::ImageForm::webp;
}

bool has_links(const OutputParams& output) {
  const auto* choice = std::get_if<OutputTextures>(&output.textures);
  return choice && *choice == OutputTextures::links;
}

int texture_size(const OutputParams& output) {
  if (const auto* size = std::get_if<std::int32_t>(&output.textures)) return *size;
  return has_links(output) ? linked_texture_size : 0;
}

Json seed_json(std::uint64_t seed) {
  constexpr std::uint64_t exact_in_javascript = (std::uint64_t{1} << 53U) - 1;
  return seed <= exact_in_javascript ? Json(seed) : Json(std::to_string(seed));
}

Demand demand_of(const OutputParams& output, const Generator& generator) {
  const bool budget_here = output.max_triangles && !generator.keeps_budget &&
                           (level_count(output) > 1 || !generator.prefers_simplification);
  const bool is_listed = has_listed_levels(output);
  return {
      .lods = budget_here || is_listed ? levels_to_choose_from : level_count(output),
      .two_sided_leaves = output.profile == OutputProfile::unreal || output.profile == OutputProfile::unity,
      .share_organs =
          output.instancing == OutputInstancing::nodes || output.instancing == OutputInstancing::gpu,
      .growth = output.animation == OutputParams::Animation::growth,
      .wind = output.wind == OutputWind::weights,
      .collision = static_cast<CollisionNames>(output.collision),
      .textures = texture_size(output),
      // Otherwise a later stage changes or merges the meshes first.
      .tangents = output.tangents == OutputTangents::auto_ && !output.max_triangles && output.variants == 1 &&
                  level_count(output) == 1 && !is_listed && !output.impostor &&
                  output.instancing != OutputInstancing::merge,
      .impostor = output.impostor,
      .copies = static_cast<CopyForm>(output.instancing),
      .most_triangles = static_cast<std::uint64_t>(output.max_triangles.value_or(0)),
      .first_fit =
          budget_here && !is_listed && level_count(output) == 1 && output.variants == 1 && !output.impostor,
      // Otherwise fit(), row_of() or merge_copies() read the meshes again.
      .packs = profile_of(output.profile).compressed && !output.max_triangles && !is_listed &&
               output.variants == 1 && output.instancing != OutputInstancing::merge};
}

/// Blender takes the first frame for the rest pose, so its growth begins at half the height.
static void start_visibly(Model& model, OutputProfile profile) {
  constexpr float begin = 0.3F;  // share of the time, when the first pieces have 51 % of their size
  if (profile != OutputProfile::blender) return;
  for (Animation& animation : model.animations) {
    float end = 0;
    for (const std::vector<float>& times : animation.times) end = std::max(end, times.back());
    trim(animation, begin * end);
  }
}

/// Writes what engines need to set up levels into the extras of the first root: triangles, and the share of the screen's
/// height below which a level is shown. It is left again where the share has grown by `hysteresis`.
static void describe_levels(Model& model) {
  constexpr double hysteresis = 0.1;
  const std::size_t levels = levels_of(model);
  if (levels == 1) return;
  std::vector<float> shares;
  for (const Node& node : model.nodes) {
    if (node.lods.size() + 1 == levels && shares.empty()) shares = screen_shares(node, levels - 1);
  }
  Json list = Json::array();
  for (std::size_t level = 0; level < levels; ++level) {
    std::uint64_t triangles = 0;
    for (const Node& node : model.nodes) {
      const int mesh = node.collision == CollisionShape::none ? mesh_at(node, level) : -1;
      if (mesh < 0) continue;
      triangles += std::max<std::size_t>(1, node.instances.transforms.size()) *
                   triangles_of(model.meshes[static_cast<std::size_t>(mesh)]);
    }
    const double screen =
        level == 0 ? 1.0 : std::floor(static_cast<double>(shares[level - 1]) * 1000 + 0.5) / 1000;
    list.push_back({{"screen", screen}, {"triangles", triangles}});
  }
  for (Node& node : model.nodes) {
    if (node.parent >= 0) continue;
    node.extras.push_back({"levels", Json({{"hysteresis", hysteresis}, {"list", std::move(list)}}).dump()});
    return;
  }
}

Result<Model> make_model(const Request& request, TextureStore* texture_store, Job& job) {
  const OutputParams& output = request.body().output;
  Result<Model> model = generate_all(request, job);
  if (!model) return std::move(model).error();
  if (model->warnings.empty() && is_empty(*model)) {
    model->warnings.push_back({"", "the model is empty: it has no triangles, lines or points", 0, 0});
  }
  if (std::optional<Error> error = make_levels(*model, request, job)) return *std::move(error);
  merge_where_wanted(*model, request, job);
  start_visibly(*model, output.profile);
  const texture::ImageStyle style = style_of(output);
  texture::paint(*model, texture_size(output), style, texture_store, job);
  if (std::optional<Issue> issue = add_impostors(*model, request, job))
    return Error{Code::invalid, {*std::move(issue)}};
  texture::form_images(*model, style.form, job);
  describe_levels(*model);
  // Engines and shops expect coordinates on every surface; viewers of the other profiles do without.
  if (!profile_of(output.profile).quantized) add_box_coordinates(*model, job);
  return model;
}

}  // namespace seedmesh
