#pragma once
/// Raw deflate (RFC 1951) without header and checksum, for texts in URLs.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

/// Compresses a text at level 9.
std::string deflate_raw(std::string_view text);

/// Decompresses `data`. Returns nothing where it is not exactly one whole stream, or yields more than `limit`
/// bytes.
std::optional<std::string> inflate_raw(std::string_view data, std::size_t limit);

}  // namespace seedmesh
