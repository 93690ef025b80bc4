#include "core/texture/link.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <vector>

#include "core/texture/paint.h"

namespace seedmesh::texture {
namespace {

constexpr std::array<std::string_view, 3> channel_names = {"color", "normal", "surface"};
constexpr int least_size = 16, greatest_size = 4096;

std::vector<std::string_view> split_at_dots(std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t dot = text.find('.');
    parts.push_back(text.substr(0, dot));
    if (dot == std::string_view::npos) return parts;
    text.remove_prefix(dot + 1);
  }
}

/// A number as std::to_chars writes it, in decimal.
std::optional<std::uint64_t> read_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (std::to_string(value) != text) return std::nullopt;
  return value;
}

std::string hex_of(const std::array<std::uint8_t, 3>& color) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t channel : color) {
    text += digits[channel >> 4U];
    text += digits[channel & 15U];
  }
  return text;
}

std::optional<std::array<std::uint8_t, 3>> read_hex(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  const std::array<std::uint8_t, 3> color = {static_cast<std::uint8_t>(value >> 16U),
                                             static_cast<std::uint8_t>(value >> 8U),
                                             static_cast<std::uint8_t>(value)};
  if (hex_of(color) != text) return std::nullopt;
  return color;
}

}  // namespace

std::string name_of(const Link& link) {
  std::string name =
      link.recipe.kind + "." + std::to_string(link.recipe.seed) + "." + std::to_string(link.size);
  if (link.recipe.color) name += "." + hex_of(*link.recipe.color);
  return name.append(".").append(channel_names[static_cast<std::size_t>(link.channel)]);
}

std::optional<Link> read_link(std::string_view name) {
  const std::vector<std::string_view> parts = split_at_dots(name);
  if (parts.size() != 4 && parts.size() != 5) return std::nullopt;
  const auto kinds = texture_kinds();
  const auto channel = std::find(channel_names.begin(), channel_names.end(), parts.back());
  const auto seed = read_number(parts[1]), size = read_number(parts[2]);
  if (std::find(kinds.begin(), kinds.end(), parts[0]) == kinds.end() || channel == channel_names.end() ||
      !seed || !size || *size < least_size || *size > greatest_size || !std::has_single_bit(*size)) {
    return std::nullopt;
  }
  Link link;
  link.recipe.kind = parts[0];
  link.recipe.seed = *seed;
  link.size = static_cast<int>(*size);
  link.channel = static_cast<Channel>(channel - channel_names.begin());
  if (parts.size() == 4) return link;
  link.recipe.color = read_hex(parts[3]);
  if (!link.recipe.color) return std::nullopt;
  return link;
}

std::shared_ptr<const Image> image_of(const Link& link, TextureStore* store, const Job& job) {
  const std::shared_ptr<const Maps> maps = maps_of(link.recipe, link.size, {}, store, job);
  const std::array<std::shared_ptr<const Image>, 3> images = {maps->color, maps->normal, maps->surface};
  return images[static_cast<std::size_t>(link.channel)];
}

}  // namespace seedmesh::texture
