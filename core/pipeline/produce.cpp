#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/geom/lod/next_positions.h"
#include "core/geom/mesh/finish.h"
#include "core/geom/mesh/tangents.h"
#include "core/gltf/content_names.h"
#include "core/gltf/write/write.h"
#include "core/pipeline/body.h"
#include "core/pipeline/guarded.h"
#include "core/pipeline/level_list.h"
#include "core/pipeline/make_model.h"
#include "core/pipeline/names.h"
#include "core/pipeline/profiles.h"
#include "core/registry/tile_extent.h"
#include "core/schema/warning_list.h"

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

/// The generator's own format that the request selects; null where it selects a model.
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

/// Predicts whether merge_where_wanted() will find too many parts in the variants side by side. A copy with
/// its share of a mesh takes about 200 bytes.
bool is_merged_as_a_row(const Appraisal& appraisal, const OutputParams& output) {
  constexpr std::uint64_t bytes_of_copy = 200;
  if (output.variants == 1 || output.instancing != OutputInstancing::auto_ || !appraisal.estimate)
    return false;
  return appraisal.estimate->bytes / bytes_of_copy * static_cast<std::uint64_t>(output.variants) > most_parts;
}

/// Warns of options about generated images and copies where the model has none.
void warn_of_unused(Model& model, const OutputParams& output) {
  const auto warn = [&model](const char* pointer, const char* reason) {
    model.warnings.push_back({pointer, std::string("has no effect: ") + reason, 0, 0});
  };
  const bool has_images =
      std::ranges::any_of(model.textures, [](const auto& image) { return !image->is_given; });
  const int size = texture_size(output);
  if (!has_images && size > 0 && output.textures != OutputParams{}.textures)
    warn("/output/textures", "the model has no generated textures");
  const bool is_webp =
      output.image_format == OutputImageFormat::webp || output.image_format == OutputImageFormat::both;
  if (!has_images && is_webp) warn("/output/image_format", "the file has no generated images");
  const bool has_arrays = std::ranges::any_of(
      model.nodes, [](const Node& node) { return !node.instances.transforms.empty() && node.skin < 0; });
  if (output.instancing == OutputInstancing::gpu && !has_arrays)
    warn("/output/instancing", "the model has no copies that arrays could hold");
}

WriteOptions write_options(const Request& request) {
  const OutputParams& output = request.body().output;
  const Profile& profile = profile_of(output.profile);
  const bool profile_default = output.instancing == OutputInstancing::auto_ && profile.prefers_gpu &&
                               !request.body().generator->repeats_parts;
  return {.container = container_of(request.format()),
          .generator = "Seedmesh " + std::string(program_version()),
          .dialect = {.compressed = profile.compressed,
                      .gpu_instances = profile_default || output.instancing == OutputInstancing::gpu,
                      .lods_inside = profile.lods_inside,
                      .quantized = profile.quantized,
                      .physics = output.profile == OutputProfile::godot,
                      .single_root = output.profile == OutputProfile::godot},
          .image_stem = name_stem(request.body()),
          .least_extent = tile_extent(*request.body().generator, request.body().params)};
}

}  // namespace

Result<Product> produce(const Request& request, const Job::Options& options, TextureStore* texture_store) {
  return guarded<Product>([&]() -> Result<Product> {
    Job job(request.seed(), options);
    if (own_format_of(request) != nullptr) return produce_own(request, job);
    const OutputParams& output = request.body().output;
    Result<Model> model = make_model(request, texture_store, job);
    if (!model) return std::move(model).error();
    warn_of_unused(*model, output);
    if (output.tangents == OutputTangents::auto_) add_tangents(*model, job);
    finish(*model, job);
    if (profile_of(output.profile).morphs) add_next_positions(*model, job);
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
    return canonical_text(*answer, [&] { job.check(); });
  });
}

/// Whether the output has exactly the triangles of the generator.
static bool leaves_meshes(const OutputParams& output) {
  return !profile_of(output.profile).quantized && level_count(output) == 1 && !has_listed_levels(output) &&
         !output.impostor;
}

