#pragma once
/// Two encodings of bytes (RFC 4648): base64url without padding, for URLs, and base64 with padding.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

/// Encodes bytes as base64url without padding.
std::string base64url(std::string_view bytes);

/// Encodes bytes as standard base64 with padding (RFC 4648 section 4). For use outside URLs.
std::string base64(std::string_view bytes);

/// Decodes base64url. Returns nullopt for padding, other characters, or unused bits that are set. Each value therefore
/// has exactly one encoding.
std::optional<std::string> from_base64url(std::string_view text);

}  // namespace seedmesh
