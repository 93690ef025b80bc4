#pragma once
/// base64url without padding (RFC 4648 section 5), for what stands in URLs.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

std::string base64url(std::string_view bytes);

/// Strict: no padding, no other characters, and no bits that are left over, so that bytes have one spelling.
std::optional<std::string> from_base64url(std::string_view text);

}  // namespace seedmesh
