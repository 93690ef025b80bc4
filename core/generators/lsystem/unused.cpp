#include "core/generators/lsystem/unused.h"

#include <algorithm>
#include <string_view>
#include <variant>

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

bool is_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Whether a text contains a name that is no part of a longer one.
bool mentions(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_of_name(text[at - 1])) && (end == text.size() || !is_of_name(text[end]))) return true;
  }
  return false;
}

/// Whether any text of the grammar contains the name `age`. Modules can have this name, too, so that true is no proof.
bool mentions_age(const LsystemParams& params) {
  const auto has_it = [](const std::string& text) { return mentions(text, "age"); };
  const auto any = [&](const std::vector<std::string>& texts) { return std::ranges::any_of(texts, has_it); };
  const auto in_values = [&](const auto& values) {
    return std::ranges::any_of(values, [&](const auto& each) {
      const auto* text = std::get_if<std::string>(&each.second);
      return text && has_it(*text);
    });
  };
  return has_it(params.axiom) || any(params.productions) || any(params.interpretation) ||
         any(params.decomposition) || any(params.functions) || has_it(params.start_each) ||
         has_it(params.end_each) || in_values(params.constants) || in_values(params.variables) ||
         std::ranges::any_of(params.tables,
                             [&](const LsystemTable& table) { return any(table.productions); });
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
  if (params.timed && !mentions_age(params))
    warn(true, params.age ? "/age" : "/timed", "no rule uses the name `age`");
  warn(params.crown_normals > 0 && !has_organ, "/crown_normals", "the plant has no organs");
  return warnings;
}

}  // namespace seedmesh::lsystem
