#include "core/base/base64.h"

#include <array>

namespace seedmesh {
namespace {

constexpr std::uint8_t no_digit = 255;

constexpr auto digit_values = [] {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::uint8_t, 256> values{};
  for (std::uint8_t& value : values) value = no_digit;
  for (std::size_t i = 0; i < digits.size(); ++i)
    values[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
  return values;
}();

}  // namespace

std::string_view without_padding(std::string_view text) {
  for (int signs = 0; signs < 2 && text.ends_with('='); ++signs) text.remove_suffix(1);
  return text;
}

Base64End read_base64(std::string_view digits, std::uint8_t* bytes) {
  std::uint32_t bits = 0;
  unsigned count = 0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const std::uint8_t value = digit_values[static_cast<unsigned char>(digits[i])];
    if (value == no_digit) return {i, 0};
    bits = (bits << 6U | value) & 0xFFFFU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    *bytes++ = static_cast<std::uint8_t>(bits >> count & 0xFFU);
  }
  return {std::string_view::npos, bits & ((1U << count) - 1U)};
}

}  // namespace seedmesh
