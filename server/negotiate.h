#pragma once
/// What a client's header fields ask for: content coding, event stream, media type of its body, validators.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace seedmesh {

enum class Coding { identity, gzip, br, zstd };

/// "gzip", "br", "zstd"; "identity".
std::string_view name_of(Coding coding);

/// Codings in order of preference, for answers made at the moment and for texts that are made once.
inline constexpr Coding quick_codings[] = {Coding::zstd, Coding::br, Coding::gzip};
inline constexpr Coding small_codings[] = {Coding::br, Coding::zstd, Coding::gzip};

/// The coding for an answer by Accept-Encoding (RFC 9110 section 12.5.3): of those offered the one that the
/// client likes best, the first among equals; `*` stands for gzip alone. Nothing where the client forbids all
/// of them and identity too. An absent field means identity.
std::optional<Coding> choose_coding(std::string_view accept_encoding,
                                    std::span<const Coding> offered = quick_codings);

/// Whether Accept names text/event-stream itself; wildcards do not count, since every client sends them.
bool wants_events(std::string_view accept);

/// application/json or anything +json, in UTF-8. An absent field counts as JSON.
bool is_json_type(std::string_view content_type);

/// The same or plain text, in UTF-8; bytes of no said kind too, since the query tells what a file is.
bool is_text_or_json_type(std::string_view content_type);

/// 32 hexadecimal digits for the answer to a canonical request by an engine.
std::string tag_of(std::string_view canonical, std::string_view engine);

/// The strong validator of the answer in a coding: `"<tag>"` or `"<tag>-gzip"`, `-br`, `-zstd`.
std::string etag(std::string_view tag, Coding coding);

/// Whether If-None-Match names the tag in any coding, or is `*`.
bool matches(std::string_view if_none_match, std::string_view tag);

/// One range of bytes, `first` to `last`, both inside a body of `size` bytes.
struct ByteRange {
  std::uint64_t first = 0, last = 0;
};
enum class RangeKind { none, one, unsatisfiable };

/// Reads a Range field. Several ranges or another unit count as none: the whole is sent, as RFC 9110
/// section 14.2 allows.
RangeKind read_range(std::string_view range, std::uint64_t size, ByteRange& out);

}  // namespace seedmesh
