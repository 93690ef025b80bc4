#pragma once
/// Matches the contexts of productions in a word with branches.
#include <algorithm>
#include <span>

#include "core/generators/lsystem/word.h"

namespace seedmesh::lsystem {

/// Writes to `partner`, for every bracket of the word, the index of the matching bracket. Other entries are
/// unspecified. Words are balanced, because every axiom and successor is. Cost: linear in the word.
void pair_brackets(const Grammar& grammar, const Word& word, Array<std::uint32_t>& partner);

/// Matches the contexts of productions at successive positions of a word. In a ring the first and the last
/// module are neighbours.
class ContextMatcher {
 public:
  /// `written` is the word that this step produces. New contexts (`<<`, `>>`) are matched against it. If
  /// Grammar::backward is set, it is written from right to left. Each module of `word` then writes one piece
  /// of it, and `pieces` has the first index of each piece.
  ContextMatcher(const Grammar& grammar, const Word& word, std::span<const std::uint32_t> partner,
                 const Word& written, const std::vector<std::size_t>& pieces, const Job& job)
      : grammar_(grammar),
        word_(word),
        partner_(partner),
        written_(written),
        pieces_(pieces),
        job_(job),
        slots_(std::max<std::size_t>(grammar.most_slots, grammar.variables.size()) + 1) {}

  void set_partner(std::span<const std::uint32_t> partner) { partner_ = partner; }

  /// Returns the variables of the grammar: the first slots of every match.
  double* variables() { return slots_.data(); }

  /// Returns the slots of `production` at `position`: the variables, the parameters of the predecessor, then
  /// of the left, right, new left and new right context, each from left to right. Returns null where the
  /// contexts do not match. The array has all slots of the production and is valid until the next call.
  double* match(const Production& production, std::size_t position);

 private:
  bool match_rest(const Production& production, std::size_t position) const;
  bool match_left(const Production& production, std::size_t position);
  bool match_right(std::span<const KindId> pattern, std::size_t from);
  bool match_branch(std::span<const KindId> pattern, std::size_t& at);
  bool match_new_left(const Production& production);
  bool match_new_right(std::span<const KindId> pattern, std::size_t piece, std::size_t at);
  bool step_right(std::size_t& piece, std::size_t& at) const;
  bool skip_branch(std::size_t& piece, std::size_t& at);
  double* take_parameters(const Word& word, std::size_t position, double* to) const;
  /// Wraps `at` from the end of a ring to its start, at most once for each match.
  void close_ring(std::size_t& at) {
    if (!grammar_.ring || has_wrapped_ || at != word_.size()) return;
    at = 0;
    has_wrapped_ = true;
  }
  /// Checks the deadline every 65,536 calls, because a context may skip any number of modules.
  void walk() {
    if ((++walked_ & 0xFFFFU) == 0) job_.check();
  }
  bool is_ignored(std::size_t position) const { return grammar_.kinds[word_.kind[position]].ignored; }

  const Grammar& grammar_;
  const Word& word_;
  std::span<const std::uint32_t> partner_;
  const Word& written_;
  const std::vector<std::size_t>& pieces_;
  const Job& job_;
  std::vector<std::size_t> left_, right_, new_left_, new_right_;  ///< positions of the matched modules
  std::vector<double> slots_;
  std::size_t position_ = 0;  ///< position of the predecessor
  bool has_wrapped_ = false;  ///< the right context has passed the end of the ring
  std::uint64_t walked_ = 0;
};

}  // namespace seedmesh::lsystem
