/// Colours in the notations of the CGA utility library: hue in degrees, saturation, value, red, green, blue and opacity
/// from 0 to 1, and hexadecimal texts. Smith, "Color gamut transform pairs", 1978.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/value_functions.h"
#include "core/schema/color.h"

namespace seedmesh::building {
namespace {

using lang::TaggedValue;
using Rgb = std::array<double, 3>;

Rgb rgb_of_hsv(double hue, double saturation, double value) {
  hue = hue - 360 * std::floor(hue / 360);
  const double chroma = value * saturation;
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hue / 60, 6);
    return value - chroma * std::max(0.0, std::min({k, 4 - k, 1.0}));
  };
  return {channel(5), channel(3), channel(1)};
}

std::array<double, 3> hsv_of_rgb(const Rgb& c) {
  const double high = std::max({c[0], c[1], c[2]}), chroma = high - std::min({c[0], c[1], c[2]});
  double hue = 0;
  if (chroma > 0) {
    if (high == c[0]) {
      hue = 60 * (c[1] - c[2]) / chroma;
    } else if (high == c[1]) {
      hue = 60 * (2 + (c[2] - c[0]) / chroma);
    } else {
      hue = 60 * (4 + (c[0] - c[1]) / chroma);
    }
    if (hue < 0) hue += 360;
  }
  return {hue, high > 0 ? chroma / high : 0, high};
}

std::string hex_of(std::span<const double> channels) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out = "#";
  for (const double each : channels) {
    const int byte = math::to_int32(std::clamp(each, 0.0, 1.0) * 255 + 0.5);
    out += digits[byte >> 4];
    out += digits[byte & 15];
  }
  return out;
}

Rgb rgb_of_hex(const Evaluation& at, const TaggedValue& value) {
  std::string text = text_in(at, value);
  if (text.size() == 9) text.resize(7);
  const auto color = color_of(text);
  if (!color) reject(at, "found " + lang::in_quotes(text) + ", expected a colour as \"#rrggbb\"");
  return {color->red / 255.0, color->green / 255.0, color->blue / 255.0};
}

double opacity_of_hex(const Evaluation& at, const TaggedValue& value) {
  const std::string text = text_in(at, value);
  if (text.size() != 9) return 1;
  const auto both = color_of("#0000" + text.substr(7));
  return both ? both->blue / 255.0 : 1;
}

std::array<double, 3> numbers(const Evaluation& at, ValueArguments a) {
  return {number_in(at, a[0]), number_in(at, a[1]), number_in(at, a[2])};
}

template <int channel>
TaggedValue hsv_to_channel(Evaluation& at, ValueArguments a) {
  const auto n = numbers(at, a);
  return number_value(rgb_of_hsv(n[0], n[1], n[2])[channel]);
}
template <int channel>
TaggedValue rgb_to_hsv(Evaluation& at, ValueArguments a) {
  return number_value(hsv_of_rgb(numbers(at, a))[channel]);
}
template <int channel>
TaggedValue hex_to_rgb(Evaluation& at, ValueArguments a) {
  return number_value(rgb_of_hex(at, a[0])[channel]);
}
template <int channel>
TaggedValue hex_to_hsv(Evaluation& at, ValueArguments a) {
  return number_value(hsv_of_rgb(rgb_of_hex(at, a[0]))[channel]);
}
TaggedValue hex_to_opacity(Evaluation& at, ValueArguments a) {
  return number_value(opacity_of_hex(at, a[0]));
}
TaggedValue hsv_to_hex(Evaluation& at, ValueArguments a) {
  const auto n = numbers(at, a);
  return text_value(at, hex_of(rgb_of_hsv(n[0], n[1], n[2])));
}
TaggedValue rgb_to_hex(Evaluation& at, ValueArguments a) { return text_value(at, hex_of(numbers(at, a))); }
TaggedValue rgbo_to_hex(Evaluation& at, ValueArguments a) {
  const auto n = numbers(at, a);
  return text_value(at, hex_of(std::array{n[0], n[1], n[2], number_in(at, a[3])}));
}
TaggedValue hsvo_to_hex(Evaluation& at, ValueArguments a) {
  const auto n = numbers(at, a);
  const Rgb c = rgb_of_hsv(n[0], n[1], n[2]);
  return text_value(at, hex_of(std::array{c[0], c[1], c[2], number_in(at, a[3])}));
}

struct Named {
  std::string_view name;
  Rgb color;
};
constexpr Named named[] = {
    {"white", {1, 1, 1}},      {"black", {0, 0, 0}},  {"red", {1, 0, 0}},      {"green", {0, 1, 0}},
    {"blue", {0, 0, 1}},       {"yellow", {1, 1, 0}}, {"orange", {1, 0.5, 0}}, {"brown", {0.55, 0.27, 0.07}},
    {"purple", {0.5, 0, 0.5}}, {"cyan", {0, 1, 1}},   {"magenta", {1, 0, 1}},  {"gray", {0.5, 0.5, 0.5}},
};

const Rgb* color_named(std::string name) {
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  const auto* const found = std::ranges::find(named, std::string_view(name), &Named::name);
  return found == std::end(named) ? nullptr : &found->color;
}

