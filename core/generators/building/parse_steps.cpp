/// Successors: symbols, operations, brackets, and what stands in braces.
#include <algorithm>

#include "core/generators/building/parser.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr int deepest = 100;                             ///< brackets and braces inside each other
constexpr std::uint32_t other_case = 1, one_letter = 2;  ///< as lang::name_distance counts

/// The operation that a name is likely to mean: another only in case, or, where both have three letters or
/// more, by one letter. Empty: none.
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

}  // namespace

bool Parser::enter(const Token& token) {
  if (++depth_ <= deepest) return true;
  fault(token, "brackets go more than 100 deep");
  --depth_;
  at_ = tokens_.end();
  return false;
}

/// case ... else ..., or one list of choices.
std::uint32_t Parser::body() {
  std::vector<Branch> branches;
  if (!enter(here())) return 0;
  if (!tokens_.is_name(at_, "case")) {
    Branch& branch = branches.emplace_back();
    std::vector<Choice> list;
    choices(list);
    branch.first_choice = static_cast<std::uint32_t>(grammar_.choices.size());
    branch.choice_count = static_cast<std::uint32_t>(list.size());
    grammar_.choices.insert(grammar_.choices.end(), list.begin(), list.end());
  } else {
    while (tokens_.is_name(at_, "case") || tokens_.is_name(at_, "else")) {
      const bool is_else = tokens_.is_name(at_, "else");
      ++at_;
      Branch branch;
      if (!is_else) branch.condition = value();
      expect(":", is_else ? "else" : "the condition");
      std::vector<Choice> list;
      choices(list);
      branch.first_choice = static_cast<std::uint32_t>(grammar_.choices.size());
      branch.choice_count = static_cast<std::uint32_t>(list.size());
      grammar_.choices.insert(grammar_.choices.end(), list.begin(), list.end());
      branches.push_back(branch);
      if (is_else) break;
    }
  }
  --depth_;
  grammar_.bodies.push_back(
      {static_cast<std::uint32_t>(grammar_.branches.size()), static_cast<std::uint32_t>(branches.size())});
  grammar_.branches.insert(grammar_.branches.end(), branches.begin(), branches.end());
  return static_cast<std::uint32_t>(grammar_.bodies.size()) - 1;
}

/// 30% : A  50% : B  else : C, or a plain successor.
void Parser::choices(std::vector<Choice>& out) {
  if (!tokens_.is(tokens_.behind_expression(at_), "%")) {
    out.push_back(successor());
    return;
  }
  while (tokens_.is(tokens_.behind_expression(at_), "%")) {
    const std::size_t from = at_, to = tokens_.behind_expression(at_);
    Value weight = value_of(from, to);
    at_ = to + 1;
    expect(":", "the percentage");
    // A percentage is a weight in hundredths; the sum is what counts in the end.
    if (weight.expression.is_constant) {
      weight.expression.value /= 100;
    } else {
      fault(tokens_.at(from), "a percentage is a constant");
    }
    Choice choice = successor();
    choice.weight = weight;
    out.push_back(choice);
  }
  if (tokens_.is_name(at_, "else") && tokens_.is(at_ + 1, ":")) {
    at_ += 2;
    out.push_back(successor());
  }
}

bool Parser::ends_successor() const {
  const Token& token = here();
  if (token.kind == TokenKind::end || is_here("|") || is_here("}") || is_here("]") || is_here(":") ||
      is_here(")") || tokens_.is_arrow(at_))
    return true;
  if (token.kind == TokenKind::name && (token.text == "case" || token.text == "else")) return true;
  if (token.kind != TokenKind::name && tokens_.is(tokens_.behind_expression(at_), "%")) return true;
  return begins_statement(at_);
}

Choice Parser::successor() {
  std::vector<Step> steps;
  int brackets = 0;
  while (true) {
    if (is_here("]") && brackets > 0) {
      --brackets;
      steps.push_back({.op = Op::pop, .offset = offset_here()});
      ++at_;
      continue;
    }
    if (is_here("[")) {
      if (++brackets > deepest) {
        fault(here(), "brackets go more than 100 deep");
        at_ = tokens_.end();
        break;
      }
      steps.push_back({.op = Op::push, .offset = offset_here()});
      ++at_;
      continue;
    }
    if (ends_successor()) break;
    if (!step(steps)) break;
  }
  if (brackets > 0) fault(here(), "found " + in_quotes(here()) + ", expected `]`");
  Choice choice;
  choice.first_step = static_cast<std::uint32_t>(grammar_.steps.size());
  choice.step_count = static_cast<std::uint32_t>(steps.size());
  grammar_.steps.insert(grammar_.steps.end(), steps.begin(), steps.end());
  return choice;
}

