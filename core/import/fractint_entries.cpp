#include "core/import/fractint_entries.h"

#include <algorithm>

#include "core/import/formats.h"

namespace seedmesh {

std::vector<FractintEntry> fractint_entries(ForeignText& source) {
  const std::string_view text = source.text();
  std::vector<FractintEntry> entries;
  bool inside = false;
  for (Line line : lines_of(text)) {
    line.to = std::min(text.substr(0, line.to).find(';', line.from), line.to);
    line = trimmed(text, line);
    while (line.from < line.to) {
      const std::string_view rest = text.substr(line.from, line.to - line.from);
      const char mark = inside ? '}' : '{';
      const std::size_t end = std::min(rest.find(mark), rest.size());
      const Line part = trimmed(text, {line.from, line.from + end});
      if (inside && part.from < part.to) entries.back().lines.push_back(part);
      if (end == rest.size()) {
        if (!inside) source.report(line.from, "found text outside an entry; expected a name and `{`");
        break;
      }
      if (!inside)
        entries.push_back({std::string(text.substr(part.from, part.to - part.from)), line.from, {}});
      inside = !inside;
      line = trimmed(text, {line.from + end + 1, line.to});
    }
  }
  if (inside) source.report(entries.back().name_at, "found an entry without its `}`");
  return entries;
}

/// Comments follow `;`, or are entries without a name or with the name comment.
std::string fractint_without_comments(std::string_view text) {
  std::string out(text);
  const auto blank = [&](std::size_t from, std::size_t to) {
    for (; from < to; ++from) out[from] = is_blank(out[from]) ? out[from] : ' ';
  };
  bool inside = false;
  for (const Line& line : lines_of(text)) {
    const std::size_t mark = std::min(text.substr(0, line.to).find(';', line.from), line.to);
    blank(mark, line.to);
    const std::size_t open = std::min(text.substr(0, mark).find('{', line.from), mark);
    const Line name = trimmed(text, {line.from, open});
    const std::string words = lower(text.substr(name.from, name.to - name.from));
    const bool begins = !inside && open < mark && (words.empty() || words == "comment");
    inside = inside || begins;
    if (!inside) continue;
    const std::size_t from = begins ? open + 1 : line.from;
    const std::size_t close = std::min(text.substr(0, mark).find('}', from), mark);
    blank(from, close);
    inside = close == mark;
  }
  return out;
}

/// A name and `{` begin an entry. Rules of Houdini can contain `{`, too, but behind `=` or `:`.
int marks_of_fractint(std::string_view text) {
  int marks = 0;
  bool inside = false;
  for (Line line : lines_of(text)) {
    line.to = std::min(text.substr(0, line.to).find(';', line.from), line.to);
    line = trimmed(text, line);
    std::string words = lower(text.substr(line.from, std::min<std::size_t>(line.to - line.from, 200)));
    const std::size_t open = words.find('{');
    if (open != std::string::npos && open > 0 && words.find_first_of("=:") > open) {
      inside = true;
      words.erase(0, words.find_first_not_of(" \t", open + 1));
    }
    const auto begins = [&](std::string_view key) {
      return words.size() > key.size() && words.substr(0, key.size()) == key &&
             (is_blank(words[key.size()]) || words[key.size()] == '=');
    };
    if (inside && (begins("axiom") || begins("angle"))) marks += 4;
    if (words.find('}') != std::string::npos) inside = false;
  }
  return marks;
}

}  // namespace seedmesh
