#include "core/generators/lsystem/growth.h"

#include <algorithm>

namespace seedmesh::lsystem {
namespace {

std::uint64_t add(std::uint64_t a, std::uint64_t b) {
  return std::min(saturated, a + std::min(saturated, b));
}

/// Returns true where one of the productions always applies, so that the module cannot stay unchanged.
bool always_rewritten(const Rules& rules, Range range) {
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    const Production& each = rules.productions[i];
    const bool certain = !each.conditional || (each.condition.is_constant && each.condition.value != 0);
    const bool possible = !each.weighted || (each.weight.is_constant && each.weight.value > 0);
    if (certain && possible && !each.has_context()) return true;
  }
  return false;
}

/// Returns false where decomposition, tables, statements or strict predecessors affect the length of a word.
bool is_written_by_productions(const Grammar& grammar) {
  return grammar.decomposition.productions.empty() && grammar.tables.empty() && !grammar.statements &&
         !grammar.strict;
}

}  // namespace

std::uint64_t least_modules(const Grammar& grammar, std::uint32_t steps) {
  if (grammar.cuts || !is_written_by_productions(grammar)) return 0;
  const Rules& rules = grammar.productions;
  std::vector<std::uint64_t> least(grammar.kinds.size(), 1);
  const auto sum = [&](Range successor) {
    std::uint64_t total = 0;
    for (const Template& each : grammar.successor(successor)) total = add(total, least[each.kind]);
    return total;
  };
  for (std::uint32_t step = 0; step < steps; ++step) {
    std::vector<std::uint64_t> before = least;  // values for one step fewer
    for (std::size_t kind = 0; kind < least.size(); ++kind) {
      const Range range = rules.of_kind[kind];
      if (range.count == 0) continue;
      std::uint64_t fewest = always_rewritten(rules, range) ? saturated : least[kind];
      for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
        fewest = std::min(fewest, sum(rules.productions[i].successor));
      }
      before[kind] = fewest;
    }
    least = std::move(before);
  }
  return sum(grammar.axiom);
}

std::vector<std::uint64_t> exact_counts(const Grammar& grammar, std::uint32_t steps) {
  const Rules& rules = grammar.productions;
  if (grammar.cuts || !is_written_by_productions(grammar)) return {};
  for (const Range& range : rules.of_kind) {
    if (range.count == 0) continue;
    const Production& first = rules.productions[range.first];
    if (first.weighted || first.conditional || first.has_context()) return {};
  }
  std::vector<std::uint64_t> counts(grammar.kinds.size(), 0);
  for (const Template& each : grammar.successor(grammar.axiom)) counts[each.kind] = add(counts[each.kind], 1);
  for (std::uint32_t step = 0; step < steps; ++step) {
    std::vector<std::uint64_t> next(counts.size(), 0);
    for (std::size_t kind = 0; kind < counts.size(); ++kind) {
      if (counts[kind] == 0) continue;
      if (!rules.rewrites(static_cast<KindId>(kind))) {
        next[kind] = add(next[kind], counts[kind]);
        continue;
      }
      const Production& production = rules.productions[rules.of_kind[kind].first];
      for (const Template& each : grammar.successor(production.successor)) {
        next[each.kind] = add(next[each.kind], counts[kind]);
      }
    }
    counts = std::move(next);
  }
  return counts;
}

}  // namespace seedmesh::lsystem
