/// `seedmesh mcp`: the same messages on standard input and output, one on a line.
#include <iostream>
#include <nlohmann/json.hpp>

#include "server/mcp.h"

namespace seedmesh::mcp {
namespace {

/// The response to a line; "" for a notification.
std::string answer_line(Service& service, const std::string& line, const std::string& folder) {
  RpcResult read = read_message(line);
  if (const auto* failure = std::get_if<Failure>(&read)) return failure_text(nullptr, *failure);
  const Json message = std::get<Json>(std::move(read));
  if (is_notification(message)) return "";
  http::Request request;
  request.method = "POST";
  request.target = request.path = "/mcp";
  request.arrived = http::Request::Clock::now();
  request.disconnect_token = [] { return std::stop_token(); };
  RequestContext call{service, request, {}, {}};
  // Without a field for the version, a message names the stateless revision itself or is of an older one.
  Context context{call, protocol_mode_of(message).value_or(ProtocolMode::handshake), {}, folder};
  if (text_in(message, "method") == "server/discover") context.protocol_mode = ProtocolMode::stateless;
  const auto failure = context.protocol_mode == ProtocolMode::stateless ? check_meta(message) : std::nullopt;
  return response_text(context, message, failure ? RpcResult(*failure) : answer_message(context, message));
}

}  // namespace

int serve_stdio(const Config& config, const std::string& folder) {
  const Log log(config.log_level);
  Service service(config, log);
  for (std::string line; std::getline(std::cin, line);) {
    if (line.empty() || line == "\r") continue;
    const std::string answer =
        line.size() > config.body_limit
            ? failure_text(nullptr,
                           {Code::no_request, "The message has more bytes than the limit of a body."})
            : answer_line(service, line, folder);
    if (!answer.empty()) std::cout << answer << std::endl;
  }
  return 0;
}

}  // namespace seedmesh::mcp
