#pragma once
/// Contexts matched over a word with branches.
#include <span>

#include "core/generators/lsystem/word.h"

namespace seedmesh::lsystem {

/// For every bracket of the word the place of its partner; other entries are unspecified. Words are balanced,
/// since every axiom and successor is.
void pair_brackets(const Grammar& grammar, const Word& word, Array<std::uint32_t>& partner);

/// Matches the contexts of productions at one place of one word after another. In a ring the two ends of the
/// word are neighbours.
class ContextMatcher {
 public:
  /// `written` is the word that is being written, for new contexts; where Grammar::backward holds it is
  /// written from its end, each module's successor as one piece, and `pieces` tells where these begin.
  ContextMatcher(const Grammar& grammar, const Word& word, std::span<const std::uint32_t> partner,
                 const Word& written, const std::vector<std::size_t>& pieces, const Job& job)
      : grammar_(grammar),
        word_(word),
        partner_(partner),
        written_(written),
        pieces_(pieces),
        job_(job),
        slots_(grammar.most_slots + 1) {}

  void set_partner(std::span<const std::uint32_t> partner) { partner_ = partner; }

  /// The slots of `production` at `place` (parameters of the predecessor, contexts from left to right), or
  /// null when its contexts do not match. Valid until the next call; has room for all slots of the
  /// production.
  double* match(const Production& production, std::size_t place);

 private:
  bool match_left(const Production& production, std::size_t place);
  bool match_right(std::span<const KindId> pattern, std::size_t from);
  bool match_branch(std::span<const KindId> pattern, std::size_t& at);
  bool match_new_left(const Production& production);
  bool match_new_right(std::span<const KindId> pattern, std::size_t piece, std::size_t at);
  bool step_right(std::size_t& piece, std::size_t& at) const;
  bool skip_branch(std::size_t& piece, std::size_t& at);
  double* take_parameters(const Word& word, std::size_t place, double* to) const;
  /// The end of a ring leads to its beginning, once.
  void close_ring(std::size_t& at) {
    if (!grammar_.ring || round_ || at != word_.size()) return;
    at = 0;
    round_ = true;
  }
  /// Contexts may pass over any number of modules: looks at stop and deadline now and then.
  void walk() {
    if ((++walked_ & 0xFFFFU) == 0) job_.check();
  }
  bool passed_over(std::size_t place) const { return grammar_.kinds[word_.kind[place]].ignored; }

  const Grammar& grammar_;
  const Word& word_;
  std::span<const std::uint32_t> partner_;
  const Word& written_;
  const std::vector<std::size_t>& pieces_;
  const Job& job_;
  std::vector<std::size_t> left_, right_, new_left_, new_right_;  ///< places that the contexts matched
  std::vector<double> slots_;
  std::size_t place_ = 0;  ///< of the module that is looked at
  bool round_ = false;     ///< the right context has passed the end of a ring
  std::uint64_t walked_ = 0;
};

}  // namespace seedmesh::lsystem
