#pragma once
/// Converts productions of cpfg.
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/import/cpfg_statements.h"
#include "core/import/cpfg_words.h"

namespace seedmesh {

struct CpfgRule {
  TracedText left, predecessor, right, condition, successor, weight;  ///< empty if absent
  std::size_t at = 0;                                                 ///< offset of the line
  bool is_strict = false;  ///< it replaces several modules together

  bool has_context() const { return is_strict || left.size() > 0 || right.size() > 0; }
  bool is_for_one_letter() const { return !is_strict && (predecessor.size() == 1 || predecessor[1] == '('); }

  /// Returns the rule as text: left < predecessor > right : condition --> successor : weight.
  TracedText written() const;
};

/// Returns the names in a text, numbers included.
std::set<std::string> cpfg_names_in(std::string_view text);

/// Contexts have a meaning in productions and decompositions; cpfg ignores those of a homomorphism.
enum class CpfgContexts { used, ignored };

/// Reads a rule. Reports errors, and then returns nullopt.
std::optional<CpfgRule> read_cpfg_rule(const TracedText& text, CpfgContexts contexts, ForeignText& source,
                                       CpfgWords& words, CpfgStatements& statements);

/// In cpfg a rule for `l` also rewrites the `l` of `~l`. Adds rules for `~l` that do the same, and rules for
/// the surfaces that these new rules write.
void add_cpfg_rules_for_surfaces(std::span<std::vector<CpfgRule>> lists, CpfgWords& words);

}  // namespace seedmesh
