#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/mcp.h"

namespace seedmesh::mcp {
namespace {

constexpr int deepest = 64;
constexpr std::int64_t hour_ms = 3'600'000;

constexpr std::string_view instructions =
    "Seedmesh makes 3D models (plants, buildings, terrain, fractals, scenes, cities) as glTF from a request "
    "with a seed. The same request always gives the same bytes. Find a preset with list_presets, learn its "
    "parameters with describe_generator, check with validate, and call generate for a link to the model.";

RpcResult discover(Context&, const Json&);
RpcResult initialize(Context&, const Json&);
RpcResult ping(Context&, const Json&) { return Json::object(); }

enum class ProtocolModes { both, handshake, stateless };

struct Method {
  std::string_view name;
  RpcResult (*answer)(Context&, const Json&);
  ProtocolModes protocol_modes = ProtocolModes::both;
  bool is_cacheable = false;
};

constexpr Method methods[] = {
    {"server/discover", discover, ProtocolModes::stateless, true},
    {"initialize", initialize, ProtocolModes::handshake},
    {"ping", ping, ProtocolModes::handshake},
    {"tools/list", list_tools, ProtocolModes::both, true},
    {"tools/call", call_tool},
    {"resources/list", list_resources, ProtocolModes::both, true},
    {"resources/templates/list", list_templates, ProtocolModes::both, true},
    {"resources/read", read_resource, ProtocolModes::both, true},
    {"prompts/list", list_prompts, ProtocolModes::both, true},
    {"prompts/get", get_prompt},
};

Json capabilities() {
  return {{"tools", Json::object()}, {"resources", Json::object()}, {"prompts", Json::object()}};
}

Json server_info() { return {{"name", "seedmesh"}, {"version", program_version()}}; }

Json supported_versions() {
  Json list = {newest_version};
  for (const std::string_view version : handshake_versions) list.push_back(version);
  return list;
}

RpcResult discover(Context&, const Json&) {
  return Json{{"supportedVersions", supported_versions()},
              {"capabilities", capabilities()},
              {"instructions", instructions}};
}

RpcResult initialize(Context&, const Json& parameters) {
  const std::string wanted = text_in(parameters, "protocolVersion");
  return Json{{"protocolVersion", has_handshake(wanted) ? wanted : std::string(handshake_versions.front())},
              {"capabilities", capabilities()},
              {"serverInfo", server_info()},
              {"instructions", instructions}};
}

const Method* method_named(std::string_view name, ProtocolMode protocol_mode) {
  const auto found = std::ranges::find_if(methods, [&](const Method& each) { return each.name == name; });
  if (found == std::end(methods)) return nullptr;
  const ProtocolModes other =
      protocol_mode == ProtocolMode::stateless ? ProtocolModes::handshake : ProtocolModes::stateless;
  return found->protocol_modes == other ? nullptr : found;
}

/// The parameters of a message; an empty object where it has none.
Json parameters_of(const Json& body) {
  const auto found = body.find("params");
  return found != body.end() && found->is_object() ? *found : Json::object();
}

Json meta_of(const Json& body) {
  const Json parameters = parameters_of(body);
  const auto found = parameters.find("_meta");
  return found != parameters.end() && found->is_object() ? *found : Json::object();
}

bool is_request(const Json& body) {
  if (!body.is_object() || text_in(body, "jsonrpc") != "2.0" || text_in(body, "method").empty()) return false;
  const auto id = body.find("id");
  if (id != body.end() && !id->is_string() && !id->is_number_integer()) return false;
  const auto parameters = body.find("params");
  return parameters == body.end() || parameters->is_object();
}

}  // namespace

bool has_handshake(std::string_view version) {
  return std::ranges::find(handshake_versions, version) != handshake_versions.end();
}

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string text_in(const Json& object, std::string_view name) {
  if (!object.is_object()) return {};
  const auto found = object.find(std::string(name));
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

RpcResult read_message(const std::string& text) {
  bool is_deep = false;
  const auto watch_depth = [&](int depth, Json::parse_event_t, Json&) {
    is_deep = is_deep || depth > deepest;
    return !is_deep;
  };
  Json body = Json::parse(text, watch_depth, false);
  if (is_deep) return Failure{Code::no_request, "The message nests deeper than 64."};
  if (body.is_discarded()) return Failure{Code::syntax, "The message is not JSON."};
  if (!is_request(body))
    return Failure{Code::no_request, "The message is not one request or notification of JSON-RPC 2.0."};
  return body;
}

bool is_notification(const Json& body) { return !body.contains("id"); }

std::optional<ProtocolMode> protocol_mode_of(const Json& body) {
  if (meta_of(body).contains(std::string(version_key))) return ProtocolMode::stateless;
  return std::nullopt;
}

std::optional<Failure> check_meta(const Json& body) {
  const Json meta = meta_of(body);
  const std::string version = text_in(meta, version_key);
  if (version.empty())
    return Failure{Code::wrong_parameters, "params._meta lacks \"" + std::string(version_key) + "\"."};
  if (version != newest_version) {
    const Json data = {{"supported", supported_versions()}, {"requested", version}};
    return Failure{Code::unsupported_version, "The protocol version is not supported.",
                   data.dump(-1, ' ', false, Json::error_handler_t::replace)};
  }
  const auto capabilities = meta.find(std::string(capabilities_key));
  if (capabilities == meta.end() || !capabilities->is_object())
    return Failure{Code::wrong_parameters, "params._meta lacks \"" + std::string(capabilities_key) + "\"."};
  return std::nullopt;
}

RpcResult answer_message(Context& context, const Json& body) {
  const std::string name = text_in(body, "method");
  const Method* method = method_named(name, context.protocol_mode);
  if (!method) return Failure{Code::unknown_method, "There is no method \"" + name.substr(0, 100) + "\"."};
  return method->answer(context, parameters_of(body));
}

std::string response_text(const Context& context, const Json& body, RpcResult answer) {
  const Json& id = body.at("id");
  if (const auto* failure = std::get_if<Failure>(&answer)) return failure_text(id, *failure);
  Json& result = std::get<Json>(answer);
  if (context.protocol_mode == ProtocolMode::stateless) {
    const Method* method = method_named(text_in(body, "method"), context.protocol_mode);
    result["resultType"] = "complete";
    result["_meta"]["io.modelcontextprotocol/serverInfo"] = server_info();
    if (method->is_cacheable) {
      result["ttlMs"] = hour_ms;
      result["cacheScope"] = context.call.service.access.closed() ? "private" : "public";
    }
  }
  const Json response = {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
  return response.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string failure_text(const Json& id, const Failure& failure) {
  Json error = {{"code", static_cast<int>(failure.code)}, {"message", failure.message}};
  if (!failure.data.empty()) error["data"] = Json::parse(failure.data);
  const Json response = {{"jsonrpc", "2.0"}, {"id", id}, {"error", std::move(error)}};
  return response.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace seedmesh::mcp
