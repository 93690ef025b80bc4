#include "core/generators/building/parse_steps.h"

#include <algorithm>

#include "core/generators/building/compile_values.h"
#include "core/generators/building/operations.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr int deepest = 100;                             ///< nested brackets of one successor
constexpr std::uint32_t other_case = 1, one_letter = 2;  ///< as lang::name_distance counts

/// The operation that a misspelt name is likely to mean: a name that differs in case only, or by one letter
/// if both have at least three. Empty: none.
std::string_view mistyped_operation(std::string_view name) {
  std::string_view best;
  std::uint32_t least = one_letter + 1;
  for (const OperationRow& row : operations()) {
    if (std::max(name.size(), row.name.size()) - std::min(name.size(), row.name.size()) > 1) continue;
    const std::uint32_t distance = lang::name_distance(name, row.name);
    const bool is_short = name.size() < 3 || row.name.size() < 3;
    if (distance >= least || (is_short && distance > other_case)) continue;
    least = distance;
    best = row.name;
  }
  return best;
}

bool begins_cases(const Parser& p) {
  if (p.tokens.is_name(p.at, "case")) return true;
  const std::size_t behind = p.tokens.after_expression(p.at);
  return behind > p.at && p.tokens.is(behind, "%") && p.tokens.is(behind + 1, ":");
}

/// A successor, or cases or percentages in its place, which end with their own else.
Choice parse_nested(Parser& p) {
  if (!begins_cases(p)) return parse_successor(p);
  Step step;
  step.op = Op::body;
  step.offset = offset_here(p);
  Part part;
  part.body = parse_body(p);
  append_rows(p.grammar.parts, std::vector<Part>{part}, step.first_part, step.part_count);
  Choice choice;
  append_rows(p.grammar.steps, std::vector<Step>{step}, choice.first_step, choice.step_count);
  return choice;
}

/// 30% : A  50% : B  else : C, or a plain successor.
void parse_choices(Parser& p, std::vector<Choice>& out) {
  if (p.tokens.is_name(p.at, "case") || !begins_cases(p)) {
    out.push_back(parse_nested(p));
    return;
  }
  while (!p.tokens.is_name(p.at, "case") && begins_cases(p)) {
    const std::size_t from = p.at, to = p.tokens.after_expression(p.at);
    Value weight = compile_value(p, from, to);
    p.at = to + 1;
    expect(p, ":", "the percentage");
    // The weight is a share of 1.
    const bool is_constant = weight.expression.is_constant && weight.tree == none;
    if (is_constant) weight.expression.value /= 100;
    Choice choice = parse_nested(p);
    choice.weight = weight;
    choice.is_percentage = !is_constant;
    out.push_back(choice);
  }
  if (p.tokens.is_name(p.at, "else") && p.tokens.is(p.at + 1, ":")) {
    p.at += 2;
    out.push_back(parse_nested(p));
  }
}

bool ends_successor(const Parser& p) {
  const Token& token = here(p);
  if (token.kind == TokenKind::end || is_here(p, "|") || is_here(p, "}") || is_here(p, "]") ||
      is_here(p, ":") || is_here(p, ")") || p.tokens.is_arrow(p.at))
    return true;
  if (token.kind == TokenKind::name && (token.text == "case" || token.text == "else")) return true;
  if (token.kind != TokenKind::name && p.tokens.is(p.tokens.after_expression(p.at), "%")) return true;
  return begins_statement(p, p.at);
}

