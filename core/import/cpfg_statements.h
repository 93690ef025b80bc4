#pragma once
/// Statements of cpfg, which have the syntax of C: assignments, `if`, `while` and `for`. They become statements of
/// L-systems (core/generators/lsystem/compile_code.cpp).
#include <set>
#include <string>
#include <utility>

#include "core/import/cpfg_words.h"

namespace seedmesh {

class CpfgStatements {
 public:
  CpfgStatements(ForeignText& source, CpfgWords& words) : source_(source), words_(words) {}

  /// Converts the statements in text[slice], which has no outer braces, to those of L-systems. Calls that print and
  /// expressions without effect are left out with a warning, and so are calls that read a file.
  TracedText converted(const TracedText& text, lsystem::Slice slice);

  /// Like converted(), for the statements of a rule. They begin with `name = 0;` for each name that only inner braces
  /// assign, because names of cpfg belong to the whole rule.
  TracedText converted_in_rule(const TracedText& text, lsystem::Slice slice);
  /// Begins a rule. `known` are the names that exist before it: parameters, and those that `Start` sets.
  void begin_rule(std::set<std::string> known) {
    known_ = std::move(known);
    known_.insert(shared_.begin(), shared_.end());
    inner_.clear();
  }
  /// Adds names that exist in all following rules.
  void share(const std::set<std::string>& names) { shared_.insert(names.begin(), names.end()); }

  /// Returns the names that the statements read so far assign.
  const std::set<std::string>& assigned() const { return assigned_; }

  /// Returns the argument of the last srand(); empty if there was none.
  const TracedText& seed() const { return seed_; }

 private:
  std::size_t statement(const TracedText& text, std::size_t at, std::size_t to, TracedText& out);
  std::size_t branch(const TracedText& text, std::size_t open, std::size_t to, TracedText& out);
  std::size_t body(const TracedText& text, std::size_t at, std::size_t to, TracedText& out);
  std::size_t do_while(const TracedText& text, lsystem::Slice word, std::size_t to, TracedText& out);
  std::size_t call(const TracedText& text, lsystem::Slice name, std::size_t to);
  std::size_t change(const TracedText& text, lsystem::Slice slice, TracedText& out);
  void append(const TracedText& text, lsystem::Slice slice, TracedText& out) const;

  ForeignText& source_;
  CpfgWords& words_;
  std::set<std::string> assigned_, known_, shared_, inner_;
  TracedText seed_;
  int depth_ = 0, do_depth_ = 0;
};

}  // namespace seedmesh
