/// Statements: rules, attributes, constants, functions, annotations.
#include <algorithm>
#include <cmath>

#include "core/generators/building/parser.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr std::uint32_t most_queries = 32;
constexpr std::size_t most_attributes = 1'000, most_parameters = 32;

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

/// name = value, name(a, b) = value, attr name = value: returns the token behind.
std::size_t Parser::survey_definition(std::size_t i, bool is_constant, bool is_attribute) {
  const Token& name = tokens_.at(i);
  std::size_t body = i + 1;
  Function function;
  if (tokens_.is(body, "(")) {
    const std::size_t close = tokens_.partner(body);
    for (std::size_t k = body + 1; k < close; ++k) {
      if (tokens_.at(k).kind == TokenKind::name) function.parameters.push_back(tokens_.at(k).text);
    }
    body = close + 1;
    is_constant = is_attribute = false;
  }
  if (!tokens_.is(body, "=")) {
    fault(tokens_.at(body),
          "found " + in_quotes(tokens_.at(body)) + ", expected `=` and a value for " + in_quotes(name));
    return body;
  }
  function.from = body + 1;
  function.to = behind_value(body + 1);
  if (function.to == function.from) {
    fault(tokens_.at(body + 1), "found " + in_quotes(tokens_.at(body + 1)) + ", expected a value");
    return body + 1;
  }
  const std::string key(name.text);
  if (declared_.contains(key) || functions_.contains(key)) {
    fault(name, in_quotes(name) + " is declared twice");
  } else if (is_attribute || is_constant) {
    declared_.emplace(key, declarations_.size());
    declarations_.push_back(
        {key, function.from, function.to, static_cast<std::uint32_t>(declarations_.size()), 0});
    Attribute attribute;
    attribute.name = key;
    attribute.is_constant = is_constant;
    attribute.offset = static_cast<std::uint32_t>(name.offset);
    grammar_.attributes.push_back(std::move(attribute));
    notes_.emplace_back();
  } else {
    functions_.emplace(key, function);
  }
  return function.to;
}

void Parser::survey() {
  std::vector<std::size_t> notes;
  for (std::size_t i = 0; !tokens_.is_end(i);) {
    const Token& token = tokens_.at(i);
    if (tokens_.is(i, "@") && tokens_.at(i + 1).kind == TokenKind::name) {
      notes.push_back(i + 1);
      i += 2;
      if (tokens_.is(i, "(")) i = tokens_.partner(i) + 1;
      continue;
    }
    const bool declares = token.kind == TokenKind::name && is_declaring(token.text) &&
                          tokens_.at(i + 1).kind == TokenKind::name;
    if (declares) {
      const std::size_t before = declarations_.size();
      i = survey_definition(i + 1, token.text == "const", token.text == "attr");
      if (declarations_.size() > before) notes_.back() = notes;
    } else if (token.kind == TokenKind::name && begins_statement(i) && !begins_rule(i) &&
               (tokens_.is(i + 1, "=") || tokens_.is(i + 1, "("))) {
      i = survey_definition(i, false, false);
    } else {
      if (begins_rule(i)) {
        const std::uint32_t symbol = symbol_of(token.text, static_cast<std::uint32_t>(token.offset));
        symbols_with_rules_.emplace(token.text);
        for (const std::size_t note : notes) {
          if (tokens_.at(note).text == "StartRule") start_ = symbol;
        }
      }
      if (tokens_.is(i, "{") || tokens_.is(i, "(") || tokens_.is(i, "[")) {
        // Nothing is declared inside brackets.
        i = std::max(tokens_.partner(i), i);
      }
      ++i;
    }
    notes.clear();
  }
}

