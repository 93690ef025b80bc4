#include "core/generators/building/choose_rule.h"

#include <algorithm>
#include <cmath>

#include "core/generators/building/evaluate.h"

namespace seedmesh::building {

double weight_of(Derivation& d, const Choice& choice, double before) {
  if (!choice.weight.is_given) return std::max(0.0, 1 - before);
  return std::max(0.0, number_of(d, choice.weight) * (choice.is_percentage ? 0.01 : 1));
}

void check_sum_of_weights(const Derivation& d, double sum, std::uint32_t offset) {
  if (!d.task.has_strict_weights || std::abs(sum - 1) <= 1e-9) return;
  d.job.refuse(issue_in_rules(
      d.task, IssueKind::evaluation, offset,
      "the weights sum to " + text_of_number(sum) + " for a shape, expected 1 because `weights` is strict"));
}

namespace {

/// Whether the parameters that the left side writes as values have these values.
bool has_fixed_values(Derivation& d, const Rule& rule) {
  const Shape& shape = d.out.shapes[d.seen_shape];
  return std::ranges::all_of(rule.fixed, [&](const auto& each) {
    return d.out.parameters[shape.first_parameter + each.first] == number_or_text(d, each.second);
  });
}

/// The values of with(...), each of which can use those before it.
void find_locals(Derivation& d, const Rule& rule) {
  std::vector<lang::TaggedValue>& values = d.locals[d.seen_shape];
  values.clear();
  for (const Value& each : rule.locals) {
    const lang::TaggedValue value = number_or_text(d, each);
    values.push_back(value);
    look_at(d, *d.seen, d.seen_shape);  // the next value reads this one
  }
}

/// The first branch whose condition is true. If the weights of its choices sum to less than 1, the choices of
/// later rules that apply take part as well. Null: no rule applies.
const Choice* choose_in(Derivation& d, std::span<const std::uint32_t> rules, std::uint32_t parameters,
                        std::uint64_t key) {
  d.random = Rng(key_at(key, step_of_conditions));
  std::vector<std::pair<const Choice*, double>> open;
  double sum = 0;
  bool is_complete = false;
  for (std::size_t r = 0; r < rules.size() && !is_complete; ++r) {
    const Rule& rule = d.grammar.rules[rules[r]];
    if (rule.parameter_count != parameters || !has_fixed_values(d, rule)) continue;
    if (!rule.locals.empty()) find_locals(d, rule);
    const Body& body = d.grammar.bodies[rule.body];
    for (std::uint32_t b = 0; b < body.branch_count; ++b) {
      const Branch& branch = d.grammar.branches[body.first_branch + b];
      if (branch.condition.is_given && !holds(d, branch.condition)) continue;
      for (std::uint32_t c = 0; c < branch.choice_count && !is_complete; ++c) {
        const Choice& choice = d.grammar.choices[branch.first_choice + c];
        const double weight = weight_of(d, choice, sum);
        is_complete = !choice.weight.is_given;
        open.emplace_back(&choice, weight);
        sum += weight;
      }
      is_complete |= sum >= 1 - 1e-9;
      break;
    }
  }
  if (open.empty()) return nullptr;
  check_sum_of_weights(d, sum, d.grammar.rules[rules.front()].offset);
  if (open.size() == 1) return open[0].first;
  double at = Rng(key_at(key, step_of_choice)).unit() * sum;
  for (const auto& [choice, weight] : open) {
    at -= weight;
    if (at < 0) return choice;
  }
  return open.back().first;
}

}  // namespace

const Choice* choose(Derivation& d, std::uint32_t index) {
  const Shape& shape = d.out.shapes[index];
  const Symbol& symbol = d.grammar.symbols[shape.symbol];
  if (symbol.rules.size() == 1) {  // the common case: one rule, always
    const Rule& rule = d.grammar.rules[symbol.rules[0]];
    const Body& body = d.grammar.bodies[rule.body];
    const Branch& branch = d.grammar.branches[body.first_branch];
    if (body.branch_count == 1 && !branch.condition.is_given && branch.choice_count == 1 &&
        rule.parameter_count == shape.parameter_count && rule.locals.empty() && rule.fixed.empty())
      return &d.grammar.choices[branch.first_choice];
  }
  const auto state = static_cast<const ShapeState&>(shape);
  look_at(d, state, index);
  return choose_in(d, symbol.rules, shape.parameter_count, shape.key);
}

}  // namespace seedmesh::building
