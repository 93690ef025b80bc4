// Values of tags; see map_values.h.
#include "core/import/map_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/import/foreign_text.h"

namespace seedmesh {
namespace {

constexpr double metres_a_foot = 0.3048;

void skip_blanks(std::string_view text, std::size_t& at) {
  while (at < text.size() && is_blank(text[at])) ++at;
}

/// Reads the decimals after a comma: one or two digits, because three can be thousands.
void take_decimals(std::string_view text, std::size_t& at, double& number) {
  std::size_t end = at + 1;
  while (end < text.size() && is_digit(text[end])) ++end;
  const std::size_t digits = end - at - 1;
  if (at >= text.size() || text[at] != ',' || digits < 1 || digits > 2 ||
      text.substr(0, at).find('.') != std::string_view::npos)
    return;
  double decimals = 0;
  std::size_t from = at + 1;
  take_number(text, from, end, decimals);
  number += decimals / (digits == 1 ? 10 : 100);
  at = end;
}

/// The number at the beginning, which may follow "~", and the rest.
std::optional<std::pair<double, std::string_view>> number_and_rest(std::string_view text) {
  const Line line = trimmed(text, {0, text.size()});
  text = text.substr(line.from, line.to - line.from);
  if (text.starts_with('~')) text.remove_prefix(1);
  double sign = 1;
  if (text.starts_with('+') || text.starts_with('-')) {
    sign = text[0] == '-' ? -1 : 1;
    text.remove_prefix(1);
  }
  std::size_t at = 0;
  double number = 0;
  if (!take_number(text, at, text.size(), number)) return std::nullopt;
  take_decimals(text, at, number);
  skip_blanks(text, at);
  return std::pair{sign * number, text.substr(at)};
}

using Pair = std::pair<std::string_view, std::string_view>;

// Colours of materials, after photographs of common ones.
constexpr std::array<Pair, 34> materials{{{"brick", "#a4604a"},
                                          {"concrete", "#a9a7a1"},
                                          {"cement_block", "#a3a19b"},
                                          {"plaster", "#ddd5c4"},
                                          {"stone", "#a59d8c"},
                                          {"sandstone", "#cbb28a"},
                                          {"limestone", "#d3cab2"},
                                          {"granite", "#8f8c8a"},
                                          {"marble", "#dcd8d0"},
                                          {"slate", "#565c63"},
                                          {"wood", "#96714c"},
                                          {"timber_framing", "#c9b48f"},
                                          {"glass", "#7d9db0"},
                                          {"mirror", "#9fb3bf"},
                                          {"metal", "#9a9fa3"},
                                          {"steel", "#9a9fa3"},
                                          {"metal_plates", "#9a9fa3"},
                                          {"tin", "#a5a8aa"},
                                          {"zinc", "#9aa3a8"},
                                          {"aluminium", "#b9bcbe"},
                                          {"copper", "#6aa38c"},
                                          {"roof_tiles", "#a1553c"},
                                          {"tile", "#a1553c"},
                                          {"clay", "#a1553c"},
                                          {"thatch", "#9c8556"},
                                          {"tar_paper", "#4b4b4d"},
                                          {"bitumen", "#4b4b4d"},
                                          {"asphalt", "#55565a"},
                                          {"asphalt_shingle", "#55565a"},
                                          {"gravel", "#a19a8e"},
                                          {"grass", "#6f8b4a"},
                                          {"eternit", "#8d8f8e"},
                                          {"plastic", "#d0d0cc"},
                                          {"solar_panels", "#27344d"}}};

constexpr std::array<std::string_view, 16> compass{"n", "nne", "ne", "ene", "e", "ese", "se", "sse",
                                                   "s", "ssw", "sw", "wsw", "w", "wnw", "nw", "nnw"};

}  // namespace

std::optional<double> map_length(std::string_view text) {
  const auto read = number_and_rest(text);
  if (!read) return std::nullopt;
  const auto [number, rest] = *read;
  const std::string unit = lower(rest);
  if (unit.empty() || unit == "m" || unit == "m." || unit == "metre" || unit == "metres" || unit == "meter" ||
      unit == "meters" || unit == "mt")
    return number;
  if (unit == "cm") return number / 100;
  if (unit == "km") return number * 1000;
  if (unit == "ft" || unit == "feet" || unit == "foot" || unit == "'") return number * metres_a_foot;
  if (unit == "in" || unit == "\"") return number * metres_a_foot / 12;
  if (unit.starts_with('\'')) {
    const auto inches = number_and_rest(std::string_view(unit).substr(1));
    if (inches && (inches->second.empty() || inches->second == "\"" || inches->second == "''"))
      return (number + inches->first / 12) * metres_a_foot;
  }
  return std::nullopt;
}

std::optional<double> map_number(std::string_view text) {
  const auto read = number_and_rest(text);
  if (!read || !(read->second.empty() || read->second.starts_with(';'))) return std::nullopt;
  return read->first;
}

std::optional<double> map_degrees(std::string_view text) {
  const auto read = number_and_rest(text);
  if (!read || !(read->second.empty() || read->second == "\xC2\xB0" || read->second == "deg"))
    return std::nullopt;
  return read->first;
}

std::optional<double> map_direction(std::string_view text) {
  if (const auto degrees = map_degrees(text)) return std::fmod(*degrees, 360);
  const Line line = trimmed(text, {0, text.size()});
  std::string name = lower(text.substr(line.from, line.to - line.from));
  constexpr std::array<Pair, 4> words{{{"north", "n"}, {"east", "e"}, {"south", "s"}, {"west", "w"}}};
  for (const auto& [word, letter] : words) {
    for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word))
      name.replace(at, word.size(), letter);
  }
  std::erase_if(name, [](char c) { return c == '-' || c == '_' || c == ' '; });
  for (std::size_t i = 0; i < compass.size(); ++i) {
    if (compass[i] == name) return 22.5 * static_cast<double>(i);
  }
  return std::nullopt;
}

std::string_view map_material_color(std::string_view material) {
  for (const auto& [name, color] : materials) {
    if (name == material) return color;
  }
  return {};
}

std::string_view map_surface(std::string_view material) {
  constexpr std::array<std::string_view, 2> glasses{"glass", "mirror"};
  constexpr std::array<std::string_view, 7> metals{"metal",     "steel", "metal_plates", "tin",
                                                   "aluminium", "zinc",  "copper"};
  if (std::find(glasses.begin(), glasses.end(), material) != glasses.end()) return "glass";
  return std::find(metals.begin(), metals.end(), material) != metals.end() ? "metal" : "plain";
}

}  // namespace seedmesh
