#include "core/generators/building/compile_values.h"

#include <algorithm>

#include "core/generators/building/value_tree.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr std::size_t most_tokens = 20'000;      ///< of one expression, functions written out
constexpr std::size_t most_written = 4'000'000;  ///< of all expressions together
constexpr int deepest_call = 32;

/// The end of name.name... in a list of tokens.
std::size_t behind_dotted(std::span<const Token> tokens, std::size_t i) {
  ++i;
  while (i + 1 < tokens.size() && is_symbol(tokens[i], ".") && tokens[i + 1].kind == TokenKind::name) i += 2;
  return i;
}

std::size_t partner_in(std::span<const Token> tokens, std::size_t i) {
  int depth = 0;
  for (; i < tokens.size(); ++i) {
    if (is_symbol(tokens[i], "(")) ++depth;
    if (is_symbol(tokens[i], ")") && --depth == 0) return i;
  }
  return tokens.size();
}

std::string lower_first(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

/// An expression that is written out, with functions and queries replaced.
struct Writing {
  std::vector<Token> out;
  int depth = 0;  ///< of functions and cases
  bool is_broken = false;
};
using Replacements = std::vector<std::pair<std::string_view, std::vector<Token>>>;

void write_tokens(Parser& p, Writing& writing, std::span<const Token> tokens,
                  const Replacements& replacements);

Token made_token(Parser& p, TokenKind kind, std::string_view text, const Token& place) {
  Token token = place;
  token.kind = kind;
  token.text = *p.made_texts.emplace(text).first;
  token.length = token.text.size();  // the reader of dotted names compares offsets
  return token;
}

/// Writes a query such as Scope.occ("noparent") or inside(all, "mass") as a slot. Returns the token behind
/// it, or i if it is no query.
std::size_t write_query(Parser& p, Writing& writing, std::span<const Token> tokens, std::size_t i,
                        std::string_view dotted) {
  const std::string name = lower_first(std::string(dotted));
  Query::Kind kind{};
  if (name == "scope.occ" || name == "shape.occ") {
    kind = Query::Kind::occlusion;
  } else if (name == "scope.visible" || name == "shape.visible") {
    kind = Query::Kind::visible;
  } else if (name == "inside") {
    kind = Query::Kind::inside;
  } else if (name == "overlaps") {
    kind = Query::Kind::overlaps;
  } else if (name == "touches") {
    kind = Query::Kind::touches;
  } else {
    return i;
  }
  const std::size_t open = behind_dotted(tokens, i), close = partner_in(tokens, open);
  std::string target = "all";
  for (std::size_t k = open + 1; k < close && k < tokens.size(); ++k) {
    if (tokens[k].kind == TokenKind::string) target = lang::string_value(tokens[k]);
  }
  const std::uint32_t query = query_index(p, kind, target);
  p.grammar.query_uses.push_back(query);
  writing.out.push_back(made_token(p, TokenKind::name, "query " + std::to_string(query), tokens[i]));
  p.names.bind_slot("query " + std::to_string(query), first_free_slot + query);
  return std::min(close + 1, tokens.size());
}

void write_range(Parser& p, Writing& writing, std::size_t from, std::size_t to,
                 const Replacements& replacements) {
  std::vector<Token> tokens;
  to = std::min(to, from + most_tokens + 1);  // more are refused
  for (std::size_t i = from; i < to; ++i) tokens.push_back(p.tokens.at(i));
  write_tokens(p, writing, tokens, replacements);
}

/// Writes `case a: x case b: y else: z` and `30%: x else: y` as select(...). Returns 0 for other tokens.
std::size_t write_choice(Parser& p, Writing& writing, std::span<const Token> tokens,
                         const Replacements& replacements) {
  const bool is_case = tokens[0].kind == TokenKind::name && tokens[0].text == "case";
  const auto find = [&](std::size_t from, auto&& matches) {
    int depth = 0;
    for (std::size_t i = from; i < tokens.size(); ++i) {
      if (is_symbol(tokens[i], "(")) ++depth;
      if (is_symbol(tokens[i], ")")) --depth;
      if (depth == 0 && matches(tokens[i])) return i;
    }
    return tokens.size();
  };
  const auto colon = find(0, [](const Token& t) { return is_symbol(t, ":"); });
  if (colon == tokens.size()) return 0;
  const bool is_weight = colon > 0 && is_symbol(tokens[colon - 1], "%");
  const auto symbol = [&](std::string_view text) {
    return made_token(p, TokenKind::symbol, text, tokens[0]);
  };
  const auto name = [&](std::string_view text) { return made_token(p, TokenKind::name, text, tokens[0]); };
  if (!is_case && !is_weight) {
    if (!(tokens[0].kind == TokenKind::name && tokens[0].text == "else" && colon == 1)) return 0;
    write_tokens(p, writing, tokens.subspan(2), replacements);
    return tokens.size();
  }
  // The next alternative of the same kind; a percentage within a case belongs to that case.
  const auto next = find(colon + 1, [&](const Token& t) {
    if (t.kind == TokenKind::name && (t.text == "else" || (is_case && t.text == "case"))) return true;
    return false;
  });
  std::size_t split = next;
  if (!is_case) {  // another percentage before the else
    int depth = 0;
    std::size_t operand = colon + 1;
    for (std::size_t i = colon + 1; i < next; ++i) {
      if (is_symbol(tokens[i], "(")) ++depth;
      if (is_symbol(tokens[i], ")")) --depth;
      if (depth == 0 && is_symbol(tokens[i], "%") && i + 1 < tokens.size() && is_symbol(tokens[i + 1], ":")) {
        split = i - 1;  // a weight is one number or one bracket
        if (is_symbol(tokens[split], ")")) {
          int back = 0;
          while (split > operand) {
            if (is_symbol(tokens[split], ")")) ++back;
            if (is_symbol(tokens[split], "(") && --back == 0) break;
            --split;
          }
        }
        break;
      }
    }
  }
  ++writing.depth;
  for (const Token& each : {name("select"), symbol("(")}) writing.out.push_back(each);
  if (is_case) {
    write_tokens(p, writing, tokens.subspan(1, colon - 1), replacements);
  } else {
    for (const Token& each : {name("rand"), symbol("("), symbol(")"), symbol("<"), symbol("(")})
      writing.out.push_back(each);
    write_tokens(p, writing, tokens.subspan(0, colon - 1), replacements);
    Token hundred = made_token(p, TokenKind::number, "100", tokens[0]);
    hundred.number = 100;
    for (const Token& each : {symbol(")"), symbol("/"), hundred}) writing.out.push_back(each);
  }
  writing.out.push_back(symbol(","));
  write_tokens(p, writing, tokens.subspan(colon + 1, split - colon - 1), replacements);
  writing.out.push_back(symbol(","));
  if (split >= tokens.size()) {
    add_error(p, tokens[0], "found cases without else, expected a value for every case");
    writing.is_broken = true;
  } else {
    write_tokens(p, writing, tokens.subspan(split), replacements);
  }
  writing.out.push_back(symbol(")"));
  --writing.depth;
  return tokens.size();
}

std::size_t write_call(Parser& p, Writing& writing, std::span<const Token> tokens, std::size_t i,
                       const RuleFunction& function, const Replacements& replacements) {
  Replacements own;
  std::size_t behind = i + 1;
  if (behind < tokens.size() && is_symbol(tokens[behind], "(")) {
    const std::size_t close = partner_in(tokens, behind);
    std::size_t from = behind + 1, count = 0;
    int depth = 0;
    for (std::size_t k = from; k <= close && k < tokens.size(); ++k) {
      if (k < close && is_symbol(tokens[k], "(")) ++depth;
      if (k < close && is_symbol(tokens[k], ")")) --depth;
      if (k != close && (depth != 0 || !is_symbol(tokens[k], ","))) continue;
      if (k > from || k != close) {
        Writing argument;
        argument.depth = writing.depth + 1;
        write_tokens(p, argument, tokens.subspan(from, k - from), replacements);
        writing.is_broken |= argument.is_broken;
        argument.out.insert(argument.out.begin(), made_token(p, TokenKind::symbol, "(", tokens[i]));
        argument.out.push_back(made_token(p, TokenKind::symbol, ")", tokens[i]));
        if (count < function.parameters.size())
          own.emplace_back(function.parameters[count], std::move(argument.out));
        ++count;
      }
      from = k + 1;
    }
    if (count != function.parameters.size()) {
      add_error(p, tokens[i],
                in_quotes(tokens[i]) + " takes " + std::to_string(function.parameters.size()) +
                    " arguments, found " + std::to_string(count));
      writing.is_broken = true;
    }
    behind = std::min(close + 1, tokens.size());
  }
  if (writing.is_broken) return behind;
  writing.out.push_back(made_token(p, TokenKind::symbol, "(", tokens[i]));
  ++writing.depth;
  write_range(p, writing, function.from, function.to, own);
  --writing.depth;
  writing.out.push_back(made_token(p, TokenKind::symbol, ")", tokens[i]));
  return behind;
}

void write_tokens(Parser& p, Writing& writing, std::span<const Token> tokens,
                  const Replacements& replacements) {
  if (tokens.empty() || writing.is_broken) return;
  p.written += tokens.size();
  const bool is_long = writing.out.size() > most_tokens || tokens.size() > most_tokens;
  if (is_long || writing.depth > deepest_call || p.written > most_written) {
    add_error(p, tokens[0],
              writing.depth > deepest_call ? "functions call each other more than 32 deep"
              : is_long                    ? "the expression is too long when its functions are written out"
                        : "the rules are too long when all their functions are written out");
    writing.is_broken = true;
    return;
  }
  if (write_choice(p, writing, tokens, replacements) > 0) return;
  for (std::size_t i = 0; i < tokens.size() && !writing.is_broken;) {
    const Token& token = tokens[i];
    if (token.kind == TokenKind::string) {
      Token text = token;
      text.number = p.grammar.texts.id_of(lang::string_value(token));
      writing.out.push_back(text);
      ++i;
      continue;
    }
    if (token.kind != TokenKind::name) {
      writing.out.push_back(token);
      ++i;
      continue;
    }
    const auto replaced =
        std::ranges::find(replacements, token.text, [](const auto& each) { return each.first; });
    if (replaced != replacements.end()) {
      p.written += replaced->second.size();
      if (writing.out.size() > most_tokens) return write_tokens(p, writing, tokens.subspan(i), replacements);
      writing.out.insert(writing.out.end(), replaced->second.begin(), replaced->second.end());
      ++i;
      continue;
    }
    const std::size_t behind = behind_dotted(tokens, i);
    std::string dotted;
    for (std::size_t k = i; k < behind; ++k) dotted += tokens[k].text;
    const bool is_call = behind < tokens.size() && is_symbol(tokens[behind], "(");
    if (const std::size_t next = is_call ? write_query(p, writing, tokens, i, dotted) : i; next != i) {
      i = next;
      continue;
    }
    const auto function = p.functions.find(dotted);
    if (function != p.functions.end() && (is_call || function->second.parameters.empty())) {
      i = write_call(p, writing, tokens, i, function->second, replacements);
      continue;
    }
    if (dotted == "rand" && !is_call && p.names.find(dotted) == nullptr) {
      for (const Token& each : {token, made_token(p, TokenKind::symbol, "(", token),
                                made_token(p, TokenKind::symbol, ")", token)})
        writing.out.push_back(each);
    } else if (dotted == "true" || dotted == "false") {
      Token number = token;
      number.kind = TokenKind::number;
      number.number = dotted == "true" ? 1 : 0;
      writing.out.push_back(number);
    } else {
      // Names with the prefix of a file are longer than in the text; the reader of names goes by their length.
      const bool is_made = behind > i + 1 || token.length != token.text.size();
      writing.out.push_back(
          is_made ? made_token(p, TokenKind::name, behind > i + 1 ? lower_first(dotted) : dotted, token)
                  : token);
    }
    i = behind;
  }
}

}  // namespace

