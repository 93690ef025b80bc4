#include "core/generators/building/check_grammar.h"

#include <algorithm>
#include <cmath>

#include "core/schema/json.h"

namespace seedmesh::building {
namespace {

/// Whether a rule leaves no shape to later rules: one branch has no condition, and the weights up to there
/// sum to 1.
bool always_holds(const Grammar& grammar, const Rule& rule) {
  if (!rule.fixed.empty()) return false;
  const Body& body = grammar.bodies[rule.body];
  for (std::uint32_t b = 0; b < body.branch_count; ++b) {
    const Branch& branch = grammar.branches[body.first_branch + b];
    double sum = 0;
    bool has_rest = false;
    for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
      const Value& weight = grammar.choices[branch.first_choice + c].weight;
      has_rest |= !weight.is_given;
      if (weight.is_given && weight.expression.is_constant) sum += weight.expression.value;
    }
    if (!has_rest && sum < 1 - 1e-9) return false;
    if (!branch.condition.is_given) return true;
  }
  return false;
}

/// Warns of rules behind one that always applies.
void warn_of_unreachable(Parser& p, const Symbol& symbol) {
  std::map<std::uint32_t, std::uint32_t> first_sure;  // by number of parameters: a rule
  for (const std::uint32_t index : symbol.rules) {
    const Rule& rule = p.grammar.rules[index];
    const auto found = first_sure.find(rule.parameter_count);
    if (found == first_sure.end()) {
      if (always_holds(p.grammar, rule)) first_sure.emplace(rule.parameter_count, index);
      continue;
    }
    if (p.grammar.warnings.size() >= lang::max_errors) return;
    add_warning(p, rule.offset,
                "this rule of `" + symbol.name + "` is never used: the rule in line " +
                    std::to_string(p.tokens.line_of(p.grammar.rules[found->second].offset)) +
                    " before it always applies");
  }
}

struct WeightSum {
  double sum = 0;
  bool is_known = true;  ///< all weights are constants, and no condition selects among them
  bool has_weight = false;
  bool has_rest = false;  ///< one choice has no weight, as else
};

WeightSum sum_of_weights(const Grammar& grammar, const Symbol& symbol) {
  WeightSum made;
  for (const std::uint32_t index : symbol.rules) {
    const Rule& rule = grammar.rules[index];
    const Body& body = grammar.bodies[rule.body];
    for (std::uint32_t b = 0; b < body.branch_count; ++b) {
      const Branch& branch = grammar.branches[body.first_branch + b];
      made.is_known &= !branch.condition.is_given && rule.fixed.empty() &&
                       rule.parameter_count == grammar.rules[symbol.rules[0]].parameter_count;
      for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
        const Value& weight = grammar.choices[branch.first_choice + c].weight;
        made.has_rest |= !weight.is_given;
        made.has_weight |= weight.is_given;
        made.is_known &= !weight.is_given || weight.expression.is_constant;
        if (weight.is_given) made.sum += weight.expression.value;
      }
    }
  }
  return made;
}

void check_weights(Parser& p) {
  for (const Symbol& symbol : p.grammar.symbols) {
    const WeightSum made = sum_of_weights(p.grammar, symbol);
    if (!made.has_weight || !made.is_known) continue;
    if (!made.has_rest && std::abs(made.sum - 1) > 1e-9) {
      add_warning(p, p.grammar.rules[symbol.rules[0]].offset,
                  "the weights of `" + symbol.name + "` do not sum to 1; they count as shares of their sum");
    }
    if (made.has_rest && made.sum > 1 + 1e-9) {
      add_warning(p, p.grammar.rules[symbol.rules[0]].offset,
                  "the weights of `" + symbol.name + "` sum to more than 1, so that else is never chosen");
    }
  }
}

