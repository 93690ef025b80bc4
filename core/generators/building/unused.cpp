#include "core/generators/building/unused.h"

#include <algorithm>
#include <variant>

#include "core/base/json_pointer.h"
#include "core/generators/building/parts/parts.h"
#include "core/generators/unused.h"
#include "core/lang/lexer.h"
#include "generated/params/building.h"
#include "generated/params/building_unused.h"

namespace seedmesh::building {
namespace {

constexpr std::string_view default_material = "building";
constexpr std::string_view prefix_of_colors = "color_";

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

/// The texts from which rules can compose names, in lower case.
std::vector<std::string> texts_for_names(const BuildingParams& params, const Grammar& grammar) {
  std::vector<std::string> texts;
  const auto add = [&texts](std::string_view text) {
    if (!text.empty()) texts.push_back(lower(text));
  };
  for (std::uint32_t id = 1; id <= grammar.texts.size(); ++id) {
    if (const std::string* const text = grammar.texts.find(id)) add(*text);
  }
  const auto add_values = [&](const auto& attributes) {
    for (const auto& [name, value] : attributes) {
      if (const auto* const text = std::get_if<std::string>(&value)) add(*text);
    }
  };
  add_values(params.attributes);
  for (const BuildingEdit& edit : params.edits) add_values(edit.attributes);
  // A cell of a table can be the name of a material or of an asset.
  for (const auto& entry : params.tables) add(entry.second);
  std::ranges::sort(texts);
  texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
  return texts;
}

/// Whether one text is a part of the name or contains it. A pattern of fileSearch can match every name.
bool is_contained(const std::string& name, const std::vector<std::string>& texts) {
  return std::ranges::any_of(texts, [&name](const std::string& text) {
    return text.find('*') != std::string::npos || text.find(name) != std::string::npos ||
           name.find(text) != std::string::npos;
  });
}

/// Materials without a name in the rules: those of symbols, of parts and of colours.
bool is_implied_material(const std::string& name, const Grammar& grammar) {
  if (name == default_material || name.starts_with(prefix_of_colors)) return true;
  const auto has_name = [&name](const Symbol& symbol) {
    return symbol.name == name || lower(symbol.name) == name;
  };
  const auto has_role = [&name](const PartMaterial& part) {
    return name == part.role || name.starts_with(std::string(part.role) + "_") ||
           part.role.starts_with(name + "_");
  };
  return std::ranges::any_of(grammar.symbols, has_name) || std::ranges::any_of(part_materials(), has_role);
}

void add_unused_names(const BuildingParams& params, const Grammar& grammar, std::vector<Warning>& warnings) {
  if (params.materials.empty() && params.assets.empty() && params.tables.empty()) return;
  const std::vector<std::string> texts = texts_for_names(params, grammar);
  const auto warn = [&](const char* list, const std::string& name) {
    warnings.push_back({"/" + std::string(list) + pointer_token(name),
                        "has no effect: the rules do not contain the name " + lang::in_quotes(name)});
  };
  for (const auto& entry : params.materials) {
    if (!is_contained(lower(entry.first), texts) && !is_implied_material(entry.first, grammar))
      warn("materials", entry.first);
  }
  for (const auto& entry : params.assets) {
    if (!is_contained(lower(entry.first), texts)) warn("assets", entry.first);
  }
  for (const auto& entry : params.tables) {
    if (!is_contained(lower(entry.first), texts)) warn("tables", entry.first);
  }
}

/// Whether a split has a group { ... }* or a step is Repeat(...).
bool has_repeat(const Grammar& grammar) {
  const auto is_group = [](const Part& part) { return part.is_group; };
  const auto repeats = [](const Step& step) { return step.op == Op::repeat || step.is_repeated; };
  return std::ranges::any_of(grammar.parts, is_group) || std::ranges::any_of(grammar.steps, repeats);
}

bool has_weight(const Grammar& grammar) {
  return std::ranges::any_of(grammar.choices, [](const Choice& choice) { return choice.weight.is_given; });
}

}  // namespace

std::vector<Warning> unused_settings(const BuildingParams& params, const Grammar* grammar) {
  std::vector<Warning> warnings = warnings_of(unused_parameters(params));
  if (grammar == nullptr) return warnings;
  if (params.repeat && !has_repeat(*grammar))
    warnings.push_back({"/repeat", "has no effect: the rules have no repeat"});
  if (params.weights == BuildingWeights::strict && !has_weight(*grammar))
    warnings.push_back({"/weights", "has no effect: the rules have no probability"});
  add_unused_names(params, *grammar, warnings);
  return warnings;
}

}  // namespace seedmesh::building
