#pragma once
/// Where statements stand in a successor, told by its text alone; compile_code.cpp has what they mean.
#include "core/generators/lsystem/compiler.h"

namespace seedmesh::lsystem {

constexpr std::size_t longest_name = 64;  ///< of a local

/// Where the name at `at` ends; of one that is too long for a local the end of what is too long. `at` where
/// no name begins.
std::size_t end_of_name(std::string_view text, std::size_t at, std::size_t to);
/// The same however long it is.
std::size_t end_of_whole_name(std::string_view text, std::size_t at, std::size_t to);
/// `word` and the parenthesis behind it stand at `at`: the place of the parenthesis, or `to`.
std::size_t open_after(std::string_view text, std::string_view word, std::size_t at, std::size_t to);

/// Both views must outlive it. Cost of a question: the bytes up to its answer.
class Statements {
 public:
  Statements(std::string_view text, const Marks& marks) : text_(text), marks_(marks) {}
  /// The parenthesis of a `for` at `at`; `to`: there is none.
  std::size_t loop_at(std::size_t at, std::size_t to) const;
  /// That of an `if` with a block or a comparison.
  std::size_t condition_at(std::size_t at, std::size_t to) const;
  /// A `let`, a name and its `=`.
  bool is_let(std::size_t at, std::size_t to) const;
  /// One of = += -= *= /= ++ -- stands at `at`, and no ==.
  bool changes(std::size_t at, std::size_t to) const;
  /// The next semicolon outside parentheses; `to`: there is none.
  std::size_t find_semicolon(std::size_t at, std::size_t to) const;

 private:
  std::string_view text_;
  const Marks& marks_;
};

}  // namespace seedmesh::lsystem
