#pragma once
/// Requests and responses as the routes see them: nothing here knows the HTTP library.
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/gltf/payload.h"

namespace seedmesh::http {

/// Header fields in order of arrival or of sending; names keep their spelling and compare without case.
using Headers = std::vector<std::pair<std::string, std::string>>;

bool same_name(std::string_view a, std::string_view b);

/// All values of a field joined by ", " as RFC 9110 section 5.3 allows; "" where the field is absent.
std::string joined(const Headers& headers, std::string_view name);
bool has(const Headers& headers, std::string_view name);

struct Request {
  using Clock = std::chrono::steady_clock;

  std::string method;  ///< a token, as sent
  std::string target;  ///< raw, origin form: "/path?query"; printable ASCII
  std::string path;    ///< raw part before '?', checked: valid escapes, no NUL, no dot segments
  std::string query;   ///< raw part after '?'
  int minor = 1;       ///< HTTP/1.0 or HTTP/1.1
  Headers headers;
  std::string body;
  std::string id;      ///< the client's X-Request-Id where it is sane, else one of ours
  std::string remote;  ///< address of the peer
  Clock::time_point arrived{};

  /// A token that is set when the client closes its side. Watching begins with the call and costs a system
  /// call, so only work that takes long asks for it.
  std::function<std::stop_token()> gone;

  std::string header(std::string_view name) const { return joined(headers, name); }
  bool has_header(std::string_view name) const { return has(headers, name); }
};

/// Part of a body: shared bytes, and which of them.
struct Slice {
  std::shared_ptr<const Payload> payload;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
};

/// Writes a body of unknown length piece by piece. `write` is false when the client has gone; end then.
using Write = std::function<bool(std::string_view piece)>;
using Stream = std::function<void(const Write& write)>;

struct Response {
  int status = 200;
  std::string type;  ///< media type of the body, "" = no body
  Headers headers;
  std::variant<std::string, Slice, Stream> body;
  bool close = false;  ///< end the connection after this answer

  // For the log and the metrics, not sent.
  std::string route;      ///< the pattern that matched; bounded in number
  std::string log_text;   ///< what went wrong, in words for the operator only
  std::string cache_use;  ///< "hit", "shared", "miss", "" where no cache was asked
  std::vector<std::pair<std::string, std::string>> log_fields;  ///< whatever else the line shall have

  void set(std::string name, std::string value) { headers.emplace_back(std::move(name), std::move(value)); }
};

using Handler = std::function<Response(const Request&)>;

}  // namespace seedmesh::http
