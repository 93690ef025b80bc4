#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>

#include "core/base/parallel.h"
#include "core/geom/copies.h"
#include "core/geom/finish.h"
#include "core/geom/tangents.h"
#include "core/gltf/write.h"
#include "core/lang/expression.h"
#include "core/model/row.h"
#include "core/pipeline/body.h"
#include "core/pipeline/fit.h"
#include "core/pipeline/profiles.h"
#include "core/texture/impostor.h"
#include "core/texture/paint.h"

namespace seedmesh {
namespace {

/// Meshes that are quantised and compressed come to so small a part of their bytes, about.
constexpr std::uint64_t compression = 4;

struct Form {
  std::string_view name;
  Container container;
  std::string_view media_type;
};
constexpr Form forms[] = {
    {"glb", Container::glb, "model/gltf-binary"},
    {"gltf", Container::gltf, "model/gltf+json"},
    {"zip", Container::zip, "application/zip"},
};

const Form& form_of(const Request& request) {
  for (const Form& form : forms) {
    if (form.name == request.format()) return form;
  }
  return forms[0];
}

/// The generator's own form that the request asks for; null where it asks for a model.
const OwnForm* own_form_of(const Request& request) {
  for (const OwnForm& form : request.body().generator->forms) {
    if (form.format == request.format()) return &form;
  }
  return nullptr;
}

/// Generators point into their parameters; a request holds these under "/parameters". What is wrong with the
/// wanted output stands beside them.
std::string in_request(std::string pointer) {
  return pointer.empty() || pointer.starts_with("/output/") ? pointer : "/parameters" + pointer;
}

Error in_request(Error error) {
  for (Issue& issue : error.issues) issue.pointer = in_request(std::move(issue.pointer));
  return error;
}

/// The only catch of Stop: whatever `work` makes, or why it ended early.
template <class T, class Work>
Result<T> guarded(Work&& work) {
  try {
    return work();
  } catch (const Stop& stop) {
    return in_request(Error{stop.code(), {stop.issue()}});
  } catch (const std::bad_alloc&) {
    return Error{Code::limit, {{"", "the machine has no memory left for this request"}}};
  }
}

/// Of a long list the first, and one last line that counts the others.
void shorten(std::vector<Warning>& warnings) {
  constexpr std::size_t most = 100;
  if (warnings.size() <= most + 1) return;  // the last may be such a line already
  const std::size_t rest = warnings.size() - most;
  warnings.resize(most);
  warnings.push_back({"", "and " + std::to_string(rest) + " more warnings", 0, 0});
}

Json described(const std::vector<Warning>& warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings) {
    Json row = {{"pointer", in_request(warning.pointer)}, {"message", warning.message}};
    if (warning.line > 0) {
      row["line"] = warning.line;
      row["column"] = warning.column;
    }
    list.push_back(std::move(row));
  }
  return list;
}

Json seed_json(std::uint64_t seed) {
  constexpr std::uint64_t exact_in_javascript = (std::uint64_t{1} << 53U) - 1;
  return seed <= exact_in_javascript ? Json(seed) : Json(std::to_string(seed));
}

void sign(Model& model, const Request& request) {
  model.extras.push_back({"engine", Json(engine_version()).dump()});
  model.extras.push_back({"generator", Json(request.generator()).dump()});
  model.extras.push_back({"seed", seed_json(request.seed()).dump()});
  shorten(model.warnings);
  for (Warning& warning : model.warnings) warning.pointer = in_request(std::move(warning.pointer));
}

static_assert(static_cast<int>(OutputCollision::godot) == static_cast<int>(CollisionNames::godot));

int texture_size(const OutputParams& output) {
  const auto* size = std::get_if<std::int32_t>(&output.textures);
  return size ? *size : 0;
}

double milliseconds(Job::Clock::duration span) {
  return std::chrono::duration<double, std::milli>(span).count();
}

/// What each stage took; the last one ends now.
std::vector<Product::Span> timing_of(const Job& job) {
  std::vector<Product::Span> spans;
  const std::vector<Job::Stage>& stages = job.stages();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const auto end = i + 1 < stages.size() ? stages[i + 1].begun : Job::Clock::now();
    spans.push_back({stages[i].name, milliseconds(end - stages[i].begun)});
  }
  return spans;
}

/// What is no model comes from its generator as one file.
Result<Product> produce_own(const Request& request, const OwnForm& form, Job& job) {
  Demand demand;
  demand.textures = texture_size(request.body().output);
  demand.tangents = request.body().output.tangents == OutputTangents::auto_;
  job.set_demand(demand);
  Result<Payload> file =
      request.body().generator->encode(request.body().params, wanted_form(request.body().output), job);
  if (!file) return in_request(std::move(file).error());
  // Some spend it on the way, before they write.
  const std::uint64_t spent = job.spent(Resource::output_bytes);
  if (file->size() > spent) job.spend(Resource::output_bytes, file->size() - spent);
  Product product;
  product.media_type = form.media_type;
  product.extension = form.extension;
  product.payload = *std::move(file);
  product.timing = timing_of(job);
  return product;
}

