#include "core/generators/lsystem/statements.h"

#include <algorithm>

namespace seedmesh::lsystem {
namespace {

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

std::size_t end_of_name(std::string_view text, std::size_t at, std::size_t to) {
  if (at < to && text[at] >= '0' && text[at] <= '9') return at;
  to = std::min(to, at + longest_name + 1);
  while (at < to && is_name(text[at])) ++at;
  return at;
}

std::size_t end_of_whole_name(std::string_view text, std::size_t at, std::size_t to) {
  std::size_t end = end_of_name(text, at, to);
  while (end > at && end < to && is_name(text[end])) ++end;
  return end;
}

std::size_t open_after(std::string_view text, std::string_view word, std::size_t at, std::size_t to) {
  if (text.substr(at, std::min(word.size(), to - at)) != word) return to;
  const std::size_t open = skip_spaces(text, at + word.size(), to);
  return open < to && text[open] == '(' ? open : to;
}

std::size_t Statements::loop_at(std::size_t at, std::size_t to) const {
  const std::size_t open = open_after(text_, "for", at, to);
  return open < to && marks_.has_semicolon({open, marks_.closing(open, to)}) ? open : to;
}

std::size_t Statements::condition_at(std::size_t at, std::size_t to) const {
  const std::size_t open = open_after(text_, "if", at, to);
  if (open == to) return to;
  const std::size_t close = marks_.closing(open, to);
  const std::size_t next = skip_spaces(text_, std::min(close + 1, to), to);
  const bool braces = next < to && text_[next] == '{';
  return braces || marks_.has_condition_operator({open, close}) ? open : to;
}

bool Statements::is_let(std::size_t at, std::size_t to) const {
  if (text_.substr(at, std::min<std::size_t>(3, to - at)) != "let" || at + 3 >= to) return false;
  const std::size_t name = skip_spaces(text_, at + 3, to);
  const std::size_t end = end_of_whole_name(text_, name, to);
  const std::size_t equals = skip_spaces(text_, end, to);
  return name > at + 3 && end > name && equals < to && text_[equals] == '=';
}

bool Statements::changes(std::size_t at, std::size_t to) const {
  const std::string_view two = text_.substr(at, std::min<std::size_t>(2, to - at));
  for (const std::string_view each : {"+=", "-=", "*=", "/=", "++", "--"}) {
    if (two == each) return true;
  }
  return !two.empty() && two[0] == '=' && two != "==";
}

std::size_t Statements::find_semicolon(std::size_t at, std::size_t to) const {
  int depth = 0;
  for (; at < to; ++at) {
    if (text_[at] == '(') ++depth;
    if (text_[at] == ')') --depth;
    if (depth == 0 && text_[at] == ';') return at;
  }
  return to;
}

bool has_statements(Source& source, Slice slice) {
  const std::string_view text = source.text;
  for (std::size_t at = slice.from; at < slice.to; ++at) {
    const char c = text[at];
    if (c != 'f' && c != 'w' && c != 'i' && c != 'l') continue;
    if (at > slice.from && text[at - 1] == '@') continue;
    const std::size_t open = open_after(text, "for", at, slice.to);
    if (open < slice.to) {
      const Marks& marks = source.marks_of_text();
      if (marks.has_semicolon({open, marks.closing(open, slice.to)})) return true;
    }
    if (open_after(text, "while", at, slice.to) < slice.to) return true;
    if (text.substr(at, std::min<std::size_t>(4, slice.to - at)) == "let ") return true;
    if (open_after(text, "if", at, slice.to) < slice.to) return true;
  }
  return false;
}

}  // namespace seedmesh::lsystem
