#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/geom/mesh/copies.h"
#include "core/geom/mesh/finish.h"
#include "core/geom/mesh/tangents.h"
#include "core/gltf/content_names.h"
#include "core/gltf/write/write.h"
#include "core/model/row.h"
#include "core/pipeline/body.h"
#include "core/pipeline/fit.h"
#include "core/pipeline/guarded.h"
#include "core/pipeline/names.h"
#include "core/pipeline/profiles.h"
#include "core/registry/tile_extent.h"
#include "core/schema/warning_list.h"
#include "core/texture/impostor.h"
#include "core/texture/paint.h"

namespace seedmesh {
namespace {

/// Quantization and compression divide the bytes of a mesh by about this.
constexpr std::uint64_t compression = 4;

Container container_of(std::string_view format) {
  return format == "zip" ? Container::zip : format == "gltf" ? Container::gltf : Container::glb;
}

void set_format(Product& product, std::string_view name) {
  const FormatInfo& format = format_named(name);
  product.media_type = format.media_type;
  product.extension = format.extension;
}

/// The generator's own format that the request asks for; null where it asks for a model.
const OwnFormat* own_format_of(const Request& request) {
  for (const OwnFormat& form : request.body().generator->formats) {
    if (form.format == request.format()) return &form;
  }
  return nullptr;
}

/// Keeps the first warnings of a long list; a last line counts the others.
void shorten(std::vector<Warning>& warnings) {
  constexpr std::size_t most = 100;
  if (warnings.size() <= most + 1) return;  // the last may be such a line already
  const std::size_t rest = warnings.size() - most;
  warnings.resize(most);
  warnings.push_back({"", "and " + std::to_string(rest) + " more warnings", 0, 0});
}

/// Points the warnings into the request.
void point_into_request(std::vector<Warning>& warnings) {
  for (Warning& warning : warnings) warning.pointer = in_request(std::move(warning.pointer));
}

Json seed_json(std::uint64_t seed) {
  constexpr std::uint64_t exact_in_javascript = (std::uint64_t{1} << 53U) - 1;
  return seed <= exact_in_javascript ? Json(seed) : Json(std::to_string(seed));
}

/// Names the model and its parts for the profile.
void name_model(Model& model, const Request& request, const Job& job) {
  const OutputProfile profile = request.body().output.profile;
  // Quantized meshes share grids, so their stored form depends on the whole request.
  const bool is_quantized = profile_of(profile).quantized;
  gltf::name_by_content(model,
                        {.stem = name_stem(request.body()),
                         .root = request.name(),
                         .form = is_quantized ? std::string_view(request.canonical()) : std::string_view()},
                        job);
  name_for(model, profile);
}

void sign(Model& model, const Request& request, const std::vector<Extra>& origin) {
  model.extras.insert(model.extras.end(), origin.begin(), origin.end());
  for (Extra& extra : model.extras) {
    if (extra.name == "seed") extra.json = seed_json(request.seed()).dump();
  }
  add_to_root(model, origin);
  shorten(model.warnings);
  point_into_request(model.warnings);
}

static_assert(static_cast<int>(OutputCollision::godot) == static_cast<int>(CollisionNames::godot));

constexpr int linked_texture_size = 512;

int texture_size(const OutputParams& output) {
  if (const auto* size = std::get_if<std::int32_t>(&output.textures)) return *size;
  return std::get<OutputTextures>(output.textures) == OutputTextures::links ? linked_texture_size : 0;
}

texture::Linking linking_of(const OutputParams& output) {
  const auto* choice = std::get_if<OutputTextures>(&output.textures);
  const bool is_linked = choice && *choice == OutputTextures::links;
  return {is_linked, "/v1/textures/" + std::string(engine_version()) + "."};
}

double milliseconds(Job::Clock::duration span) {
  return std::chrono::duration<double, std::milli>(span).count();
}

/// The duration of each stage; the last one ends now.
std::vector<Product::Span> timing_of(const Job& job) {
  std::vector<Product::Span> spans;
  const std::vector<Job::Stage>& stages = job.stages();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const auto end = i + 1 < stages.size() ? stages[i + 1].begun : Job::Clock::now();
    spans.push_back({stages[i].name, milliseconds(end - stages[i].begun)});
  }
  return spans;
}

/// A file that is not a model.
Result<Product> produce_own(const Request& request, Job& job) {
  Demand demand;
  demand.textures = texture_size(request.body().output);
  demand.tangents = request.body().output.tangents == OutputTangents::auto_;
  Result<Payload> file = request.body().generator->encode(
      request.body().params, wanted_format(request.body().output), {job, demand, generators()});
  if (!file) return in_request(std::move(file).error());
  // Some generators spend bytes before they write them.
  const std::uint64_t spent = job.spent(Resource::output_bytes);
  if (file->size() > spent) job.spend(Resource::output_bytes, file->size() - spent);
  Product product;
  set_format(product, request.format());
  product.payload = *std::move(file);
  product.timing = timing_of(job);
  return product;
}

/// Beyond this number of copies, the parts of one object are merged by material.
constexpr std::uint64_t most_parts = 400;

static_assert(static_cast<int>(OutputInstancing::merge) == static_cast<int>(CopyForm::merge));

Demand demand_of(const OutputParams& output, const Generator& generator) {
  const bool budget_here =
      output.max_triangles && !generator.keeps_budget && (output.lods > 1 || !generator.joins_triangles);
  return {
      .lods = budget_here ? levels_to_choose_from : output.lods,
      .two_sided_leaves = output.profile == OutputProfile::unreal || output.profile == OutputProfile::unity,
      .share_organs =
          output.instancing == OutputInstancing::nodes || output.instancing == OutputInstancing::gpu,
      .growth = output.animation == OutputParams::Animation::growth,
      .wind = output.wind == OutputWind::weights,
      .collision = static_cast<CollisionNames>(output.collision),
      .textures = texture_size(output),
      // Otherwise a later stage changes or merges the meshes first.
      .tangents = output.tangents == OutputTangents::auto_ && !output.max_triangles && output.variants == 1 &&
                  output.lods == 1 && !output.impostor && output.instancing != OutputInstancing::merge,
      .impostor = output.impostor,
      .copies = static_cast<CopyForm>(output.instancing),
      .most_triangles = static_cast<std::uint64_t>(output.max_triangles.value_or(0)),
      // Otherwise fit(), row_of() or merge_copies() read the meshes again.
      .packs = profile_of(output.profile).compressed && !output.max_triangles && output.variants == 1 &&
               output.instancing != OutputInstancing::merge};
}

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

/// Merges copies into meshes where the output asks for it, or where there are too many parts.
void merge_where_wanted(Model& model, const Request& request, Job& job) {
  const OutputInstancing instancing = request.body().output.instancing;
  const bool has_too_many = instancing == OutputInstancing::auto_ && request.body().generator->parts &&
                            count_copies(model) > most_parts;
  if (instancing == OutputInstancing::merge || has_too_many) merge_copies(model, job);
}

/// Predicts whether merge_where_wanted() will find too many parts in the variants side by side. A copy with
/// its share of a mesh takes about 200 bytes.
bool is_merged_as_a_row(const Appraisal& appraisal, const OutputParams& output) {
  constexpr std::uint64_t bytes_of_copy = 200;
  if (output.variants == 1 || output.instancing != OutputInstancing::auto_ || !appraisal.estimate)
    return false;
  return appraisal.estimate->bytes / bytes_of_copy * static_cast<std::uint64_t>(output.variants) > most_parts;
}

bool is_empty(const Model& model) {
  return std::ranges::all_of(model.meshes, [](const MeshGroup& group) {
    return std::ranges::all_of(group.primitives,
                               [](const Primitive& each) { return each.mesh.elements() == 0; });
  });
}

/// Adds impostors as the coarsest level where the output asks for them, and draws those of a scene.
std::optional<Issue> add_impostors(Model& model, const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  const int size = texture_size(output);
  const bool is_scene = request.body().generator->keeps_budget;
  if (output.impostor && !is_scene && is_empty(model))
    return Issue{IssueKind::not_available, "/output/impostor",
                 "the model is empty, and an empty model has no impostor"};
  if (output.impostor && !is_scene && texture::add_impostor_levels(model, job) == 0) {
    return Issue{
        IssueKind::not_available, "/output/impostor",
        "the model has no static mesh of its own that an impostor could replace; expected `instancing` "
        "auto"};
  }
  texture::draw_impostors(model, is_scene ? std::max(size / 2, 64) : size, job);
  return std::nullopt;
}

/// Walls are sheets too, and must not be thinned out like leaves.
SimplifyLimits simplify_limits(const Generator& generator) {
  constexpr double detail = 0.004;
  return generator.parts ? SimplifyLimits{.leaves = false, .detail = detail} : SimplifyLimits{};
}

/// Adds how a request gets more levels to a message about a model that has one.
std::string with_hint(std::string message, const Generator& generator) {
  if (!generator.own_levels.empty()) message.append("; ").append(generator.own_levels);
  return message;
}

/// Gives the model the wanted levels of detail within the budget; an error where that is impossible.
std::optional<Error> make_levels(Model& model, const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  const Generator& generator = *request.body().generator;
  const SimplifyLimits limits = simplify_limits(generator);
  const bool has_one = levels_of(model) == 1;
  const auto refused = [&](Code code, Issue issue) {
    if (has_one) issue.message = with_hint(std::move(issue.message), generator);
    return Error{code, {std::move(issue)}};
  };
  if (output.max_triangles) {
    const auto most = static_cast<std::uint64_t>(*output.max_triangles);
    const int pictures = output.impostor && generator.keeps_budget ? 1 : 0;
    if (std::optional<Issue> issue = fit(model, most, output.lods + pictures, limits, job))
      return refused(Code::limit, *std::move(issue));
  }
  if (output.lods < 2) return std::nullopt;
  const std::size_t before = model.warnings.size();
  if (std::optional<Issue> issue = add_levels(model, output.lods, limits, job))
    return refused(Code::invalid, *std::move(issue));
  if (has_one && model.warnings.size() > before)
    model.warnings.back().message = with_hint(std::move(model.warnings.back().message), generator);
  return std::nullopt;
}

WriteOptions write_options(const Request& request) {
  const OutputParams& output = request.body().output;
  const Profile& profile = profile_of(output.profile);
  const bool profile_default =
      output.instancing == OutputInstancing::auto_ && profile.prefers_gpu && !request.body().generator->parts;
  return {.container = container_of(request.format()),
          .generator = "Seedmesh " + std::string(program_version()),
          .dialect = {.compressed = profile.compressed,
                      .gpu_instances = profile_default || output.instancing == OutputInstancing::gpu,
                      .lods_inside = profile.lods_inside,
                      .quantized = profile.quantized},
          .image_stem = name_stem(request.body()),
          .least_extent = tile_extent(*request.body().generator, request.body().params)};
}

}  // namespace

