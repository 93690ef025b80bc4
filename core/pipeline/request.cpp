#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/generators/child.h"
#include "core/pipeline/body.h"
#include "core/pipeline/profiles.h"
#include "core/schema/nearest.h"
#include "core/schema/parse_body.h"
#include "core/schema/presets.h"
#include "generated/params/request.h"

namespace seedmesh {
namespace {

constexpr std::int32_t least_impostor = 64;  ///< texels of a side

std::string canonical_request(const Request::Body& body) {
  Json json = {{"generator", body.generator->name}};
  RequestParams frame;
  frame.seed = body.seed;
  frame.output = body.output;
  json.update(write_request(frame));  // seed and output, where they are no defaults
  Json params = body.generator->write(body.params);
  if (!params.empty()) json["parameters"] = std::move(params);
  return canonical_text(json);
}

const Generator* named_generator(const Json& json, const RequestParams& frame, Faults& faults) {
  if (!frame.generator) {
    // A preset that is no preset would have told it; one fault is enough for that.
    if (json.is_object() && !json.contains("preset") && !json.contains("generator")) {
      faults.add_missing("", "generator", "\"generator\" is missing, and no \"preset\" tells it");
    }
    return nullptr;
  }
  const Generator* generator = find_generator(*frame.generator);
  if (!generator && !faults.covers("/generator")) {
    faults.add({"/generator", unknown_generator(*frame.generator)});
  }
  return generator;
}

Generator::Params parameters_of(const Json& body, const Generator& generator, const Limits& limits,
                                Faults& faults) {
  if (body.contains("parameters"))
    return read_parameters(generator, body["parameters"], "/parameters", limits, faults);
  Faults lacking;
  Generator::Params params = read_parameters(generator, Json::object(), "/parameters", limits, lacking);
  for (const Issue& issue : lacking.issues()) {
    // There is no object yet that could lack the member: the body lacks the object.
    faults.add_missing("", "parameters", "\"parameters\" is missing: in it, " + issue.message);
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
  return own == json["generator"] ? std::string() : own;
}

/// The parameters of a body that is merged over a preset of another generator: one fault for all that is left
/// of the other's parameters.
Generator::Params mixed_parameters(const Json& merged, const std::string& other, const Generator& generator,
                                   const Limits& limits, Faults& faults) {
  Faults strangers;
  Generator::Params params = parameters_of(merged, generator, limits, strangers);
  if (!strangers.empty()) {
    const std::string name(generator.name);
    faults.add({"/generator", "found \"" + name + "\", but the preset is a request for " + other +
                                  ", whose parameters are no parameters of " + name});
  }
  return params;
}

constexpr std::string_view forms_of_models[] = {"glb", "gltf", "zip"};

bool is_model(const OutputParams& output) {
  return std::ranges::find(forms_of_models, text_of(output.format)) != std::end(forms_of_models);
}

/// A form that only other generators have is refused.
void add_form_fault(const Generator& generator, const OutputParams& output, Faults& faults) {
  if (is_model(output)) return;
  const std::string_view format = text_of(output.format);
  std::string known;
  for (const std::string_view each : forms_of_models)
    known += std::string(known.empty() ? "" : ", ") + std::string(each);
  for (const OwnForm& form : generator.forms) {
    if (form.format == format) return;
    known += ", " + std::string(form.format);
  }
  faults.add({"/output/format", "found \"" + std::string(format) + "\"; the forms of " +
                                    std::string(generator.name) + " are " + known});
}

/// Levels of detail need somebody who reads them, and copies on the GPU too.
void check_profile(const OutputParams& output, Faults& faults) {
  const Profile& profile = profile_of(output.profile);
  const std::string named = "the profile " + std::string(text_of(output.profile));
  if (output.lods > 1 && output.format != OutputFormat::zip && !profile.lods_inside) {
    faults.add({"/output/lods", "found " + std::to_string(output.lods) + " levels of detail in the format " +
                                    std::string(text_of(output.format)) + " with " + named +
                                    ", which hold one; expected the format zip, or one of the profiles " +
                                    profiles_where(&Profile::lods_inside)});
  }
  if (output.impostor && output.format != OutputFormat::zip && !profile.lods_inside) {
    faults.add({"/output/impostor", "found an impostor, which is one more level of detail, in the format " +
                                        std::string(text_of(output.format)) + " with " + named +
                                        ", which hold one; expected the format zip, or one of the profiles " +
                                        profiles_where(&Profile::lods_inside)});
  }
  if (output.instancing == OutputInstancing::gpu && !profile.gpu_instances) {
    faults.add(
        {"/output/instancing", "found gpu with " + named +
                                   ", whose readers do not all take it; expected one of the profiles " +
                                   profiles_where(&Profile::gpu_instances)});
  }
}

/// A picture needs texels, and something that stands still.
void check_impostor(const Generator& generator, const OutputParams& output, Faults& faults) {
  if (!output.impostor) return;
  const auto refuse = [&faults](std::string message) {
    faults.add({"/output/impostor", std::move(message)});
  };
  const auto* size = std::get_if<std::int32_t>(&output.textures);
  if (!generator.has_impostor) refuse("the generator " + std::string(generator.name) + " makes no impostors");
  if (!size)
    refuse("an impostor is a picture, and `textures` is none; expected textures of at least " +
           std::to_string(least_impostor) + " texels");
  if (size && *size < least_impostor) {
    refuse("found textures of " + std::to_string(*size) + " texels for an impostor; expected at least " +
           std::to_string(least_impostor));
  }
  if (output.animation == OutputParams::Animation::growth)
    refuse("found an impostor and the growth animation; a picture does not grow");
}

/// What the schema cannot say of the output.
void check_output(const OutputParams& output, std::uint64_t seed, Faults& faults) {
  const auto* size = std::get_if<std::int32_t>(&output.textures);
  if (size && !std::has_single_bit(static_cast<std::uint32_t>(*size)) && !faults.covers("/output/textures")) {
    faults.add({"/output/textures", "found " + std::to_string(*size) + "; expected a power of two, as 512"});
  }
  const auto more = static_cast<std::uint64_t>(output.variants - 1);
  if (seed + more < seed) {
    faults.add({"/output/variants",
                "found " + std::to_string(output.variants) + " seeds, of which some would be 2^64 or more"});
  }
  if (is_model(output)) check_profile(output, faults);  // other forms have none of these options
}

/// What the generator cannot add to its models is refused.
void check_abilities(const Generator& generator, const OutputParams& output, Faults& faults) {
  check_impostor(generator, output, faults);
  const auto refuse = [&](const char* option, bool is_wanted, const char* lack) {
    if (is_wanted)
      faults.add({std::string("/output/") + option, "the generator " + std::string(generator.name) + lack});
  };
  refuse("animation", output.animation == OutputParams::Animation::growth && !generator.grows,
         " makes no growth animation");
  refuse("wind", output.wind != OutputWind::none && !generator.sways, " has no wind weights");
  refuse("collision", output.collision != OutputCollision::none && !generator.has_collision,
         " makes no collision shapes");
}

/// A form that is no model has no use for what only models have, and the parameters must suit it.
void check_own_form(const OwnForm& own, const Generator& generator, const Generator::Params& params,
                    const OutputParams& output, Faults& faults) {
  // Where parameters are refused already, others stand in for them.
  const bool sound = std::none_of(faults.issues().begin(), faults.issues().end(), [](const Issue& issue) {
    return issue.pointer.starts_with("/parameters");
  });
  if (params && generator.check_form && sound) {
    for (Issue& issue : generator.check_form(params, wanted_form(output))) {
      if (!issue.pointer.starts_with("/output/")) issue.pointer = "/parameters" + issue.pointer;
      faults.add(std::move(issue));
    }
  }
  Json options = write_output(output);
  options.erase("format");
  if (own.has_profiles) options.erase("profile");
  if (own.has_models) {
    options.erase("textures");
    options.erase("tangents");
  }
  for (const auto& [name, value] : options.items()) {
    faults.add({"/output/" + name, "found " + value.dump() + " with the format " + std::string(own.format) +
                                       ", which is no model and has no such option"});
  }
}

/// Whether the generator can make what the output asks for. Each option is refused once: of a form that is no
/// model, for that alone.
void check_use(const Generator& generator, const Generator::Params& params, const OutputParams& output,
               Faults& faults) {
  const auto is_wanted = [&](const OwnForm& form) { return form.format == text_of(output.format); };
  const auto own = std::ranges::find_if(generator.forms, is_wanted);
  if (own == generator.forms.end()) {
    check_abilities(generator, output, faults);
  } else {
    check_own_form(*own, generator, params, output, faults);
  }
}

/// What else is wrong with a body; not that there is null where a number is told of already.
void add_others(const std::vector<Issue>& others, std::vector<Issue>& issues) {
  std::set<std::string, std::less<>> told;
  for (const Issue& issue : issues) told.insert(issue.pointer);
  for (const Issue& issue : others) {
    if (!issue.message.starts_with("found null") || !told.contains(issue.pointer)) issues.push_back(issue);
  }
}

/// A member that stands beside the part of the request that it belongs to is told where that is.
std::vector<Issue> with_parts(std::vector<Issue> issues, const Json& body, const Generator* generator) {
  if (!body.is_object()) return issues;
  for (const auto& [name, value] : body.items()) {
    const std::string_view part = part_with(name, generator ? generator->name : std::string_view());
    if (part.empty()) continue;
    for (Issue& issue : issues) {
      if (issue.pointer != pointer_token(name) ||
          issue.message.find("is not known here") == std::string::npos)
        continue;
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

Result<Request> read_request_body(const Json& json, const Limits& limits) {
  Faults faults;
  const Json merged = with_preset(json);
  const RequestParams frame = read_request(merged, "", faults);
  if (frame.preset && !faults.covers("/preset")) {
    faults.add({"/preset", schema::unknown_word("preset", *frame.preset, preset_names())});
  }
  check_output(frame.output, frame.seed, faults);
  Request::Body body;
  body.generator = named_generator(merged, frame, faults);
  if (body.generator && (!merged.contains("parameters") || merged["parameters"].is_object())) {
    const std::string other = preset_of_another(json);
    body.params = other.empty() ? parameters_of(merged, *body.generator, limits, faults)
                                : mixed_parameters(merged, other, *body.generator, limits, faults);
  }
  if (body.generator) {
    add_form_fault(*body.generator, frame.output, faults);
    check_use(*body.generator, body.params, frame.output, faults);
  }
  if (!faults.empty()) return Error{Code::invalid, with_parts(faults.take(), merged, body.generator)};
  body.output = frame.output;
  body.seed = frame.seed;
  body.canonical = canonical_request(body);
  return Request(std::make_shared<const Request::Body>(std::move(body)));
}

Result<Request> read_request(std::string_view json, const Limits& limits) {
  std::vector<Issue> issues;
  Result<Json> body = parse_body(json, issues);
  if (!body) return std::move(body).error();
  Result<Request> request = read_request_body(*body, limits);
  if (issues.empty()) return request;
  if (!request) add_others(request.error().issues, issues);
  return Error{Code::invalid, std::move(issues)};
}

Result<Request> with_format(const Request& request, std::string_view format) {
  Json output = write_output(request.body().output);
  output["format"] = format;
  Faults faults;
  Request::Body body = request.body();
  body.output = read_output(output, "/output", faults);
  if (faults.empty()) add_form_fault(*body.generator, body.output, faults);
  if (faults.empty()) check_output(body.output, body.seed, faults);
  if (faults.empty()) check_use(*body.generator, body.params, body.output, faults);
  if (!faults.empty()) return Error{Code::invalid, faults.take()};
  body.canonical = canonical_request(body);
  return Request(std::make_shared<const Request::Body>(std::move(body)));
}

}  // namespace seedmesh
