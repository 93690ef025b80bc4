#pragma once
/// Reads base64 (RFC 4648 section 4). Writers are in base64url.h.
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace seedmesh {

/// Returns the text without the one or two signs `=` at its end.
std::string_view without_padding(std::string_view text);

/// Returns the number of bytes of this number of digits. A last group of one digit is no byte.
constexpr std::size_t base64_bytes(std::size_t digits) {
  return digits / 4 * 3 + (digits % 4 > 1 ? digits % 4 - 1 : 0);
}

/// How a text ended.
struct Base64End {
  std::size_t bad = std::string_view::npos;  ///< index of the first character that is no digit
  std::uint32_t unused = 0;                  ///< bits of the last digit behind the last byte; should be 0
};

/// Decodes digits without padding. `bytes` has capacity for base64_bytes(digits.size()). Stops at the first character
/// that is no digit. Cost: about 1 ns a digit.
Base64End read_base64(std::string_view digits, std::uint8_t* bytes);

}  // namespace seedmesh
