/// POST /mcp: Streamable HTTP. Each POST has one message, and its answer is JSON.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/base64url.h"
#include "server/mcp.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

using mcp::Code;
using mcp::Failure;
using mcp::Json;
using mcp::ProtocolMode;

/// The host of "http://host:80" or "host:80" in lower case; with its brackets for IPv6.
std::string host_in(std::string_view text) {
  if (const auto scheme = text.find("://"); scheme != std::string_view::npos) text.remove_prefix(scheme + 3);
  const auto bracket = text.find(']');
  const auto colon = text.find(':', bracket == std::string_view::npos ? 0 : bracket);
  std::string host(text.substr(0, colon));
  std::ranges::transform(host, host.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return host;
}

bool is_loopback(const std::string& host) {
  return host == "localhost" || host == "127.0.0.1" || host == "[::1]" || host == "::1";
}

/// Pages of other origins must not use a service unless its settings allow their origin. A service that listens only
/// on this machine also checks the host (DNS rebinding).
std::optional<Problem> check_origin(const RequestContext& call) {
  const Config& config = call.service.config;
  const std::string host = host_in(call.request.header("Host"));
  if (is_loopback(config.host) && !host.empty() && !is_loopback(host))
    return problem(403, "found a Host that is not this machine, on a service that listens on loopback only");
  const std::string origin = call.request.header("Origin");
  if (origin.empty() || host_in(origin) == host) return std::nullopt;
  for (const std::string& allowed : config.cors_origins) {
    if (allowed == "*" || allowed == origin) return std::nullopt;
  }
  return problem(403, "found an Origin that the setting cors-origins does not list");
}

/// The value of a field that may be written as =?base64?...?=.
std::optional<std::string> decoded(const std::string& value) {
  constexpr std::string_view begin = "=?base64?", end = "?=";
  if (!value.starts_with(begin) || !value.ends_with(end) || value.size() < begin.size() + end.size())
    return value;
  std::string text = value.substr(begin.size(), value.size() - begin.size() - end.size());
  while (text.ends_with('=')) text.pop_back();
  std::ranges::replace(text, '+', '-');
  std::ranges::replace(text, '/', '_');
  return from_base64url(text);
}

/// The parameter that the field Mcp-Name repeats; "" for methods without one.
std::string_view named_parameter(std::string_view method) {
  if (method == "tools/call" || method == "prompts/get") return "name";
  return method == "resources/read" ? "uri" : "";
}

/// Checks that the fields of a stateless message agree with its body.
std::optional<Failure> check_fields(const http::Request& request, const Json& body) {
  const auto differs = [](std::string_view field, const std::string& expected) {
    return Failure{Code::header_mismatch,
                   std::string(field) + " is missing or differs from the body; expected " + expected};
  };
  const Json empty = Json::object();
  const Json& parameters = body.contains("params") ? body["params"] : empty;
  const std::string version =
      parameters.contains("_meta") ? mcp::text_in(parameters["_meta"], mcp::version_key) : std::string();
  const std::string field = request.header("MCP-Protocol-Version");
  if (field.empty() || (!version.empty() && field != version))
    return differs("MCP-Protocol-Version", version);
  const std::string method = mcp::text_in(body, "method");
  if (request.header("Mcp-Method") != method) return differs("Mcp-Method", method);
  if (const std::string_view name = named_parameter(method); !name.empty()) {
    const std::string wanted = mcp::text_in(parameters, name);
    if (!request.has_header("Mcp-Name") || decoded(request.header("Mcp-Name")) != wanted)
      return differs("Mcp-Name", wanted);
  }
  return std::nullopt;
}

ProtocolMode protocol_mode_of(const http::Request& request, const Json& body) {
  if (const auto protocol_mode = mcp::protocol_mode_of(body)) return *protocol_mode;
  const std::string version = request.header("MCP-Protocol-Version");
  return version.empty() || mcp::has_handshake(version) ? ProtocolMode::handshake : ProtocolMode::stateless;
}

/// The HTTP status of an answer. Clients with a handshake read errors from the body alone.
int status_of(const Failure& failure, ProtocolMode protocol_mode) {
  if (failure.code == Code::syntax || failure.code == Code::no_request) return 400;
  if (protocol_mode == ProtocolMode::handshake) return 200;
  return failure.code == Code::unknown_method ? 404 : 400;
}

http::Response json_response(int status, std::string text) {
  http::Response response;
  response.status = status;
  response.type = "application/json";
  response.set("Cache-Control", "no-store");
  response.body = std::move(text);
  return response;
}

}  // namespace

http::Response post_mcp(RequestContext& call) {
  if (const auto refused = check_origin(call)) return refuse(call, *refused);
  if (!is_json_type(call.request.header("Content-Type")))
    return refuse(call, problem(415, "expected the Content-Type application/json"));
  mcp::RpcResult read = mcp::read_message(call.request.body);
  if (const auto* failure = std::get_if<Failure>(&read))
    return json_response(status_of(*failure, ProtocolMode::stateless), mcp::failure_text(nullptr, *failure));
  const Json body = std::get<Json>(std::move(read));
  mcp::Context context{call, protocol_mode_of(call.request, body), origin_of(call)};
  if (mcp::is_notification(body)) {
    http::Response accepted;
    accepted.status = 202;
    return accepted;
  }
  mcp::RpcResult answer = Json();
  std::optional<Failure> failure;
  if (context.protocol_mode == ProtocolMode::stateless) {
    failure = check_fields(call.request, body);
    if (!failure) failure = mcp::check_meta(body);
  }
  if (failure) {
    answer = *failure;
  } else {
    answer = mcp::answer_message(context, body);
    if (const auto* failed = std::get_if<Failure>(&answer)) failure = *failed;
  }
  const int status = failure ? status_of(*failure, context.protocol_mode) : 200;
  return json_response(status, mcp::response_text(context, body, std::move(answer)));
}

}  // namespace seedmesh
