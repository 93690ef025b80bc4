#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/generators/child.h"
#include "core/pipeline/body.h"
#include "core/pipeline/guarded.h"
#include "core/pipeline/level_list.h"
#include "core/pipeline/names.h"
#include "core/pipeline/profiles.h"
#include "core/schema/nearest.h"
#include "core/schema/parse_body.h"
#include "core/schema/presets.h"
#include "core/schema/reader.h"
#include "generated/params/request.h"

namespace seedmesh {
namespace {

constexpr std::int32_t least_impostor = 64;  ///< texels of a side

const Generator* named_generator(const Json& json, const RequestParams& frame, IssueList& errors) {
  if (!frame.generator) {
    // An unknown preset is reported elsewhere as a separate error.
    if (json.is_object() && !json.contains("preset") && !json.contains("generator")) {
      errors.add_missing("", "generator",
                         "\"generator\" is missing, and there is no \"preset\" that names one");
    }
    return nullptr;
  }
  const Generator* generator = find_generator(*frame.generator);
  if (!generator && !errors.covers("/generator")) {
    errors.add({IssueKind::unknown_name, "/generator", unknown_generator(generators(), *frame.generator)});
  }
  return generator;
}

Generator::Params parameters_of(const Json& body, const Generator& generator, const Job& job,
                                IssueList& errors) {
  if (body.contains("parameters"))
    return read_parameters(generator, body["parameters"], "/parameters", {job, generators()}, errors);
  IssueList missing;
  Generator::Params params =
      read_parameters(generator, Json::object(), "/parameters", {job, generators()}, missing);
  for (const Issue& issue : missing.issues()) {
    // The object itself is missing, not one of its members.
    errors.add_missing("", "parameters", "\"parameters\" is missing: in it, " + issue.message);
  }
  return params;
}

/// The generator of the preset that a body names, where the body names another one; else empty.
std::string preset_of_another(const Json& json) {
  if (!json.is_object() || !json.contains("preset") || !json.contains("generator")) return {};
  if (!json["preset"].is_string() || !json["generator"].is_string()) return {};
  const auto preset = preset_requests().find(json["preset"].get_ref<const std::string&>());
  if (preset == preset_requests().end()) return {};
  const auto own = preset->second.request["generator"].get<std::string>();
  return own == json["generator"].get_ref<const std::string&>() ? std::string() : own;
}

/// The parameters of a body that was merged over a preset of another generator. One error covers all
/// parameters of the other generator.
Generator::Params mixed_parameters(const Json& merged, const std::string& other, const Generator& generator,
                                   const Job& job, IssueList& errors) {
  IssueList foreign;
  Generator::Params params = parameters_of(merged, generator, job, foreign);
  if (!foreign.empty()) {
    const std::string name(generator.name);
    errors.add({conflict_with({"preset"}), "/generator",
                "found \"" + name + "\", but the preset is a request for " + other +
                    ", which has other parameters than " + name});
  }
  return params;
}

bool is_model(const OutputParams& output) { return format_named(text_of(output.format)).is_model; }

/// Refuses a format that only other generators have.
void check_format(const Generator& generator, const OutputParams& output, IssueList& errors) {
  if (is_model(output)) return;
  const std::string_view format = text_of(output.format);
  std::string known;
  for (const FormatInfo& each : output_formats) {
    if (each.is_model) known += std::string(known.empty() ? "" : ", ") + std::string(each.name);
  }
  for (const OwnFormat& form : generator.formats) {
    if (form.format == format) return;
    known += ", " + std::string(form.format);
  }
  errors.add({IssueKind::not_available, "/output/format",
              "found \"" + std::string(format) + "\"; the formats of " + std::string(generator.name) +
                  " are " + known});
}

/// Refuses levels of detail and GPU instances where no reader of the profile supports them.
void check_profile(const OutputParams& output, IssueList& errors) {
  const Profile& profile = profile_of(output.profile);
  const std::string named = "the profile " + std::string(text_of(output.profile));
  if (level_count(output) > 1 && output.format != OutputFormat::zip && !profile.lods_inside) {
    errors.add({IssueKind::not_available, "/output/lods",
                "found " + std::to_string(level_count(output)) + " levels of detail in the format " +
                    std::string(text_of(output.format)) + " with " + named +
                    ", which have one; expected the format zip, or one of the profiles " +
                    profiles_where(&Profile::lods_inside)});
  }
  if (output.impostor && output.format != OutputFormat::zip && !profile.lods_inside) {
    errors.add({IssueKind::not_available, "/output/impostor",
                "found an impostor in the format " + std::string(text_of(output.format)) + " with " + named +
                    ", which have one level of detail; expected the format zip, or one of the profiles " +
                    profiles_where(&Profile::lods_inside)});
  }
  if (output.image_format == OutputImageFormat::webp && !profile.reads_webp) {
    errors.add({IssueKind::not_available, "/output/image_format",
                "found webp with " + named +
                    ", which does not read it; expected png or both, or one of the profiles " +
                    profiles_where(&Profile::reads_webp)});
  }
  if (output.instancing == OutputInstancing::gpu && !profile.gpu_instances) {
    errors.add({IssueKind::not_available, "/output/instancing",
                "found gpu with " + named +
                    ", which some of its readers do not support; expected one of the profiles " +
                    profiles_where(&Profile::gpu_instances)});
  }
}

/// An impostor needs texels, and a model that does not move.
void check_impostor(const Generator& generator, const OutputParams& output, IssueList& errors) {
  if (!output.impostor) return;
  const auto refuse = [&errors](IssueCause cause, std::string message) {
    errors.add({std::move(cause), "/output/impostor", std::move(message)});
  };
  const auto* size = std::get_if<std::int32_t>(&output.textures);
  const auto* choice = std::get_if<OutputTextures>(&output.textures);
  if (!generator.has_impostor)
    refuse(IssueKind::not_available, "the generator " + std::string(generator.name) + " makes no impostors");
  if (choice && *choice == OutputTextures::none) {
    refuse(conflict_with({"textures"}),
           "an impostor is a texture, and `textures` is none; expected textures of at least " +
               std::to_string(least_impostor) + " texels");
  }
  if (size && *size < least_impostor) {
    refuse(conflict_with({"textures"}), "found textures of " + std::to_string(*size) +
                                            " texels for an impostor; expected at least " +
                                            std::to_string(least_impostor));
  }
  if (output.animation == OutputParams::Animation::growth)
    refuse(conflict_with({"animation"}),
           "found an impostor and the growth animation; an impostor cannot grow");
}

/// Linked textures are beside the model, where a file on a disk finds none, and impostors are drawn of their texels.
void check_links(const OutputParams& output, IssueList& errors) {
  const auto* choice = std::get_if<OutputTextures>(&output.textures);
  if (!choice || *choice != OutputTextures::links) return;
  if (output.format != OutputFormat::glb && output.format != OutputFormat::gltf) {
    errors.add({conflict_with({"format"}), "/output/textures",
                "found links in the format " + std::string(text_of(output.format)) +
                    "; expected the format glb or gltf, or textures inside the file"});
  }
  if (output.image_format == OutputImageFormat::webp || output.image_format == OutputImageFormat::both) {
    errors.add(
        {conflict_with({"textures"}), "/output/image_format",
         "found " + std::string(text_of(output.image_format)) + "; linked textures are PNG, expected png"});
  }
  if (output.impostor) {
    errors.add(
        {conflict_with({"impostor"}), "/output/textures",
         "found links and an impostor, whose texture shows the other textures; expected a size such as 512"});
  }
}

/// Errors of the output that the schema cannot express.
void check_output(const OutputParams& output, std::uint64_t seed, IssueList& errors) {
  const auto* size = std::get_if<std::int32_t>(&output.textures);
  if (size && !std::has_single_bit(static_cast<std::uint32_t>(*size)) && !errors.covers("/output/textures")) {
    errors.add({IssueKind::invalid_value, "/output/textures",
                "found " + std::to_string(*size) + "; expected a power of two, such as 512"});
  }
  const auto more = static_cast<std::uint64_t>(output.variants - 1);
  if (seed + more < seed) {
    errors.add({IssueKind::out_of_range, "/output/variants",
                "found " + std::to_string(output.variants) + " seeds, of which some would be 2^64 or more"});
  }
  check_links(output, errors);
  if (!errors.covers("/output/lods")) check_level_list(output, errors);
  if (is_model(output)) check_profile(output, errors);  // other formats have none of these options
}

/// Refuses options that the generator does not support.
void check_abilities(const Generator& generator, const OutputParams& output, IssueList& errors) {
  check_impostor(generator, output, errors);
  const auto refuse = [&](const char* option, bool is_wanted, const char* lack) {
    if (is_wanted) {
      errors.add({IssueKind::not_available, std::string("/output/") + option,
                  "the generator " + std::string(generator.name) + lack});
    }
  };
  refuse("animation", output.animation == OutputParams::Animation::growth && !generator.grows,
         " makes no growth animation");
  refuse("wind", output.wind != OutputWind::none && !generator.sways, " has no wind weights");
  refuse("collision", output.collision != OutputCollision::none && !generator.has_collision,
         " makes no collision shapes");
}

/// Refuses options of models for a format that is not a model, and parameters that do not suit the format.
void check_own_format(const OwnFormat& own, const Generator& generator, const Generator::Params& params,
                      const OutputParams& output, IssueList& errors) {
  // Refused parameters were replaced by defaults, which are not those of the request.
  const bool sound = std::none_of(errors.issues().begin(), errors.issues().end(), [](const Issue& issue) {
    return issue.pointer.starts_with("/parameters");
  });
  if (params && generator.check_format && sound) {
    for (Issue& issue : generator.check_format(params, wanted_format(output))) {
      if (!issue.pointer.starts_with("/output/")) issue.pointer = "/parameters" + issue.pointer;
      errors.add(std::move(issue));
    }
  }
  Json options = write_output(output);
  for (const char* name : {"format", "name", "provenance"}) options.erase(name);
  if (own.has_profiles) options.erase("profile");
  if (own.has_models) {
    options.erase("textures");
    options.erase("tangents");
  }
  for (const auto& [name, value] : options.items()) {
    errors.add({conflict_with({"format"}), "/output/" + name,
                "found " + value.dump() + " with the format " + std::string(own.format) +
                    ", which is not a model and does not have this option"});
  }
}

/// Refuses what the generator cannot make. Each option is refused once.
void check_use(const Generator& generator, const Generator::Params& params, const OutputParams& output,
               IssueList& errors) {
  const auto is_wanted = [&](const OwnFormat& form) { return form.format == text_of(output.format); };
  const auto own = std::ranges::find_if(generator.formats, is_wanted);
  if (own == generator.formats.end()) {
    check_abilities(generator, output, errors);
  } else {
    check_own_format(*own, generator, params, output, errors);
  }
}

/// Adds the other errors of a body. Numbers that are too large were read as null; the wrong type there is not
/// a separate error.
void add_others(const std::vector<Issue>& others, std::vector<Issue>& issues) {
  std::set<std::string, std::less<>> too_large;
  for (const Issue& issue : issues) too_large.insert(issue.pointer);
  for (const Issue& issue : others) {
    if (issue.kind != IssueKind::wrong_type || !too_large.contains(issue.pointer)) issues.push_back(issue);
  }
}

/// Returns a hint for a member that is outside the part of the request to which it belongs.
std::vector<Issue> with_parts(std::vector<Issue> issues, const Json& body, const Generator* generator) {
  if (!body.is_object()) return issues;
  for (const auto& [name, value] : body.items()) {
    const std::string_view part = part_with(name, generator ? generator->name : std::string_view());
    if (part.empty()) continue;
    for (Issue& issue : issues) {
      if (issue.pointer != pointer_token(name) || issue.kind != IssueKind::unknown_key) continue;
      issue.message = "\"" + name + "\" is not known here; it belongs in \"" + std::string(part) + "\"";
    }
  }
  return issues;
}

}  // namespace

std::string_view Request::generator() const { return body_->generator->name; }
std::string_view Request::format() const { return text_of(body_->output.format); }
const std::string& Request::canonical() const { return body_->canonical; }
std::uint64_t Request::seed() const { return body_->seed; }
const std::string& Request::name() const { return body_->name; }

std::string canonical_request(const Request::Body& body) {
  Json json = {{"generator", body.generator->name}};
  RequestParams frame;
  frame.seed = body.seed;
  frame.output = body.output;
  json.update(write_request(frame));  // seed and output, unless they are defaults
  Json params = body.generator->write(body.params);
  if (!params.empty()) json["parameters"] = std::move(params);
  return canonical_text(json);
}

Result<Request::Body> read_parts(const Json& json, const Job& job) {
  if (const std::string_view type = schema::geojson_type(json);
      !type.empty() && !json.contains("generator")) {
    return Error{
        Code::invalid,
        {{IssueKind::wrong_type, "",
          "found GeoJSON (" + std::string(type) +
              "), expected a request with \"generator\" or \"preset\"; POST /v1/import makes one of a map in "
              "degrees; \"coordinates\" in metres belong in one of its parameters, such as \"footprint\" of "
              "the generator building"}}};
  }
  IssueList errors;
  const Json merged = with_preset(json);
  const RequestParams frame = read_request(merged, "", errors);
  if (frame.preset && !errors.covers("/preset")) {
    errors.add(
        {IssueKind::unknown_name, "/preset", schema::unknown_word("preset", *frame.preset, preset_names())});
  }
  check_output(frame.output, frame.seed, errors);
  Request::Body body;
  body.generator = named_generator(merged, frame, errors);
  if (body.generator && (!merged.contains("parameters") || merged["parameters"].is_object())) {
    const std::string other = preset_of_another(json);
    body.params = other.empty() ? parameters_of(merged, *body.generator, job, errors)
                                : mixed_parameters(merged, other, *body.generator, job, errors);
  }
  if (body.generator) {
    check_format(*body.generator, frame.output, errors);
    check_use(*body.generator, body.params, frame.output, errors);
  }
  if (!errors.empty()) return Error{Code::invalid, with_parts(errors.take(), merged, body.generator)};
  body.output = frame.output;
  body.seed = frame.seed;
  return body;
}

static Result<Request> read_checked(const Json& json, const Job& job) {
  Result<Request::Body> body = read_parts(json, job);
  if (!body) return std::move(body).error();
  body->canonical = canonical_request(*body);
  body->name = model_name(*body);
  return Request(std::make_shared<const Request::Body>(*std::move(body)));
}

Result<Request> read_request_body(const Json& json, const Job::Options& options) {
  return guarded<Request>([&] { return read_checked(json, Job(0, options)); });
}

Result<Request> read_request(std::string_view json, const Job::Options& options) {
  return guarded<Request>([&]() -> Result<Request> {
    const Job job(0, options);
    std::vector<Issue> issues;
    Result<Json> body = parse_body(json, issues, {.job = &job});
    if (!body) return std::move(body).error();
    Result<Request> request = read_checked(*body, job);
    if (issues.empty()) return request;
    if (!request) add_others(request.error().issues, issues);
    return Error{Code::invalid, std::move(issues)};
  });
}

Result<Request> read_request(std::string_view json, const Limits& limits) {
  Job::Options options;
  options.limits = limits;
  return read_request(json, options);
}

Result<Request> with_format(const Request& request, std::string_view format) {
  Json output = write_output(request.body().output);
  output["format"] = format;
  IssueList errors;
  Request::Body body = request.body();
  body.output = read_output(output, "/output", errors);
  if (errors.empty()) check_format(*body.generator, body.output, errors);
  if (errors.empty()) check_output(body.output, body.seed, errors);
  if (errors.empty()) check_use(*body.generator, body.params, body.output, errors);
  if (!errors.empty()) return Error{Code::invalid, errors.take()};
  body.canonical = canonical_request(body);
  return Request(std::make_shared<const Request::Body>(std::move(body)));
}

}  // namespace seedmesh
