#include "core/generators/lsystem/contexts.h"

namespace seedmesh::lsystem {

void pair_brackets(const Grammar& grammar, const Word& word, Array<std::uint32_t>& partner) {
  partner.resize(word.size());
  std::uint32_t open =
      0xFFFFFFFFU;  // innermost open bracket; the ones around it are chained through `partner`
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

const double* ContextMatcher::match(const Production& production, std::size_t place) {
  right_.clear();
  if (!match_left(production, place) || !match_right(production.right, place + 1)) return nullptr;
  slots_.clear();
  take_parameters(place);
  for (auto each = left_.rbegin(); each != left_.rend(); ++each) take_parameters(*each);
  for (const std::size_t each : right_) take_parameters(each);
  slots_.push_back(0);  // never empty: a null pointer means no match
  return slots_.data();
}

bool ContextMatcher::match_left(const Production& production, std::size_t place) {
  left_.clear();
  std::size_t at = place;
  for (const KindId wanted : production.left) {
    for (;;) {
      if (at == 0) return false;
      --at;
      const KindId kind = word_.kind[at];
      if (kind == grammar_.close) {
        at = partner_[at];  // a sibling branch: past it
      } else if (kind != grammar_.open && !passed_over(at)) {
        break;  // an open bracket leads up to the parent branch
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
      if (!match_branch(pattern.subspan(1, close - 2), at)) return false;
      pattern = pattern.subspan(close);
      continue;
    }
    while (at < word_.size() && (word_.kind[at] == grammar_.open || passed_over(at))) {
      at = word_.kind[at] == grammar_.open ? partner_[at] + 1 : at + 1;
    }
    if (at >= word_.size() || word_.kind[at] != pattern[0]) return false;  // a ] is no kind of a pattern here
    right_.push_back(at++);
    pattern = pattern.subspan(1);
  }
  return true;
}

/// The first of the branches that start at `at` whose beginning matches; `at` moves behind it.
bool ContextMatcher::match_branch(std::span<const KindId> pattern, std::size_t& at) {
  while (at < word_.size() && (word_.kind[at] == grammar_.open || passed_over(at))) {
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

void ContextMatcher::take_parameters(std::size_t place) {
  const std::uint32_t arity = grammar_.kinds[word_.kind[place]].arity;
  if (arity == 0) return;
  const double* first = word_.parameter.data() + word_.at[place];
  slots_.insert(slots_.end(), first, first + arity);
}

}  // namespace seedmesh::lsystem
