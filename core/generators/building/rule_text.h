#pragma once
/// The rules of one request as one text: one rule file, or several that import each other. Errors are bytes of
/// the joined text; they are reported in the file that they belong to.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace seedmesh::building {

struct RuleText {
  /// One file; it ends with a line break of its own in the joined text.
  struct Part {
    std::string name;  ///< the key in `rules`; empty if `rules` is a text
    std::size_t first = 0, count = 0;
  };
  std::string text;
  std::vector<Part> parts;  ///< the main file first

  std::string_view text_of(const Part& part) const {
    return std::string_view(text).substr(part.first, part.count);
  }
  /// Returns the file that contains a byte of the joined text.
  const Part& part_at(std::size_t offset) const;
  /// Returns the file that an import names: by its key, with or without directories and the ending ".cga". Returns
  /// null if there is none.
  const Part* find(std::string_view path) const;
};

/// Returns the text of a single file.
RuleText rule_text(std::string_view text);

/// Returns the files of a request, of which at least one is given. The main file is the one that no other file
/// imports. If there are several, it is the one with the rule `start`, else the only one with a mark of its start
/// rule. Adds an issue if none or several are left.
RuleText rule_text(const std::map<std::string, std::string>& files, std::string_view start,
                   std::vector<Issue>& issues);

/// Returns the pointer, line and column of a byte of the rules: /rules, or /rules/<file>.
Issue issue_at(IssueKind kind, const RuleText& text, std::size_t offset, std::string message);

/// Returns a text with blanks instead of comments (// # and /* */), and typographical signs such as ≥ as those of the
/// language. All other bytes keep their positions. `unclosed` receives the position of a /* without its */, which
/// hides the rest of the text.
std::string without_comments(std::string_view text, std::optional<std::size_t>* unclosed = nullptr);

}  // namespace seedmesh::building