std::uint32_t query_index(Parser& p, Query::Kind kind, std::string target) {
  for (std::uint32_t i = 0; i < p.grammar.queries.size(); ++i) {
    if (p.grammar.queries[i].kind == kind && p.grammar.queries[i].target == target) return i;
    if (i > most_queries) return i;  // too many; check_grammar reports it
  }
  const auto index = static_cast<std::uint32_t>(p.grammar.queries.size());
  p.grammar.queries.push_back({kind, std::move(target), 0});
  return index;
}

std::size_t end_of_value(const Parser& p, std::size_t i) {
  const auto is_weight = [&](std::size_t at) {
    const std::size_t behind = p.tokens.after_expression(at);
    return behind > at && p.tokens.is(behind, "%") && p.tokens.is(behind + 1, ":");
  };
  // Cases inside a case end with their else.
  const auto skip = [&](auto&& self, std::size_t at, int depth) -> std::size_t {
    const bool is_case = p.tokens.is_name(at, "case");
    if (depth > 100 || (!is_case && !is_weight(at))) return p.tokens.after_expression(at);
    while (is_case ? p.tokens.is_name(at, "case") : is_weight(at)) {
      const std::size_t behind = p.tokens.after_expression(is_case ? at + 1 : at);
      at = is_case ? behind : behind + 1;
      if (!p.tokens.is(at, ":")) return at;
      const std::size_t value = self(self, at + 1, depth + 1);
      if (value == at + 1) return value;
      at = value;
    }
    if (!p.tokens.is_name(at, "else")) return at;
    return p.tokens.is(at + 1, ":") ? self(self, at + 2, depth + 1) : at + 1;
  };
  return skip(skip, i, 0);
}

