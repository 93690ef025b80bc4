#pragma once
/// Recognizes statements in the text of a successor; compile_code.cpp compiles them.
#include "core/generators/lsystem/compilation.h"

namespace seedmesh::lsystem {

constexpr std::size_t longest_name = 64;  ///< longest name of a local variable, in bytes

/// Returns the end of the name at `at`, or `at` where no name starts. If the name is longer than
/// `longest_name`, only its first longest_name + 1 bytes are read.
std::size_t end_of_name(std::string_view text, std::size_t at, std::size_t to);
/// The same without the limit of length.
std::size_t end_of_whole_name(std::string_view text, std::size_t at, std::size_t to);
/// Returns the position of the parenthesis that follows `word` at `at`, or `to`.
std::size_t open_after(std::string_view text, std::string_view word, std::size_t at, std::size_t to);

/// Whether a part of the text has the form of a statement.
bool has_statements(Source& source, Slice slice);

/// Queries over one text. Both arguments must outlive the object. Cost of a query: linear in the distance to its
/// result.
class Statements {
 public:
  Statements(std::string_view text, const Marks& marks) : text_(text), marks_(marks) {}
  /// Returns the parenthesis of a `for` at `at`; `to`: there is none.
  std::size_t loop_at(std::size_t at, std::size_t to) const;
  /// Returns the parenthesis of an `if` at `at` that has a block or a comparison; `to`: there is none.
  std::size_t condition_at(std::size_t at, std::size_t to) const;
  /// Whether a `let`, a name and its `=` are at `at`.
  bool is_let(std::size_t at, std::size_t to) const;
  /// True where one of = += -= *= /= ++ -- is at `at`, and not ==.
  bool changes(std::size_t at, std::size_t to) const;
  /// Returns the next semicolon outside parentheses; `to`: there is none.
  std::size_t find_semicolon(std::size_t at, std::size_t to) const;

 private:
  std::string_view text_;
  const Marks& marks_;
};

}  // namespace seedmesh::lsystem
