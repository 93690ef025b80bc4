/// Attributes, constants, functions and their annotations, which may stand behind where they are used.
#include <algorithm>

#include "core/generators/building/parser.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr std::size_t most_attributes = 1'000;
constexpr std::size_t most_parameters = 32;

bool is_declaring(std::string_view word) { return word == "attr" || word == "const"; }

}  // namespace

/// name = value, name(a, b) = value, attr name = value: returns the token behind.
std::size_t Parser::survey_definition(std::size_t i, bool is_constant, bool is_attribute) {
  const Token& name = tokens_.at(i);
  std::size_t body = i + 1;
  Function function;
  if (tokens_.is(body, "(")) {
    const std::size_t close = tokens_.partner(body);
    for (std::size_t k = body + 1; k < close; ++k) {
      if (tokens_.at(k).kind != TokenKind::name) continue;
      if (function.parameters.size() == most_parameters) {
        fault(tokens_.at(k), "more than 32 parameters");
        break;
      }
      function.parameters.push_back(tokens_.at(k).text);
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
  if (depth_ > 200) {
    fault(tokens_.at(declaration.from), "more than 200 attributes need each other in a row");
    return;
  }
  if (declaration.state == 1) {
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

}  // namespace seedmesh::building
