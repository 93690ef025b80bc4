#pragma once
/// base64url without padding (RFC 4648 section 5), for URLs, and base64.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

std::string base64url(std::string_view bytes);

/// The same in base64 with padding (section 4), for texts that are no URLs.
std::string base64(std::string_view bytes);

/// Strict: no padding, no other characters and no unused bits that are set, so that each value has one spelling.
std::optional<std::string> from_base64url(std::string_view text);

}  // namespace seedmesh
