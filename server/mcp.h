#pragma once
/// The Model Context Protocol, by which agent programs use the service through tools, resources and prompts. The
/// revision 2026-07-28 has no handshake and no session. Earlier revisions begin with `initialize`.
///
/// Messages are JSON-RPC 2.0. `POST /mcp` (mcp_http.cpp) and `seedmesh mcp` (mcp_stdio.cpp) pass them to
/// answer_message(). What the methods do is in mcp_tools.cpp, mcp_resources.cpp and mcp_prompts.cpp.
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "server/config.h"
#include "server/service.h"

namespace seedmesh::mcp {

using Json = nlohmann::ordered_json;

constexpr std::string_view newest_version = "2026-07-28";
/// Revisions with a handshake, newest first.
constexpr std::array<std::string_view, 3> handshake_versions = {"2025-11-25", "2025-06-18", "2025-03-26"};
bool has_handshake(std::string_view version);

constexpr std::string_view version_key = "io.modelcontextprotocol/protocolVersion";
constexpr std::string_view capabilities_key = "io.modelcontextprotocol/clientCapabilities";

enum class ProtocolMode { handshake, stateless };

/// Error codes of JSON-RPC and of the Model Context Protocol.
enum class Code : int {
  syntax = -32700,
  no_request = -32600,
  unknown_method = -32601,
  wrong_parameters = -32602,
  header_mismatch = -32020,
  unsupported_version = -32022,
  unknown_resource_of_handshake = -32002
};

struct Failure {
  Code code = Code::wrong_parameters;
  std::string message;
  std::string data = {};  ///< JSON text; "" for none
};
using RpcResult = std::variant<Json, Failure>;

/// What a method may use.
struct Context {
  RequestContext& call;
  ProtocolMode protocol_mode = ProtocolMode::stateless;
  std::string origin = {};  ///< "http://127.0.0.1:8080" for links; "" where models are written into `folder`
  std::string folder = {};
};

/// Returns a message as JSON, or a failure for text that is not JSON, nests deeper than 64, or is no request.
RpcResult read_message(const std::string& text);

/// Whether the message is a notification, which gets no response.
bool is_notification(const Json& message);

/// Returns the mode that the parameters of a message state, or nullopt if they state none.
std::optional<ProtocolMode> protocol_mode_of(const Json& message);

/// Checks `_meta` of a stateless message.
std::optional<Failure> check_meta(const Json& message);

/// Calls the method of a message.
RpcResult answer_message(Context& context, const Json& message);

/// Returns the whole response to a message, with its id and the members that the mode adds to every result.
std::string response_text(const Context& context, const Json& message, RpcResult answer);
std::string failure_text(const Json& id, const Failure& failure);

// Methods. `parameters` is an object.
RpcResult list_tools(Context& context, const Json& parameters);  // mcp_tools.cpp
RpcResult call_tool(Context& context, const Json& parameters);
RpcResult list_resources(Context& context, const Json& parameters);  // mcp_resources.cpp
RpcResult list_templates(Context& context, const Json& parameters);
RpcResult read_resource(Context& context, const Json& parameters);
RpcResult list_prompts(Context& context, const Json& parameters);  // mcp_prompts.cpp
RpcResult get_prompt(Context& context, const Json& parameters);

/// Returns the failure for a name that no generator has, or nothing for a known name (mcp_describe.cpp).
std::optional<Failure> unknown_generator_of(const std::string& generator);

/// Returns part of the schema of a generator in at most about 8,000 characters, or a failure for an unknown generator
/// or topic (mcp_describe.cpp). `topic` is a path of names with slashes; "" for the list of parameters.
std::variant<std::string, Failure> describe_schema(const std::string& generator, const std::string& topic);

/// The input of find_presets(). Empty texts match every preset.
struct PresetQuery {
  std::string query, generator, tag;
  std::size_t limit = 20;
};
/// Returns the presets that match and that the key of the caller allows, the best match first, at most `limit`
/// (mcp_describe.cpp).
Json find_presets(const Access& access, const PresetQuery& preset_query);

/// Returns a value as JSON on one line. Bytes that are not valid UTF-8 are replaced.
std::string dumped(const Json& json);

/// Returns a member of an object that is text; "" where it is missing or something else.
std::string text_in(const Json& object, std::string_view name);

/// Reads messages, one on a line, from standard input until its end, and answers on standard output. Models are
/// written into `folder`. Returns the exit status.
int serve_stdio(const Config& config, const std::string& folder);

}  // namespace seedmesh::mcp
