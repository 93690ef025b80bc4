#include "core/import/houdini_settings.h"

#include <algorithm>

#include "core/import/foreign_text.h"
#include "core/import/formats.h"

namespace seedmesh {
namespace {

constexpr HoudiniSetting settings[] = {
    {"generations", 7},
    {"angle", 28},
    {"stepsize", 0.1},
    {"stepsizescale", 0.9},
    {"thickness", 0.05},
    {"thicknessscale", 0.8},
    {"anglescale", 0.9},
    {"randomseed", 1},
    {"gravity", 0},
    {"b", 0},
    {"c", 0},
    {"d", 0},
};

}  // namespace

std::span<const HoudiniSetting> houdini_settings() { return settings; }

std::string houdini_name(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (!is_blank(c) && c != '-' && c != '_') out += lower(c);
  }
  if (out == "iterations" || out == "generation") return "generations";
  if (out == "step" || out == "steplength") return "stepsize";
  if (out == "seed") return "randomseed";
  return out;
}

/// The names `axiom`, `angle` and those of one letter occur in other formats, too.
int marks_of_houdini(std::string_view text) {
  int marks = 0;
  bool has_rule = false;
  for (const Line& each : lines_of(text)) {
    const Line line = trimmed(text, each);
    const std::string_view words = text.substr(line.from, std::min<std::size_t>(line.to - line.from, 200));
    const std::size_t sign = words.find_first_of(":=");
    const bool has_sign = sign != std::string_view::npos;
    const std::string key = houdini_name(words.substr(0, sign));
    const bool is_setting =
        std::ranges::any_of(settings, [&](const HoudiniSetting& setting) { return setting.name == key; });
    if (key.starts_with("premise")) {
      marks += 4;
    } else if (has_sign && (key == "axiom" || key == "angle")) {
      marks += 2;
    } else if (has_sign && key.size() > 1 &&
               (is_setting || key.starts_with("rule") || key == "contextignore")) {
      marks += 4;
    }
    has_rule = has_rule || (words.size() > 2 && words[1] == '=' && is_letter(words[0]));
  }
  return marks + (has_rule ? 2 : 0);
}

}  // namespace seedmesh
