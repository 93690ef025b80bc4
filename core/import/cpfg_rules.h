#pragma once
/// Productions of cpfg as productions of ours.
#include <optional>
#include <span>
#include <vector>

#include "core/import/cpfg_words.h"

namespace seedmesh {

struct CpfgRule {
  TracedText left, predecessor, right, condition, successor, weight;  ///< empty: not there
  std::size_t at = 0;                                                 ///< of the line

  bool is_for_one_letter() const { return predecessor.size() == 1 || predecessor[1] == '('; }

  /// left < predecessor > right : condition --> successor : weight
  TracedText written() const;
};

/// Contexts count in productions and decompositions; cpfg passes over those of a homomorphism.
enum class CpfgContexts { counted, passed_over };

/// Empty: it has a fault, which was told.
std::optional<CpfgRule> read_cpfg_rule(const TracedText& text, CpfgContexts contexts, ForeignText& source,
                                       CpfgWords& words);

/// In cpfg a rule for `l` rewrites the `l` of `~l` too: adds the rules for `~l` that do so, and those for
/// what they write.
void add_cpfg_rules_for_surfaces(std::span<std::vector<CpfgRule>> lists, CpfgWords& words);

}  // namespace seedmesh
