#include "server/negotiate.h"

#include <xxhash.h>

#include <algorithm>

#include "server/http/text.h"

namespace seedmesh {
namespace {

/// An element of a list with weights: "gzip;q=0.5".
struct Weighted {
  std::string_view name;
  double weight = 1;
};

Weighted take_weighted(std::string_view& list) {
  std::string_view element = http::take_part(list, ',');
  Weighted weighted{http::take_part(element, ';')};
  while (!element.empty()) {
    std::string_view parameter = http::take_part(element, ';');
    if (!http::equals_ignoring_case(http::take_part(parameter, '='), "q")) continue;
    weighted.weight = http::parse_number<double>(parameter).value_or(0);
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
      const bool named = http::equals_ignoring_case(coding.name, name_of(each));
      if (named || (each == Coding::gzip && http::equals_ignoring_case(coding.name, "x-gzip")))
        weights[static_cast<std::size_t>(each)] = coding.weight;
    }
    if (coding.name == "*") any = coding.weight;
  }
  // Identity is acceptable unless it is excluded, but ranks below every coding that is named.
  const double plain = weights[0] ? *weights[0] : any && *any <= 0 ? 0 : 0.001;
  std::optional<Coding> best;
  double best_weight = 0;
  for (const Coding each : offered) {
    // Old clients that send "*" alone support gzip and no later coding.
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
    if (http::equals_ignoring_case(type.name, "text/event-stream") && type.weight > 0) return true;
  }
  return false;
}

/// Whether the parameters of a media type name no charset other than UTF-8.
static bool is_utf8(std::string_view parameters) {
  while (!parameters.empty()) {
    std::string_view parameter = http::take_part(parameters, ';');
    if (!http::equals_ignoring_case(http::take_part(parameter, '='), "charset")) continue;
    if (!http::equals_ignoring_case(parameter, "utf-8") &&
        !http::equals_ignoring_case(parameter, "\"utf-8\""))
      return false;
  }
  return true;
}

bool is_json_type(std::string_view content_type) {
  std::string_view rest = content_type;
  const std::string_view type = http::take_part(rest, ';');
  if (type.empty()) return content_type.empty();
  const std::string_view suffix = "+json";
  const bool json = http::equals_ignoring_case(type, "application/json") ||
                    (type.size() > suffix.size() &&
                     http::equals_ignoring_case(type.substr(type.size() - suffix.size()), suffix));
  return json && is_utf8(rest);
}

bool is_text_or_json_type(std::string_view content_type) {
  if (is_json_type(content_type)) return true;
  std::string_view rest = content_type;
  const std::string_view type = http::take_part(rest, ';');
  return (http::equals_ignoring_case(type, "text/plain") || http::equals_ignoring_case(type, "text/xml") ||
          http::equals_ignoring_case(type, "application/xml") ||
          http::equals_ignoring_case(type, "application/vnd.osm+xml") ||
          http::equals_ignoring_case(type, "application/octet-stream")) &&
         is_utf8(rest);
}

std::string tag_of(std::string_view canonical, std::string_view engine) {
  const XXH64_hash_t engine_hash = XXH3_64bits(engine.data(), engine.size());
  const XXH128_hash_t hash = XXH3_128bits_withSeed(canonical.data(), canonical.size(), engine_hash);
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  return http::hex({reinterpret_cast<const char*>(bytes.digest), sizeof(bytes.digest)});
}

std::string etag(std::string_view tag, Coding coding) {
  if (coding == Coding::identity) return "\"" + std::string(tag) + "\"";
  return "W/\"" + std::string(tag) + "-" + std::string(name_of(coding)) + "\"";
}

bool matches(std::string_view if_none_match, std::string_view tag) {
  while (!if_none_match.empty()) {
    std::string_view each = http::take_part(if_none_match, ',');
    if (each == "*") return true;
    if (each.starts_with("W/")) each.remove_prefix(2);
    if (each.size() < tag.size() + 2 || each.front() != '"' || each.back() != '"') continue;
    each = each.substr(1, each.size() - 2);
    if (!each.starts_with(tag)) continue;
    each.remove_prefix(tag.size());
    if (each.empty() || each == "-gzip" || each == "-br" || each == "-zstd") return true;
  }
  return false;
}

RangeKind read_range(std::string_view range, std::uint64_t size, ByteRange& out) {
  std::string_view rest = range;
  if (!http::equals_ignoring_case(http::take_part(rest, '='), "bytes") ||
      rest.find(',') != std::string_view::npos || rest.find('-') == std::string_view::npos)
    return RangeKind::none;
  const std::string_view first = http::take_part(rest, '-'), last = http::trimmed(rest);
  const auto from = http::parse_number<std::uint64_t>(first), to = http::parse_number<std::uint64_t>(last);
  if (first.empty()) {  // "-500": the last 500 bytes
    if (!to) return RangeKind::none;
    if (*to == 0 || size == 0) return RangeKind::unsatisfiable;
    out = {size - std::min(*to, size), size - 1};
    return RangeKind::one;
  }
  if (!from || (!last.empty() && (!to || *to < *from))) return RangeKind::none;
  if (*from >= size) return RangeKind::unsatisfiable;
  out = {*from, std::min(to.value_or(size), size - 1)};
  return RangeKind::one;
}

}  // namespace seedmesh
