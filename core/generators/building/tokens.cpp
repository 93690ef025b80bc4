#include "core/generators/building/tokens.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/generators/building/syntax.h"

namespace seedmesh::building {
namespace {

using lang::TokenKind;

bool opens(const lang::Token& token) {
  return is_symbol(token, "(") || is_symbol(token, "[") || is_symbol(token, "{");
}
bool closes(const lang::Token& token) {
  return is_symbol(token, ")") || is_symbol(token, "]") || is_symbol(token, "}");
}
bool fit(std::string_view open, std::string_view close) {
  return (open == "(" && close == ")") || (open == "[" && close == "]") || (open == "{" && close == "}");
}

bool is_sign(const lang::Token& token) {
  return is_symbol(token, "-") || is_symbol(token, "+") || is_symbol(token, "!");
}

/// Leaves out the empty brackets behind the names of attributes and constants: `size()` is `size`, as in CityEngine.
void drop_empty_brackets(std::vector<lang::Token>& tokens) {
  const auto is_empty_call = [&](std::size_t i) {
    return i + 2 < tokens.size() && tokens[i].kind == TokenKind::name && is_symbol(tokens[i + 1], "(") &&
           is_symbol(tokens[i + 2], ")");
  };
  std::set<std::string_view> values;
  bool has_calls = false;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    has_calls |= is_empty_call(i);
    if (i > 0 && tokens[i].kind == TokenKind::name && is_symbol(tokens[i + 1], "=") &&
        (tokens[i - 1].text == "const" || tokens[i - 1].text == "attr"))
      values.emplace(tokens[i].text);
  }
  if (!has_calls || values.empty()) return;
  std::vector<lang::Token> kept;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    kept.push_back(tokens[i]);
    const bool is_defined = i + 3 < tokens.size() && is_symbol(tokens[i + 3], "=");
    if (is_empty_call(i) && !is_defined && values.contains(tokens[i].text)) i += 2;
  }
  tokens = std::move(kept);
}

bool is_infix(const lang::Token& token) {
  constexpr std::string_view signs[] = {
      "||", "|", "&&", "&", "<", "<=", ">", ">=", "==", "!=", "+", "-", "*", "/", "%", "^"};
  if (token.kind == TokenKind::name) return token.text == "mod";
  return token.kind == TokenKind::symbol && std::ranges::find(signs, token.text) != std::end(signs);
}

}  // namespace

std::uint32_t Texts::id_of(std::string_view text) {
  if (shared_) {
    const auto known = shared_->ids.find(text);
    if (known != shared_->ids.end()) return known->second;
  }
  const auto found = own_.ids.find(text);
  if (found != own_.ids.end()) return found->second;
  own_.texts.emplace_back(text);
  const auto id = static_cast<std::uint32_t>(size());
  own_.ids.emplace(std::string(text), id);
  return id;
}

void Texts::share() {
  shared_ = std::make_shared<const Table>(std::move(own_));
  own_ = {};
}

std::uint32_t Grammar::symbol_named(std::string_view name) const {
  for (std::uint32_t i = 0; i < symbols.size(); ++i) {
    if (symbols[i].name == name) return i;
  }
  return none;
}

Tokens::Tokens(const RuleText& text, std::string_view style, std::vector<lang::TextError>& errors)
    : files_(text), main_size_(text.parts.front().count) {
  for (const RuleText::Part& part : text.parts) {  // a comment without an end ends with its file
    text_.resize(part.first, '\n');
    std::optional<std::size_t> unclosed;
    text_ += without_comments(text.text_of(part), &unclosed);
    if (unclosed) errors.push_back({part.first + *unclosed, "the comment that opens here is not closed"});
  }
  loaded_ = load_files(text, text_, style, errors);
  drop_empty_brackets(loaded_.tokens);
  partner_.assign(tokens_.size(), tokens_.size() - 1);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    if (opens(tokens_[i])) {
      open.push_back(i);
    } else if (closes(tokens_[i])) {
      if (open.empty()) {
        if (errors.size() < lang::max_errors) {
          errors.push_back({tokens_[i].offset,
                            "found " + in_quotes(tokens_[i]) + ", expected an opening bracket before it"});
        }
      } else {
        if (!fit(tokens_[open.back()].text, tokens_[i].text) && errors.size() < lang::max_errors) {
          errors.push_back({tokens_[i].offset, "found " + in_quotes(tokens_[i]) +
                                                   ", expected the partner of " +
                                                   in_quotes(tokens_[open.back()])});
        }
        partner_[open.back()] = i;
        open.pop_back();
      }
    }
  }
  for (const std::size_t i : open) {
    if (errors.size() < lang::max_errors)
      errors.push_back({tokens_[i].offset, in_quotes(tokens_[i]) + " is not closed"});
  }
}

int Tokens::line_of(std::size_t offset) const {
  const RuleText::Part& part = files_.part_at(offset);
  return text_position(files_.text_of(part), offset - part.first).line;
}

bool Tokens::is_missing(std::string_view name) const {
  return std::ranges::any_of(loaded_.missing,
                             [&](const std::string& prefix) { return name.starts_with(prefix); });
}

bool Tokens::is_each_comparison(std::size_t i) const {
  constexpr std::string_view signs[] = {"==", "!=", "<", "<=", ">", ">="};
  return is(i, ".") && at(i + 1).kind == TokenKind::symbol && at(i + 1).offset == at(i).offset + 1 &&
         std::ranges::find(signs, at(i + 1).text) != std::end(signs);
}

std::size_t Tokens::after_operand(std::size_t i) const {
  const lang::Token& token = at(i);
  if (token.kind == TokenKind::number || token.kind == TokenKind::string) return i + 1;
  if (is(i, "(") || is(i, "[")) return std::min(partner(i) + 1, end());
  if (token.kind != TokenKind::name || token.text == "case" || token.text == "else") return i;
  ++i;
  while (is(i, ".") && at(i + 1).kind == TokenKind::name &&
         at(i).offset == at(i - 1).offset + at(i - 1).length && at(i + 1).offset == at(i).offset + 1) {
    i += 2;
  }
  const bool is_comp = token.text == "comp";
  if (is(i, "(")) i = std::min(partner(i) + 1, end());
  if (is_comp && is(i, "{")) i = std::min(partner(i) + 1, end());
  return i;
}

std::size_t Tokens::after_expression(std::size_t i) const {
  while (true) {
    std::size_t operand = i;
    while (is_sign(at(operand))) ++operand;
    std::size_t behind = after_operand(operand);
    if (behind == operand) return i;
    while (is(behind, "[") && at(behind - 1).kind != TokenKind::number)
      behind = std::min(partner(behind) + 1, end());
    i = behind;
    if (is_each_comparison(i)) ++i;
    if (!is_infix(at(i))) return i;
    std::size_t next = i + 1;
    if (is(i, "*") && is(next, "*")) ++next;
    std::size_t probe = next;
    while (is_sign(at(probe))) ++probe;
    if (after_operand(probe) == probe) return i;
    // The percent sign of a weight, as in `30% : A`, does not get here: no operand follows it.
    i = next;
  }
}

}  // namespace seedmesh::building
