#include "core/import/cpfg_text.h"

#include <algorithm>

#include "core/import/formats.h"

namespace seedmesh {
namespace {

bool begins_comment(std::string_view text, std::size_t at) {
  if (at == 0 || text[at - 1] == '\n') return true;
  return is_blank(text[at - 1]) && (at + 2 >= text.size() || is_blank(text[at + 2]));
}

/// The end of the line if only blanks follow; the end of the text otherwise.
std::size_t line_end_behind(std::string_view text, std::size_t at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t' || text[at] == '\r')) ++at;
  return at < text.size() && text[at] == '\n' ? at : text.size();
}

}  // namespace

std::string cpfg_without_comments(ForeignText& source) {
  const std::string_view text = source.text();
  std::string out(text);
  std::size_t line = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const char next = i + 1 < out.size() ? out[i + 1] : ' ';
    if (out[i] == '\n') line = i + 1;
    if (out[i] == '/' && next == '*') {
      const std::size_t end = std::min(text.find("*/", i + 2), text.size());
      if (end == text.size()) source.report(i, "found a comment without its end; expected `*/`");
      for (const std::size_t stop = std::min(end + 2, text.size()); i < stop; ++i) {
        if (out[i] != '\n') out[i] = ' ';
      }
      --i;
    } else if (out[i] == '/' && next == '/' && begins_comment(text, i)) {
      const Line before = trimmed(out, {line, i});
      if (before.from < before.to && out[before.from] != '#')
        source.warn(i, "`//` between blanks begins a comment here; two rolls are written `/ /`");
      for (; i < out.size() && out[i] != '\n'; ++i) out[i] = ' ';
      --i;
    } else if (out[i] == '/' && next == '/') {
      while (i + 1 < out.size() && out[i + 1] == '/') ++i;
    } else if (const std::size_t end = out[i] == '\\' ? line_end_behind(out, i + 1) : out.size();
               end < out.size()) {
      // In a macro, `\\\\` is read as one sign by cpfg before its preprocessor joins the lines.
      const bool is_macro = trimmed(out, {line, i}).from < i && out[trimmed(out, {line, i}).from] == '#';
      if (is_macro && i > 0 && out[i - 1] == '\\') out[i - 1] = ' ';
      for (; i <= end; ++i) out[i] = ' ';
      --i;
    }
  }
  return out;
}

std::string cpfg_without_comments(std::string_view text) {
  ForeignText source(text);
  return cpfg_without_comments(source);
}

bool is_cpfg_directive(std::string_view text, Line line) {
  if (line.from == line.to || text[line.from] != '#') return false;
  const Line word = trimmed(text, {line.from + 1, line.to});
  for (const char* each : {"define", "include", "undef", "if", "el", "endif", "line", "pragma"}) {
    if (text.substr(word.from, word.to - word.from).substr(0, std::string_view(each).size()) == each)
      return true;
  }
  return word.from == line.from + 1 && word.from < word.to && is_letter(text[word.from]) &&
         text.substr(word.from, word.to - word.from).find("-->") == std::string_view::npos;
}

bool has_cpfg_arrow(std::string_view line) {
  return line.find("-->") != std::string_view::npos || line.find("-o>") != std::string_view::npos;
}

/// Whether a line can only be one of Python or of L-Py: a statement, or a keyword that cpfg lacks.
static bool is_of_lpy(std::string_view words) {
  for (const std::string_view key : {"production:", "interpretation:", "produce ", "nproduce ", "def ",
                                     "import ", "from openalea", "from math import", "context()."}) {
    if (words.starts_with(key)) return true;
  }
  // A predecessor, `:` and a statement; in cpfg a condition and an arrow follow the colon.
  const std::size_t colon = words.find(':');
  if (colon == std::string_view::npos || has_cpfg_arrow(words)) return false;
  const Line behind = trimmed(words, {colon + 1, words.size()});
  const std::string_view statement = words.substr(behind.from, behind.to - behind.from);
  return statement.starts_with("produce ") || statement.starts_with("nproduce ");
}

std::optional<OtherLanguage> other_language_of(std::string_view text) {
  const bool is_of_lpfg = text.find("lpfgall.h") != std::string_view::npos;
  for (const Line& each : lines_of(text)) {
    const Line line = trimmed(text, each);
    const std::string_view words = text.substr(line.from, line.to - line.from);
    const bool is_module = words.starts_with("module ") && words.find("--") == std::string_view::npos;
    if (!is_module && !is_of_lpy(words) && words.find("lpfgall.h") == std::string_view::npos) continue;
    const bool is_lpfg = is_of_lpfg || (is_module && words.ends_with(';'));
    return OtherLanguage{line.from, is_lpfg ? "L+C, the language of lpfg" : "L-Py"};
  }
  return std::nullopt;
}

int marks_of_cpfg(std::string_view text) {
  int marks = 0;
  for (const Line& each : lines_of(text)) {
    const Line line = trimmed(text, each);
    const std::string words = lower(text.substr(line.from, std::min<std::size_t>(line.to - line.from, 200)));
    for (const char* key : {"lsystem:", "derivation length:", "axiom:", "homomorphism", "decomposition",
                            "endlsystem", "#define "}) {
      if (words.substr(0, std::string_view(key).size()) == key) marks += 3;
    }
    if (words.find("-->") != std::string::npos) ++marks;
  }
  return marks;
}

}  // namespace seedmesh
