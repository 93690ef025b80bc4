#pragma once
/// Contexts matched over a word with branches.
#include <span>

#include "core/generators/lsystem/word.h"

namespace seedmesh::lsystem {

/// For every bracket of the word the place of its partner; other entries are unspecified. Words are balanced,
/// since every axiom and successor is.
void pair_brackets(const Grammar& grammar, const Word& word, Array<std::uint32_t>& partner);

/// Matches the contexts of productions at one place of one word after another.
class ContextMatcher {
 public:
  ContextMatcher(const Grammar& grammar, const Word& word, std::span<const std::uint32_t> partner)
      : grammar_(grammar), word_(word), partner_(partner) {}

  /// The slots of `production` at `place` (parameters of the predecessor, left context, right context), or
  /// null when its contexts do not match. Valid until the next call.
  const double* match(const Production& production, std::size_t place);

 private:
  bool match_left(const Production& production, std::size_t place);
  bool match_right(std::span<const KindId> pattern, std::size_t from);
  bool match_branch(std::span<const KindId> pattern, std::size_t& at);
  void take_parameters(std::size_t place);
  bool passed_over(std::size_t place) const { return grammar_.kinds[word_.kind[place]].ignored; }

  const Grammar& grammar_;
  const Word& word_;
  std::span<const std::uint32_t> partner_;
  std::vector<std::size_t> left_;
  std::vector<std::size_t> right_;
  std::vector<double> slots_;
};

}  // namespace seedmesh::lsystem
