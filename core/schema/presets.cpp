#include "core/schema/presets.h"

#include "core/schema/embedded.h"

namespace seedmesh {
namespace {

/// The members of a preset file that are not part of the request.
constexpr std::string_view gallery_members[] = {"title", "description", "tags"};

Preset preset_of(const EmbeddedText& row) {
  auto file = nlohmann::ordered_json::parse(row.text);
  for (const std::string_view member : gallery_members) file.erase(std::string(member));
  file["output"]["name"] = row.name;
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

Json with_preset(const Json& json) {
  if (!json.is_object() || !json.contains("preset") || !json["preset"].is_string()) return json;
  const auto preset = preset_requests().find(json["preset"].get_ref<const std::string&>());
  if (preset == preset_requests().end()) return json;
  Json patch = json;
  patch.erase("preset");
  Json merged = preset->second.request;
  merge_patch(merged, patch);
  return merged;
}

}  // namespace seedmesh
