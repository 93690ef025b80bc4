#include "server/negotiate.h"

#include <xxhash.h>

#include <algorithm>
#include <charconv>

#include "server/http/message.h"

namespace seedmesh {
namespace {

using http::same_name;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Cuts `rest` at the next `separator` and gives the trimmed part before it.
std::string_view take(std::string_view& rest, char separator) {
  const auto end = std::min(rest.find(separator), rest.size());
  const std::string_view part = trimmed(rest.substr(0, end));
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

/// An element of a list with weights: "gzip;q=0.5".
struct Weighted {
  std::string_view name;
  double weight = 1;
};

Weighted take_weighted(std::string_view& list) {
  std::string_view element = take(list, ',');
  Weighted weighted{take(element, ';')};
  while (!element.empty()) {
    std::string_view parameter = take(element, ';');
    if (!same_name(take(parameter, '='), "q")) continue;
    double value = 0;
    const auto [end, fault] = std::from_chars(parameter.data(), parameter.data() + parameter.size(), value);
    weighted.weight = fault == std::errc() && end == parameter.data() + parameter.size() ? value : 0;
  }
  return weighted;
}

}  // namespace

std::string_view name_of(Coding coding) {
  static constexpr std::string_view names[] = {"identity", "gzip", "br", "zstd"};
  return names[static_cast<std::size_t>(coding)];
}

std::optional<Coding> choose_coding(std::string_view accept_encoding, std::span<const Coding> offered) {
  std::optional<double> weights[4];
  std::optional<double> any;
  while (!accept_encoding.empty()) {
    const Weighted coding = take_weighted(accept_encoding);
    for (const Coding each : {Coding::identity, Coding::gzip, Coding::br, Coding::zstd}) {
      const bool named = same_name(coding.name, name_of(each));
      if (named || (each == Coding::gzip && same_name(coding.name, "x-gzip")))
        weights[static_cast<std::size_t>(each)] = coding.weight;
    }
    if (coding.name == "*") any = coding.weight;
  }
  // Acceptable unless it is ruled out, but liked less than anything that is named.
  const double plain = weights[0] ? *weights[0] : any && *any <= 0 ? 0 : 0.001;
  std::optional<Coding> best;
  double best_weight = 0;
  for (const Coding each : offered) {
    // Old clients that send "*" alone know gzip and not what came after it.
    const double weight =
        weights[static_cast<std::size_t>(each)].value_or(each == Coding::gzip ? any.value_or(0) : 0);
    if (weight > best_weight) best = each, best_weight = weight;
  }
  if (best && best_weight >= plain) return best;
  if (plain > 0) return Coding::identity;
  return std::nullopt;
}

bool wants_events(std::string_view accept) {
  while (!accept.empty()) {
    const Weighted type = take_weighted(accept);
    if (same_name(type.name, "text/event-stream") && type.weight > 0) return true;
  }
  return false;
}

/// Everything behind the type: where a charset is told, it is UTF-8.
static bool says_utf8(std::string_view parameters) {
  while (!parameters.empty()) {
    std::string_view parameter = take(parameters, ';');
    if (!same_name(take(parameter, '='), "charset")) continue;
    if (!same_name(parameter, "utf-8") && !same_name(parameter, "\"utf-8\"")) return false;
  }
  return true;
}

bool is_json_type(std::string_view content_type) {
  std::string_view rest = content_type;
  const std::string_view type = take(rest, ';');
  if (type.empty()) return content_type.empty();
  const std::string_view suffix = "+json";
  const bool json =
      same_name(type, "application/json") ||
      (type.size() > suffix.size() && same_name(type.substr(type.size() - suffix.size()), suffix));
  return json && says_utf8(rest);
}

bool is_text_or_json_type(std::string_view content_type) {
  if (is_json_type(content_type)) return true;
  std::string_view rest = content_type;
  const std::string_view type = take(rest, ';');
  return (same_name(type, "text/plain") || same_name(type, "application/octet-stream")) && says_utf8(rest);
}

std::string tag_of(std::string_view canonical, std::string_view engine) {
  const XXH64_hash_t engine_hash = XXH3_64bits(engine.data(), engine.size());
  const XXH128_hash_t hash = XXH3_128bits_withSeed(canonical.data(), canonical.size(), engine_hash);
  static constexpr char digits[] = "0123456789abcdef";
  std::string tag;
  for (const XXH64_hash_t half : {hash.high64, hash.low64}) {
    for (unsigned shift = 64; shift > 0; shift -= 4) tag.push_back(digits[(half >> (shift - 4)) & 15U]);
  }
  return tag;
}

std::string etag(std::string_view tag, Coding coding) {
  std::string quoted = "\"";
  quoted += tag;
  if (coding != Coding::identity) (quoted += '-') += name_of(coding);
  quoted += '"';
  return quoted;
}

bool matches(std::string_view if_none_match, std::string_view tag) {
  while (!if_none_match.empty()) {
    std::string_view each = take(if_none_match, ',');
    if (each == "*") return true;
    if (each.substr(0, 2) == "W/") each.remove_prefix(2);
    for (const Coding coding : {Coding::identity, Coding::gzip, Coding::br, Coding::zstd}) {
      if (each == etag(tag, coding)) return true;
    }
  }
  return false;
}

RangeKind read_range(std::string_view range, std::uint64_t size, ByteRange& out) {
  std::string_view rest = range;
  if (!same_name(take(rest, '='), "bytes") || rest.find(',') != std::string_view::npos)
    return RangeKind::none;
  const std::string_view first = take(rest, '-');
  const std::string_view last = trimmed(rest);
  const auto number = [](std::string_view text, std::uint64_t& value) {
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc() && end == text.data() + text.size();
  };
  if (range.find('-') == std::string_view::npos) return RangeKind::none;
  std::uint64_t from = 0, to = size == 0 ? 0 : size - 1;
  if (first.empty()) {  // the last so many bytes
    std::uint64_t count = 0;
    if (!number(last, count)) return RangeKind::none;
    if (count == 0 || size == 0) return RangeKind::unsatisfiable;
    out = {size - std::min(count, size), to};
    return RangeKind::one;
  }
  if (!number(first, from)) return RangeKind::none;
  if (!last.empty()) {
    std::uint64_t wanted = 0;
    if (!number(last, wanted) || wanted < from) return RangeKind::none;
    to = std::min(to, wanted);
  }
  if (from >= size) return RangeKind::unsatisfiable;
  out = {from, to};
  return RangeKind::one;
}

}  // namespace seedmesh
