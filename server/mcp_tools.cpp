/// The tools: search, description, check, generation, derivation and comparison. A request that is refused is a
/// result with `isError` and one line for each error, so that the caller can correct the request.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/base64url.h"
#include "core/base/token.h"
#include "server/files.h"
#include "server/mcp.h"
#include "server/routes.h"

namespace seedmesh::mcp {
namespace {

constexpr std::size_t longest_text = 12'000;  ///< characters of a derivation
constexpr std::size_t most_differences = 100;
constexpr std::uint32_t picture_size = 384;  ///< about 10 KB, which fits into a context

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json text_content(std::string text) { return {{"type", "text"}, {"text", std::move(text)}}; }

/// The same as structured content and as text, for clients that read only text.
Json result_of(Json structured) {
  Json content = Json::array({text_content(dumped(structured))});
  return {{"structuredContent", std::move(structured)}, {"content", std::move(content)}};
}

Json refused(std::string text) {
  return {{"isError", true}, {"content", Json::array({text_content(std::move(text))})}};
}

/// The problem of a response as lines: "/parameters/productions/0 (line 1, column 7): found ...".
Json refused(const http::Response& response) {
  const auto* body = std::get_if<std::string>(&response.body);
  const Json problem = Json::parse(body ? *body : std::string(), nullptr, false);
  if (!problem.is_object()) return refused("The request was refused.");
  std::string lines;
  for (const Json& error : problem.value("errors", Json::array())) {
    lines += (lines.empty() ? "" : "\n") + text_in(error, "pointer");
    if (error.contains("line"))
      lines += " (line " + error["line"].dump() + ", column " + error.value("column", Json(1)).dump() + ")";
    lines += ": " + text_in(error, "message");
  }
  if (lines.empty()) lines = text_in(problem, "detail");
  for (const auto& [name, value] : response.headers) {
    if (name == "Retry-After") lines += " Try again after " + value + " s.";
  }
  return refused(std::move(lines));
}

Json refused(const Context& context, const Problem& problem) {
  return refused(refuse(context.call, problem));
}

/// A request at `pointer` of the arguments.
std::variant<Request, http::Response> read_request_in(Context& context, const Json& json) {
  return read_text(context.call, dumped(json));
}

std::string short_link(const Json& arguments, const Request& request, const TaggedRequest& wanted) {
  const std::string extension(format_named(request.format()).extension);
  bool is_plain = !text_in(arguments, "preset").empty();
  for (const auto& [name, value] : arguments.items())
    is_plain = is_plain && (name == "preset" || name == "seed");
  if (is_plain) {
    const std::string path = "/v1/presets/" + text_in(arguments, "preset") + "." + extension;
    return arguments.contains("seed") ? path + "?seed=" + std::to_string(request.seed()) : path;
  }
  return wanted.token.empty() ? "" : permalink(wanted.token, extension);
}

/// Where the model can be fetched; "" where its request is too long for a URL.
std::string address_of(const Context& context, const Json& arguments, const TaggedRequest& wanted,
                       const CachedModel& made) {
  if (!context.folder.empty()) {
    const std::filesystem::path file =
        std::filesystem::absolute(context.folder) / (wanted.request.name() + "." + made.product.extension);
    return write_file(file.string(), *made.payload) ? "file://" + file.string() : "";
  }
  const std::string path = context.call.service.access.signed_for(
      context.call.grant, short_link(arguments, wanted.request, wanted));
  return path.empty() ? "" : context.origin + path;
}

Json statistics_of(const CachedModel& made) {
  const Statistics& statistics = made.product.statistics;
  return {{"triangles", statistics.triangles},
          {"vertices", statistics.vertices},
          {"bytes", made.payload->size()},
          {"warnings", statistics.warnings}};
}

/// A picture of the model as image content; nothing where it cannot be drawn, as for worlds.
std::optional<Json> picture_content(Context& context, const Request& request) {
  const Cache::Lookup answer =
      picture_of(context.call, request, {.width = picture_size, .height = picture_size});
  const auto* entry = std::get_if<Cache::Entry>(&answer.outcome);
  if (!entry) return std::nullopt;
  return Json{{"type", "image"},
              {"data", base64((*entry)->payload->text())},
              {"mimeType", (*entry)->product.media_type}};
}

Json generate(Context& context, const Json& arguments) {
  auto read = read_request_in(context, arguments);
  if (const auto* refusal = std::get_if<http::Response>(&read)) return refused(*refusal);
  TaggedRequest wanted = tagged(std::get<Request>(std::move(read)));
  wanted.token = token_of(wanted.request);
  const Cache::Lookup answer = model_of(context.call, wanted, {});
  if (const auto* problem = std::get_if<Problem>(&answer.outcome)) return refused(context, *problem);
  const CachedModel& made = *std::get<Cache::Entry>(answer.outcome);
  const std::string address = address_of(context, arguments, wanted, made);
  const std::string file = wanted.request.name() + "." + made.product.extension;
  Json structured = {{"name", file}};
  structured["url"] = address.empty() ? Json() : Json(address);
  const std::string path = wanted.token.empty() ? "" : permalink(wanted.token, made.product.extension);
  structured["permalink"] = path.empty() ? Json() : Json(path);
  structured.update(statistics_of(made));
  structured["engine"] = engine_version();
  Json result = result_of(structured);
  if (!address.empty()) {
    result["content"].push_back({{"type", "resource_link"},
                                 {"uri", address},
                                 {"name", file},
                                 {"mimeType", made.product.media_type},
                                 {"size", made.payload->size()}});
  }
  if (std::optional<Json> picture = picture_content(context, wanted.request))
    result["content"].push_back(*std::move(picture));
  return result;
}

/// Runs validate() or derive() with a worker.
std::variant<std::string, Json> worked(Context& context, const Json& arguments,
                                       Result<std::string> (*work)(const Request&, const Job::Options&)) {
  auto read = read_request_in(context, arguments);
  if (const auto* refusal = std::get_if<http::Response>(&read)) return refused(*refusal);
  const Request request = std::get<Request>(std::move(read));
  std::optional<Result<std::string>> result;
  const auto run = [&](const Job::Options& options) { result = work(request, options); };
  if (const auto problem = with_worker(context.call, context.call.request.disconnect_token(), run))
    return refused(context, *problem);
  if (!*result) return refused(context, problem_of(result->error()));
  return std::move(**result);
}

Json check(Context& context, const Json& arguments) {
  auto answer = worked(context, arguments, validate);
  if (auto* refusal = std::get_if<Json>(&answer)) return std::move(*refusal);
  return result_of(Json::parse(std::get<std::string>(answer)));
}

/// Cuts long lists and texts. What is left out is counted.
Json shortened(const Json& value, std::size_t longest_list, std::size_t longest_string) {
  if (value.is_string() && value.get_ref<const std::string&>().size() > longest_string) {
    const std::string& text = value.get_ref<const std::string&>();
    std::size_t end = longest_string;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "... (" + std::to_string(text.size()) + " bytes)";
  }
  if (!value.is_structured()) return value;
  Json result = value.is_array() ? Json::array() : Json::object();
  for (const auto& [name, part] : value.items()) {
    if (result.size() == longest_list) {
      const std::string rest = std::to_string(value.size() - longest_list) + " more";
      if (value.is_array()) result.push_back(rest);
      if (value.is_object()) result["..."] = rest;
      break;
    }
    Json each = shortened(part, longest_list, longest_string);
    if (value.is_array()) result.push_back(std::move(each));
    if (value.is_object()) result[name] = std::move(each);
  }
  return result;
}

Json derived(Context& context, const Json& arguments) {
  auto answer = worked(context, arguments, derive);
  if (auto* refusal = std::get_if<Json>(&answer)) return std::move(*refusal);
  const Json whole = Json::parse(std::get<std::string>(answer));
  Json result = whole;
  for (std::size_t longest = 64; dumped(result).size() > longest_text && longest > 0; longest /= 2)
    result = shortened(whole, longest, longest * 64);
  return result_of({{"complete", result == whole}, {"result", std::move(result)}});
}

Json compare(Context& context, const Json& arguments) {
  std::array<Json, 2> statistics, flat;
  std::array<std::string, 2> tags;
  constexpr std::array<const char*, 2> names = {"a", "b"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Json given = arguments.value(names[i], Json());
    auto read = read_request_in(context, given);
    if (const auto* refusal = std::get_if<http::Response>(&read)) {
      Json result = refused(*refusal);
      std::string& text = result["content"][0]["text"].get_ref<std::string&>();
      text = std::string("In the request \"") + names[i] + "\":\n" + text;
      return result;
    }
    const TaggedRequest wanted = tagged(std::get<Request>(std::move(read)));
    flat[i] = Json::parse(wanted.request.canonical()).flatten();
    tags[i] = wanted.tag;
    const Cache::Lookup answer = model_of(context.call, wanted, {});
    if (const auto* problem = std::get_if<Problem>(&answer.outcome)) return refused(context, *problem);
    statistics[i] = statistics_of(*std::get<Cache::Entry>(answer.outcome));
  }
  Json differences = Json::array();
  std::size_t count = 0;
  const auto add = [&](const std::string& pointer, const Json& a, const Json& b) {
    if (++count <= most_differences) differences.push_back({{"pointer", pointer}, {"a", a}, {"b", b}});
  };
  for (const auto& [pointer, value] : flat[0].items()) {
    const Json other = flat[1].value(pointer, Json());
    if (other != value) add(pointer, value, other);
  }
  for (const auto& [pointer, value] : flat[1].items()) {
    if (!flat[0].contains(pointer)) add(pointer, nullptr, value);
  }
  return result_of({{"same_bytes", tags[0] == tags[1]},
                    {"a", statistics[0]},
                    {"b", statistics[1]},
                    {"differences", std::move(differences)},
                    {"difference_count", count}});
}

Json list_presets(Context& context, const Json& arguments) {
  const std::string generator = text_in(arguments, "generator");
  if (!generator.empty()) {
    if (const auto unknown = unknown_generator_of(generator)) return refused(unknown->message);
  }
  PresetQuery preset_query{text_in(arguments, "query"), generator, text_in(arguments, "tag")};
  if (arguments.contains("limit")) preset_query.limit = arguments["limit"].get<std::size_t>();
  return result_of(find_presets(context.call.service.access, preset_query));
}

Json describe_generator(Context&, const Json& arguments) {
  auto answer = describe_schema(text_in(arguments, "generator"), text_in(arguments, "topic"));
  if (const auto* failure = std::get_if<Failure>(&answer)) return refused(failure->message);
  return {{"content", Json::array({text_content(std::get<std::string>(std::move(answer)))})}};
}

Json text_schema(const char* text) { return {{"type", "string"}, {"description", text}}; }

Json object_schema(Json properties, Json required) {
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

Json request_schema() {
  return object_schema(
      {{"preset", text_schema("Name from list_presets; the rest is merged over its request.")},
       {"generator",
        text_schema("Required without a preset, as lsystem, tree, building, terrain, city or scene.")},
       {"seed",
        {{"type", "integer"},
         {"minimum", 0},
         {"description", "Another seed gives another model of the same kind."}}},
       {"parameters", {{"type", "object"}, {"description", "See describe_generator."}}},
       {"output",
        {{"type", "object"}, {"description", "Format, profile, lods, textures; topic \"output\"."}}}},
      Json::array());
}

Json presets_schema() {
  return object_schema(
      {{"query", text_schema("Words in name, title, tags or description; all have to match.")},
       {"generator", text_schema("Only presets of this generator.")},
       {"tag", text_schema("Only presets with this tag.")},
       {"limit", {{"type", "integer"}, {"minimum", 1}, {"maximum", 100}, {"default", 20}}}},
      Json::array());
}

Json description_schema() {
  return object_schema(
      {{"generator", text_schema("Name of the generator.")},
       {"topic",
        text_schema(
            "Path such as productions, leaves/shape or output/lods; without it the list of parameters.")}},
      Json::array({"generator"}));
}

Json comparison_schema() {
  Json request = {{"type", "object"}, {"description", "A request as for generate."}};
  return object_schema({{"a", request}, {"b", request}}, Json::array({"a", "b"}));
}

struct Tool {
  std::string_view name, title, text;
  Json (*input)();
  Json (*run)(Context&, const Json&);
};

constexpr Tool tools[] = {
    {"list_presets", "Search presets", "Lists ready-made requests that match a search, the best first.",
     presets_schema, list_presets},
    {"describe_generator", "Describe a generator",
     "Shows the parameters of a generator, or one part of them, as JSON Schema or as an outline of it.",
     description_schema, describe_generator},
    {"validate", "Check a request",
     "Checks a request and estimates triangles and bytes without making a model. Errors name a JSON Pointer.",
     request_schema, check},
    {"generate", "Generate a model",
     "Makes the model of a request. Returns its link, statistics and a picture. The same request gives the "
     "same bytes.",
     request_schema, generate},
    {"derive", "Derive a request",
     "Shows the generator's result before geometry, such as the word of an L-system. Long parts are cut.",
     request_schema, derived},
    {"compare", "Compare two requests", "Shows how two requests and their models differ.", comparison_schema,
     compare},
};

/// The first error of arguments by the schema of their tool; "" for none. Requests are checked when they are read.
std::string argument_error(const Tool& tool, const Json& arguments) {
  const Json schema = tool.input();
  for (const Json& name : schema["required"]) {
    if (!arguments.contains(name.get<std::string>()))
      return "/: expected " + dumped(name) + ", which is missing";
  }
  if (tool.input == request_schema) return "";
  for (const auto& [name, value] : arguments.items()) {
    const std::string pointer = "/" + name.substr(0, 40);
    if (!schema["properties"].contains(name))
      return pointer + ": " + std::string(tool.name) + " has no such argument";
    const std::string type = schema["properties"][name]["type"];
    if (type == "string" && !value.is_string())
      return pointer + ": found " + dumped(value).substr(0, 40) + ", expected text";
    if (type == "object" && !value.is_object())
      return pointer + ": found " + dumped(value).substr(0, 40) + ", expected an object";
    const bool is_small = value.is_number_unsigned() && value >= 1 && value <= 100;
    if (type == "integer" && !is_small)
      return pointer + ": found " + dumped(value).substr(0, 40) + ", expected an integer from 1 to 100";
  }
  return "";
}

}  // namespace

RpcResult list_tools(Context& context, const Json&) {
  Json list = Json::array();
  for (const Tool& tool : tools) {
    const bool writes = tool.run == generate && !context.folder.empty();
    list.push_back({{"name", tool.name},
                    {"title", tool.title},
                    {"description", tool.text},
                    {"inputSchema", tool.input()},
                    {"annotations",
                     {{"readOnlyHint", !writes},
                      {"destructiveHint", false},
                      {"idempotentHint", true},
                      {"openWorldHint", false}}}});
  }
  return Json{{"tools", std::move(list)}};
}

RpcResult call_tool(Context& context, const Json& parameters) {
  const std::string name = text_in(parameters, "name");
  const auto tool = std::ranges::find_if(tools, [&](const Tool& each) { return each.name == name; });
  if (tool == std::end(tools))
    return Failure{Code::wrong_parameters, "There is no tool \"" + name.substr(0, 100) + "\"."};
  const Json arguments = parameters.value("arguments", Json::object());
  if (!arguments.is_object()) return Failure{Code::wrong_parameters, "params.arguments is not an object."};
  if (std::string error = argument_error(*tool, arguments); !error.empty()) return refused(std::move(error));
  return tool->run(context, arguments);
}

}  // namespace seedmesh::mcp