/// In the order in which they need each other.
void Parser::settle_attributes() {
  if (declarations_.size() > most_attributes)
    fault(tokens_.at(declarations_[most_attributes].from), "more than 1000 attributes");
  grammar_.first_attribute_slot = first_free_slot + most_queries;
  const std::vector<Attribute> declared = std::move(grammar_.attributes);
  grammar_.attributes.clear();
  for (std::size_t i = 0; i < declared.size(); ++i) {
    names_.bind_slot(declared[i].name, grammar_.first_attribute_slot + static_cast<std::uint32_t>(i));
  }
  // Values are worked out in the order of grammar_.attributes; slots stay those of the declaration.
  std::vector<Attribute> kept = declared;
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i].slot = grammar_.first_attribute_slot + static_cast<std::uint32_t>(i);
  grammar_.attributes = std::move(kept);
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < declarations_.size(); ++i) settle_attribute(i);
  std::vector<Attribute> sorted;
  for (const std::string& name : attribute_order_) {
    sorted.push_back(std::move(grammar_.attributes[declared_.find(name)->second]));
  }
  grammar_.attributes = std::move(sorted);
  grammar_.first_parameter_slot =
      grammar_.first_attribute_slot + static_cast<std::uint32_t>(grammar_.attributes.size());
}

void Parser::settle_attribute(std::size_t index) {
  Declaration& declaration = declarations_[index];
  if (declaration.state == 2) return;
  if (declaration.state == 1 || depth_ > 200) {
    fault(tokens_.at(declaration.from), "the value of `" + declaration.name + "` depends on itself");
    return;
  }
  declaration.state = 1;
  ++depth_;
  for (std::size_t i = declaration.from; i < declaration.to; ++i) {
    if (tokens_.at(i).kind != TokenKind::name || tokens_.is(i - 1, ".")) continue;
    const auto found = declared_.find(tokens_.at(i).text);
    if (found != declared_.end()) settle_attribute(found->second);
  }
  --depth_;
  declaration.state = 2;
  Attribute& attribute = grammar_.attributes[index];
  attribute.value = value_of(declaration.from, declaration.to);
  check_range(attribute, notes_[index]);
  attribute_order_.push_back(declaration.name);
}

/// @Range(1, 10) or @Range(min=1, max=10), @Enum("a", "b"); the others are for forms alone.
void Parser::check_range(Attribute& attribute, const std::vector<std::size_t>& notes) {
  constexpr std::string_view known[] = {"Range",   "Enum",        "Color",     "Group", "Order",
                                        "Hidden",  "Description", "StartRule", "Angle", "Distance",
                                        "Percent", "File",        "Handle"};
  for (const std::size_t note : notes) {
    const Token& name = tokens_.at(note);
    if (std::ranges::find(known, name.text) == std::end(known)) {
      fault(name, "unknown annotation " + in_quotes(name));
      continue;
    }
    if (!tokens_.is(note + 1, "(")) continue;
    std::vector<double> numbers;
    double sign = 1;
    for (std::size_t i = note + 2; i < tokens_.partner(note + 1); ++i) {
      const Token& token = tokens_.at(i);
      if (token.kind == TokenKind::number) numbers.push_back(sign * token.number);
      if (token.kind == TokenKind::string)
        numbers.push_back(grammar_.texts.number_of(lang::string_value(token)));
      sign = tokens_.is(i, "-") ? -1 : 1;
    }
    if (name.text == "Enum")
      attribute.choices = std::move(numbers);
    else if (name.text == "Range" && numbers.size() >= 2) {
      attribute.has_range = true;
      attribute.low = numbers[0];
      attribute.high = numbers[1];
    }
  }
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
    for (const Symbol& symbol : grammar_.symbols) settle_endless(symbol);
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
    if (step.op == Op::split || step.op == Op::repeat) search(search, step.first_part, step.part_count);
  }
}

Grammar read_rules(std::string_view text, std::string_view start, std::vector<lang::Fault>& faults) {
  Grammar grammar;
  Parser(text, grammar, faults).parse(start);
  std::ranges::stable_sort(faults, {}, &lang::Fault::offset);
  // A place in a text is worked out once for all warnings.
  for (Warning& warning : grammar.warnings) {
    const TextPlace place = place_of(text, static_cast<std::size_t>(warning.line));
    warning.line = place.line;
    warning.column = place.column;
  }
  return grammar;
}

}  // namespace seedmesh::building