Result<Product> produce(const Request& request, const Job::Options& options, TextureStore* texture_store) {
  return guarded<Product>([&]() -> Result<Product> {
    Job job(request.seed(), options);
    if (own_format_of(request) != nullptr) return produce_own(request, job);
    const OutputParams& output = request.body().output;
    Result<Model> model = generate_all(request, job);
    if (!model) return std::move(model).error();
    if (model->warnings.empty() && is_empty(*model)) {
      model->warnings.push_back({"", "the model is empty: it has no triangles, lines or points", 0, 0});
    }
    if (std::optional<Error> error = make_levels(*model, request, job)) return *std::move(error);
    merge_where_wanted(*model, request, job);
    texture::paint(*model, texture_size(output), linking_of(output), texture_store, job);
    if (std::optional<Issue> issue = add_impostors(*model, request, job))
      return Error{Code::invalid, {*std::move(issue)}};
    if (output.tangents == OutputTangents::auto_) add_tangents(*model, job);
    finish(*model, job);
    name_model(*model, request, job);
    std::vector<Extra> origin;
    if (output.provenance == OutputProvenance::full) origin = provenance(request);
    sign(*model, request, origin);
    ModelCounts counts = count(*model);
    Product product;
    product.statistics.warnings = static_cast<std::uint32_t>(model->warnings.size());
    product.warnings = model->warnings;
    set_format(product, request.format());
    job.progress("encode", 0);
    WriteOptions written = write_options(request);
    written.counts = &counts;
    written.scene_extras = std::move(origin);
    product.payload = write(std::move(*model), written, job);
    product.statistics.triangles = counts.triangles;
    product.statistics.vertices = counts.vertices;
    product.timing = timing_of(job);
    return product;
  });
}

