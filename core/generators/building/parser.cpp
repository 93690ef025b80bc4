#include "core/generators/building/parser.h"

#include <algorithm>

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr int deepest = 100;  ///< nested brackets

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

}  // namespace

Parser::Parser(const RuleText& text, std::string_view style, Grammar& given,
               std::vector<lang::TextError>& found)
    : grammar(given), errors(found), tokens(text, style, found) {
  for (const SlotName& each : slot_names) names.bind_slot(each.name, each.slot);
}

void add_error(Parser& p, const Token& token, std::string message, IssueKind kind) {
  if (p.errors.size() >= lang::max_errors || token.offset == p.last_error) return;
  p.last_error = token.offset;
  if (p.errors.size() + 1 == lang::max_errors) message += " (further errors are not reported)";
  p.errors.push_back({token.offset, std::move(message), kind});
}

void add_unexpected(Parser& p, std::string_view expected) {
  add_error(p, here(p), "found " + in_quotes(here(p)) + ", expected " + std::string(expected));
}

void add_wrong_word(Parser& p, std::string_view word, std::string_view expected) {
  add_error(p, p.tokens.at(p.at > 0 ? p.at - 1 : 0),
            "found " + lang::in_quotes(word) + ", expected " + std::string(expected));
}

void add_warning(Parser& p, std::uint32_t offset, std::string message) {
  if (p.grammar.warnings.size() >= lang::max_errors) return;
  p.grammar.warnings.push_back({"/rules", std::move(message), static_cast<int>(offset), 0});
}

bool take(Parser& p, std::string_view symbol) {
  if (!is_here(p, symbol)) return false;
  ++p.at;
  return true;
}

void expect(Parser& p, std::string_view symbol, std::string_view after) {
  if (!take(p, symbol)) add_unexpected(p, lang::in_quotes(symbol) + " after " + std::string(after));
}

bool enter_bracket(Parser& p, const Token& token) {
  if (++p.depth <= deepest) return true;
  add_error(p, token, "brackets are nested more than 100 deep");
  --p.depth;
  p.at = p.tokens.end();
  return false;
}

std::uint32_t symbol_index(Parser& p, std::string_view name, std::uint32_t offset) {
  const auto found = p.symbols.find(name);
  if (found != p.symbols.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(p.grammar.symbols.size());
  p.symbols.emplace(std::string(name), index);
  p.grammar.symbols.push_back({std::string(name), {}, offset});
  return index;
}

std::uint32_t word_index(Parser& p, std::string_view word) {
  const auto found = p.words.find(word);
  if (found != p.words.end()) return found->second;
  const auto index = static_cast<std::uint32_t>(p.grammar.words.size());
  p.words.emplace(std::string(word), index);
  p.grammar.words.emplace_back(word);
  return index;
}

std::size_t behind_head(const Parser& p, std::size_t i) {
  ++i;
  if (p.tokens.is(i, "(")) i = p.tokens.partner(i) + 1;
  if (p.tokens.is_name(i, "with") && p.tokens.is(i + 1, "(")) i = p.tokens.partner(i + 1) + 1;
  return i;
}

bool begins_local(const Parser& p, std::size_t i) {
  return p.tokens.at(i).kind == TokenKind::name && p.tokens.is(i + 1, ":") && p.tokens.is(i + 2, "=");
}

/// A name, its parameters, perhaps a condition, and an arrow.
bool begins_rule(const Parser& p, std::size_t i) {
  if (p.tokens.at(i).kind != TokenKind::name) return false;
  i = behind_head(p, i);
  while (p.tokens.is(i, "+")) {  // a left side of several shapes
    const bool is_kept = p.tokens.is(i + 1, "[");
    if (p.tokens.at(is_kept ? i + 2 : i + 1).kind != TokenKind::name) break;
    i = behind_head(p, is_kept ? i + 2 : i + 1);
    if (is_kept && !p.tokens.is(i++, "]")) return false;
  }
  if (p.tokens.is_arrow(i)) return true;
  if (!p.tokens.is(i, ":")) return false;
  const std::size_t behind = p.tokens.after_expression(i + 1);
  // `B : 0.5 ~> C : 0.5` is a weight and another successor: no condition is a mere number.
  const bool is_number = behind == i + 2 && p.tokens.at(i + 1).kind == TokenKind::number;
  return behind > i + 1 && !is_number && p.tokens.is_arrow(behind);
}

bool begins_statement(const Parser& p, std::size_t i) {
  const Token& token = p.tokens.at(i);
  if (token.kind == TokenKind::end || p.tokens.is(i, "@")) return true;
  if (token.kind == TokenKind::number) return p.tokens.is(i + 1, ":") && begins_rule(p, i + 2);
  if (token.kind != TokenKind::name) return false;
  const bool names_next = p.tokens.at(i + 1).kind == TokenKind::name;
  if ((token.text == "attr" || token.text == "const" || token.text == "import" || token.text == "style") &&
      names_next)
    return true;
  if (token.text == "version" && p.tokens.at(i + 1).kind == TokenKind::string) return true;
  if (token.text == "PRIORITY" && p.tokens.at(i + 1).kind == TokenKind::number) return true;
  return p.tokens.is(behind_head(p, i), "=") || begins_rule(p, i);
}

}  // namespace seedmesh::building