/// Warns where the model may not fit the budget of the finest level, whose triangles are known only when it is made.
/// Also warns where simplification takes seconds.
static void warn_of_budget(Appraisal& appraisal, const OutputParams& output) {
  constexpr double seconds_a_triangle = 2e-6, long_time = 1;
  const bool is_listed = !output.max_triangles && has_listed_levels(output) && appraisal.estimate;
  if (!output.max_triangles && !is_listed) return;
  const std::uint64_t triangles =
      appraisal.estimate ? appraisal.estimate->triangles * static_cast<std::uint64_t>(output.variants) : 0;
  const std::uint64_t most = is_listed ? listed_triangles(output, triangles).front()
                                       : static_cast<std::uint64_t>(*output.max_triangles);
  if (appraisal.estimate && triangles <= most) return;
  std::string message =
      appraisal.estimate ? "about " + std::to_string(triangles) + " triangles are made and then reduced to "
                         : "the triangles are counted when the model is made, and then reduced to ";
  message += std::to_string(most);
  const double seconds = seconds_a_triangle * static_cast<double>(triangles);
  if (seconds >= long_time) {
    message += ", which takes about " + std::to_string(static_cast<std::uint64_t>(seconds)) +
               " s; parameters that make fewer triangles cost less";
  }
  message += "; generation refuses the request if the coarsest level has more";
  const char* const pointer = is_listed ? "/output/lods/0" : "/output/max_triangles";
  appraisal.warnings.push_back({pointer, std::move(message), 0, 0});
}

/// The bytes of the images of a model in the form of the output.
static std::uint64_t image_bytes_of(const Estimate& model, const OutputParams& output) {
  constexpr std::uint64_t webp_share = 5;  // a WebP has about this part of the bytes of the PNG, measured
  if (has_links(output)) return 0;
  const std::uint64_t png = image_bytes(model);
  switch (image_form_of(output)) {
    case texture::ImageForm::webp:
      return png / webp_share;
    case texture::ImageForm::both:
      return png + png / webp_share;
    default:
      return png;
  }
}

/// The size of a file with this output, of which the generator's estimate is one model. Variants share images.
static Estimate estimate_of_file(const Estimate& model, const OutputParams& output) {
  const auto variants = static_cast<std::uint64_t>(output.variants);
  Estimate file{model.triangles * variants, (model.bytes - image_bytes(model)) * variants,
                model.exact && variants == 1 && leaves_meshes(output)};
  // The positions of the next level have 12 bytes a vertex, about a seventh of what a vertex and its indices have.
  const bool has_next = profile_of(output.profile).morphs && level_count(output) > 1;
  if (has_next) file.bytes = file.bytes * 8 / 7;
  if (profile_of(output.profile).compressed) file.bytes /= compression;
  const auto most = static_cast<std::uint64_t>(output.max_triangles.value_or(0));
  if (most > 0 && file.triangles > most) file = {most, file.bytes / file.triangles * most, false};
  file.bytes += image_bytes_of(model, output);
  return file;
}

/// The bytes of what the document of a model states about its origin: in the asset, the scene and the root node.
static std::uint64_t bytes_of_origin(const Request& request) {
  constexpr std::uint64_t copies = 3, punctuation = 4;
  if (request.body().output.provenance != OutputProvenance::full) return 0;
  std::uint64_t bytes = 0;
  for (const Extra& extra : provenance(request)) bytes += extra.name.size() + extra.json.size() + punctuation;
  return copies * bytes;
}

Result<std::string> validate(const Request& request, const Job::Options& options) {
  return guarded<std::string>([&]() -> Result<std::string> {
    Job job(request.seed(), options);
    const OutputParams& output = request.body().output;
    const Generator& generator = *request.body().generator;
    GenerateContext context{job, demand_of(output, generator), generators()};
    context.demand.tangents = output.tangents == OutputTangents::auto_;
    Result<Appraisal> appraisal = generator.appraise(request.body().params, context);
    if (appraisal && generator.repeats_parts && is_merged_as_a_row(*appraisal, output)) {
      context.demand.copies = CopyForm::merge;
      appraisal = generator.appraise(request.body().params, context);
    }
    if (!appraisal) return in_request(std::move(appraisal).error());
    warn_of_budget(*appraisal, output);
    shorten(appraisal->warnings);
    point_into_request(appraisal->warnings);
    Json answer = {{"valid", true}, {"warnings", warning_list(appraisal->warnings)}, {"estimate", nullptr}};
    if (std::optional<Estimate>& estimate = appraisal->estimate) {
      *estimate = estimate_of_file(*estimate, output);
      estimate->bytes += bytes_of_origin(request);
      answer["estimate"] = {
          {"triangles", estimate->triangles}, {"bytes", estimate->bytes}, {"exact", estimate->exact}};
    }
    return canonical_text(answer);
  });
}

}  // namespace seedmesh
