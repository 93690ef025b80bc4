#include <algorithm>
#include <utility>

#include "core/generators/building/parser.h"

namespace seedmesh::building {
namespace {

using lang::TokenKind;

/// Signs of three bytes as print has them, and what the language writes with as many.
constexpr std::pair<std::string_view, std::string_view> signs_of_print[] = {
    {"\u2265", ">= "}, {"\u2264", "<= "}, {"\u2260", "!= "}};

/// Comments become spaces and signs of print those of the language, so that every byte stays where it is.
std::string plain(std::string_view text) {
  std::string out(text);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] == '"') {
      for (++i; i < out.size() && out[i] != '"' && out[i] != '\n'; ++i) i += out[i] == '\\' ? 1 : 0;
    } else if (out[i] == '/' && i + 1 < out.size() && out[i + 1] == '/') {
      for (; i < out.size() && out[i] != '\n'; ++i) out[i] = ' ';
    } else if (out[i] == '/' && i + 1 < out.size() && out[i + 1] == '*') {
      const std::size_t end = std::min(out.find("*/", i + 2), out.size() - 1);
      for (const std::size_t last = std::min(end + 2, out.size()); i < last; ++i) {
        if (out[i] != '\n') out[i] = ' ';
      }
      --i;
    } else if (out[i] == '\xE2') {
      for (const auto& [sign, meant] : signs_of_print) {
        if (text.substr(i).starts_with(sign)) out.replace(i, sign.size(), meant);
      }
    }
  }
  return out;
}

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

bool is_infix(const lang::Token& token) {
  constexpr std::string_view signs[] = {
      "||", "|", "&&", "&", "<", "<=", ">", ">=", "==", "!=", "+", "-", "*", "/", "%", "^"};
  if (token.kind == TokenKind::name) return token.text == "mod";
  return token.kind == TokenKind::symbol && std::ranges::find(signs, token.text) != std::end(signs);
}

}  // namespace

double Texts::number_of(std::string_view text) {
  const auto found = places_.find(text);
  if (found != places_.end()) return text_base + found->second;
  const auto place = static_cast<std::uint32_t>(texts_.size());
  places_.emplace(std::string(text), place);
  texts_.emplace_back(text);
  return text_base + place;
}

const std::string* Texts::of(double number) const {
  const double place = number - text_base;
  if (!(place >= 0) || !(place < static_cast<double>(texts_.size()))) return nullptr;
  return &texts_[static_cast<std::size_t>(place)];
}

std::uint32_t Grammar::symbol_named(std::string_view name) const {
  for (std::uint32_t i = 0; i < symbols.size(); ++i) {
    if (symbols[i].name == name) return i;
  }
  return none;
}

Tokens::Tokens(std::string_view text, std::vector<lang::Fault>& faults) : text_(plain(text)) {
  tokens_ = lang::tokenize(text_, 0, text_.size(), faults);
  partner_.assign(tokens_.size(), tokens_.size() - 1);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    if (opens(tokens_[i])) {
      open.push_back(i);
    } else if (closes(tokens_[i])) {
      if (open.empty()) {
        if (faults.size() < lang::max_faults)
          faults.push_back({tokens_[i].offset, "found " + in_quotes(tokens_[i]) + " that closes nothing"});
      } else {
        if (!fit(tokens_[open.back()].text, tokens_[i].text) && faults.size() < lang::max_faults)
          faults.push_back({tokens_[i].offset,
                            "found " + in_quotes(tokens_[i]) + " for " + in_quotes(tokens_[open.back()])});
        partner_[open.back()] = i;
        open.pop_back();
      }
    }
  }
  for (const std::size_t i : open) {
    if (faults.size() < lang::max_faults)
      faults.push_back({tokens_[i].offset, in_quotes(tokens_[i]) + " is not closed"});
  }
}

std::size_t Tokens::behind_operand(std::size_t i) const {
  const lang::Token& token = at(i);
  if (token.kind == TokenKind::number || token.kind == TokenKind::string) return i + 1;
  if (is(i, "(")) return std::min(partner(i) + 1, end());
  if (token.kind != TokenKind::name || token.text == "case" || token.text == "else") return i;
  ++i;
  while (is(i, ".") && at(i + 1).kind == TokenKind::name &&
         at(i).offset == at(i - 1).offset + at(i - 1).length && at(i + 1).offset == at(i).offset + 1) {
    i += 2;
  }
  if (is(i, "(")) i = std::min(partner(i) + 1, end());
  return i;
}

std::size_t Tokens::behind_expression(std::size_t i) const {
  while (true) {
    std::size_t operand = i;
    while (is_sign(at(operand))) ++operand;
    const std::size_t behind = behind_operand(operand);
    if (behind == operand) return i;
    i = behind;
    if (!is_infix(at(i))) return i;
    std::size_t next = i + 1;
    if (is(i, "*") && is(next, "*")) ++next;
    std::size_t probe = next;
    while (is_sign(at(probe))) ++probe;
    if (behind_operand(probe) == probe) return i;
    // The percent of a weight: `30% : A`; and a bar or a sign between cells is none of an expression.
    i = next;
  }
}

}  // namespace seedmesh::building
