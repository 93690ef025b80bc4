#include <algorithm>
#include <new>
#include <nlohmann/json.hpp>

#include "core/geom/finish.h"
#include "core/geom/tangents.h"
#include "core/gltf/write.h"
#include "core/lang/expression.h"
#include "core/pipeline/body.h"
#include "core/texture/paint.h"

namespace seedmesh {
namespace {

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

/// Generators point into their parameters; a request holds these under "/parameters".
std::string in_request(std::string pointer) { return pointer.empty() ? pointer : "/parameters" + pointer; }

Error in_request(Error error) {
  for (Issue& issue : error.issues) issue.pointer = in_request(std::move(issue.pointer));
  return error;
}

/// The only catch of Stop: whatever `work` makes, or why it ended early.
template <class T, class Work>
Result<T> guarded(Work&& work) {
  try {
    Result<T> result = work();
    if (!result) return in_request(std::move(result).error());
    return result;
  } catch (const Stop& stop) {
    return in_request(Error{stop.code(), {stop.issue()}});
  } catch (const std::bad_alloc&) {
    return Error{Code::limit, {{"", "the machine has no memory left for this request"}}};
  }
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
  for (Warning& warning : model.warnings) warning.pointer = in_request(std::move(warning.pointer));
}

static_assert(static_cast<int>(OutputCollision::godot) == static_cast<int>(CollisionNames::godot));

bool has_levels(const Model& model) {
  return std::any_of(model.nodes.begin(), model.nodes.end(),
                     [](const Node& node) { return !node.lods.empty(); });
}

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
  Result<Array<std::uint8_t>> file =
      request.body().generator->encode(request.body().params, form.format, job);
  if (!file) return std::move(file).error();
  job.spend(Resource::output_bytes, file->size());
  Product product;
  product.media_type = form.media_type;
  product.extension = form.extension;
  auto kept = std::make_shared<const Array<std::uint8_t>>(*std::move(file));
  const auto bytes = std::as_bytes(kept->span());
  product.payload.add(std::move(kept), bytes);
  product.timing = timing_of(job);
  return product;
}

}  // namespace

Result<Product> produce(const Request& request, Job& job, TextureStore* texture_store) {
  return guarded<Product>([&]() -> Result<Product> {
    if (const OwnForm* form = own_form_of(request)) return produce_own(request, *form, job);
    const OutputParams& output = request.body().output;
    job.set_demand({output.lods, output.instancing == OutputInstancing::nodes,
                    output.animation == OutputParams::Animation::growth, output.wind == OutputWind::weights,
                    static_cast<CollisionNames>(output.collision)});
    Result<Model> model = request.body().generator->generate(request.body().params, job);
    if (!model) return std::move(model).error();
    if (output.lods > 1 && !has_levels(*model)) {
      return Error{Code::invalid,
                   {{"", "output.lods asks for " + std::to_string(output.lods) +
                             " levels of detail; this model has one"}}};
    }
    texture::paint(*model, texture_size(output), texture_store, job);
    if (output.tangents == OutputTangents::auto_) add_tangents(*model, job);
    finish(*model, job);
    sign(*model, request);
    const ModelCounts counts = count(*model);
    Product product;
    product.statistics = {counts.triangles, counts.vertices,
                          static_cast<std::uint32_t>(model->warnings.size())};
    const Form& form = form_of(request);
    product.media_type = form.media_type;
    product.extension = form.name;
    job.progress("encode", 0);
    product.payload =
        write(std::move(*model), form.container, "Seedmesh " + std::string(program_version()), job);
    product.timing = timing_of(job);
    return product;
  });
}

Result<std::string> derive(const Request& request, Job& job) {
  return guarded<std::string>([&]() -> Result<std::string> {
    Result<Json> answer = request.body().generator->derive(request.body().params, job);
    if (!answer) return std::move(answer).error();
    return canonical_text(*answer);
  });
}

Result<std::string> validate(const Request& request, Job& job) {
  return guarded<std::string>([&]() -> Result<std::string> {
    Result<Appraisal> appraisal = request.body().generator->appraise(request.body().params, job);
    if (!appraisal) return std::move(appraisal).error();
    Json answer = {{"valid", true}, {"warnings", described(appraisal->warnings)}, {"estimate", nullptr}};
    if (const std::optional<Estimate>& estimate = appraisal->estimate) {
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
