#include "core/generators/lsystem/table.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t most_kinds = 96;  // the table has about the cube of this number of entries: 7 MB
constexpr std::size_t copied = 8;       // bytes of one copy; longer successors need several
constexpr std::size_t chunk = 4096;

bool plain(const Grammar& grammar, const Production& production) {
  const auto is_bracket = [&](KindId kind) { return kind == grammar.open || kind == grammar.close; };
  return !production.conditional && !production.weighted && !production.has_new_context() &&
         production.left.size() <= 1 && production.right.size() <= 1 &&
         std::none_of(production.right.begin(), production.right.end(), is_bracket);
}

}  // namespace

bool TableRewriter::fits(const Grammar& grammar) {
  const Rules& rules = grammar.productions;
  const bool by_productions_alone = grammar.decomposition.productions.empty() && grammar.tables.empty() &&
                                    !grammar.statements && !grammar.ring && !grammar.strict &&
                                    grammar.variables.empty();
  return by_productions_alone && grammar.widest == 0 && !grammar.cuts && !rules.random &&
         grammar.kinds.size() <= most_kinds &&
         std::all_of(rules.productions.begin(), rules.productions.end(),
                     [&](const Production& each) { return plain(grammar, each); });
}

TableRewriter::TableRewriter(const Grammar& grammar, Job& job)
    : grammar_(grammar),
      job_(job),
      kinds_(grammar.kinds.size()),
      bits_(static_cast<unsigned>(std::bit_width(kinds_))),
      table_(std::size_t{1} << (3 * bits_)),
      right_(job) {
  for (const Kind& kind : grammar.kinds) role_.push_back(kind.ignored ? Role::ignored : Role::neighbour);
  role_[grammar.open] = Role::open;
  role_[grammar.close] = Role::close;
  for (const Template& each : grammar.templates) row_ = row_ && role_[each.kind] == Role::neighbour;
  for (std::size_t kind = 0; kind < kinds_; ++kind) {
    // Starts with the identity, then enters the productions from last to first, so that the first match wins.
    const Entry self{static_cast<std::uint32_t>(successors_.size()), 1};
    successors_.push_back(static_cast<std::uint8_t>(kind));
    for (std::size_t left = 0; left <= kinds_; ++left) {
      for (std::size_t right = 0; right <= kinds_; ++right) table_[entry_index(left, kind, right)] = self;
    }
    const Range range = grammar.productions.of_kind[kind];
    for (std::uint32_t i = range.count; i-- > 0;) {
      fill(grammar.productions.productions[range.first + i], static_cast<KindId>(kind));
    }
  }
  successors_.resize(successors_.size() + copied, 0);
}

void TableRewriter::fill(const Production& production, KindId kind) {
  const std::span<const Template> successor = grammar_.successor(production.successor);
  const Entry made{static_cast<std::uint32_t>(successors_.size()),
                   static_cast<std::uint32_t>(successor.size())};
  for (const Template& each : successor) successors_.push_back(static_cast<std::uint8_t>(each.kind));
  longest_ = std::max(longest_, successor.size());
  for (std::size_t left = 0; left <= kinds_; ++left) {
    if (!production.left.empty() && production.left[0] != left) continue;
    for (std::size_t right = 0; right <= kinds_; ++right) {
      if (production.right.empty() || production.right[0] == right)
        table_[entry_index(left, kind, right)] = made;
    }
  }
}

/// Scans from the end. The last symbol of a branch has no right neighbour. The right neighbour of a symbol
/// before a branch follows the branch.
void TableRewriter::find_right_neighbours(const Array<std::uint8_t>& in) {
  right_.resize(in.size());
  stack_.clear();
  const auto none = static_cast<std::uint8_t>(kinds_);
  std::uint8_t next = none;
  for (std::size_t i = in.size(); i-- > 0;) {
    const std::uint8_t kind = in[i];
    right_[i] = next;
    switch (role_[kind]) {
      case Role::neighbour:
        next = kind;
        break;
      case Role::ignored:
        break;
      case Role::open:
        next = stack_.back();
        stack_.pop_back();
        break;
      case Role::close:
        stack_.push_back(next);
        next = none;
        break;
    }
  }
}

void TableRewriter::step(const Array<std::uint8_t>& in, Array<std::uint8_t>& out) {
  if (row_) {
    const std::size_t last = in.size() - 1;
    const auto none = static_cast<std::uint8_t>(kinds_);
    return rewrite(in, out, [&in, last, none](std::size_t i) { return i < last ? in[i + 1] : none; });
  }
  find_right_neighbours(in);
  rewrite(in, out, [this](std::size_t i) { return right_[i]; });
}

template <class RightOf>
void TableRewriter::rewrite(const Array<std::uint8_t>& in, Array<std::uint8_t>& out, RightOf&& right_of) {
  stack_.clear();
  std::size_t left = kinds_;
  std::size_t length = 0;
  for (std::size_t from = 0; from < in.size(); from += chunk) {
    job_.check();
    const std::size_t to = std::min(in.size(), from + chunk);
    const std::size_t needed = length + (to - from) * longest_ + copied;
    if (needed > out.capacity()) out.reserve(std::max(needed, 2 * out.capacity()));
    std::uint8_t* write = out.data() + length;
    for (std::size_t i = from; i < to; ++i) {
      const std::uint8_t kind = in[i];
      const Entry found = table_[entry_index(left, kind, right_of(i))];
      const std::uint8_t* successor = successors_.data() + found.first;
      std::memcpy(write, successor, copied);
      if (found.length > copied) std::memcpy(write + copied, successor + copied, found.length - copied);
      write += found.length;
      if (role_[kind] == Role::neighbour) {
        left = kind;
      } else if (role_[kind] == Role::open) {
        stack_.push_back(static_cast<std::uint8_t>(left));
      } else if (role_[kind] == Role::close) {
        left = stack_.back();
        stack_.pop_back();
      }
    }
    length = static_cast<std::size_t>(write - out.data());
    if (length > job_.limits().modules) {
      job_.refuse(limit_issue(
          {Resource::modules, job_.limits().modules, length},
          "needs more than " + std::to_string(job_.limits().modules) + " modules, which is the limit"));
    }
  }
  out.resize(length);
}

Array<std::uint8_t> TableRewriter::axiom() const {
  Array<std::uint8_t> word(job_);
  for (const Template& each : grammar_.successor(grammar_.axiom))
    word.push_back(static_cast<std::uint8_t>(each.kind));
  return word;
}

Word TableRewriter::derive(std::uint32_t steps) {
  Array<std::uint8_t> word = axiom();
  Array<std::uint8_t> next(job_);
  for (std::uint32_t i = 0; i < steps; ++i) {
    next.clear();
    step(word, next);
    std::swap(word, next);
  }
  job_.spend(Resource::modules, word.size());
  Word made(job_);
  made.kind.resize(word.size());
  std::copy(word.begin(), word.end(), made.kind.begin());
  return made;
}

}  // namespace seedmesh::lsystem
