#include "server/routes.h"

#include <string_view>

#include "core/base/json_pointer.h"
#include "server/http/text.h"
#include "server/negotiate.h"

namespace seedmesh {
namespace {

/// Whether the route needs a key or a signature on a closed service (access.h).
enum class Guard { open, closed };

/// How a query is treated: refused, read by the route, or ignored, because probes and browsers may add one.
enum class Query { refused, read, ignored };

struct Route {
  std::string_view method;   ///< GET includes HEAD
  std::string_view pattern;  ///< "/{...}" at the end matches any one segment, "/{...*}" all that follows
  http::Response (*answer)(RequestContext&);
  Guard guard = Guard::open;
  Query query = Query::refused;
};

constexpr Route table[] = {
    {"POST", "/v1/generate", post_generate, Guard::closed},
    {"GET", "/v1/models/{token}", get_model, Guard::closed, Query::read},
    {"GET", "/m/{token}", get_card, Guard::closed},
    {"GET", "/v1/textures/{name}", get_texture, Guard::closed},
    {"GET", "/v1/worlds/{file*}", get_world, Guard::open, Query::read},
    {"GET", "/v1/presets", get_presets},
    {"GET", "/v1/presets/{name}", get_preset, Guard::closed, Query::read},
    {"POST", "/v1/validate", post_validate, Guard::closed},
    {"POST", "/v1/derive", post_derive, Guard::closed, Query::read},
    {"POST", "/v1/import", post_import, Guard::closed, Query::read},
    {"POST", "/mcp", post_mcp, Guard::closed},
    {"GET", "/v1/schemas/{name}", get_schema},
    {"GET", "/v1/vocabulary", get_vocabulary},
    {"GET", "/openapi.json", get_openapi},
    {"GET", "/docs", get_docs, Guard::open, Query::ignored},
    {"GET", "/healthz", get_healthz, Guard::open, Query::ignored},
    {"GET", "/readyz", get_readyz, Guard::open, Query::ignored},
    {"GET", "/metrics", get_metrics, Guard::open, Query::ignored},
    {"GET", "/version", get_version},
};
/// Parsing a larger text needs a worker.
constexpr std::size_t largest_without_worker = 256 * 1'024;

constexpr Route asset_route = {"GET", "/", get_asset, Guard::open, Query::ignored};

/// The segment that matches {...}, or "" for a pattern without it; nothing where the path does not match.
std::optional<std::string> match(std::string_view pattern, std::string_view path) {
  const auto brace = pattern.find('{');
  if (brace == std::string_view::npos) {
    if (path != pattern) return std::nullopt;
    return std::string();
  }
  const std::string_view segment = path.substr(std::min(brace, path.size()));
  if (path.substr(0, brace) != pattern.substr(0, brace) || segment.empty()) return std::nullopt;
  if (pattern.ends_with("*}")) return std::string(segment);  // undecoded: the route splits it
  if (segment.find('/') != std::string_view::npos) return std::nullopt;
  return http::percent_decode(segment);
}

bool allows(const Route& row, std::string_view method) {
  return row.method == method || (row.method == "GET" && method == "HEAD");
}

/// Refuses a query on a route that reads none, as an unknown member of a body is refused.
std::optional<http::Response> refuse_query(const Route& row, const RequestContext& call) {
  if (row.query != Query::refused || call.query().empty()) return std::nullopt;
  auto query = parse_query(call);
  if (auto* refusal = std::get_if<http::Response>(&query)) return std::move(*refusal);
  constexpr std::size_t most_issues = 20, longest_key = 40;
  std::vector<Issue> issues;
  for (const auto& [key, value] : std::get<Overrides>(query)) {
    if (issues.size() == most_issues) break;
    issues.emplace_back(IssueKind::unknown_key, pointer_token(key.substr(0, longest_key)),
                        std::string(row.pattern) + " takes no query.");
  }
  if (issues.empty()) return std::nullopt;  // `?` or `?&` alone
  return refuse(call, problem_of({Code::invalid, std::move(issues)}));
}

/// Refuses a body that would have no effect.
std::optional<http::Response> refuse_body(const Route& row, const RequestContext& call) {
  const std::size_t length = call.request.body.size();
  if (row.method != "GET" || length == 0) return std::nullopt;
  return refuse(call, problem_of({Code::malformed,
                                  {{IssueKind::not_available, "",
                                    "found a body of " + std::to_string(length) +
                                        " bytes, expected none for " + call.request.method +
                                        "; values belong in the query, or in a POST to /v1/generate"}}}));
}

http::Response answer(const Route& row, RequestContext& call) {
  if (auto refusal = refuse_query(row, call)) return std::move(*refusal);
  if (auto refusal = refuse_body(row, call)) return std::move(*refusal);
  return row.answer(call);
}

http::Response admit_and_answer(const Route& row, RequestContext& call) {
  auto admitted = call.service.access.admit(call.request);
  if (const auto* denial = std::get_if<Denial>(&admitted)) return deny(call, *denial);
  call.grant = std::get<Grant>(std::move(admitted));
  http::Response response = answer(row, call);
  if (call.grant.by == Grant::By::key) {
    response.log_fields.emplace_back("key", call.grant.key);
    call.service.metrics.used(call.grant.key);
  }
  return response;
}

http::Response run(const Route& row, RequestContext& call) {
  http::Response response = row.guard == Guard::closed ? admit_and_answer(row, call) : answer(row, call);
  if (response.route.empty()) response.route = row.pattern;
  return response;
}

/// The response to a method that the route does not have.
http::Response other_method(const Route& row, RequestContext& call) {
  const std::string allowed = row.method == "GET" ? "GET, HEAD, OPTIONS" : "POST, OPTIONS";
  http::Response response;
  if (call.request.method == "OPTIONS") {
    response.status = 204;
  } else {
    response = refuse(
        call, problem(405, call.request.method + " is not allowed on this path; it allows " + allowed + "."));
  }
  response.set("Allow", allowed);
  response.route = row.pattern;
  return response;
}

/// The response to OPTIONS with the target "*", which asks about the server as a whole (RFC 9110 section 9.3.7).
http::Response options_of_server() {
  http::Response response;
  response.status = 204;
  response.set("Allow", "GET, HEAD, POST, OPTIONS");
  response.route = "*";
  return response;
}

/// The first segments of a path, such as the two of "/v1/presets".
std::string_view first_segments(std::string_view path, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count && end != std::string_view::npos; ++i) end = path.find('/', end + 1);
  return path.substr(0, end);
}

/// The message for a path without a resource, with the route that it most likely means.
std::string no_resource(std::string_view path) {
  constexpr std::string_view version = "/v1";
  constexpr std::size_t least = 4;      // characters of a path that can be compared
  std::vector<std::string_view> fixed;  // the parts of patterns before {...}
  for (const Route& row : table) fixed.push_back(row.pattern.substr(0, row.pattern.find("/{")));
  std::string_view nearest;
  for (const std::string& meant :
       {std::string(first_segments(path, 2)), std::string(version).append(first_segments(path, 1)),
        std::string(first_segments(path.substr(path.starts_with("/v1/") ? version.size() : 0), 1))}) {
    if (nearest.empty() && meant.size() > least) nearest = nearest_name(meant, fixed);
  }
  const Route* found = nullptr;
  const bool is_longer = path.find('/', version.size() + 1) != std::string_view::npos;
  for (const Route& row : table) {
    const bool has_name = row.pattern.find("/{") != std::string_view::npos;
    const bool is_same = row.pattern.substr(0, row.pattern.find("/{")) == nearest;
    if (is_same && (found == nullptr || has_name == is_longer)) found = &row;
  }
  std::string message = "There is no resource at this path";
  message += found == nullptr
                 ? "."
                 : "; did you mean " + std::string(found->method) + ' ' + std::string(found->pattern) + '?';
  return message + " /openapi.json lists all.";
}

http::Response no_route(const RequestContext& call) {
  http::Response response = refuse(call, problem(404, no_resource(call.request.path)));
  response.route = "none";
  return response;
}

}  // namespace

