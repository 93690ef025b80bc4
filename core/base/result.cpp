#include "core/base/result.h"

#include <iterator>

namespace seedmesh {
namespace {

constexpr std::string_view kind_words[] = {
    "syntax",         "duplicate_key", "unknown_key", "unknown_name",  "missing",    "wrong_type",
    "out_of_range",   "invalid_value", "conflict",    "not_available", "evaluation", "limit",
    "truncated_list", "deadline",      "cancelled",   "internal",
};
static_assert(std::size(kind_words) == static_cast<std::size_t>(IssueKind::internal) + 1);

constexpr std::string_view resource_words[] = {
    "modules",  "shapes", "triangles", "output_bytes", "memory_bytes", "file_bytes",  "vertices", "points",
    "segments", "joints", "leaves",    "iterations",   "depth",        "json_values", "steps",
};
static_assert(std::size(resource_words) == static_cast<std::size_t>(Resource::steps) + 1);

}  // namespace

std::string_view word_of(IssueKind kind) { return kind_words[static_cast<std::size_t>(kind)]; }

std::string_view word_of(Resource resource) { return resource_words[static_cast<std::size_t>(resource)]; }

bool operator==(const Limit& a, const Limit& b) {
  return a.resource == b.resource && a.bound == b.bound && a.needed == b.needed;
}

IssueCause::IssueCause(IssueKind what, std::initializer_list<std::string_view> names)
    : kind(what), members(names.begin(), names.end()) {}

IssueCause conflict_with(std::initializer_list<std::string_view> members) {
  return {IssueKind::conflict, members};
}

IssueCause missing_for(std::initializer_list<std::string_view> members) {
  return {IssueKind::missing, members};
}

TextPosition text_position(std::string_view text, std::size_t offset) {
  TextPosition position;
  for (std::size_t i = 0; i < offset && i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte == '\n') {
      ++position.line;
      position.column = 1;
    } else if ((byte & 0xC0U) != 0x80U) {  // continuation bytes belong to the code point before them
      ++position.column;
    }
  }
  return position;
}

Issue limit_issue(const Limit& limit, std::string message, std::string pointer) {
  Issue issue(IssueKind::limit, std::move(pointer), std::move(message));
  issue.limit = limit;
  return issue;
}

Issue truncated_list(std::uint64_t unlisted) {
  Issue issue(IssueKind::truncated_list, "",
              "and " + std::to_string(unlisted) + (unlisted == 1 ? " more error" : " more errors"));
  issue.unlisted = unlisted;
  return issue;
}

Issue issue_at(IssueKind kind, std::string pointer, std::string_view text, std::size_t offset,
               std::string message) {
  const TextPosition position = text_position(text, offset);
  return {kind, std::move(pointer), std::move(message), position.line, position.column};
}

}  // namespace seedmesh
