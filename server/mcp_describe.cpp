/// Answers that fit the context of a language model: parts of schemas, and a search of presets.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "server/mcp.h"

namespace seedmesh::mcp {
namespace {

constexpr std::size_t longest_answer = 8'000;
constexpr std::size_t longest_enum = 24;

std::string first_sentence(const std::string& text) {
  const auto end = text.find(". ");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

/// The members of a schema that say what values it takes, without those of its parts.
Json outline_of(const Json& schema, std::size_t longest_text) {
  Json outline = Json::object();
  for (const char* name :
       {"type", "default", "minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "pattern"}) {
    if (schema.contains(name) && dumped(schema[name]).size() <= 200) outline[name] = schema[name];
  }
  if (schema.contains("enum") && schema["enum"].size() <= longest_enum) outline["enum"] = schema["enum"];
  if (schema.contains("x-unit")) outline["unit"] = schema["x-unit"];
  const std::string text = first_sentence(text_in(schema, "description"));
  if (!text.empty() && longest_text > 0) outline["text"] = text.substr(0, longest_text);
  for (const char* parts : {"properties", "items", "oneOf", "anyOf", "additionalProperties"}) {
    if (schema.contains(parts) && schema[parts].is_structured()) outline["has_parts"] = true;
  }
  return outline;
}

using Members = std::vector<std::pair<std::string, Json>>;

/// The named parts of a schema, through its items and alternatives.
Members members_of(const Json& schema) {
  Members members;
  std::set<std::string> seen;
  const auto add = [&](const auto& self, const Json& each) -> void {
    if (!each.is_object()) return;
    if (each.contains("properties")) {
      for (const auto& [name, part] : each["properties"].items()) {
        if (seen.insert(name).second) members.emplace_back(name, part);
      }
    }
    for (const char* several : {"oneOf", "anyOf"}) {
      if (!each.contains(several)) continue;
      for (const Json& one : each[several]) self(self, one);
    }
    for (const char* inner : {"items", "additionalProperties"}) {
      if (each.contains(inner)) self(self, each[inner]);
    }
  };
  add(add, schema);
  return members;
}

/// The whole schema where it is short, else its members with less and less text.
std::string fitting(const Json& schema) {
  std::string whole = dumped(schema);
  if (whole.size() <= longest_answer) return whole;
  for (const std::size_t longest_text : {160, 60, 0}) {
    Json answer = {{"outline", true}, {"title", text_in(schema, "title")}, {"members", Json::object()}};
    for (const auto& [name, part] : members_of(schema))
      answer["members"][name] = outline_of(part, longest_text);
    whole = dumped(answer);
    if (whole.size() <= longest_answer) return whole;
  }
  Json names = Json::array();
  for (const auto& [name, part] : members_of(schema)) names.push_back(name);
  return dumped({{"outline", true}, {"members", names}});
}

std::string name_list(const Members& members) {
  std::string list;
  for (const auto& [name, part] : members) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none" : list;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : lower(text) + " ") {
    const bool is_word =
        (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 128;
    if (is_word) {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::exchange(word, {}));
    }
  }
  return words;
}

/// Names count most, then tags and titles, then descriptions. 0: a word is nowhere.
int score_of(const PresetInfo& preset, const std::vector<std::string>& words) {
  const std::string name = lower(preset.name), title = lower(preset.title), text = lower(preset.description);
  int score = 1;
  for (const std::string& word : words) {
    int found = 0;
    if (text.find(word) != std::string::npos || preset.generator == word) found = 1;
    if (title.find(word) != std::string::npos) found = 3;
    if (std::ranges::find(preset.tags, word) != preset.tags.end()) found = 4;
    if (name.find(word) != std::string::npos) found = name == word ? 9 : 5;
    if (found == 0) return 0;
    score += found;
  }
  return score;
}

}  // namespace

std::optional<Failure> unknown_generator_of(const std::string& generator) {
  const auto names = generator_names();
  if (std::ranges::find(names, generator) != names.end()) return std::nullopt;
  std::string known;
  for (const std::string_view name : names) known += (known.empty() ? "" : ", ") + std::string(name);
  return Failure{Code::wrong_parameters,
                 "/generator: found \"" + generator.substr(0, 40) + "\", expected one of " + known};
}

std::variant<std::string, Failure> describe_schema(const std::string& generator, const std::string& topic) {
  if (auto unknown = unknown_generator_of(generator)) return *std::move(unknown);
  const auto text = schema_json(topic == "output" || topic.starts_with("output/") ? "output" : generator);
  Json schema = Json::parse(text.value());
  std::string_view rest = topic;
  if (rest.starts_with("output")) rest.remove_prefix(std::min<std::size_t>(rest.size(), 7));
  while (!rest.empty()) {
    const auto slash = std::min(rest.find('/'), rest.size());
    const std::string_view name = rest.substr(0, slash);
    rest.remove_prefix(std::min(slash + 1, rest.size()));
    Members members = members_of(schema);
    const auto found = std::ranges::find_if(members, [&](const auto& each) { return each.first == name; });
    if (found == members.end()) {
      return Failure{Code::wrong_parameters, "/topic: found \"" + std::string(name.substr(0, 40)) +
                                                 "\", expected one of " + name_list(members)};
    }
    schema = Json(found->second);
  }
  return fitting(schema);
}

Json find_presets(const Access& access, const PresetQuery& preset_query) {
  const std::vector<std::string> words = words_of(preset_query.query);
  std::vector<std::pair<int, const PresetInfo*>> found;
  for (const PresetInfo& preset : presets()) {
    const bool is_wanted =
        access.allows_generator(preset.generator) &&
        (preset_query.generator.empty() || preset.generator == preset_query.generator) &&
        (preset_query.tag.empty() || std::ranges::find(preset.tags, preset_query.tag) != preset.tags.end());
    if (const int score = is_wanted ? score_of(preset, words) : 0; score > 0)
      found.emplace_back(score, &preset);
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.first > b.first; });
  Json list = Json::array();
  for (const auto& [score, preset] : found) {
    if (list.size() == preset_query.limit) break;
    list.push_back({{"name", preset->name},
                    {"generator", preset->generator},
                    {"title", preset->title},
                    {"description", preset->description},
                    {"tags", preset->tags}});
  }
  return {{"presets", std::move(list)}, {"matches", found.size()}};
}

}  // namespace seedmesh::mcp