/// A rule that always cuts its own symbol out of itself, as A --> split(x){ 1: A | ~1: B }, has no end. The
/// inner A becomes a leaf, with a warning. (With `iterations` it is cut that many times.)
void leave_endless_whole(Parser& p, const Symbol& symbol) {
  if (symbol.rules.size() != 1) return;
  const Rule& rule = p.grammar.rules[symbol.rules[0]];
  const Body& body = p.grammar.bodies[rule.body];
  const Branch& branch = p.grammar.branches[body.first_branch];
  if (!rule.fixed.empty()) return;
  if (body.branch_count != 1 || branch.condition.is_given || branch.choice_count != 1) return;
  const Choice& choice = p.grammar.choices[branch.first_choice];
  const auto search = [&](auto&& self, std::uint32_t first, std::uint32_t count) -> void {
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Part& part = p.grammar.parts[i];
      if (part.is_group) self(self, part.first_part, part.part_count);
      if (part.body == none) continue;
      const Body& inner = p.grammar.bodies[part.body];
      const Branch& only = p.grammar.branches[inner.first_branch];
      if (inner.branch_count != 1 || only.condition.is_given || only.choice_count != 1) continue;
      const Choice& steps = p.grammar.choices[only.first_choice];
      if (steps.step_count != 1) continue;
      Step& step = p.grammar.steps[steps.first_step];
      if (step.op != Op::symbol || step.is_leaf || step.argument_count > 0 || step.symbol != rule.symbol)
        continue;
      step.stays_whole = true;
      add_warning(p, step.offset,
                  "`" + symbol.name + "` always contains another `" + symbol.name +
                      "`, without end: the inner one becomes a leaf; give the rule a condition, or write `" +
                      symbol.name + ".`");
    }
  };
  for (std::uint32_t i = 0; i < choice.step_count; ++i) {
    const Step& step = p.grammar.steps[choice.first_step + i];
    if (step.op == Op::split || step.op == Op::split_area || step.op == Op::repeat)
      search(search, step.first_part, step.part_count);
  }
}

}  // namespace

std::uint32_t least_parameters(const Grammar& grammar, std::uint32_t symbol) {
  std::uint32_t least = none;
  for (const std::uint32_t rule : grammar.symbols[symbol].rules)
    least = std::min(least, grammar.rules[rule].parameter_count);
  return least == none ? 0 : least;
}

void check_grammar(Parser& p, std::string_view start) {
  if (p.grammar.rules.empty()) {
    if (!p.errors.empty()) return;
    const bool has_declarations = !p.grammar.attributes.empty() || !p.functions.empty();
    if (!p.grammar.is_cityengine && !has_declarations)
      return add_error(p, p.tokens.at(0), "found no rule, expected at least one");
    // A file of values for other files.
    add_warning(p, 0, "found no rule, so that the first shape is the result");
    p.grammar.start = symbol_index(p, start.empty() ? "Lot" : start, 0);
    return;
  }
  if (p.grammar.queries.size() > most_queries)
    add_error(p, p.tokens.at(0), "the rules have more than 32 different queries about other shapes");
  p.grammar.start = p.start != none ? p.start : p.grammar.rules.front().symbol;
  if (!start.empty()) {
    const auto found = p.symbols.find(start);
    p.grammar.start = found == p.symbols.end() ? none : found->second;
  }
  if (p.errors.empty()) check_weights(p);
  if (p.errors.empty()) {
    for (const Symbol& symbol : p.grammar.symbols) {
      leave_endless_whole(p, symbol);
      warn_of_unreachable(p, symbol);
    }
  }
  for (const Step& step : p.grammar.steps) {
    if (step.op != Op::symbol) continue;
    Symbol& symbol = p.grammar.symbols[step.symbol];
    const auto takes = [&](std::uint32_t r) {
      return p.grammar.rules[r].parameter_count == step.argument_count;
    };
    if (!step.is_leaf && !symbol.rules.empty() && std::ranges::none_of(symbol.rules, takes) &&
        p.errors.size() < lang::max_errors) {
      p.errors.push_back({step.offset,
                          "`" + symbol.name + "` takes " +
                              std::to_string(p.grammar.rules[symbol.rules[0]].parameter_count) +
                              " parameters, found " + std::to_string(step.argument_count),
                          IssueKind::out_of_range});
    }
    if (!step.is_leaf && !symbol.is_in_joint && symbol.rules.empty() && symbol.first_use != none) {
      add_warning(p, symbol.first_use,
                  "there is no rule for `" + symbol.name + "`, so that it is a leaf; write `" + symbol.name +
                      ".` if you mean that");
      symbol.first_use = none;
    }
  }
}

std::vector<lang::TextError> errors_of_weights(const Grammar& grammar) {
  std::vector<lang::TextError> errors;
  for (const Symbol& symbol : grammar.symbols) {
    const WeightSum made = sum_of_weights(grammar, symbol);
    if (!made.has_weight || !made.is_known) continue;
    if (made.has_rest ? made.sum <= 1 + 1e-9 : std::abs(made.sum - 1) <= 1e-9) continue;
    lang::TextError error;
    error.kind = IssueKind::invalid_value;
    error.offset = grammar.rules[symbol.rules[0]].offset;
    error.message = "the weights of `" + symbol.name + "` sum to " +
                    number_text(std::round(made.sum * 1e9) / 1e9) + ", expected " +
                    (made.has_rest ? "at most 1" : "1") + " because `weights` is strict";
    errors.push_back(std::move(error));
  }
  return errors;
}

}  // namespace seedmesh::building
