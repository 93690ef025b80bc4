#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/lang/expression.h"
#include "core/pipeline.h"
#include "core/registry/registry.h"
#include "core/schema/embedded.h"
#include "core/schema/nearest.h"
#include "core/schema/presets.h"

namespace seedmesh {
namespace {

PresetInfo info_of(const EmbeddedText& row) {
  const Json file = Json::parse(row.text);
  return {.name = std::string(row.name),
          .generator = file.at("generator"),
          .title = file.at("title"),
          .description = file.at("description"),
          .tags = file.at("tags")};
}

}  // namespace

const std::vector<PresetInfo>& presets() {
  static const auto all = [] {
    std::vector<PresetInfo> infos;
    for (const EmbeddedText& row : embedded_presets()) infos.push_back(info_of(row));
    return infos;
  }();
  return all;
}

std::optional<std::string> preset_json(std::string_view name) {
  const auto preset = preset_requests().find(name);
  if (preset == preset_requests().end()) return std::nullopt;
  return preset->second.request_text;
}

std::string no_preset(std::string_view name) {
  std::string words = schema::unknown_word("preset", name, preset_names());
  words.front() = 'T';
  return words;
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> names) {
  return schema::nearest_word(name, names);
}

std::string no_schema(std::string_view name) {
  std::string words = schema::unknown_word_of_few("schema", name, schema_names());
  words.front() = 'T';
  return words;
}

std::optional<std::string_view> schema_json(std::string_view name) {
  const auto rows = embedded_schemas();
  const auto row = std::ranges::find(rows, name, &EmbeddedText::name);
  if (row == rows.end()) return std::nullopt;
  return row->text;
}

std::vector<std::string_view> schema_names() {
  std::vector<std::string_view> names;
  for (const EmbeddedText& row : embedded_schemas()) names.push_back(row.name);
  return names;
}

std::string_view openapi_json() { return embedded_openapi(); }

std::vector<std::string_view> generator_names() {
  std::vector<std::string_view> names;
  for (const Generator& generator : generators()) names.push_back(generator.name);
  return names;
}

std::string vocabulary_json() {
  Json vocabulary = Json::object();
  for (const Generator& generator : generators()) vocabulary.update(generator.vocabulary());
  Json functions = Json::array();
  for (const lang::Function& function : lang::functions()) {
    functions.push_back({{"name", function.name},
                         {"arity", function.arity},
                         {"text", function.text},
                         {"example", function.example}});
  }
  vocabulary["functions"] = std::move(functions);
  return canonical_text(vocabulary);
}

}  // namespace seedmesh
