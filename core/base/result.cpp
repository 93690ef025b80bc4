#include "core/base/result.h"

namespace seedmesh {

TextPlace place_of(std::string_view text, std::size_t offset) {
  TextPlace place;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte == '\n') {
      ++place.line;
      place.column = 1;
    } else if ((byte & 0xC0U) != 0x80U) {  // continuation bytes belong to the code point before them
      ++place.column;
    }
  }
  return place;
}

Issue issue_at(std::string pointer, std::string_view text, std::size_t offset, std::string message) {
  const TextPlace place = place_of(text, offset);
  return {std::move(pointer), std::move(message), place.line, place.column};
}

}  // namespace seedmesh
