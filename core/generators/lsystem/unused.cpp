#include "core/generators/lsystem/unused.h"

#include <algorithm>

#include "core/generators/unused.h"
#include "generated/params/lsystem.h"
#include "generated/params/lsystem_unused.h"

namespace seedmesh::lsystem {
namespace {

template <class Holds>
bool any_production(const Grammar& grammar, const Holds& holds) {
  const auto is_in = [&holds](const Rules& rules) { return std::ranges::any_of(rules.productions, holds); };
  return is_in(grammar.productions) || is_in(grammar.interpretation) || is_in(grammar.decomposition) ||
         std::ranges::any_of(grammar.tables, is_in);
}

}  // namespace

std::vector<Warning> unused_settings(const LsystemParams& params, const Grammar& grammar) {
  std::vector<Warning> warnings = warnings_of(unused_parameters(params));
  const bool has_context = any_production(grammar, [](const Production& each) { return each.has_context(); });
  const bool has_weight = any_production(grammar, [](const Production& each) { return each.weighted; });
  const bool has_organ =
      std::ranges::any_of(grammar.kinds, [](const Kind& kind) { return kind.surface != Kind::none; });
  const auto warn = [&warnings](bool is_unused, const char* pointer, const char* reason) {
    if (is_unused) warnings.push_back({pointer, std::string("has no effect: ") + reason});
  };
  using Params = LsystemParams;
  warn(params.ring && !has_context, "/ring", "no production has a context");
  warn(params.rule_order != Params::RuleOrder::contexts_first && !has_context, "/rule_order",
       "no production has a context");
  warn(params.weights == Params::Weights::strict && !has_weight, "/weights",
       "no production has a probability");
  warn(params.strict_predecessors && !grammar.strict, "/strict_predecessors",
       "no predecessor has several modules");
  warn(params.crown_normals > 0 && !has_organ, "/crown_normals", "the plant has no organs");
  return warnings;
}

}  // namespace seedmesh::lsystem