/// colorRamp("greenToRed", 0.3), or with the values at both ends.
TaggedValue ramp(Evaluation& at, ValueArguments a) {
  const std::string name = text_in(at, a[0]);
  double share = number_in(at, a[1]);
  if (a.size() == 4) {
    const double low = number_in(at, a[2]), high = number_in(at, a[3]);
    share = high == low ? 0 : (share - low) / (high - low);
  }
  share = std::clamp(share, 0.0, 1.0);
  if (name == "spectrum") return text_value(at, hex_of(rgb_of_hsv(300 * share, 1, 1)));
  const std::size_t to = name.find("To");
  const Rgb *first = nullptr, *last = nullptr;
  if (to != std::string::npos) {
    first = color_named(name.substr(0, to));
    last = color_named(name.substr(to + 2));
  }
  if (first == nullptr || last == nullptr) {
    reject(at, "found the colour ramp " + lang::in_quotes(name) +
                   ", expected spectrum or two colours as in greenToRed: white, black, red, green, blue, "
                   "yellow, orange, "
                   "brown, purple, cyan, magenta or gray");
  }
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = (*first)[i] + ((*last)[i] - (*first)[i]) * share;
  return text_value(at, hex_of(out));
}

constexpr ValueFunctionRow rows[] = {
    {"colorHSVToR", 3, 3, hsv_to_channel<0>, "h, s, v",
     "The red channel of a colour by hue in degrees, saturation and value.",
     "A --> color(colorHSVToR(0, 1, 1), 0, 0) B."},
    {"colorHSVToG", 3, 3, hsv_to_channel<1>, "h, s, v", "The green channel.",
     "A --> color(0, colorHSVToG(120, 1, 1), 0) B."},
    {"colorHSVToB", 3, 3, hsv_to_channel<2>, "h, s, v", "The blue channel.",
     "A --> color(0, 0, colorHSVToB(240, 1, 1)) B."},
    {"colorHSVToHex", 3, 3, hsv_to_hex, "h, s, v", "The colour as \"#rrggbb\".",
     "A --> color(colorHSVToHex(30, 0.5, 0.8)) B."},
    {"colorHSVOToHex", 4, 4, hsvo_to_hex, "h, s, v, opacity", "The colour as \"#rrggbbaa\".",
     "A --> color(colorHSVOToHex(30, 0.5, 0.8, 1)) B."},
    {"colorRGBToHex", 3, 3, rgb_to_hex, "r, g, b", "The colour as \"#rrggbb\".",
     "A --> color(colorRGBToHex(1, 0.5, 0)) B."},
    {"colorRGBOToHex", 4, 4, rgbo_to_hex, "r, g, b, opacity", "The colour as \"#rrggbbaa\".",
     "A --> color(colorRGBOToHex(1, 0.5, 0, 1)) B."},
    {"colorRGBToH", 3, 3, rgb_to_hsv<0>, "r, g, b", "The hue in degrees.",
     "A --> s(colorRGBToH(0, 1, 0), '1, '1) B."},
    {"colorRGBToS", 3, 3, rgb_to_hsv<1>, "r, g, b", "The saturation.",
     "A --> s(colorRGBToS(0, 1, 0), '1, '1) B."},
    {"colorRGBToV", 3, 3, rgb_to_hsv<2>, "r, g, b", "The value.", "A --> s(colorRGBToV(0, 1, 0), '1, '1) B."},
    {"colorHexToR", 1, 1, hex_to_rgb<0>, "color", "The red channel.",
     "A --> s(colorHexToR(\"#ff0000\"), '1, '1) B."},
    {"colorHexToG", 1, 1, hex_to_rgb<1>, "color", "The green channel.",
     "A --> s(colorHexToG(\"#00ff00\"), '1, '1) B."},
    {"colorHexToB", 1, 1, hex_to_rgb<2>, "color", "The blue channel.",
     "A --> s(colorHexToB(\"#0000ff\"), '1, '1) B."},
    {"colorHexToH", 1, 1, hex_to_hsv<0>, "color", "The hue.",
     "A --> s(1 + colorHexToH(\"#ff0000\"), '1, '1) B."},
    {"colorHexToS", 1, 1, hex_to_hsv<1>, "color", "The saturation.",
     "A --> s(colorHexToS(\"#ff0000\"), '1, '1) B."},
    {"colorHexToV", 1, 1, hex_to_hsv<2>, "color", "The value.",
     "A --> s(colorHexToV(\"#ff0000\"), '1, '1) B."},
    {"colorHexToO", 1, 1, hex_to_opacity, "color", "The opacity.",
     "A --> s(colorHexToO(\"#ff0000ff\"), '1, '1) B."},
    {"colorRamp", 2, 4, ramp, "name, value, low, high",
     "A colour between two others, such as greenToRed, at a value from 0 to 1 or between two ends.",
     "A --> color(colorRamp(\"greenToRed\", 3, 0, 10)) B."},
};

}  // namespace

std::span<const ValueFunctionRow> color_functions() { return rows; }

}  // namespace seedmesh::building