/// Parts of one thing that are repeated more often than this are merged by material.
constexpr std::uint64_t most_parts = 400;

static_assert(static_cast<int>(OutputInstancing::merge) == static_cast<int>(CopyForm::merge));

Demand demand_of(const OutputParams& output, const Generator& generator) {
  const bool budget_here =
      output.max_triangles && !generator.keeps_budget && (output.lods > 1 || !generator.joins_triangles);
  return {.lods = budget_here ? levels_to_choose_from : output.lods,
          .share_organs =
              output.instancing == OutputInstancing::nodes || output.instancing == OutputInstancing::gpu,
          .growth = output.animation == OutputParams::Animation::growth,
          .wind = output.wind == OutputWind::weights,
          .collision = static_cast<CollisionNames>(output.collision),
          .textures = texture_size(output),
          // Else meshes are merged, simplified or drawn before they get tangents.
          .tangents = output.tangents == OutputTangents::auto_ && !output.max_triangles &&
                      output.variants == 1 && output.lods == 1 && !output.impostor &&
                      output.instancing != OutputInstancing::merge,
          .impostor = output.impostor,
          .copies = static_cast<CopyForm>(output.instancing),
          .most_triangles = static_cast<std::uint64_t>(output.max_triangles.value_or(0)),
          // Else fit(), row_of() or merge_copies() look at meshes again.
          .packs = profile_of(output.profile).compressed && !output.max_triangles && output.variants == 1 &&
                   output.instancing != OutputInstancing::merge};
}

/// The model of one seed, as its generator makes it.
Result<Model> generate(const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  job.set_demand(demand_of(output, *request.body().generator));
  Result<Model> model = request.body().generator->generate(request.body().params, job);
  if (!model) return in_request(std::move(model).error());
  return model;
}

/// The models of as many seeds as are wanted, side by side.
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

/// Copies as meshes of their own, where that is wanted.
void merge_where_wanted(Model& model, const Request& request, Job& job) {
  const OutputInstancing instancing = request.body().output.instancing;
  const bool crowded = instancing == OutputInstancing::auto_ && request.body().generator->parts &&
                       count_copies(model) > most_parts;
  if (instancing == OutputInstancing::merge || crowded) merge_copies(model, job);
}

/// Whether merge_where_wanted will take the variants side by side as crowded. Their copies are not counted
/// before they are made: a copy with its share of a mesh takes about 200 bytes.
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

/// Pictures as the coarsest level where they are wanted; those that a scene has chosen in any case.
std::optional<Issue> add_impostors(Model& model, const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  const int size = texture_size(output);
  const bool is_scene = request.body().generator->keeps_budget;
  if (output.impostor && !is_scene && is_empty(model))
    return Issue{"/output/impostor", "the model is empty, and no picture can take the place of nothing"};
  if (output.impostor && !is_scene && texture::add_impostor_levels(model, job) == 0) {
    return Issue{"/output/impostor",
                 "the model has no mesh that stands still by itself, which an impostor could take the place "
                 "of; expected `instancing` auto"};
  }
  texture::draw_impostors(model, is_scene ? std::max(size / 2, 64) : size, job);
  return std::nullopt;
}

/// Walls are sheets, too, and what would take them away is no coarser building.
Sacrifice sacrifice_of(const Generator& generator) {
  constexpr double detail = 0.004;
  return generator.parts ? Sacrifice{.leaves = false, .detail = detail} : Sacrifice{};
}

/// One level is less than is wanted: how the request gets more.
std::string with_hint(std::string message, const Generator& generator) {
  if (!generator.own_levels.empty()) message.append("; ").append(generator.own_levels);
  return message;
}

/// The levels of detail within the budget that are wanted, or why not.
std::optional<Error> settle_levels(Model& model, const Request& request, Job& job) {
  const OutputParams& output = request.body().output;
  const Generator& generator = *request.body().generator;
  const Sacrifice sacrifice = sacrifice_of(generator);
  const bool has_one = levels_of(model) == 1;
  const auto refused = [&](Code code, Issue issue) {
    if (has_one) issue.message = with_hint(std::move(issue.message), generator);
    return Error{code, {std::move(issue)}};
  };
  if (output.max_triangles) {
    const auto most = static_cast<std::uint64_t>(*output.max_triangles);
    const int pictures = output.impostor && generator.keeps_budget ? 1 : 0;
    if (std::optional<Issue> issue = fit(model, most, output.lods + pictures, sacrifice, job))
      return refused(Code::limit, *std::move(issue));
  }
  if (output.lods < 2) return std::nullopt;
  const std::size_t told = model.warnings.size();
  if (std::optional<Issue> issue = add_levels(model, output.lods, sacrifice, job))
    return refused(Code::invalid, *std::move(issue));
  if (has_one && model.warnings.size() > told)
    model.warnings.back().message = with_hint(std::move(model.warnings.back().message), generator);
  return std::nullopt;
}

