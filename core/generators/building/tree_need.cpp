/// Decides which expressions need a tree; see value_tree.h.
#include <algorithm>

#include "core/generators/building/value_functions.h"
#include "core/generators/building/value_tree.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

/// Signs of texts in an expression.
struct Signs {
  bool has_plus = false, has_text = false, has_unknown = false, has_comparison = false, needs_tree = false;
};

bool is_operand_end(const Token& token) {
  return token.kind == TokenKind::number || token.kind == TokenKind::name ||
         token.kind == TokenKind::string || is_symbol(token, ")") || is_symbol(token, "]");
}

bool may_be_text(Parser& p, std::string_view attribute);

Signs signs_of(Parser& p, std::size_t from, std::size_t to, std::span<const std::string_view> parameters) {
  Signs signs;
  int weights = 0, cases = 0;
  for (std::size_t i = from; i < to; ++i) {
    const Token& token = p.tokens.at(i);
    // Each case written out is one call deeper.
    if (p.tokens.is_name(i, "case") && ++cases > 16) signs.needs_tree = true;
    // Cases in brackets of their own, or behind an operator.
    signs.needs_tree |= i > from && p.tokens.is_name(i, "case") && p.tokens.is(i - 1, "(") &&
                        (i == from + 1 || p.tokens.at(i - 2).kind != TokenKind::name);
    signs.needs_tree |= i > from + 1 && p.tokens.is_name(i, "case") && p.tokens.is(i - 1, ":") &&
                        !p.tokens.is_name(i - 2, "else");
    if (token.kind == TokenKind::string) signs.has_text = true;
    if (token.kind == TokenKind::symbol) {
      signs.has_plus |= token.text == "+" && i > from && is_operand_end(p.tokens.at(i - 1));
      signs.has_comparison |= token.text == "==" || token.text == "!=";
      signs.needs_tree |= token.text == "[" || token.text == "{";
      if (token.text == "%" && i + 1 < to && p.tokens.is(i + 1, ":")) {
        // Several percentages, and those directly in a case, need more than select().
        std::size_t operand = i - 1;
        for (int depth = 0; operand > from; --operand) {
          if (p.tokens.is(operand, ")")) ++depth;
          if (p.tokens.is(operand, "(")) --depth;
          if (depth == 0) break;
        }
        const bool is_in_case =
            operand > from + 1 && p.tokens.is(operand - 1, ":") && !p.tokens.is_name(operand - 2, "else");
        signs.needs_tree |= is_in_case || ++weights > 1;
      }
    }
    if (token.kind != TokenKind::name ||
        (i > from && p.tokens.is(i - 1, ".") && p.tokens.at(i - 1).offset + 1 == token.offset))
      continue;
    std::string dotted(token.text);
    for (std::size_t k = i; p.tokens.is(k + 1, ".") && p.tokens.at(k + 2).kind == TokenKind::name; k += 2)
      dotted += "." + std::string(p.tokens.at(k + 2).text);
    if (std::ranges::find(parameters, token.text) != parameters.end()) {
      signs.has_unknown = true;
      continue;
    }
    const auto function = p.functions.find(dotted);
    if (function != p.functions.end()) {
      signs.needs_tree |= function_needs_tree(p, dotted);
      signs.has_unknown |= !function->second.parameters.empty() || may_be_text(p, dotted);
      continue;
    }
    const std::size_t behind = i + 1 + 2 * static_cast<std::size_t>(std::ranges::count(dotted, '.'));
    if (p.tokens.is(behind, "(") && !p.declared.contains(dotted) && is_tree_name(dotted)) {
      signs.needs_tree = true;
      continue;
    }
    if (p.declared.contains(dotted)) {
      signs.has_text |= may_be_text(p, dotted);
      continue;
    }
    const lang::Names::Binding* const bound = p.names.find(dotted);
    if (bound != nullptr) {
      signs.has_unknown |= !bound->is_constant && bound->slot >= p.grammar.first_parameter_slot &&
                           p.grammar.first_parameter_slot > first_free_slot;
      continue;
    }
    signs.needs_tree |= is_tree_name(dotted) || dotted == "with" || p.tokens.is_missing(dotted);
  }
  return signs;
}

/// Whether the value of an attribute, or of a function without parameters, can be a text or an array.
bool may_be_text(Parser& p, std::string_view name) {
  const auto [known, is_new] = p.text_signs.try_emplace(std::string(name), false);
  if (!is_new) return known->second;
  std::size_t from = 0, to = 0;
  if (const auto found = p.declared.find(name); found != p.declared.end()) {
    from = p.declarations[found->second].from;
    to = p.declarations[found->second].to;
  } else if (const auto function = p.functions.find(name); function != p.functions.end()) {
    from = function->second.from;
    to = function->second.to;
  }
  const Signs signs = signs_of(p, from, to, {});
  const bool is_text = signs.has_text || signs.needs_tree || signs.has_unknown;
  p.text_signs[std::string(name)] = is_text;
  return is_text;
}

TreeNeed need_of(const Signs& signs) {
  if (signs.needs_tree || (signs.has_plus && signs.has_text)) return TreeNeed::always;
  if (!signs.has_plus || !signs.has_unknown) return TreeNeed::unneeded;
  return signs.has_comparison ? TreeNeed::always : TreeNeed::fallback;
}

}  // namespace

bool is_tree_name(std::string_view name) { return find_value_function(name) != none; }

bool function_needs_tree(Parser& p, std::string_view name) {
  const auto [known, is_new] = p.tree_signs.try_emplace(std::string(name), true);  // true: it calls itself
  if (!is_new) return known->second;
  const RuleFunction& function = p.functions.find(name)->second;
  if (!function.locals.empty()) return true;
  const Signs signs = signs_of(p, function.from, function.to, function.parameters);
  const bool needs = need_of(signs) == TreeNeed::always;
  p.tree_signs[std::string(name)] = needs;
  return needs;
}

TreeNeed tree_need(Parser& p, std::size_t from, std::size_t to) { return need_of(signs_of(p, from, to, {})); }

}  // namespace seedmesh::building
