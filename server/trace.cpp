#include "server/trace.h"

#include <algorithm>

#include "server/http/text.h"

namespace seedmesh {
namespace {

constexpr std::size_t field_size = 55;  // "00-" 32 "-" 16 "-" 2

bool is_id(std::string_view text) {
  const auto digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return std::all_of(text.begin(), text.end(), digit);
}

bool is_zero(std::string_view text) { return text.find_first_not_of('0') == std::string_view::npos; }

}  // namespace

std::optional<Trace> read_traceparent(std::string_view field) {
  // Later versions may be longer, but begin like this one.
  if (field.size() < field_size || (field.size() > field_size && field[field_size] != '-'))
    return std::nullopt;
  const std::string_view version = field.substr(0, 2);
  const std::string_view trace = field.substr(3, 32), parent = field.substr(36, 16),
                         flags = field.substr(53, 2);
  if (field[2] != '-' || field[35] != '-' || field[52] != '-') return std::nullopt;
  if (!is_id(version) || version == "ff" || (version == "00" && field.size() != field_size))
    return std::nullopt;
  if (!is_id(trace) || is_zero(trace) || !is_id(parent) || is_zero(parent) || !is_id(flags))
    return std::nullopt;
  return Trace{std::string(trace), std::string(parent), http::random_id(), std::string(flags)};
}

std::string traceparent(const Trace& trace) {
  return "00-" + trace.trace_id + "-" + trace.span_id + "-" + trace.flags;
}

}  // namespace seedmesh
