#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

/// A colour in sRGB with 8 bits a channel, as a request writes it.
struct Color {
  std::uint8_t red = 0, green = 0, blue = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

/// Parses "#rrggbb" with hexadecimal digits of either case. Returns nullopt for anything else.
std::optional<Color> color_of(std::string_view text);

/// Returns the colour of a CSS name in lower case, such as "darkorange", or nullopt for anything else.
std::optional<Color> color_named(std::string_view name);

/// Returns the colour as "#rrggbb" in lower case.
std::string text_of(const Color& color);

}  // namespace seedmesh
