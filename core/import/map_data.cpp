#include "core/import/map_data.h"

#include "core/base/result.h"

namespace seedmesh {
namespace {

// More different warnings than a list of them shows.
constexpr std::size_t most_entries = 100;

}  // namespace

std::string_view MapTags::get(std::string_view name) const {
  for (const auto& [key, value] : tags_) {
    if (key == name) return value;
  }
  return {};
}

std::string_view MapTags::get(std::initializer_list<std::string_view> names) const {
  for (const std::string_view name : names) {
    if (const std::string_view value = get(name); !value.empty()) return value;
  }
  return {};
}

bool MapTags::has(std::string_view name) const {
  const std::string_view value = get(name);
  return !value.empty() && value != "no";
}

void MapWarnings::add(std::string message, const MapPosition& position) {
  const auto known = known_.find(message);
  if (known != known_.end()) {
    ++entries_[known->second].count;
    return;
  }
  if (entries_.size() >= most_entries) return;
  known_.emplace(message, entries_.size());
  entries_.push_back({std::move(message), position, 1});
}

std::vector<Warning> MapWarnings::list(std::string_view text) const {
  std::vector<Warning> warnings;
  for (const Entry& entry : entries_) {
    Warning warning;
    warning.pointer = entry.position.pointer;
    warning.message = entry.message;
    if (entry.count > 1) warning.message += " (" + std::to_string(entry.count) + " times)";
    if (!text.empty()) {
      const TextPosition position = text_position(text, entry.position.offset);
      warning.line = position.line;
      warning.column = position.column;
    }
    warnings.push_back(std::move(warning));
  }
  return warnings;
}

}  // namespace seedmesh
