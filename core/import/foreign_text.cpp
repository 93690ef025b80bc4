#include "core/import/foreign_text.h"

#include <algorithm>
#include <charconv>

namespace seedmesh {

void ForeignText::trace(std::size_t& offset, std::string* message) const {
  const auto behind = std::ranges::upper_bound(parts_, offset, {}, &TextPart::from);
  if (behind == parts_.begin()) return;
  const TextPart& part = *(behind - 1);
  if (part.file.empty()) {
    offset = part.origin + (offset - part.from);
  } else {
    if (message != nullptr) *message = "`" + shortened(part.file, 60) + "`: " + *message;
    offset = part.origin;
  }
}

void ForeignText::report(std::size_t offset, std::string message, IssueKind kind) {
  if (issues_.size() < most) {
    trace(offset, &message);
    issues_.push_back(issue_at(kind, "", foreign_, offset, std::move(message)));
  } else {
    ++unlisted_;
  }
}

void ForeignText::warn(std::size_t offset, std::string message, std::string pointer) {
  if (warnings_.size() >= most) return;
  trace(offset, &message);
  const TextPosition position = text_position(foreign_, offset);
  warnings_.push_back({std::move(pointer), std::move(message), position.line, position.column});
}

Imported ForeignText::finish(Imported imported) {
  const auto earlier = [](const auto& a, const auto& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
  };
  std::stable_sort(issues_.begin(), issues_.end(), earlier);
  std::stable_sort(warnings_.begin(), warnings_.end(), earlier);
  for (Origin& origin : imported.origins) {
    for (TextRun& run : origin.runs) trace(run.from, nullptr);
  }
  imported.errors = std::move(issues_);
  imported.warnings = std::move(warnings_);
  return imported;
}

std::optional<Error> entry_error(const ImportOptions& options, const std::string& what) {
  if (options.entry.empty()) return std::nullopt;
  return Error{Code::invalid, {{IssueKind::not_available, "/entry", what + "; expected no entry"}}};
}

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const bool carriage = end > from && text[end - 1] == '\r';
    lines.push_back({from, carriage ? end - 1 : end});
    from = end + 1;
  }
  return lines;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\x1A'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = lower(c);
  return out;
}

Line trimmed(std::string_view text, Line line) {
  while (line.from < line.to && is_blank(text[line.from])) ++line.from;
  while (line.from < line.to && is_blank(text[line.to - 1])) --line.to;
  return line;
}

bool take_number(std::string_view text, std::size_t& at, std::size_t to, double& number) {
  std::size_t end = at;
  bool digits = false, point = false;
  for (; end < to; ++end) {
    if (is_digit(text[end])) {
      digits = true;
    } else if (text[end] == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (!digits || end - at > 300) return false;
  std::from_chars(text.data() + at, text.data() + end, number);
  at = end;
  return true;
}

}  // namespace seedmesh