Result<std::string> derive(const Request& request, const Job::Options& options) {
  return guarded<std::string>([&]() -> Result<std::string> {
    Job job(request.seed(), options);
    Result<Json> answer = request.body().generator->derive(request.body().params, {job, {}, generators()});
    if (!answer) return in_request(std::move(answer).error());
    if (const auto warnings = answer->find("warnings"); warnings != answer->end()) {
      for (Json& each : *warnings) each["pointer"] = in_request(each["pointer"].get<std::string>());
    }
    return canonical_text(*answer);
  });
}

/// Does the output hold exactly the triangles of the generator?
static bool leaves_meshes(const OutputParams& output) {
  return !profile_of(output.profile).quantized && output.lods == 1 && !output.impostor;
}

/// A warning where simplification to the budget takes seconds.
static void warn_of_simplification(Appraisal& appraisal, std::uint64_t most) {
  constexpr double seconds_a_triangle = 2e-6, long_time = 1;
  const std::uint64_t triangles = appraisal.estimate->triangles;
  const double seconds = seconds_a_triangle * static_cast<double>(triangles);
  if (triangles <= most || seconds < long_time) return;
  appraisal.warnings.push_back({"/output/max_triangles",
                                "about " + std::to_string(triangles) +
                                    " triangles are made and then simplified to " + std::to_string(most) +
                                    ", which takes about " +
                                    std::to_string(static_cast<std::uint64_t>(seconds)) +
                                    " s; parameters that make fewer triangles cost less",
                                0, 0});
}

