#pragma once
/// Strict parser for the head of an HTTP/1.1 request (RFC 9112). It refuses every form that two programs
/// between client and service could read differently (RFC 9112 section 11.2: request smuggling).
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "server/http/message.h"

namespace seedmesh::http {

struct HeadLimits {
  std::size_t target = 8'000;       ///< characters of the request target; beyond: 414
  std::size_t head = 32 * 1'024;    ///< bytes of request line and fields together; beyond: 431
  std::size_t fields = 100;         ///< header fields; beyond: 431
  std::uint64_t body = 16U << 20U;  ///< bytes of the body; beyond: 413
};

/// Why a request cannot be served. The connection ends after the response, because the bytes that follow may
/// not be a request.
struct Refusal {
  int status = 400;
  std::string detail;
  std::string_view reason = "malformed";  ///< label for the metrics, from a bounded set
};

struct RequestHead {
  Request request;           ///< without body, id, remote and arrived
  std::uint64_t length = 0;  ///< bytes of the body that follows
  bool keep_alive = true;
  bool expects_continue = false;
};

/// Parses a whole head: request line, fields and the empty line at the end.
/// Errors:
/// - 400: a bare CR or LF, a folded line, white space before a colon, or a control character;
/// - 400: a missing, repeated or malformed Host; a repeated Content-Length, or one that is not a number;
/// - 400: an invalid escape, a NUL or a dot segment in the path;
/// - 411: Transfer-Encoding, or a missing length;
/// - 413, 414 and 431: a limit is exceeded;
/// - 415: an encoded body; 417: an unknown expectation; 505: another version.
std::variant<RequestHead, Refusal> parse_head(std::string_view text, const HeadLimits& limits);

/// Returns what a refused head states well enough to respond to it: the method, the target if the first line is valid,
/// and the valid fields, in order. `text` may be a part of the head. Nothing else of the request is set, and no field
/// is trusted for more than the form of the response: its origin, its identifier and its trace.
Request legible_part(std::string_view text, const HeadLimits& limits);

/// Returns 414 or 431 as soon as a head that is not complete yet exceeds its limits, else nothing.
std::optional<Refusal> check_partial_head(std::string_view text, const HeadLimits& limits);

}  // namespace seedmesh::http