WriteOptions write_options(const Request& request, const Form& form) {
  const OutputParams& output = request.body().output;
  const Profile& profile = profile_of(output.profile);
  const bool by_itself =
      output.instancing == OutputInstancing::auto_ && profile.prefers_gpu && !request.body().generator->parts;
  return {.container = form.container,
          .generator = "Seedmesh " + std::string(program_version()),
          .dialect = {.compressed = profile.compressed,
                      .gpu_instances = by_itself || output.instancing == OutputInstancing::gpu,
                      .lods_inside = profile.lods_inside}};
}

}  // namespace

Result<Product> produce(const Request& request, Job& job, TextureStore* texture_store) {
  return guarded<Product>([&]() -> Result<Product> {
    const KeepAwake awake(job);
    if (const OwnForm* form = own_form_of(request)) return produce_own(request, *form, job);
    const OutputParams& output = request.body().output;
    Result<Model> model = generate_all(request, job);
    if (!model) return std::move(model).error();
    if (model->warnings.empty() && is_empty(*model)) {
      model->warnings.push_back(
          {"", "nothing is to be seen: the model has no triangles, lines or points", 0, 0});
    }
    if (std::optional<Error> error = settle_levels(*model, request, job)) return *std::move(error);
    merge_where_wanted(*model, request, job);
    texture::paint(*model, texture_size(output), texture_store, job);
    if (std::optional<Issue> issue = add_impostors(*model, request, job))
      return Error{Code::invalid, {*std::move(issue)}};
    if (output.tangents == OutputTangents::auto_) add_tangents(*model, job);
    finish(*model, job);
    name_for(*model, output.profile);
    sign(*model, request);
    ModelCounts counts = count(*model);
    Product product;
    product.statistics.warnings = static_cast<std::uint32_t>(model->warnings.size());
    product.warnings = model->warnings;
    const Form& form = form_of(request);
    product.media_type = form.media_type;
    product.extension = form.name;
    job.progress("encode", 0);
    WriteOptions written = write_options(request, form);
    written.counts = &counts;
    product.payload = write(std::move(*model), written, job);
    product.statistics.triangles = counts.triangles;
    product.statistics.vertices = counts.vertices;
    product.timing = timing_of(job);
    return product;
  });
}

Result<std::string> derive(const Request& request, Job& job) {
  return guarded<std::string>([&]() -> Result<std::string> {
    Result<Json> answer = request.body().generator->derive(request.body().params, job);
    if (!answer) return in_request(std::move(answer).error());
    return canonical_text(*answer);
  });
}

/// Whether the output holds the generator's own triangles, no more and no fewer.
static bool leaves_meshes(const OutputParams& output) {
  return !profile_of(output.profile).compressed && output.lods == 1 && !output.impostor;
}

Result<std::string> validate(const Request& request, Job& job) {
  return guarded<std::string>([&]() -> Result<std::string> {
    const OutputParams& output = request.body().output;
    const Generator& generator = *request.body().generator;
    Demand demand = demand_of(output, generator);
    job.set_demand(demand);
    Result<Appraisal> appraisal = generator.appraise(request.body().params, job);
    if (appraisal && generator.parts && is_merged_as_a_row(*appraisal, output)) {
      demand.copies = CopyForm::merge;
      job.set_demand(demand);
      appraisal = generator.appraise(request.body().params, job);
    }
    if (!appraisal) return in_request(std::move(appraisal).error());
    shorten(appraisal->warnings);
    Json answer = {{"valid", true}, {"warnings", described(appraisal->warnings)}, {"estimate", nullptr}};
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

std::string vocabulary_json() {
  Json vocabulary = Json::object();
  for (const Generator& generator : generators()) vocabulary.update(generator.vocabulary());
  Json functions = Json::array();
  for (const lang::Function& function : lang::functions()) {
    functions.push_back({{"name", function.name},
                         {"arity", function.arity},
                         {"text", function.text},
                         {"example", function.example}});
  }
  vocabulary["functions"] = std::move(functions);
  return canonical_text(vocabulary);
}

}  // namespace seedmesh
