// Colours of maps; see map_values.h.
#include <cstdint>

#include "core/base/math.h"
#include "core/import/foreign_text.h"
#include "core/import/map_values.h"
#include "core/schema/color.h"

namespace seedmesh {
namespace {

constexpr std::string_view digits = "0123456789abcdef";

bool is_hexadecimal(std::string_view text) {
  return text.find_first_not_of(digits) == std::string_view::npos;
}

std::string hexadecimal(std::uint32_t value) {
  std::string color = "#";
  for (int shift = 20; shift >= 0; shift -= 4) color += digits[value >> static_cast<unsigned>(shift) & 15U];
  return color;
}

/// "rgb(240,10,10)" in lower case without blanks.
std::optional<std::string> functional_color(std::string_view text) {
  if (!text.starts_with("rgb(") || !text.ends_with(')')) return std::nullopt;
  std::size_t at = 4;
  std::uint32_t value = 0;
  for (int channel = 0; channel < 3; ++channel) {
    double number = 0;
    if (channel > 0 && (at >= text.size() || text[at++] != ',')) return std::nullopt;
    if (!take_number(text, at, text.size() - 1, number) || number > 255) return std::nullopt;
    value = value << 8U | math::to_uint32(number);
  }
  return at + 1 == text.size() ? std::optional(hexadecimal(value)) : std::nullopt;
}

}  // namespace

std::optional<std::string> map_color(std::string_view text) {
  std::string name = lower(text);
  std::erase_if(name, [](char c) { return c == '_' || c == '-' || is_blank(c); });
  const bool has_sign = name.starts_with('#');
  const std::string_view code = std::string_view(name).substr(has_sign ? 1 : 0);
  if (is_hexadecimal(code)) {
    if (code.size() == 6) return "#" + std::string(code);
    if (has_sign && code.size() == 3)
      return std::string{'#', code[0], code[0], code[1], code[1], code[2], code[2]};
  }
  if (name.starts_with("rgb(")) return functional_color(name);
  const std::optional<Color> named = color_named(name);
  return named ? std::optional(text_of(*named)) : std::nullopt;
}

}  // namespace seedmesh