Value compile_value(Parser& p, std::size_t from, std::size_t to) {
  Value value;
  value.is_given = true;
  value.offset = static_cast<std::uint32_t>(p.tokens.at(from).offset);
  value.first_query = static_cast<std::uint32_t>(p.grammar.query_uses.size());
  const TreeNeed need = tree_need(p, from, to);
  value.is_fallback = need == TreeNeed::fallback;
  if (need != TreeNeed::unneeded) value.tree = parse_tree(p, from, to);
  if (need == TreeNeed::always) return value;
  Writing writing;
  write_range(p, writing, from, to, {});
  if (writing.is_broken) return value;
  Token end = p.tokens.at(to);
  end.kind = TokenKind::end;
  end.text = {};
  writing.out.push_back(end);
  std::size_t at = 0;
  const std::size_t before = p.errors.size();
  value.expression = p.grammar.program.parse(writing.out, at, p.names, p.errors);
  if (p.errors.size() == before && at + 1 < writing.out.size()) {
    add_error(p, writing.out[at],
              "found " + in_quotes(writing.out[at]) + ", expected an operator or the end of the expression");
  }
  value.query_count = static_cast<std::uint32_t>(p.grammar.query_uses.size()) - value.first_query;
  return value;
}

Value parse_value(Parser& p) {
  const std::size_t from = p.at;
  const std::size_t to = end_of_value(p, from);
  if (to == from) {
    add_unexpected(p, "a value");
    return {};
  }
  p.at = to;
  return compile_value(p, from, to);
}

}  // namespace seedmesh::building
