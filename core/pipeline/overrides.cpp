/// Presets with the overrides of a query. Every value is text, so the schema determines its type.
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/pipeline/body.h"
#include "core/schema/nearest.h"
#include "core/schema/presets.h"

namespace seedmesh {
namespace {

/// The location that an override changes, and the schema of the value there.
struct Target {
  std::vector<std::string> tokens;
  const Json* schema = nullptr;

  std::string pointer() const {
    std::string text;
    for (const std::string& token : tokens) text += pointer_token(token);
    return text;
  }
};

const std::map<std::string_view, Json>& parsed_schemas() {
  static const auto all = [] {
    std::map<std::string_view, Json> schemas;
    for (const std::string_view name : schema_names()) schemas.emplace(name, Json::parse(*schema_json(name)));
    return schemas;
  }();
  return all;
}

const Json* property(const Json& schema, std::string_view name) {
  const auto properties = schema.find("properties");
  if (properties == schema.end()) return nullptr;
  const auto found = properties->find(name);
  return found == properties->end() ? nullptr : &*found;
}

/// `seed`, `output.x`, a parameter, or `x.name` where the parameter x is an object of free names.
std::optional<Target> target_of(std::string_view key, std::string_view generator) {
  const Json& request = parsed_schemas().at("request");
  const Json& params = parsed_schemas().at(generator);
  if (key == "seed") return Target{{"seed"}, property(request, "seed")};
  if (const Json* parameter = property(params, key))
    return Target{{"parameters", std::string(key)}, parameter};
  const std::size_t dot = key.find('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::string group(key.substr(0, dot));
  const std::string name(key.substr(dot + 1));
  if (group == "output") {
    const Json* option = property(*property(request, "output"), name);
    return option ? std::optional(Target{{"output", name}, option}) : std::nullopt;
  }
  const Json* map = property(params, group);
  if (!map || !map->contains("additionalProperties") || !map->at("additionalProperties").is_object())
    return std::nullopt;
  return Target{{"parameters", group, name}, &map->at("additionalProperties")};
}

/// The property that `name` most likely misspells, as the end of a sentence; empty where there is no similar
/// property.
/// `others` are compared too, before the properties.
std::string did_you_mean(std::string_view name, const Json& schema, const std::string& group,
                         std::vector<std::string_view> others = {}) {
  std::vector<std::string_view> words = std::move(others);
  for (const auto& [word, unused] : schema.at("properties").get_ref<const Json::object_t&>())
    words.push_back(word);
  const std::string_view nearest = schema::nearest_word(name, words);
  return nearest.empty() ? "" : "; did you mean \"" + group + std::string(nearest) + "\"?";
}

/// The message for an unknown key. Keys that begin with "output." are compared with options of the output.
std::string unknown_key(std::string_view key, std::string_view generator) {
  constexpr std::string_view group = "output.";
  const std::string found = "\"" + shortened(key, 40) + "\"";
  if (key.starts_with(group)) {
    const Json& output = *property(parsed_schemas().at("request"), "output");
    return found + " is not an option of the output" +
           did_you_mean(key.substr(group.size()), output, std::string(group));
  }
  constexpr std::string_view parameters = "parameters.";
  const std::string_view own = key.starts_with(parameters) ? key.substr(parameters.size()) : key;
  const std::string_view outer = own.substr(0, own.find('.'));
  if (outer.size() < own.size() && property(parsed_schemas().at(generator), outer)) {
    const std::string whole(outer);
    return found + " is only a part of \"" + whole + "\", which takes its whole value as JSON, such as " +
           whole + "={\"" + shortened(own.substr(outer.size() + 1), 40) + "\":…}";
  }
  std::string meant;
  if (part_with(key, "") == "output") {
    meant = "; did you mean \"output." + std::string(key) + "\"?";
  } else if (own != key && part_with(own, generator) == "parameters") {
    meant = "; did you mean \"" + std::string(own) + "\"?";
  } else {
    meant = did_you_mean(key, parsed_schemas().at(generator), "", {"seed"});
  }
  return found + " is neither seed, nor output.…, nor a parameter of " + std::string(generator) + meant;
}

bool takes(const Json& schema, const Json& value) {
  if (schema.contains("oneOf")) {
    for (const Json& alternative : schema["oneOf"]) {
      if (takes(alternative, value)) return true;
    }
    return false;
  }
  const std::string_view type = schema["type"].get_ref<const std::string&>();
  if (type == "boolean") return value.is_boolean();
  if (type == "number" || type == "integer") return value.is_number();
  if (type == "array") return value.is_array();
  return type == "object" && value.is_object();
}

/// The value as JSON where the schema accepts its type, else the text itself, which the reader then checks.
Json value_of(const Json& schema, const std::string& text) {
  Result<Json> value = parse_json(text);
  if (value && takes(schema, *value)) return *std::move(value);
  return text;
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

void place(Json& request, const Target& target, Json value) {
  Json* at = &request;
  for (const std::string& token : target.tokens) at = &(*at)[token];
  *at = std::move(value);
}

bool is_inside(std::string_view pointer, std::string_view outer) {
  return pointer.starts_with(outer) && (pointer.size() == outer.size() || pointer[outer.size()] == '/');
}

/// Moves the pointer of an error in an overridden value to the override.
void point_at_overrides(std::vector<Issue>& issues,
                        const std::vector<std::pair<std::string, std::string>>& places) {
  for (Issue& issue : issues) {
    for (const auto& [pointer, key] : places) {
      if (!is_inside(issue.pointer, pointer)) continue;
      issue.pointer = pointer_token(key);
      break;
    }
  }
}

}  // namespace

std::string_view part_with(std::string_view member, std::string_view generator) {
  const auto& schemas = parsed_schemas();
  if (property(*property(schemas.at("request"), "output"), member)) return "output";
  const auto own = schemas.find(generator);
  return own != schemas.end() && property(own->second, member) ? "parameters" : "";
}

std::optional<Result<Request>> read_preset(std::string_view name, const Overrides& overrides,
                                           const Limits& limits) {
  const auto preset = preset_requests().find(name);
  if (preset == preset_requests().end()) return std::nullopt;
  Json request = preset->second.request;
  const std::string generator = request.at("generator");

  IssueList errors;
  std::set<std::string_view> seen;
  std::vector<std::pair<std::string, std::string>> places;
  for (const auto& [key, value] : overrides) {
    if (find_bad_utf8(key) != std::string_view::npos || find_bad_utf8(value) != std::string_view::npos) {
      errors.add({IssueKind::syntax, "", "the query is not UTF-8"});
    } else if (!seen.insert(key).second) {
      errors.add({IssueKind::duplicate_key, pointer_token(key),
                  "\"" + shortened(key, 40) + "\" is given twice in the query"});
    } else if (const auto target = target_of(key, generator)) {
      // A seed stays a text where it is beyond 64 bits, so that a message repeats all its digits.
      place(request, *target,
            key == "seed" && is_digits(value) ? Json(value) : value_of(*target->schema, value));
      places.emplace_back(target->pointer(), key);
    } else {
      errors.add({IssueKind::unknown_key, pointer_token(key), unknown_key(key, generator)});
    }
  }
  Job::Options options;
  options.limits = limits;
  Result<Request> result = read_request_body(request, options);
  std::vector<Issue> issues = errors.take();
  if (result && issues.empty()) return result;
  if (!result) {
    std::vector<Issue> others = result.error().issues;
    point_at_overrides(others, places);
    issues.insert(issues.end(), others.begin(), others.end());
  }
  return Error{Code::invalid, std::move(issues)};
}

}  // namespace seedmesh
