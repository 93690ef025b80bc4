/// Statements of rules; see read_rules in syntax.h.
#include <algorithm>

#include "core/generators/building/check_grammar.h"
#include "core/generators/building/compile_values.h"
#include "core/generators/building/declarations.h"
#include "core/generators/building/parse_steps.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

/// Are these two or more symbols side by side, with one argument each?
bool is_row_of_symbols(const Grammar& grammar, const Choice& choice) {
  for (std::uint32_t i = 0; i < choice.step_count; ++i) {
    const Step& step = grammar.steps[choice.first_step + i];
    if (step.op != Op::symbol || step.argument_count != 1) return false;
  }
  return choice.step_count >= 2;
}

/// Reads `successor : weight ~> successor : weight ...` under one condition, or a body in today's notation.
std::uint32_t parse_alternatives_2006(Parser& p, const Value& condition, bool may_stack) {
  if (!condition.is_given &&
      (p.tokens.is_name(p.at, "case") || p.tokens.is(p.tokens.after_expression(p.at), "%")))
    return parse_body(p);
  Branch branch;
  branch.condition = condition;
  std::vector<Choice> choices;
  do {
    Choice choice = parse_successor(p);
    choice.is_stack = may_stack && is_row_of_symbols(p.grammar, choice);
    if (take(p, ":")) choice.weight = parse_value(p);
    choices.push_back(choice);
  } while (p.tokens.is_arrow(p.at) && ++p.at);
  append_rows(p.grammar.choices, choices, branch.first_choice, branch.choice_count);
  p.grammar.branches.push_back(branch);
  p.grammar.bodies.push_back({static_cast<std::uint32_t>(p.grammar.branches.size()) - 1, 1});
  return static_cast<std::uint32_t>(p.grammar.bodies.size()) - 1;
}

/// with ( name := value  name := value ): values that the successor reads. The closing bracket is read too. It stands
/// before the arrow, or behind it.
void parse_locals(Parser& p, Rule& rule) {
  while (begins_local(p, p.at)) {
    const std::string name(here(p).text);
    p.at += 3;
    const std::size_t number = rule.parameter_count + rule.locals.size();
    if (number >= most_parameters) {
      add_error(p, here(p), "found more than 32 parameters and values in one rule");
      break;
    }
    rule.locals.push_back(parse_value(p));
    p.names.bind_slot(name, p.grammar.first_parameter_slot + static_cast<std::uint32_t>(number));
    if (!take(p, ",")) take(p, ";");
  }
  expect(p, ")", "the values of with");
}

/// Reads one parameter of a left side: a name, or a value that the parameter has to have.
void parse_parameter(Parser& p, Rule& rule) {
  if (rule.parameter_count == most_parameters) {
    add_error(p, here(p), "found more than 32 parameters in one rule");
    ++p.at;
    return;
  }
  const bool is_name =
      here(p).kind == TokenKind::name && (p.tokens.is(p.at + 1, ",") || p.tokens.is(p.at + 1, ")"));
  if (is_name) {
    p.names.bind_slot(std::string(here(p).text), p.grammar.first_parameter_slot + rule.parameter_count++);
    ++p.at;
    return;
  }
  const std::size_t before = p.at;
  rule.fixed.emplace_back(rule.parameter_count++, parse_value(p));
  if (p.at == before) ++p.at;  // the error is reported
}

/// Reads the name and the parameters of one shape of a left side.
Joint::Left parse_left(Parser& p, Rule& rule) {
  Joint::Left left;
  left.is_kept = take(p, "[");
  left.symbol = symbol_index(p, here(p).text, offset_here(p));
  const std::uint32_t before = rule.parameter_count;
  ++p.at;
  if (is_here(p, "(")) {
    const std::size_t close = p.tokens.partner(p.at);
    ++p.at;
    while (p.at < close) {
      if (!take(p, ",")) parse_parameter(p, rule);
    }
    p.at = std::min(close + 1, p.tokens.end());
  }
  left.parameter_count = rule.parameter_count - before;
  if (left.is_kept) take(p, "]");
  return left;
}

/// The symbol of shapes that are joined by this left side.
std::uint32_t joint_symbol(Parser& p, const std::vector<Joint::Left>& lefts, std::uint32_t offset) {
  for (const Joint& joint : p.grammar.joints) {
    if (joint.lefts == lefts) return joint.symbol;
  }
  std::string name;
  for (const Joint::Left& left : lefts) {
    Symbol& symbol = p.grammar.symbols[left.symbol];
    symbol.is_in_joint = true;
    name += (name.empty() ? "" : " + ") + (left.is_kept ? "[" + symbol.name + "]" : symbol.name);
  }
  const std::uint32_t symbol = symbol_index(p, name, offset);
  p.grammar.joints.push_back({lefts, symbol});
  return symbol;
}