void parse_symbol(Parser& p, std::vector<Step>& out) {
  const Token token = here(p);
  Step step;
  step.offset = static_cast<std::uint32_t>(token.offset);
  step.symbol = symbol_index(p, token.text, step.offset);
  ++p.at;
  std::vector<Argument> list;
  const auto point = [&] {
    if (!is_here(p, ".") || here(p).offset != p.tokens.at(p.at - 1).offset + p.tokens.at(p.at - 1).length)
      return;
    ++p.at;
    step.is_leaf = true;
  };
  point();
  if (!step.is_leaf && is_here(p, "(")) {
    const std::size_t close = p.tokens.partner(p.at);
    ++p.at;
    while (p.at < close && !is_here(p, ")")) {
      Argument argument;
      argument.value = parse_value(p);
      list.push_back(argument);
      if (!take(p, ",")) break;
    }
    if (p.at < close) {
      add_unexpected(p, "`,` or `)`");
    }
    p.at = std::min(close + 1, p.tokens.end());
    point();
  }
  append_rows(p.grammar.arguments, list, step.first_argument, step.argument_count);
  // A name without a rule is a leaf, unless it is likely to be a misspelt or unknown operation.
  if (p.tokens.is_missing(token.text)) step.is_leaf = true;
  if (!list.empty() && !step.is_leaf && !p.symbols_with_rules.contains(token.text)) {
    const std::string_view hint = mistyped_operation(token.text);
    if (!hint.empty() || is_here(p, "{")) {
      add_error(p, token,
                "there is no operation and no rule " + in_quotes(token) +
                    (hint.empty() ? std::string() : "; did you mean " + lang::in_quotes(hint) + "?"));
    }
  }
  out.push_back(step);
}

}  // namespace

bool parse_step(Parser& p, std::vector<Step>& out) {
  const Token& token = here(p);
  if (take(p, "*") || take(p, "ε")) {  // an empty successor, as in L-systems
    out.push_back({.op = Op::nil, .offset = static_cast<std::uint32_t>(token.offset)});
    return true;
  }
  if (token.kind != TokenKind::name) {
    add_error(p, token, "found " + in_quotes(token) + ", expected a symbol, an operation or a bracket");
    return false;
  }
  if (token.text == "NIL" || token.text == "NULL" || token.text == "epsilon") {
    out.push_back({.op = Op::nil, .offset = static_cast<std::uint32_t>(token.offset)});
    ++p.at;
    if (is_here(p, "(") && p.tokens.is(p.at + 1, ")")) p.at += 2;
    return true;
  }
  if (const OperationRow* row = operation_here(p); row != nullptr) {
    parse_operation(p, *row, out);
  } else {
    parse_symbol(p, out);
  }
  return true;
}

std::uint32_t parse_body(Parser& p) {
  std::vector<Branch> branches;
  if (!enter_bracket(p, here(p))) return 0;
  if (!p.tokens.is_name(p.at, "case")) {
    Branch& branch = branches.emplace_back();
    std::vector<Choice> list;
    parse_choices(p, list);
    append_rows(p.grammar.choices, list, branch.first_choice, branch.choice_count);
  } else {
    while (p.tokens.is_name(p.at, "case") || p.tokens.is_name(p.at, "else")) {
      const bool is_else = p.tokens.is_name(p.at, "else");
      ++p.at;
      Branch branch;
      if (!is_else) branch.condition = parse_value(p);
      expect(p, ":", is_else ? "else" : "the condition");
      std::vector<Choice> list;
      parse_choices(p, list);
      append_rows(p.grammar.choices, list, branch.first_choice, branch.choice_count);
      branches.push_back(branch);
      if (is_else) break;
    }
  }
  --p.depth;
  p.grammar.bodies.push_back(
      {static_cast<std::uint32_t>(p.grammar.branches.size()), static_cast<std::uint32_t>(branches.size())});
  p.grammar.branches.insert(p.grammar.branches.end(), branches.begin(), branches.end());
  return static_cast<std::uint32_t>(p.grammar.bodies.size()) - 1;
}

Choice parse_successor(Parser& p) {
  std::vector<Step> steps;
  int brackets = 0;
  while (true) {
    if (is_here(p, "]") && brackets > 0) {
      --brackets;
      steps.push_back({.op = Op::pop, .offset = offset_here(p)});
      ++p.at;
      continue;
    }
    if (is_here(p, "[")) {
      if (++brackets > deepest) {
        add_error(p, here(p), "brackets are nested more than 100 deep");
        p.at = p.tokens.end();
        break;
      }
      steps.push_back({.op = Op::push, .offset = offset_here(p)});
      ++p.at;
      if (begins_cases(p)) {
        const Choice nested = parse_nested(p);
        steps.push_back(p.grammar.steps[nested.first_step]);
      }
      continue;
    }
    if (ends_successor(p)) break;
    if (!parse_step(p, steps)) break;
  }
  if (brackets > 0) add_unexpected(p, "`]`");
  Choice choice;
  append_rows(p.grammar.steps, steps, choice.first_step, choice.step_count);
  return choice;
}

}  // namespace seedmesh::building
