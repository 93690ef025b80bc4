/// What can be told of rules when all of them are read: weights, calls, symbols without a rule, no end.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/generators/building/parser.h"
#include "core/lang/text_places.h"

namespace seedmesh::building {
namespace {

/// Whether the choices of every branch leave nothing of 1 to later rules, and one branch has no condition.
bool always_holds(const Grammar& grammar, const Rule& rule) {
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

}  // namespace

std::uint32_t least_parameters(const Grammar& grammar, std::uint32_t symbol) {
  std::uint32_t least = none;
  for (const std::uint32_t rule : grammar.symbols[symbol].rules)
    least = std::min(least, grammar.rules[rule].parameter_count);
  return least == none ? 0 : least;
}

/// A rule behind one that always holds.
void Parser::check_reach(const Symbol& symbol) {
  std::map<std::uint32_t, std::uint32_t> first_sure;  // by number of parameters: a rule
  for (const std::uint32_t index : symbol.rules) {
    const Rule& rule = grammar_.rules[index];
    const auto found = first_sure.find(rule.parameter_count);
    if (found == first_sure.end()) {
      if (always_holds(grammar_, rule)) first_sure.emplace(rule.parameter_count, index);
      continue;
    }
    if (grammar_.warnings.size() >= lang::max_faults) return;
    warn(rule.offset, "this rule of `" + symbol.name + "` is never used: the one in line " +
                          std::to_string(tokens_.line_of(grammar_.rules[found->second].offset)) +
                          " before it always holds");
  }
}

/// Weights that are known and do not sum to 1, symbols without a rule, and the start.
void Parser::finish(std::string_view start) {
  if (grammar_.rules.empty()) {
    if (faults_.empty()) fault(tokens_.at(0), "there is no rule");
    return;
  }
  if (grammar_.queries.size() > most_queries)
    fault(tokens_.at(0), "the rules ask more than 32 different questions to other shapes");
  grammar_.start = start_ != none ? start_ : grammar_.rules.front().symbol;
  if (!start.empty()) {
    const auto found = symbols_.find(start);
    grammar_.start = found == symbols_.end() ? none : found->second;
  }
  if (faults_.empty()) check_weights();
  if (faults_.empty()) {
    for (const Symbol& symbol : grammar_.symbols) {
      settle_endless(symbol);
      check_reach(symbol);
    }
  }
  for (const Step& step : grammar_.steps) {
    if (step.op != Op::symbol) continue;
    Symbol& symbol = grammar_.symbols[step.symbol];
    const auto takes = [&](std::uint32_t r) {
      return grammar_.rules[r].parameter_count == step.argument_count;
    };
    if (!step.is_leaf && !symbol.rules.empty() && std::ranges::none_of(symbol.rules, takes) &&
        faults_.size() < lang::max_faults)
      faults_.push_back({step.offset, "`" + symbol.name + "` takes " +
                                          std::to_string(grammar_.rules[symbol.rules[0]].parameter_count) +
                                          " parameters, found " + std::to_string(step.argument_count)});
    if (!step.is_leaf && symbol.rules.empty() && symbol.first_use != none) {
      warn(symbol.first_use, "there is no rule for `" + symbol.name +
                                 "`, so that it stays as it is; write `" + symbol.name +
                                 ".` where that is meant");
      symbol.first_use = none;
    }
  }
}

void Parser::check_weights() {
  for (const Symbol& symbol : grammar_.symbols) {
    double sum = 0;
    bool is_known = true, has_weight = false, has_rest = false;
    for (const std::uint32_t index : symbol.rules) {
      const Rule& rule = grammar_.rules[index];
      const Body& body = grammar_.bodies[rule.body];
      for (std::uint32_t b = 0; b < body.branch_count; ++b) {
        const Branch& branch = grammar_.branches[body.first_branch + b];
        is_known &= !branch.condition.is_given &&
                    rule.parameter_count == grammar_.rules[symbol.rules[0]].parameter_count;
        for (std::uint32_t c = 0; c < branch.choice_count; ++c) {
          const Value& weight = grammar_.choices[branch.first_choice + c].weight;
          has_rest |= !weight.is_given;
          has_weight |= weight.is_given;
          is_known &= !weight.is_given || weight.expression.is_constant;
          if (weight.is_given) sum += weight.expression.value;
        }
      }
    }
    if (has_weight && is_known && !has_rest && std::abs(sum - 1) > 1e-9)
      warn(grammar_.rules[symbol.rules[0]].offset,
           "the weights of `" + symbol.name + "` do not sum to 1; they are taken as shares of their sum");
    if (has_weight && is_known && has_rest && sum > 1 + 1e-9)
      warn(grammar_.rules[symbol.rules[0]].offset,
           "the weights of `" + symbol.name + "` sum to more than 1, so that nothing is left for else");
  }
}

/// A rule that always cuts its own symbol out of itself, A --> split(x){ 1: A | ~1: B }, would never end: the
/// inner A is left whole, with a warning. (With `iterations` it is cut as often as that says.)
void Parser::settle_endless(const Symbol& symbol) {
  if (symbol.rules.size() != 1) return;
  const Rule& rule = grammar_.rules[symbol.rules[0]];
  const Body& body = grammar_.bodies[rule.body];
  const Branch& branch = grammar_.branches[body.first_branch];
  if (body.branch_count != 1 || branch.condition.is_given || branch.choice_count != 1) return;
  const Choice& choice = grammar_.choices[branch.first_choice];
  const auto search = [&](auto&& self, std::uint32_t first, std::uint32_t count) -> void {
    for (std::uint32_t p = first; p < first + count; ++p) {
      const Part& part = grammar_.parts[p];
      if (part.is_group) self(self, part.first_part, part.part_count);
      if (part.body == none) continue;
      const Body& inner = grammar_.bodies[part.body];
      const Branch& only = grammar_.branches[inner.first_branch];
      if (inner.branch_count != 1 || only.condition.is_given || only.choice_count != 1) continue;
      const Choice& steps = grammar_.choices[only.first_choice];
      if (steps.step_count != 1) continue;
      Step& step = grammar_.steps[steps.first_step];
      if (step.op != Op::symbol || step.is_leaf || step.argument_count > 0 || step.symbol != rule.symbol)
        continue;
      step.stays_whole = true;
      warn(step.offset,
           "`" + symbol.name + "` always cuts out another `" + symbol.name +
               "`, which has no end: the inner one is left whole; give the rule a condition, or write `" +
               symbol.name + ".`");
    }
  };
  for (std::uint32_t i = 0; i < choice.step_count; ++i) {
    const Step& step = grammar_.steps[choice.first_step + i];
    if (step.op == Op::split || step.op == Op::split_area || step.op == Op::repeat)
      search(search, step.first_part, step.part_count);
  }
}

Grammar read_rules(std::string_view text, std::string_view start, std::vector<lang::Fault>& faults) {
  Grammar grammar;
  Parser(text, grammar, faults).parse(start);
  std::ranges::stable_sort(faults, {}, &lang::Fault::offset);
  // A place in a text is worked out once for all warnings.
  lang::TextPlaces places(text);
  for (Warning& warning : grammar.warnings) {
    const TextPlace place = places.of(static_cast<std::size_t>(warning.line));
    warning.line = place.line;
    warning.column = place.column;
  }
  return grammar;
}

}  // namespace seedmesh::building