bool Parser::step(std::vector<Step>& out) {
  const Token& token = here();
  if (take("*") || take("ε")) {  // an empty successor, as in L-systems
    out.push_back({.op = Op::nil, .offset = static_cast<std::uint32_t>(token.offset)});
    return true;
  }
  if (token.kind != TokenKind::name) {
    fault(token, "found " + in_quotes(token) + ", expected a symbol, an operation or a bracket");
    return false;
  }
  if (token.text == "NIL" || token.text == "NULL" || token.text == "epsilon") {
    out.push_back({.op = Op::nil, .offset = static_cast<std::uint32_t>(token.offset)});
    ++at_;
    if (is_here("(") && tokens_.is(at_ + 1, ")")) at_ += 2;
    return true;
  }
  const OperationRow* row = tokens_.is(at_ + 1, "(") ? find_operation(token.text) : nullptr;
  if (row != nullptr) {
    operation_step(*row, out);
  } else {
    symbol_step(out);
  }
  return true;
}

void Parser::symbol_step(std::vector<Step>& out) {
  const Token token = here();
  Step step;
  step.offset = static_cast<std::uint32_t>(token.offset);
  step.symbol = symbol_of(token.text, step.offset);
  ++at_;
  std::vector<Argument> list;
  const auto point = [&] {
    if (!is_here(".") || here().offset != tokens_.at(at_ - 1).offset + tokens_.at(at_ - 1).length) return;
    ++at_;
    step.is_leaf = true;
  };
  point();
  if (!step.is_leaf && is_here("(")) {
    const std::size_t close = tokens_.partner(at_);
    ++at_;
    while (at_ < close && !is_here(")")) {
      Argument argument;
      argument.value = value();
      list.push_back(argument);
      if (!take(",")) break;
    }
    if (at_ < close) {
      fault(here(), "found " + in_quotes(here()) + ", expected `,` or `)`");
    }
    at_ = std::min(close + 1, tokens_.end());
    point();
  }
  step.first_argument = static_cast<std::uint32_t>(grammar_.arguments.size());
  step.argument_count = static_cast<std::uint32_t>(list.size());
  grammar_.arguments.insert(grammar_.arguments.end(), list.begin(), list.end());
  // A name without a rule is a leaf, unless it is most likely an operation written wrong or one not known.
  if (!list.empty() && !step.is_leaf && !symbols_with_rules_.contains(token.text)) {
    const std::string_view hint = mistyped_operation(token.text);
    if (!hint.empty() || is_here("{"))
      fault(token, "there is no operation and no rule " + in_quotes(token) +
                       (hint.empty() ? std::string() : "; did you mean " + lang::in_quotes(hint) + "?"));
  }
  out.push_back(step);
}

void Parser::operation_step(const OperationRow& row, std::vector<Step>& out) {
  const Token token = here();
  Step step;
  step.op = row.op;
  step.offset = static_cast<std::uint32_t>(token.offset);
  ++at_;
  std::vector<Argument> list;
  std::vector<Part> parts;
  if (!arguments(row, list, step, parts)) return;
  settle_axis(row, step, list);
  step.first_argument = static_cast<std::uint32_t>(grammar_.arguments.size());
  step.argument_count = static_cast<std::uint32_t>(list.size());
  grammar_.arguments.insert(grammar_.arguments.end(), list.begin(), list.end());
  if (row.braces != Braces::absent) {
    if (!is_here("{")) {
      fault(here(), "found " + lang::in_quotes(here()) + ", expected `{` after " + lang::in_quotes(row.name) +
                        "(...)");
      return;
    }
    const std::size_t close = tokens_.partner(at_);
    if (!enter(here())) return;
    ++at_;
    if (row.braces == Braces::cells) cells(parts, true);
    if (row.braces == Braces::selectors) selectors(parts);
    if (row.braces == Braces::names || (row.braces == Braces::one)) {
      std::vector<std::uint32_t> bodies;
      do bodies.push_back(body());
      while (take("|"));
      if (row.op == Op::comp) {
        old_selectors(step, list, parts);
        if (parts.size() == 1) {
          // One successor serves all; several are taken in turn, by number.
          const Part first = parts.front();
          parts.clear();
          for (std::size_t i = 0; i < bodies.size(); ++i) {
            Part part = first;
            part.body = bodies[i];
            if (bodies.size() > 1) part.index = static_cast<std::int32_t>(i);
            parts.push_back(part);
          }
        }
      } else if (row.op == Op::repeat || row.op == Op::roof) {
        Part part;
        part.body = bodies.front();
        if (bodies.size() > 1)
          fault(token,
                lang::in_quotes(row.name) + " has one successor, found " + std::to_string(bodies.size()));
        parts.assign(1, part);
      } else {
        std::size_t next = 0;
        fill_bodies(parts, bodies, next);
        if (next != bodies.size() || next == 0)
          fault(token, "found " + std::to_string(next) + " sizes and " + std::to_string(bodies.size()) +
                           " successors, expected as many of both");
      }
    }
    --depth_;
    if (!is_here("}")) {
      fault(here(), "found " + in_quotes(here()) + ", expected `|` or `}`");
      at_ = std::max(at_, std::min(close, tokens_.end()));
    }
    take("}");
    if (row.braces == Braces::cells && is_here("*")) {
      ++at_;
      Part group;
      group.is_group = true;
      group.offset = step.offset;
      group.first_part = static_cast<std::uint32_t>(grammar_.parts.size());
      group.part_count = static_cast<std::uint32_t>(parts.size());
      grammar_.parts.insert(grammar_.parts.end(), parts.begin(), parts.end());
      parts.assign(1, group);
    }
  }
  add_parts(step, parts);
  out.push_back(step);
}

