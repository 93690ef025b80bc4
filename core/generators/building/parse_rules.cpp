/// Statements: rules, attributes, constants, functions, annotations.
#include <algorithm>

#include "core/generators/building/parser.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr std::size_t most_parameters = 32;

/// The names of the fixed slots.
struct SlotName {
  const char* name;
  Slot slot;
};
constexpr SlotName slot_names[] = {
    {"scope.sx", slot_sx},
    {"scope.sy", slot_sy},
    {"scope.sz", slot_sz},
    {"scope.tx", slot_tx},
    {"scope.ty", slot_ty},
    {"scope.tz", slot_tz},
    {"split.index", slot_split_index},
    {"split.total", slot_split_total},
    {"comp.index", slot_comp_index},
    {"comp.total", slot_comp_total},
    {"geometry.area", slot_area},
    {"geometry.volume", slot_volume},
    {"shape.depth", slot_depth},
};

bool is_declaring(std::string_view word) { return word == "attr" || word == "const"; }

}  // namespace

Parser::Parser(std::string_view text, Grammar& grammar, std::vector<lang::Fault>& faults)
    : grammar_(grammar), faults_(faults), tokens_(text, faults) {
  for (const SlotName& each : slot_names) names_.bind_slot(each.name, each.slot);
}

void Parser::fault(const Token& token, std::string message) {
  if (faults_.size() >= lang::max_faults || token.offset == last_fault_) return;
  last_fault_ = token.offset;
  if (faults_.size() + 1 == lang::max_faults) message += " (more faults are not told)";
  faults_.push_back({token.offset, std::move(message)});
}

void Parser::warn(std::uint32_t offset, std::string message) {
  if (grammar_.warnings.size() >= lang::max_faults) return;
  grammar_.warnings.push_back({"/rules", std::move(message), static_cast<int>(offset), 0});
}

bool Parser::take(std::string_view symbol) {
  if (!is_here(symbol)) return false;
  ++at_;
  return true;
}

void Parser::expect(std::string_view symbol, std::string_view after) {
  if (take(symbol)) return;
  fault(here(), "found " + in_quotes(here()) + ", expected " + lang::in_quotes(symbol) + " after " +
                    std::string(after));
}

