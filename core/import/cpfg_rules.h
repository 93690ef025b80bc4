#pragma once
/// Productions of cpfg as productions of ours.
#include <optional>

#include "core/import/cpfg_words.h"

namespace seedmesh {

struct CpfgRule {
  TracedText left, predecessor, right, condition, successor, weight;  ///< empty: not there
  std::size_t at = 0;                                                 ///< of the line

  /// left < predecessor > right : condition --> successor : weight
  TracedText written() const;
};

/// Contexts count in productions and decompositions; cpfg passes over those of a homomorphism.
enum class CpfgContexts { counted, passed_over };

/// Empty: it has a fault, which was told.
std::optional<CpfgRule> read_cpfg_rule(const TracedText& text, CpfgContexts contexts, ForeignText& source,
                                       CpfgWords& words);

/// A rule for `l` rewrites the `l` of `~l` too, where that is a module of its own, as in cpfg: the rule for
/// `~l` that does so. Empty: the rule is for no surface.
std::optional<CpfgRule> cpfg_rule_for_surface(const CpfgRule& rule, CpfgWords& words);

}  // namespace seedmesh