bool Parser::arguments(const OperationRow& row, std::vector<Argument>& out, Step& step,
                       std::vector<Part>& cells) {
  const std::size_t close = tokens_.partner(at_);
  ++at_;
  std::size_t mandatory = row.arguments.find('|');
  std::string kinds;
  for (const char c : row.arguments) {
    if (c != '|') kinds += c;
  }
  if (mandatory == std::string_view::npos) mandatory = kinds.size();
  const bool has_sizes = row.braces == Braces::names;
  while (at_ < close) {
    const std::size_t before = at_;
    if (has_sizes && out.size() == 1) {
      this->cells(cells, false);
      break;
    }
    if (out.size() < kinds.size())
      out.push_back(argument(kinds[out.size()]));
    else
      ++at_;
    if (at_ == before) break;
    if (!take(",")) break;
    if (at_ >= close && has_sizes) break;
  }
  const bool is_short =
      out.size() < mandatory || (row.op == Op::color && out.size() > 1 && out.size() != 4 && out.size() != 3);
  if (at_ < close || is_short) {
    fault(is_short && at_ >= close ? tokens_.at(close) : here(),
          lang::in_quotes(row.name) + " takes (" + std::string(row.parameters) + "), found " +
              (is_short ? std::to_string(out.size()) + " of them" : in_quotes(here())));
  }
  at_ = std::min(close + 1, tokens_.end());
  (void)step;
  return true;
}

Argument Parser::word_argument() {
  Argument argument;
  const Token& token = here();
  if (token.kind == TokenKind::string) {
    argument.word = word_of(lang::string_value(token));
    ++at_;
  } else if (token.kind == TokenKind::name) {
    std::string word(token.text);
    ++at_;
    while (is_here(".") && tokens_.at(at_ + 1).kind == TokenKind::name) {
      word += "." + std::string(tokens_.at(at_ + 1).text);
      at_ += 2;
    }
    argument.word = word_of(word);
  } else {
    fault(token, "found " + in_quotes(token) + ", expected a word");
  }
  return argument;
}

/// 30, byAngle(30), byHeight(3), or as CityEngine has it: byHeight, 3
Argument Parser::slope() {
  Argument argument;
  const bool is_height = tokens_.is_name(at_, "byHeight");
  if (!is_height && !tokens_.is_name(at_, "byAngle")) {
    argument.value = value();
    return argument;
  }
  if (is_height) argument.measure = Measure::height;
  ++at_;
  const bool has_bracket = is_here("(");
  if (!take("(")) expect(",", is_height ? "byHeight" : "byAngle");
  argument.value = value();
  if (has_bracket) expect(")", is_height ? "the height" : "the angle");
  return argument;
}

Argument Parser::argument(char kind) {
  if (kind == 'i' && here().kind == TokenKind::number) {
    Argument index;
    index.word = word_of(here().text);
    ++at_;
    return index;
  }
  if (kind == 'w' || kind == 'i') return word_argument();
  if (kind == 'h') return slope();
  Argument argument;
  if (take("'"))
    argument.measure = Measure::relative;
  else if (take("~"))
    argument.measure = Measure::floating;
  argument.value = value();
  const Token& behind = here();
  const Token& last = tokens_.at(at_ > 0 ? at_ - 1 : 0);
  if (behind.kind == TokenKind::name && behind.text == "r" && behind.offset == last.offset + last.length) {
    argument.measure = Measure::floating;
    ++at_;
  }
  return argument;
}

void Parser::add_parts(Step& step, const std::vector<Part>& parts) {
  step.first_part = static_cast<std::uint32_t>(grammar_.parts.size());
  step.part_count = static_cast<std::uint32_t>(parts.size());
  grammar_.parts.insert(grammar_.parts.end(), parts.begin(), parts.end());
}

}  // namespace seedmesh::building
