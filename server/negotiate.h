#pragma once
/// Content negotiation (RFC 9110): content coding, media types, validators and ranges.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace seedmesh {

enum class Coding { identity, gzip, br, zstd };

/// "identity", "gzip", "br" or "zstd".
std::string_view name_of(Coding coding);

/// Codings in order of preference. quick_codings is for responses that are encoded for each request, and
/// small_codings for texts that are encoded once. With Effort::fast, gzip is both faster and smaller than
/// Brotli.
inline constexpr Coding quick_codings[] = {Coding::zstd, Coding::gzip, Coding::br};
inline constexpr Coding small_codings[] = {Coding::br, Coding::zstd, Coding::gzip};

/// Selects the coding of a response by Accept-Encoding (RFC 9110 section 12.5.3): the offered coding with the
/// largest weight, the first among equals; `*` means gzip alone. Returns nothing where the client accepts
/// neither an offered coding nor identity. An absent field means identity.
std::optional<Coding> choose_coding(std::string_view accept_encoding,
                                    std::span<const Coding> offered = quick_codings);

/// Whether Accept names text/event-stream. Wildcards do not count, because most clients send them.
bool wants_events(std::string_view accept);

/// Whether a body is application/json or another type with the suffix +json, in UTF-8. An absent field counts
/// as JSON.
bool is_json_type(std::string_view content_type);

/// Whether a body is of a type that is_json_type() accepts, or plain text in UTF-8, or application/octet-stream.
bool is_text_or_json_type(std::string_view content_type);

/// 32 hexadecimal digits that identify the result of a canonical request with an engine version.
std::string tag_of(std::string_view canonical, std::string_view engine);

/// Returns the validator of a response in a coding: `"<tag>"` or `W/"<tag>-gzip"`, `-br`, `-zstd`. Encoded bytes
/// depend on the version of a library and on the processor, so their validator is weak.
std::string etag(std::string_view tag, Coding coding);

/// Whether If-None-Match contains the tag in any coding, or `*`.
bool matches(std::string_view if_none_match, std::string_view tag);

/// One range of bytes, `first` to `last`, both inside a body of `size` bytes.
struct ByteRange {
  std::uint64_t first = 0, last = 0;
};
enum class RangeKind { none, one, unsatisfiable };

/// Parses a Range field. Several ranges or another unit count as none: the whole body is sent, as RFC 9110
/// section 14.2 allows.
RangeKind read_range(std::string_view range, std::uint64_t size, ByteRange& out);

}  // namespace seedmesh
