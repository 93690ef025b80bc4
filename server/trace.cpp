#include "server/trace.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <random>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr std::size_t field_size = 55;  // "00-" 32 "-" 16 "-" 2

bool is_id(std::string_view text) {
  const auto digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return std::all_of(text.begin(), text.end(), digit);
}

bool is_nought(std::string_view text) { return text.find_first_not_of('0') == std::string_view::npos; }

std::string draw_span() {
  static std::atomic<std::uint64_t> next = [] {
    std::random_device entropy;
    return (std::uint64_t{entropy()} << 32U) | entropy();
  }();
  static constexpr char digits[] = "0123456789abcdef";
  const std::uint64_t drawn = mix(next.fetch_add(1, std::memory_order_relaxed));
  std::uint64_t bits = drawn == 0 ? 1 : drawn;  // nought is no span
  std::string id(16, '0');
  for (char& c : id) {
    c = digits[bits & 15U];
    bits >>= 4U;
  }
  return id;
}

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
  if (!is_id(trace) || is_nought(trace) || !is_id(parent) || is_nought(parent) || !is_id(flags))
    return std::nullopt;
  return Trace{std::string(trace), std::string(parent), draw_span(), std::string(flags)};
}

std::string traceparent(const Trace& trace) {
  return "00-" + trace.trace_id + "-" + trace.span_id + "-" + trace.flags;
}

}  // namespace seedmesh
