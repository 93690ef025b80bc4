#include "core/pipeline/catalog.h"

#include <algorithm>

#include "core/generators/registry.h"
#include "core/schema/embedded.h"

namespace seedmesh {
namespace {

/// What a preset file has beside the request.
constexpr std::string_view gallery_members[] = {"title", "description", "tags"};

PresetInfo info_of(const EmbeddedText& row) {
  const Json file = Json::parse(row.text);
  return {.name = std::string(row.name),
          .generator = file.at("generator"),
          .title = file.at("title"),
          .description = file.at("description"),
          .tags = file.at("tags")};
}

Preset preset_of(const EmbeddedText& row) {
  auto file = nlohmann::ordered_json::parse(row.text);
  for (const std::string_view member : gallery_members) file.erase(std::string(member));
  return {.request = Json::parse(file.dump()), .request_text = file.dump(2) + "\n"};
}

}  // namespace

const std::map<std::string, Preset, std::less<>>& preset_requests() {
  static const auto all = [] {
    std::map<std::string, Preset, std::less<>> presets;
    for (const EmbeddedText& row : embedded_presets()) presets.emplace(row.name, preset_of(row));
    return presets;
  }();
  return all;
}

std::vector<std::string_view> preset_names() {
  std::vector<std::string_view> names;
  for (const EmbeddedText& row : embedded_presets()) names.push_back(row.name);
  return names;
}

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

}  // namespace seedmesh
