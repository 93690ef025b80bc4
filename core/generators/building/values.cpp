/// Expressions: functions of the user's are written out, texts become numbers, questions to other shapes
/// become names, `case` and percentages become select(); the rest is core/lang.
#include <algorithm>

#include "core/generators/building/parser.h"

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

}  // namespace

Token Parser::made(TokenKind kind, std::string_view text, const Token& place) {
  Token token = place;
  token.kind = kind;
  token.text = *kept_.emplace(text).first;
  token.length = token.text.size();  // whoever reads names looks at so many bytes
  return token;
}

std::uint32_t Parser::query_named(Query::Kind kind, std::string target) {
  for (std::uint32_t i = 0; i < grammar_.queries.size(); ++i) {
    if (grammar_.queries[i].kind == kind && grammar_.queries[i].target == target) return i;
    if (i > most_queries) return i;  // too many already, which finish() tells
  }
  const auto index = static_cast<std::uint32_t>(grammar_.queries.size());
  grammar_.queries.push_back({kind, std::move(target), 0});
  return index;
}

/// Where the value that begins at i ends: an expression, or the cases of a function or attribute.
std::size_t Parser::behind_value(std::size_t i) const {
  if (!tokens_.is_name(i, "case") && !(tokens_.is(tokens_.behind_expression(i), "%"))) {
    return tokens_.behind_expression(i);
  }
  while (true) {
    if (tokens_.is_name(i, "case")) {
      i = tokens_.behind_expression(i + 1);
    } else if (tokens_.is_name(i, "else")) {
      ++i;
    } else {
      const std::size_t weight = tokens_.behind_expression(i);
      if (weight == i || !tokens_.is(weight, "%")) return i;
      i = weight + 1;
    }
    if (!tokens_.is(i, ":")) return i;
    ++i;
    if (!tokens_.is_name(i, "case")) {
      const std::size_t behind = tokens_.behind_expression(i);
      if (behind == i) return i;
      if (!tokens_.is(behind, "%")) i = behind;
    }
  }
}

Value Parser::value() {
  const std::size_t from = at_;
  const std::size_t to = behind_value(from);
  if (to == from) {
    fault(here(), "found " + in_quotes(here()) + ", expected a value");
    return {};
  }
  at_ = to;
  return value_of(from, to);
}

Value Parser::value_of(std::size_t from, std::size_t to) {
  Value value;
  value.is_given = true;
  value.offset = static_cast<std::uint32_t>(tokens_.at(from).offset);
  value.first_query = static_cast<std::uint32_t>(grammar_.query_uses.size());
  Writing writing;
  writing.value = &value;
  write(writing, from, to, {});
  if (writing.is_broken) return value;
  Token end = tokens_.at(to);
  end.kind = TokenKind::end;
  end.text = {};
  writing.out.push_back(end);
  std::size_t at = 0;
  const std::size_t before = faults_.size();
  value.expression = grammar_.program.parse(writing.out, at, names_, faults_);
  if (faults_.size() == before && at + 1 < writing.out.size()) {
    fault(writing.out[at], "found " + in_quotes(writing.out[at]) + " that does not belong to the expression");
  }
  value.query_count = static_cast<std::uint32_t>(grammar_.query_uses.size()) - value.first_query;
  return value;
}

void Parser::write(Writing& writing, std::size_t from, std::size_t to, const Replacements& replacements) {
  std::vector<Token> tokens;
  to = std::min(to, from + most_tokens + 1);  // more are refused
  for (std::size_t i = from; i < to; ++i) tokens.push_back(tokens_.at(i));
  write_tokens(writing, tokens, replacements);
}

void Parser::write_tokens(Writing& writing, std::span<const Token> tokens, const Replacements& replacements) {
  if (tokens.empty() || writing.is_broken) return;
  written_ += tokens.size();
  const bool is_long = writing.out.size() > most_tokens || tokens.size() > most_tokens;
  if (is_long || writing.depth > deepest_call || written_ > most_written) {
    fault(tokens[0], writing.depth > deepest_call ? "functions call each other more than 32 deep"
                     : is_long ? "the expression is too long when its functions are written out"
                               : "the rules are too long when all their functions are written out");
    writing.is_broken = true;
    return;
  }
  if (write_choice(writing, tokens, replacements) > 0) return;
  for (std::size_t i = 0; i < tokens.size() && !writing.is_broken;) {
    const Token& token = tokens[i];
    if (token.kind == TokenKind::string) {
      Token number = token;
      number.kind = TokenKind::number;
      number.number = grammar_.texts.number_of(lang::string_value(token));
      writing.out.push_back(number);
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
      written_ += replaced->second.size();
      if (writing.out.size() > most_tokens) return write_tokens(writing, tokens.subspan(i), replacements);
      writing.out.insert(writing.out.end(), replaced->second.begin(), replaced->second.end());
      ++i;
      continue;
    }
    const std::size_t behind = behind_dotted(tokens, i);
    std::string dotted;
    for (std::size_t k = i; k < behind; ++k) dotted += tokens[k].text;
    const bool is_call = behind < tokens.size() && is_symbol(tokens[behind], "(");
    if (const std::size_t next = is_call ? write_query(writing, tokens, i, dotted) : i; next != i) {
      i = next;
      continue;
    }
    const auto function = functions_.find(dotted);
    if (function != functions_.end() && (is_call || function->second.parameters.empty())) {
      i = write_call(writing, tokens, i, function->second, replacements);
      continue;
    }
    if (dotted == "true" || dotted == "false") {
      Token number = token;
      number.kind = TokenKind::number;
      number.number = dotted == "true" ? 1 : 0;
      writing.out.push_back(number);
    } else {
      writing.out.push_back(behind > i + 1 ? made(TokenKind::name, lower_first(dotted), token) : token);
    }
    i = behind;
  }
}