std::optional<http::Response> refuse_target(Service& service, const http::Request& request) {
  RequestContext call{service, request, {}, {}};
  for (const Route& row : table) {
    if (!match(row.pattern, request.path)) continue;
    if (allows(row, request.method)) return std::nullopt;
    return other_method(row, call);
  }
  if (service.pages.find(request.path)) return other_method(asset_route, call);
  return no_route(call);
}

http::Response route(Service& service, const http::Request& request) {
  if (request.path == "*") return options_of_server();
  RequestContext call{service, request, {}, {}};
  call.grant.target_size = request.target.size();
  for (const Route& row : table) {
    std::optional<std::string> name = match(row.pattern, request.path);
    if (!name) continue;
    call.name = std::move(*name);
    http::Response response = allows(row, request.method) ? run(row, call) : other_method(row, call);
    if (row.answer == get_world) open_to_pages(service, request, response);
    return response;
  }
  if (service.pages.find(request.path)) {
    return allows(asset_route, request.method) ? run(asset_route, call) : other_method(asset_route, call);
  }
  return no_route(call);
}

std::optional<Overrides> read_query(std::string_view query) {
  Overrides overrides;
  while (!query.empty()) {
    const auto end = std::min(query.find('&'), query.size());
    const std::string_view pair = query.substr(0, end);
    query.remove_prefix(std::min(end + 1, query.size()));
    if (pair.empty()) continue;
    const auto equals = std::min(pair.find('='), pair.size());
    std::optional<std::string> key = http::percent_decode(pair.substr(0, equals), http::PlusSign::space);
    std::optional<std::string> value =
        http::percent_decode(pair.substr(std::min(equals + 1, pair.size())), http::PlusSign::space);
    if (!key || !value) return std::nullopt;
    overrides.emplace_back(std::move(*key), std::move(*value));
  }
  return overrides;
}

std::variant<Overrides, http::Response> parse_query(const RequestContext& call) {
  if (auto query = read_query(call.query())) return std::move(*query);
  return refuse(call, problem_of({Code::malformed,
                                  {{IssueKind::syntax, "", "The query has a malformed percent escape."}}}));
}

std::variant<Request, http::Response> read_text(RequestContext& call, const std::string& text) {
  std::optional<Result<Request>> request;
  const auto read = [&](const Job::Options& options) { request = read_request(text, options); };
  if (text.size() <= largest_without_worker) {
    read(options_without_worker(call));
  } else if (const auto refused = with_worker(call, call.request.disconnect_token(), read)) {
    return refuse(call, *refused);
  }
  if (!*request) return refuse(call, problem_of(request->error()));
  if (auto refusal = check_allowed(call, **request)) return std::move(*refusal);
  return std::move(**request);
}

std::variant<Request, http::Response> read_body(RequestContext& call) {
  const std::string type = call.request.header("Content-Type");
  if (!is_json_type(type)) {
    http::Response response =
        refuse(call, problem(415, "found the Content-Type \"" + type.substr(0, 100) +
                                      "\"; expected application/json in UTF-8, or none (with curl: --json, "
                                      "or -H 'Content-Type: application/json')"));
    response.set("Accept", "application/json");
    return response;
  }
  return read_text(call, call.request.body);
}

}  // namespace seedmesh
