#pragma once
/// The strict reading of a request's head. Whatever two parties could read in two ways (RFC 9112 section 11:
/// request smuggling) is refused here, so that the HTTP library behind never sees a byte of a client.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "server/http/message.h"

namespace seedmesh::http {

struct HeadLimits {
  std::size_t target = 8'000;       ///< characters of the request target; beyond: 414
  std::size_t head = 32 * 1'024;    ///< bytes of request line and fields together; beyond: 431
  std::size_t fields = 100;         ///< beyond: 431
  std::uint64_t body = 16U << 20U;  ///< beyond: 413
};

/// Why a request cannot be served; the connection ends after the answer, since what follows is not known to
/// be a request.
struct Refusal {
  int status = 400;
  std::string detail;
  std::string_view reason = "malformed";  ///< one word for the metrics, of a bounded set
};

struct Head {
  Request request;           ///< without body, id, remote and time
  std::uint64_t length = 0;  ///< of the body that follows
  bool keep_alive = true;
  bool expects_continue = false;
};

/// Reads a whole head: request line and fields, the empty line at its end included. Refuses bare CR or LF,
/// folded lines, white space before a colon, control characters, anything but one Host, two lengths or a
/// length that is no number, Transfer-Encoding (411), a body in an encoding (415), escapes that are none, NUL
/// and dot segments in the path.
std::variant<Head, Refusal> read_head(std::string_view text, const HeadLimits& limits);

/// What can be said before the head is whole: 414 or 431 once it has grown past the limits. Status 0: read
/// on.
Refusal too_long(std::string_view unfinished, const HeadLimits& limits);

/// Resolves %xx; `plus_is_space` as in forms. False where an escape is malformed.
enum class Plus { literal, space };
bool percent_decode(std::string_view text, Plus plus, std::string& out);

}  // namespace seedmesh::http
