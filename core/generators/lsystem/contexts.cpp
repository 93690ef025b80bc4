#include "core/generators/lsystem/contexts.h"

#include <algorithm>

namespace seedmesh::lsystem {

void pair_brackets(const Grammar& grammar, const Word& word, Array<std::uint32_t>& partner) {
  partner.resize(word.size());
  std::uint32_t open = 0xFFFFFFFFU;  // innermost open bracket; outer ones are linked through `partner`
  for (std::uint32_t i = 0; i < word.size(); ++i) {
    if (word.kind[i] == grammar.open) {
      partner[i] = open;
      open = i;
    } else if (word.kind[i] == grammar.close) {
      const std::uint32_t outer = partner[open];
      partner[open] = i;
      partner[i] = open;
      open = outer;
    }
  }
}

double* ContextMatcher::match(const Production& production, std::size_t position) {
  position_ = position;
  has_wrapped_ = false;
  right_.clear();
  const std::size_t behind = position + 1 + production.rest.size();
  if (!match_rest(production, position) || !match_left(production, position) ||
      !match_right(production.right, behind))
    return nullptr;
  new_right_.clear();
  if (!match_new_left(production)) return nullptr;
  if (!production.new_right.empty() && !match_new_right(production.new_right, pieces_.size(), 0))
    return nullptr;
  double* to = slots_.data() + grammar_.variables.size();
  for (std::size_t i = position; i < behind; ++i) to = take_parameters(word_, i, to);
  for (auto each = left_.rbegin(); each != left_.rend(); ++each) to = take_parameters(word_, *each, to);
  for (const std::size_t each : right_) to = take_parameters(word_, each, to);
  for (auto each = new_left_.rbegin(); each != new_left_.rend(); ++each)
    to = take_parameters(written_, *each, to);
  for (const std::size_t each : new_right_) to = take_parameters(written_, each, to);
  return slots_.data();
}

/// The modules of a strict predecessor follow each other without others in between.
bool ContextMatcher::match_rest(const Production& production, std::size_t position) const {
  const std::vector<KindId>& rest = production.rest;
  if (rest.size() >= word_.size() - position) return rest.empty();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (word_.kind[position + 1 + i] != rest[i]) return false;
  }
  return true;
}

bool ContextMatcher::match_left(const Production& production, std::size_t position) {
  left_.clear();
  std::size_t at = position;
  bool round = false;  // true after a ring was left at its start and entered at its end
  for (const KindId wanted : production.left) {
    for (;;) {
      if (at == 0) {
        if (!grammar_.ring || round) return false;
        round = true;
        at = word_.size();
      }
      walk();
      --at;
      if (round && at <= position) return false;
      const KindId kind = word_.kind[at];
      if (kind == grammar_.close) {
        at = partner_[at];  // skip a sibling branch
      } else if (kind != grammar_.open && !is_ignored(at)) {
        break;  // an open bracket leads to the parent branch
      }
    }
    if (word_.kind[at] != wanted) return false;
    left_.push_back(at);
  }
  return true;
}

bool ContextMatcher::match_right(std::span<const KindId> pattern, std::size_t at) {
  while (!pattern.empty()) {
    if (pattern[0] == grammar_.open) {
      std::size_t close = 1;
      for (int depth = 1; depth > 0; ++close) {
        if (pattern[close] == grammar_.open) ++depth;
        if (pattern[close] == grammar_.close) --depth;
      }
      close_ring(at);
      if (!match_branch(pattern.subspan(1, close - 2), at)) return false;
      pattern = pattern.subspan(close);
      continue;
    }
    close_ring(at);
    while (at < word_.size() && (word_.kind[at] == grammar_.open || is_ignored(at))) {
      walk();
      at = word_.kind[at] == grammar_.open ? partner_[at] + 1 : at + 1;
      close_ring(at);
    }
    if (has_wrapped_ && at >= position_) return false;
    if (at >= word_.size() || word_.kind[at] != pattern[0]) return false;  // a ] is no kind of a pattern here
    right_.push_back(at++);
    pattern = pattern.subspan(1);
  }
  return true;
}