std::uint32_t Parser::symbol_of(std::string_view name, std::uint32_t offset) {
  const auto found = symbols_.find(name);
  if (found != symbols_.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(grammar_.symbols.size());
  symbols_.emplace(std::string(name), index);
  grammar_.symbols.push_back({std::string(name), {}, offset});
  return index;
}

std::uint32_t Parser::word_of(std::string_view word) {
  const auto found = words_.find(word);
  if (found != words_.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(grammar_.words.size());
  words_.emplace(std::string(word), index);
  grammar_.words.emplace_back(word);
  return index;
}

/// A name, its parameters, perhaps a condition, and an arrow.
bool Parser::begins_rule(std::size_t i) const {
  if (tokens_.at(i).kind != TokenKind::name) return false;
  ++i;
  if (tokens_.is(i, "(")) i = tokens_.partner(i) + 1;
  if (tokens_.is_arrow(i)) return true;
  if (!tokens_.is(i, ":")) return false;
  const std::size_t behind = tokens_.behind_expression(i + 1);
  // `B : 0.5 ~> C : 0.5` is a weight and another successor: no condition is a mere number.
  const bool is_number = behind == i + 2 && tokens_.at(i + 1).kind == TokenKind::number;
  return behind > i + 1 && !is_number && tokens_.is_arrow(behind);
}

bool Parser::begins_statement(std::size_t i) const {
  const Token& token = tokens_.at(i);
  if (token.kind == TokenKind::end || tokens_.is(i, "@")) return true;
  if (token.kind == TokenKind::number) return tokens_.is(i + 1, ":") && begins_rule(i + 2);
  if (token.kind != TokenKind::name) return false;
  const bool names_next = tokens_.at(i + 1).kind == TokenKind::name;
  if ((is_declaring(token.text) || token.text == "import" || token.text == "style") && names_next)
    return true;
  if (token.text == "version" && tokens_.at(i + 1).kind == TokenKind::string) return true;
  if (token.text == "PRIORITY" && tokens_.at(i + 1).kind == TokenKind::number) return true;
  std::size_t behind = i + 1;
  if (tokens_.is(behind, "(")) behind = tokens_.partner(behind) + 1;
  if (tokens_.is(behind, "=")) return true;
  return begins_rule(i);
}

void Parser::parse(std::string_view start) {
  survey();
  settle_attributes();
  std::int32_t priority = 0;
  while (!tokens_.is_end(at_)) {
    const std::size_t before = at_;
    const Token& token = here();
    if (take("@")) {
      ++at_;
      if (is_here("(")) at_ = tokens_.partner(at_) + 1;
    } else if (token.kind == TokenKind::name && token.text == "version") {
      at_ += 2;
    } else if (token.kind == TokenKind::name && (token.text == "import" || token.text == "style") &&
               tokens_.at(at_ + 1).kind == TokenKind::name) {
      fault(token, in_quotes(token) + ": a request has no other files; put the rules into this text");
      at_ += 2;
      while (!begins_statement(at_)) ++at_;
    } else if (token.kind == TokenKind::name && token.text == "PRIORITY" &&
               tokens_.at(at_ + 1).kind == TokenKind::number) {
      priority = static_cast<std::int32_t>(std::clamp(tokens_.at(at_ + 1).number, -1e6, 1e6));
      at_ += 2;
      take(":");
    } else if (token.kind == TokenKind::name && is_declaring(token.text) && !begins_rule(at_)) {
      at_ += 2;
      if (is_here("(")) at_ = tokens_.partner(at_) + 1;
      if (take("=")) at_ = behind_value(at_);
    } else if (token.kind == TokenKind::name && !begins_rule(at_) && begins_statement(at_)) {
      ++at_;
      if (is_here("(")) at_ = tokens_.partner(at_) + 1;
      if (take("=")) at_ = behind_value(at_);
    } else {
      rule(priority);
    }
    if (at_ == before) ++at_;
  }
  finish(start);
}

void Parser::rule(std::int32_t priority) {
  if (here().kind == TokenKind::number && tokens_.is(at_ + 1, ":")) at_ += 2;  // its label
  const Token name = here();
  if (!begins_rule(at_)) {
    fault(name, "found " + in_quotes(name) +
                    ", expected a rule: a symbol, an arrow (--> or ~>) and what follows it");
    ++at_;
    while (!begins_statement(at_)) ++at_;
    return;
  }
  Rule rule;
  rule.symbol = symbol_of(name.text, static_cast<std::uint32_t>(name.offset));
  rule.offset = static_cast<std::uint32_t>(name.offset);
  rule.priority = priority;
  ++at_;
  const std::size_t names = names_.size();
  if (is_here("(")) {
    const std::size_t close = tokens_.partner(at_);
    for (++at_; at_ < close; ++at_) {
      if (is_here(",")) continue;
      if (here().kind != TokenKind::name) {
        fault(here(), "found " + in_quotes(here()) + ", expected the name of a parameter");
      } else if (rule.parameter_count == most_parameters) {
        fault(here(), "more than 32 parameters");
      } else {
        names_.bind_slot(std::string(here().text), grammar_.first_parameter_slot + rule.parameter_count++);
      }
    }
    at_ = std::min(close + 1, tokens_.end());
  }
  grammar_.most_parameters = std::max(grammar_.most_parameters, rule.parameter_count);
  Value condition;
  if (take(":")) condition = value();
  if (!tokens_.is_arrow(at_)) {
    fault(here(), "found " + in_quotes(here()) + ", expected an arrow");
  } else {
    const bool is_old = !tokens_.is(at_, "-->");
    ++at_;
    rule.body = condition.is_given || is_old ? alternatives_2006(condition) : body();
    grammar_.symbols[rule.symbol].rules.push_back(static_cast<std::uint32_t>(grammar_.rules.size()));
    grammar_.rules.push_back(rule);
  }
  names_.forget_after(names);
  if (!begins_statement(at_)) {
    fault(here(), "found " + in_quotes(here()) + " that belongs to no successor");
    while (!begins_statement(at_)) ++at_;
  }
}

/// successor : weight ~> successor : weight ... under one condition; or a body of today's notation.
std::uint32_t Parser::alternatives_2006(const Value& condition) {
  if (!condition.is_given &&
      (tokens_.is_name(at_, "case") || tokens_.is(tokens_.behind_expression(at_), "%")))
    return body();
  Branch branch;
  branch.condition = condition;
  std::vector<Choice> choices;
  do {
    Choice choice = successor();
    if (take(":")) choice.weight = value();
    choices.push_back(choice);
  } while (tokens_.is_arrow(at_) && ++at_);
  branch.first_choice = static_cast<std::uint32_t>(grammar_.choices.size());
  branch.choice_count = static_cast<std::uint32_t>(choices.size());
  grammar_.choices.insert(grammar_.choices.end(), choices.begin(), choices.end());
  grammar_.branches.push_back(branch);
  grammar_.bodies.push_back({static_cast<std::uint32_t>(grammar_.branches.size()) - 1, 1});
  return static_cast<std::uint32_t>(grammar_.bodies.size()) - 1;
}

}  // namespace seedmesh::building
