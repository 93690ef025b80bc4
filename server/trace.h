#pragma once
/// W3C Trace Context: connects log lines with the trace of the client.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

struct Trace {
  std::string trace_id;   ///< 32 hexadecimal digits
  std::string parent_id;  ///< the client's span, 16 digits
  std::string span_id;    ///< our own span, 16 digits
  std::string flags;      ///< two digits, as the client sent them
};

/// Parses a `traceparent` field and creates a span of our own. Returns nothing where the field is absent or
/// malformed, because by the standard such a field is ignored.
std::optional<Trace> read_traceparent(std::string_view field);

/// Returns the field with our span. The response carries it, so that the client can refer to the span.
std::string traceparent(const Trace& trace);

}  // namespace seedmesh