Result<std::string> validate(const Request& request, const Job::Options& options) {
  return guarded<std::string>([&]() -> Result<std::string> {
    Job job(request.seed(), options);
    const OutputParams& output = request.body().output;
    const Generator& generator = *request.body().generator;
    GenerateContext context{job, demand_of(output, generator), generators()};
    Result<Appraisal> appraisal = generator.appraise(request.body().params, context);
    if (appraisal && generator.parts && is_merged_as_a_row(*appraisal, output)) {
      context.demand.copies = CopyForm::merge;
      appraisal = generator.appraise(request.body().params, context);
    }
    if (!appraisal) return in_request(std::move(appraisal).error());
    if (appraisal->estimate && output.max_triangles && !generator.keeps_budget)
      warn_of_simplification(*appraisal, static_cast<std::uint64_t>(*output.max_triangles));
    shorten(appraisal->warnings);
    point_into_request(appraisal->warnings);
    Json answer = {{"valid", true}, {"warnings", warning_list(appraisal->warnings)}, {"estimate", nullptr}};
    if (std::optional<Estimate>& estimate = appraisal->estimate) {
      const auto variants = static_cast<std::uint64_t>(output.variants);
      *estimate = {estimate->triangles * variants, estimate->bytes * variants,
                   estimate->exact && variants == 1 && leaves_meshes(output)};
      if (profile_of(output.profile).compressed) estimate->bytes /= compression;
      const auto most = static_cast<std::uint64_t>(output.max_triangles.value_or(0));
      if (most > 0 && estimate->triangles > most) {
        *estimate = {most, estimate->bytes / estimate->triangles * most, false};
      }
      answer["estimate"] = {
          {"triangles", estimate->triangles}, {"bytes", estimate->bytes}, {"exact", estimate->exact}};
    }
    return canonical_text(answer);
  });
}

}  // namespace seedmesh
