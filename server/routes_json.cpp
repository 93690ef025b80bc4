/// Routes that answer with JSON: checks of requests, imports, presets and schemas.
#include <nlohmann/json.hpp>

#include "server/negotiate.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

/// Runs derive() or validate() with a worker.
http::Response answer_with(RequestContext& call,
                           Result<std::string> (*work)(const Request&, const Job::Options&)) {
  auto body = read_body(call);
  if (auto* refusal = std::get_if<http::Response>(&body)) return std::move(*refusal);
  const Request request = std::get<Request>(std::move(body));
  std::optional<Result<std::string>> result;
  const auto run = [&](const Job::Options& options) { result = work(request, options); };
  if (const auto refused = with_worker(call, call.request.disconnect_token(), run))
    return refuse(call, *refused);
  if (!*result) return refuse(call, problem_of(result->error()));
  return json_response(call, std::move(**result));
}

/// The question of an import from its query; the response for an unknown key.
std::variant<ImportInput, http::Response> import_question(RequestContext& call, const Overrides& query) {
  ImportInput question{{}, {}, call.request.body};
  std::vector<Issue> issues;
  for (const auto& [key, value] : query) {
    if (key == "format") {
      question.format = value;
    } else if (key == "entry") {
      question.entry = value;
    } else {
      issues.emplace_back(IssueKind::unknown_key, "/" + key,
                          "expected format or entry; an import has no other options");
    }
  }
  if (!issues.empty()) return refuse(call, problem_of({Code::invalid, std::move(issues)}));
  return question;
}

/// The generators with their titles, in the order of the registry.
Json generator_list(const Access& access) {
  Json list = Json::array();
  for (const std::string_view name : generator_names()) {
    if (!access.allows_generator(name)) continue;
    const std::string title = Json::parse(schema_json(name).value_or("{}")).value("title", std::string(name));
    list.push_back({{"name", name}, {"title", title}});
  }
  return list;
}

std::string preset_list(const Access& access) {
  Json list = Json::array();
  for (const PresetInfo& preset : presets()) {
    if (!access.allows_generator(preset.generator)) continue;
    list.push_back({{"name", preset.name},
                    {"generator", preset.generator},
                    {"title", preset.title},
                    {"description", preset.description},
                    {"tags", preset.tags}});
  }
  return Json{{"presets", std::move(list)}, {"generators", generator_list(access)}}.dump();
}

}  // namespace

http::Response post_validate(RequestContext& call) { return answer_with(call, validate); }

http::Response post_derive(RequestContext& call) {
  if (call.query().find_first_not_of('&') == std::string_view::npos) return answer_with(call, derive);
  auto body = read_body(call);
  if (auto* refusal = std::get_if<http::Response>(&body)) return std::move(*refusal);
  return derive_world(call, std::get<Request>(body));
}

http::Response post_import(RequestContext& call) {
  if (call.service.access.only_presets()) {
    return deny(call, {problem(403, "This service makes only presets, so imports are not available."),
                       "only_presets"});
  }
  auto query = parse_query(call);
  if (auto* refusal = std::get_if<http::Response>(&query)) return std::move(*refusal);
  if (!is_text_or_json_type(call.request.header("Content-Type"))) {
    http::Response response =
        refuse(call, problem(415, "Send the file as text/plain, application/json or application/xml."));
    response.set("Accept", "text/plain, application/json, application/xml");
    return response;
  }
  auto asked = import_question(call, std::get<Overrides>(query));
  if (auto* refusal = std::get_if<http::Response>(&asked)) return std::move(*refusal);
  const auto question = std::get<ImportInput>(asked);
  std::optional<Result<ImportedRequest>> imported;
  const auto read = [&](const Job::Options& options) { imported = import_request(question, options); };
  if (const auto refused = with_worker(call, call.request.disconnect_token(), read))
    return refuse(call, *refused);
  if (!*imported) {
    Problem problem = problem_of(imported->error());
    if (question.format.empty() && imported->error().code == Code::invalid)
      problem.format = likely_import_format(question.text);
    return refuse(call, problem);
  }
  return json_response(call, std::move((*imported)->answer));
}

http::Response get_presets(RequestContext& call) {
  return static_response(call, "/v1/presets", "application/json",
                         [&] { return preset_list(call.service.access); });
}

http::Response get_schema(RequestContext& call) {
  std::string name = call.name;
  for (std::string_view suffix : {".json", ".schema"}) {  // schemas refer to each other by file name
    if (name.size() > suffix.size() &&
        name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0) {
      name.resize(name.size() - suffix.size());
    }
  }
  const auto text = schema_json(name);
  if (!text) return refuse(call, problem(404, no_schema(name)));
  return static_response(call, "/v1/schemas/" + name, "application/schema+json",
                         [&] { return std::string(*text); });
}

http::Response get_vocabulary(RequestContext& call) {
  return static_response(call, "/v1/vocabulary", "application/json", vocabulary_json);
}

http::Response get_openapi(RequestContext& call) {
  return static_response(call, "/openapi.json", "application/json",
                         [] { return std::string(openapi_json()); });
}

}  // namespace seedmesh