/// Matches the first branch at `at` whose start fits the pattern, and moves `at` after it.
bool ContextMatcher::match_branch(std::span<const KindId> pattern, std::size_t& at) {
  while (at < word_.size() && (word_.kind[at] == grammar_.open || is_ignored(at))) {
    walk();
    if (word_.kind[at] != grammar_.open) {
      ++at;
      continue;
    }
    const std::size_t behind = partner_[at] + 1;
    const std::size_t taken = right_.size();
    if (match_right(pattern, at + 1)) {
      at = behind;
      return true;
    }
    right_.resize(taken);
    at = behind;
  }
  return false;
}

/// Walks left in the word of the next step as in the present one, but counts brackets.
bool ContextMatcher::match_new_left(const Production& production) {
  new_left_.clear();
  std::size_t at = written_.size();
  for (const KindId wanted : production.new_left) {
    for (int depth = 0;;) {
      if (at == 0) return false;
      walk();
      const KindId kind = written_.kind[--at];
      if (kind == grammar_.close) {
        ++depth;
      } else if (kind == grammar_.open) {
        if (depth > 0) --depth;
      } else if (depth == 0 && !grammar_.kinds[kind].ignored) {
        break;
      }
    }
    if (written_.kind[at] != wanted) return false;
    new_left_.push_back(at);
  }
  return true;
}

/// Moves to the next module to the right of a word that is written from its end. Returns false after its last
/// module.
bool ContextMatcher::step_right(std::size_t& piece, std::size_t& at) const {
  while (piece == pieces_.size() ||
         at == (piece + 1 < pieces_.size() ? pieces_[piece + 1] : written_.size())) {
    if (piece == 0) return false;
    at = pieces_[--piece];
  }
  return true;
}

/// Moves from an opening bracket to the module after its partner.
bool ContextMatcher::skip_branch(std::size_t& piece, std::size_t& at) {
  int depth = 0;
  do {
    if (!step_right(piece, at)) return false;
    walk();
    if (written_.kind[at] == grammar_.open) ++depth;
    if (written_.kind[at] == grammar_.close) --depth;
    ++at;
  } while (depth > 0);
  return true;
}

/// Same as match_right(). A branch of the pattern matches the first branch that starts with it.
bool ContextMatcher::match_new_right(std::span<const KindId> pattern, std::size_t piece, std::size_t at) {
  while (!pattern.empty()) {
    if (!step_right(piece, at)) return false;
    walk();
    const KindId kind = written_.kind[at];
    if (kind != grammar_.open) {
      if (grammar_.kinds[kind].ignored) {
        ++at;
        continue;
      }
      if (kind != pattern[0]) return false;  // a ] is no kind of a pattern here
      new_right_.push_back(at++);
      pattern = pattern.subspan(1);
      continue;
    }
    if (pattern[0] == grammar_.open) {
      std::size_t close = 1;
      for (int depth = 1; depth > 0; ++close) {
        if (pattern[close] == grammar_.open) ++depth;
        if (pattern[close] == grammar_.close) --depth;
      }
      const std::size_t taken = new_right_.size();
      if (match_new_right(pattern.subspan(1, close - 2), piece, at + 1)) {
        pattern = pattern.subspan(close);
      } else {
        new_right_.resize(taken);
      }
    }
    if (!skip_branch(piece, at)) return false;
  }
  return true;
}

double* ContextMatcher::take_parameters(const Word& word, std::size_t position, double* to) const {
  const std::uint32_t arity = grammar_.kinds[word.kind[position]].arity;
  if (arity == 0) return to;
  const double* first = word.parameter.data() + word.at[position];
  return std::copy(first, first + arity, to);
}

}  // namespace seedmesh::lsystem
