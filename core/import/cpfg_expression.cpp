/// Converts expressions of cpfg. There a sign binds closer than `^`, which is left associative, `<>` means `!=`, and
/// `a ? b : c` chooses.
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

/// Whether the sign at token `i` has no left operand.
bool is_prefix(const std::vector<Token>& tokens, std::size_t i) {
  if (i == 0) return true;
  const Token& before = tokens[i - 1];
  return before.kind == TokenKind::symbol && before.text != ")" && before.text != "]";
}

/// The first `mark` outside of inner parentheses, and for `:` outside of inner choices; slice.to if there is none.
std::size_t find_mark(const TracedText& text, lsystem::Slice slice, char mark) {
  int depth = 0, choices = 0;
  for (std::size_t i = slice.from; i < slice.to; ++i) {
    const char c = text[i];
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (depth > 0) continue;
    if (c == mark && choices == 0) return i;
    if (c == '?') ++choices;
    if (c == ':') --choices;
  }
  return slice.to;
}

/// `a ? b : c` as select(a, b, c), in all parentheses; deeper ones than `depth` stay as they are.
TracedText with_choices(const TracedText& text, lsystem::Slice slice, int depth) {
  TracedText out;
  const std::size_t comma = find_mark(text, slice, ',');
  const std::size_t question = std::min(find_mark(text, slice, '?'), comma);
  const auto append = [&](lsystem::Slice part) {
    const TracedText converted = with_choices(text, part, depth - 1);
    out.copy(converted, 0, converted.size());
  };
  if (depth > 0 && comma < slice.to) {
    append({slice.from, comma});
    out.copy(text, comma, comma + 1);
    append({comma + 1, slice.to});
    return out;
  }
  const std::size_t colon = question < slice.to ? find_mark(text, {question + 1, slice.to}, ':') : slice.to;
  if (depth > 0 && colon < slice.to) {
    out.write("select(", text.origin(slice.from));
    append({slice.from, question});
    out.write(",", text.origin(question));
    append({question + 1, colon});
    out.write(",", text.origin(colon));
    append({colon + 1, slice.to});
    out.write(")", text.origin(slice.to - 1));
    return out;
  }
  for (std::size_t at = slice.from; at < slice.to;) {
    const std::size_t close = text[at] == '(' ? lsystem::closing(text.text(), at, slice.to) : slice.to;
    if (close == slice.to || depth <= 0) {
      out.copy(text, at, at + 1);
      ++at;
      continue;
    }
    out.copy(text, at, at + 1);
    append({at + 1, close});
    out.copy(text, close, close + 1);
    at = close + 1;
  }
  return out;
}

constexpr int deepest_choice = 200;

}  // namespace

TracedText CpfgWords::expression(const TracedText& text, lsystem::Slice slice) const {
  if (text.text().substr(slice.from, slice.to - slice.from).find('?') == std::string::npos)
    return powers(text, slice);
  const TracedText chosen = with_choices(text, slice, deepest_choice);
  return powers(chosen, {0, chosen.size()});
}

TracedText CpfgWords::powers(const TracedText& text, lsystem::Slice slice) {
  std::vector<lang::TextError> errors;
  const std::vector<Token> tokens = lang::tokenize(text.text(), slice.from, slice.to, errors);
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
