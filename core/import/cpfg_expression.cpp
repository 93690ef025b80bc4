/// Expressions of cpfg in ours. Its grammar: signs bind closer than `^`, which groups from the left; `<>` is
/// `!=`.
#include <algorithm>

#include "core/import/cpfg_words.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

using lang::Token;
using lang::TokenKind;

/// The first token of the primary that ends with token `last`: a number, a name, a call or parentheses.
std::size_t primary_from(const std::vector<Token>& tokens, std::size_t last) {
  if (!lang::is_symbol(tokens[last], ")")) return last;
  int depth = 0;
  for (std::size_t i = last + 1; i-- > 0;) {
    if (lang::is_symbol(tokens[i], ")")) ++depth;
    if (lang::is_symbol(tokens[i], "(") && --depth == 0)
      return i > 0 && tokens[i - 1].kind == TokenKind::name ? i - 1 : i;
  }
  return last;
}

/// Whether token `i`, a sign, has nothing to its left that it could take as an operand.
bool is_prefix(const std::vector<Token>& tokens, std::size_t i) {
  if (i == 0) return true;
  const Token& before = tokens[i - 1];
  return before.kind == TokenKind::symbol && before.text != ")" && before.text != "]";
}

}  // namespace

TracedText CpfgWords::expression(const TracedText& text, lsystem::Slice slice) const {
  std::vector<lang::Fault> faults;
  const std::vector<Token> tokens = lang::tokenize(text.text(), slice.from, slice.to, faults);
  std::vector<int> opened(tokens.size()), closed(tokens.size());  // before and after each token
  std::vector<std::size_t> chain(tokens.size());                  // where the left operand of a ^ begins
  for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
    if (!lang::is_symbol(tokens[i], "^")) continue;
    const std::size_t primary = primary_from(tokens, i - 1);
    std::size_t from = primary;
    while (from > 0 && lang::is_symbol(tokens[from - 1], "-") && is_prefix(tokens, from - 1)) --from;
    if (from > 0 && lang::is_symbol(tokens[from - 1], "^")) from = chain[from - 1];
    chain[i] = from;
    if (from == primary) continue;
    ++opened[from];
    ++closed[i - 1];
  }
  TracedText out;
  std::size_t at = slice.from;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    out.copy(text, at, tokens[i].offset);
    const std::size_t from = text.origin(tokens[i].offset);
    out.write(std::string(static_cast<std::size_t>(opened[i]), '('), from);
    at = tokens[i].offset + tokens[i].length;
    if (lang::is_symbol(tokens[i], "<") && lang::is_symbol(tokens[i + 1], ">") &&
        tokens[i + 1].offset == at) {
      out.write("!=", from);
      at = tokens[++i].offset + 1;
    } else {
      out.copy(text, tokens[i].offset, at);
    }
    out.write(std::string(static_cast<std::size_t>(closed[i]), ')'), from);
  }
  out.copy(text, at, slice.to);
  return out;
}

}  // namespace seedmesh
