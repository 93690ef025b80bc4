#pragma once
/// Shared parts of the readers of foreign texts: errors and warnings with line and column, and small lexical helpers.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/import.h"

namespace seedmesh {

/// The bytes of a joined text from `from` on, up to the next part. They come from byte `origin` of the
/// foreign text. If `file` is not empty, all of them map to the line at `origin`, which includes that file.
struct TextPart {
  std::size_t from = 0, origin = 0;
  std::string file;
};

/// A foreign text, with its errors and warnings.
class ForeignText {
 public:
  explicit ForeignText(std::string_view text) : text_(text), foreign_(text) {}
  /// `text` is joined from `foreign` and further files. Offsets refer to `text`; reported lines and columns refer
  /// to `foreign`.
  ForeignText(std::string_view text, std::string_view foreign, std::vector<TextPart> parts)
      : text_(text), foreign_(foreign), parts_(std::move(parts)) {}

  std::string_view text() const { return text_; }
  void report(std::size_t offset, std::string message, IssueKind kind = IssueKind::syntax);
  void warn(std::size_t offset, std::string message, std::string pointer = "");
  std::size_t error_count() const { return issues_.size() + unlisted_; }

  /// Returns `imported` with the errors and warnings, in the order of the text.
  Imported finish(Imported imported);

 private:
  static constexpr std::size_t most = 100;  ///< errors, and warnings, that are kept

  /// Converts an offset of `text_` to one of `foreign_`. For an included file, also puts its name before the message.
  void trace(std::size_t& offset, std::string* message) const;

  std::string_view text_, foreign_;
  std::vector<TextPart> parts_;  ///< parts in their order; empty: both texts are the same
  std::vector<Issue> issues_;
  std::vector<Warning> warnings_;
  std::size_t unlisted_ = 0;  ///< errors that were not kept
};

/// A line without its line end: bytes [from, to) of the text.
struct Line {
  std::size_t from = 0, to = 0;
};
std::vector<Line> lines_of(std::string_view text);

/// Greatest size in bytes of a JSON text whose format can be detected as that of a tree. For a longer text,
/// the request has to name the format. Detection therefore does not parse whole maps.
constexpr std::size_t largest_tree_file = 256 * 1024;

/// Returns an error if `options` name an entry, for formats whose files have no entries; else nullopt. `what` begins
/// the message: "a file of cpfg has one system".
std::optional<Error> entry_error(const ImportOptions& options, const std::string& what);

bool is_blank(char c);
bool is_letter(char c);
bool is_digit(char c);
char lower(char c);
std::string lower(std::string_view text);

/// Returns `line` without blanks at both ends.
Line trimmed(std::string_view text, Line line);

/// Reads the unsigned number at text[at, to) (digits and at most one point) and moves `at` behind it. Returns
/// false if there is none.
bool take_number(std::string_view text, std::size_t& at, std::size_t to, double& number);

}  // namespace seedmesh