/// `case a: x case b: y else: z` and `30%: x else: y` as select(...); 0 where the tokens are neither.
std::size_t Parser::write_choice(Writing& writing, std::span<const Token> tokens,
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
  const auto symbol = [&](std::string_view text) { return made(TokenKind::symbol, text, tokens[0]); };
  const auto name = [&](std::string_view text) { return made(TokenKind::name, text, tokens[0]); };
  if (!is_case && !is_weight) {
    if (!(tokens[0].kind == TokenKind::name && tokens[0].text == "else" && colon == 1)) return 0;
    write_tokens(writing, tokens.subspan(2), replacements);
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
    write_tokens(writing, tokens.subspan(1, colon - 1), replacements);
  } else {
    for (const Token& each : {name("rand"), symbol("("), symbol(")"), symbol("<"), symbol("(")})
      writing.out.push_back(each);
    write_tokens(writing, tokens.subspan(0, colon - 1), replacements);
    Token hundred = made(TokenKind::number, "100", tokens[0]);
    hundred.number = 100;
    for (const Token& each : {symbol(")"), symbol("/"), hundred}) writing.out.push_back(each);
  }
  writing.out.push_back(symbol(","));
  write_tokens(writing, tokens.subspan(colon + 1, split - colon - 1), replacements);
  writing.out.push_back(symbol(","));
  if (split >= tokens.size()) {
    fault(tokens[0], "the cases have no else, so that there may be no value");
    writing.is_broken = true;
  } else {
    write_tokens(writing, tokens.subspan(split), replacements);
  }
  writing.out.push_back(symbol(")"));
  --writing.depth;
  return tokens.size();
}

std::size_t Parser::write_call(Writing& writing, std::span<const Token> tokens, std::size_t i,
                               const Function& function, const Replacements& replacements) {
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
        argument.value = writing.value;
        argument.depth = writing.depth + 1;
        write_tokens(argument, tokens.subspan(from, k - from), replacements);
        writing.is_broken |= argument.is_broken;
        argument.out.insert(argument.out.begin(), made(TokenKind::symbol, "(", tokens[i]));
        argument.out.push_back(made(TokenKind::symbol, ")", tokens[i]));
        if (count < function.parameters.size())
          own.emplace_back(function.parameters[count], std::move(argument.out));
        ++count;
      }
      from = k + 1;
    }
    if (count != function.parameters.size()) {
      fault(tokens[i], in_quotes(tokens[i]) + " takes " + std::to_string(function.parameters.size()) +
                           " arguments, found " + std::to_string(count));
      writing.is_broken = true;
    }
    behind = std::min(close + 1, tokens.size());
  }
  if (writing.is_broken) return behind;
  writing.out.push_back(made(TokenKind::symbol, "(", tokens[i]));
  ++writing.depth;
  write(writing, function.from, function.to, own);
  --writing.depth;
  writing.out.push_back(made(TokenKind::symbol, ")", tokens[i]));
  return behind;
}

/// Scope.occ("noparent"), overlaps(), inside(all, "mass") and their like; i where it is none of them.
std::size_t Parser::write_query(Writing& writing, std::span<const Token> tokens, std::size_t i,
                                std::string_view dotted) {
  const std::string name = lower_first(std::string(dotted));
  Query::Kind kind;
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
  const std::uint32_t query = query_named(kind, target);
  grammar_.query_uses.push_back(query);
  writing.out.push_back(made(TokenKind::name, "query " + std::to_string(query), tokens[i]));
  // Its slot is known only when all queries are: attributes and parameters stand behind them.
  names_.bind_slot("query " + std::to_string(query), first_free_slot + query);
  return std::min(close + 1, tokens.size());
}

}  // namespace seedmesh::building
