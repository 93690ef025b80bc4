#pragma once
/// W3C Trace Context: what ties the lines of our log to the trace of whoever asked.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

struct Trace {
  std::string trace_id;   ///< 32 hexadecimal digits
  std::string parent_id;  ///< the caller's span, 16 digits
  std::string span_id;    ///< ours
  std::string flags;      ///< two digits, as the caller sent them
};

/// Reads a `traceparent` field and draws a span of our own. Nothing where the field is absent or malformed:
/// such a one is to be overlooked.
std::optional<Trace> read_traceparent(std::string_view field);

/// The field as our span would send it on; the answer carries it, so that the caller can name our span.
std::string traceparent(const Trace& trace);

}  // namespace seedmesh
