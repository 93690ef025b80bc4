
#include "core/schema/json.h"

namespace seedmesh {
namespace {

/// The bytes of a code point that begins with `lead`: their number (0: no code point begins so) and the range of
/// the second byte. The range excludes overlong forms, surrogates and code points above U+10FFFF (The Unicode
/// Standard, table 3-7).
struct Shape {
  std::size_t length = 0;
  unsigned low = 0x80, high = 0xBF;
};

Shape shape_of(unsigned lead) {
  if (lead < 0x80) return {.length = 1};
  if (lead < 0xC2) return {};
  if (lead < 0xE0) return {.length = 2};
  if (lead == 0xE0) return {.length = 3, .low = 0xA0};
  if (lead == 0xED) return {.length = 3, .high = 0x9F};
  if (lead < 0xF0) return {.length = 3};
  if (lead == 0xF0) return {.length = 4, .low = 0x90};
  if (lead < 0xF4) return {.length = 4};
  if (lead == 0xF4) return {.length = 4, .high = 0x8F};
  return {};
}

unsigned byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

}  // namespace

std::size_t find_bad_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const Shape shape = shape_of(byte_at(text, i));
    if (shape.length == 0 || i + shape.length > text.size()) return i;
    if (shape.length > 1 && (byte_at(text, i + 1) < shape.low || byte_at(text, i + 1) > shape.high)) return i;
    for (std::size_t k = 2; k < shape.length; ++k) {
      if ((byte_at(text, i + k) & 0xC0U) != 0x80U) return i;
    }
    i += shape.length;
  }
  return std::string_view::npos;
}

std::string shortened(std::string_view text, std::size_t most) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if ((byte_at(text, i) & 0xC0U) == 0x80U) continue;
    if (++characters > most) return std::string(text.substr(0, i)) + "…";
  }
  return std::string(text);
}

}  // namespace seedmesh