void parse_rule(Parser& p, std::int32_t priority) {
  if (here(p).kind == TokenKind::number && p.tokens.is(p.at + 1, ":")) p.at += 2;  // the label of the rule
  const Token name = here(p);
  if (!begins_rule(p, p.at)) {
    add_error(
        p, name,
        "found " + in_quotes(name) + ", expected a rule: a symbol, an arrow (--> or ~>) and what follows it");
    ++p.at;
    while (!begins_statement(p, p.at)) ++p.at;
    return;
  }
  Rule rule;
  rule.offset = static_cast<std::uint32_t>(name.offset);
  rule.priority = priority;
  const std::size_t names = p.names.size();
  std::vector<Joint::Left> lefts{parse_left(p, rule)};
  while (take(p, "+")) lefts.push_back(parse_left(p, rule));
  rule.symbol = lefts.size() == 1 ? lefts[0].symbol : joint_symbol(p, lefts, rule.offset);
  const auto parse_with = [&] {
    if (!p.tokens.is_name(p.at, "with") || !p.tokens.is(p.at + 1, "(")) return;
    p.at += 2;
    parse_locals(p, rule);
  };
  parse_with();
  Value condition;
  if (take(p, ":")) condition = parse_value(p);
  if (!p.tokens.is_arrow(p.at)) {
    add_unexpected(p, "an arrow");
  } else {
    const bool is_old = !p.tokens.is(p.at, "-->");
    ++p.at;
    parse_with();
    const bool may_stack = is_old && rule.parameter_count == 1;
    rule.body =
        condition.is_given || is_old ? parse_alternatives_2006(p, condition, may_stack) : parse_body(p);
    p.grammar.most_parameters = std::max(
        p.grammar.most_parameters, rule.parameter_count + static_cast<std::uint32_t>(rule.locals.size()));
    p.grammar.symbols[rule.symbol].rules.push_back(static_cast<std::uint32_t>(p.grammar.rules.size()));
    p.grammar.rules.push_back(rule);
  }
  p.names.forget_after(names);
  if (!begins_statement(p, p.at)) {
    add_error(p, here(p), "found " + in_quotes(here(p)) + ", expected a step of a successor or another rule");
    while (!begins_statement(p, p.at)) ++p.at;
  }
}

/// Whether @StartRule is anywhere in the text, which makes it a rule file of CityEngine from its first line on.
bool has_start_rule(const Parser& p) {
  for (std::size_t i = 0; !p.tokens.is_end(i); ++i) {
    if (p.tokens.is(i, "@") && p.tokens.at(i + 1).text == "StartRule") return true;
  }
  return false;
}

void parse_all(Parser& p, std::string_view start) {
  collect_declarations(p);
  compile_attributes(p);
  p.grammar.is_cityengine = p.tokens.has_imports() || has_start_rule(p);
  std::int32_t priority = 0;
  while (!p.tokens.is_end(p.at)) {
    const std::size_t before = p.at;
    const Token& token = here(p);
    if (take(p, "@")) {
      p.grammar.keeps_scopes |= here(p).text == "KeepScopes";
      ++p.at;
      if (is_here(p, "(")) p.at = p.tokens.partner(p.at) + 1;
    } else if (token.kind == TokenKind::name && token.text == "version") {
      p.grammar.is_cityengine = true;
      p.at += 2;
    } else if (token.kind == TokenKind::name && token.text == "PRIORITY" &&
               p.tokens.at(p.at + 1).kind == TokenKind::number) {
      priority = static_cast<std::int32_t>(std::clamp(p.tokens.at(p.at + 1).number, -1e6, 1e6));
      p.at += 2;
      take(p, ":");
    } else if (token.kind == TokenKind::name && (token.text == "attr" || token.text == "const") &&
               !begins_rule(p, p.at)) {
      p.at += 2;
      if (is_here(p, "(")) p.at = p.tokens.partner(p.at) + 1;
      if (take(p, "=")) p.at = end_of_value(p, p.at);
    } else if (token.kind == TokenKind::name && !begins_rule(p, p.at) && begins_statement(p, p.at)) {
      p.at = behind_head(p, p.at);
      if (take(p, "=")) p.at = end_of_value(p, p.at);
    } else {
      parse_rule(p, priority);
    }
    if (p.at == before) ++p.at;
  }
  p.grammar.turns_scopes = p.grammar.is_cityengine && !p.grammar.keeps_scopes;
  check_grammar(p, start);
}

}  // namespace

Grammar read_rules(const RuleText& text, std::string_view start, std::vector<lang::TextError>& errors) {
  Grammar grammar;
  const std::size_t dollar = start.find('$');
  const std::string_view style =
      dollar == std::string_view::npos ? std::string_view() : start.substr(0, dollar);
  if (dollar != std::string_view::npos) start.remove_prefix(dollar + 1);
  Parser parser(text, style, grammar, errors);
  for (const lang::TextError& warning : parser.tokens.warnings())
    add_warning(parser, static_cast<std::uint32_t>(warning.offset), warning.message);
  parse_all(parser, start);
  std::ranges::stable_sort(errors, {}, &lang::TextError::offset);
  for (Warning& warning : grammar.warnings) {
    const Issue place = issue_at(IssueKind::syntax, text, static_cast<std::size_t>(warning.line), "");
    warning.pointer = place.pointer;
    warning.line = place.line;
    warning.column = place.column;
  }
  return grammar;
}

}  // namespace seedmesh::building
