#pragma once
/// The requests that routes receive, and the responses that they return.
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

/// Header fields in the order in which they arrive or are sent. Names keep their spelling.
using Headers = std::vector<std::pair<std::string, std::string>>;

/// Returns all values of a field joined by ", " as RFC 9110 section 5.3 allows; "" where the field is absent.
std::string field_value(const Headers& headers, std::string_view name);
std::size_t field_count(const Headers& headers, std::string_view name);

struct Request {
  using Clock = std::chrono::steady_clock;

  std::string method;  ///< a token, as sent
  std::string target;  ///< undecoded, in origin form: "/path?query"; printable ASCII
  std::string path;    ///< undecoded part before '?': its escapes are valid, it has no NUL and no dot segment
  std::string query;   ///< undecoded part after '?'
  int minor = 1;       ///< 0 for HTTP/1.0, 1 for HTTP/1.1
  Headers headers;
  std::string body;
  std::string id;      ///< the client's X-Request-Id if it is well formed, else a new one
  std::string remote;  ///< IP address of the client
  Clock::time_point arrived{};

  /// Returns a token that is set when the client closes its side of the connection. The first call starts
  /// the watch and costs a system call, so only long work uses it.
  std::function<std::stop_token()> disconnect_token;

  std::string header(std::string_view name) const { return field_value(headers, name); }
  bool has_header(std::string_view name) const { return field_count(headers, name) > 0; }
};

/// Part of a payload as a response body. The bytes are shared and not copied.
struct Slice {
  std::shared_ptr<const Payload> payload;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
};

/// Writes a body of unknown length piece by piece. `write` returns false when the client has left; the
/// stream has to end then.
using Write = std::function<bool(std::string_view piece)>;
using Stream = std::function<void(const Write& write)>;

struct Response {
  int status = 200;
  std::string type;  ///< media type of the body; "" without a body
  Headers headers;
  std::variant<std::string, Slice, Stream> body;
  bool close = false;  ///< close the connection after this response

  // For the log and the metrics. They are not sent.
  std::string route;      ///< the pattern that matched, so that the number of values is bounded
  std::string log_text;   ///< the reason of an error, for the operator only
  std::string cache_use;  ///< "hit", "shared", "miss", or "" where no cache was used
  std::vector<std::pair<std::string, std::string>> log_fields;  ///< further fields of the log line

  void set(std::string name, std::string value) { headers.emplace_back(std::move(name), std::move(value)); }
};

using Handler = std::function<Response(const Request&)>;

}  // namespace seedmesh::http
