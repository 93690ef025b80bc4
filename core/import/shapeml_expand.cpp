#include "core/import/shapeml_expand.h"

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace seedmesh {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr int deepest = 30;
constexpr std::size_t most_tokens = 1'000'000;

/// What stands for a name: the tokens between the braces, and the names of the parameters.
struct Operations {
  std::vector<std::string_view> parameters;
  std::vector<Token> body;
};

bool opens(const Token& token) {
  return is_symbol(token, "(") || is_symbol(token, "{") || is_symbol(token, "[");
}
bool closes(const Token& token) {
  return is_symbol(token, ")") || is_symbol(token, "}") || is_symbol(token, "]");
}

/// The partner of the bracket at `i`; the last token if it has none.
std::size_t partner_of(std::span<const Token> tokens, std::size_t i) {
  int depth = 0;
  for (std::size_t k = i; k < tokens.size(); ++k) {
    if (opens(tokens[k])) ++depth;
    if (closes(tokens[k]) && --depth == 0) return k;
  }
  return tokens.size() - 1;
}

class Expander {
 public:
  explicit Expander(ForeignText& source) : source_(source) {}

  /// The tokens without definitions of operations, which are kept here.
  std::vector<Token> without_definitions(std::span<const Token> tokens) {
    std::vector<Token> out;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      const std::string_view word = tokens[i].text;
      const bool declares = tokens[i].kind == TokenKind::name && (word == "func" || word == "const") &&
                            i + 2 < tokens.size() && tokens[i + 1].kind == TokenKind::name;
      std::size_t equals = i + 2;
      if (declares && is_symbol(tokens[equals], "(")) equals = partner_of(tokens, equals) + 1;
      if (!declares || equals + 1 >= tokens.size() || !is_symbol(tokens[equals], "=") ||
          !is_symbol(tokens[equals + 1], "{")) {
        out.push_back(tokens[i]);
        continue;
      }
      Operations& made = known_[std::string(tokens[i + 1].text)];
      for (std::size_t k = i + 2; k < equals; ++k) {
        if (tokens[k].kind == TokenKind::name) made.parameters.push_back(tokens[k].text);
      }
      const std::size_t close = partner_of(tokens, equals + 1);
      made.body.assign(tokens.begin() + static_cast<std::ptrdiff_t>(equals + 2),
                       tokens.begin() + static_cast<std::ptrdiff_t>(close));
      i = close;
      if (i + 1 < tokens.size() && is_symbol(tokens[i + 1], ";")) ++i;
    }
    return out;
  }

  void expand(std::span<const Token> tokens, int depth, std::vector<Token>& out) {
    for (std::size_t i = 0; i < tokens.size() && !is_stopped_; ++i) {
      const bool is_use = is_symbol(tokens[i], "^") && i + 1 < tokens.size() &&
                          tokens[i + 1].kind == TokenKind::name &&
                          (i == 0 || is_symbol(tokens[i - 1], ",") || is_symbol(tokens[i - 1], "(") ||
                           !is_value(tokens[i - 1]) || known_.contains(std::string(tokens[i + 1].text)));
      if (!is_use) {
        out.push_back(tokens[i]);
        if (out.size() > most_tokens) stop(tokens[i], "the operations are longer than 1,000,000 tokens");
        continue;
      }
      const bool is_argument = i > 0 && (is_symbol(tokens[i - 1], ",") || is_symbol(tokens[i - 1], "("));
      const Token name = tokens[i + 1];
      const bool has_list = i + 2 < tokens.size() && is_symbol(tokens[i + 2], "(");
      const std::size_t close = has_list ? partner_of(tokens, i + 2) : i + 1;
      if (is_argument) out.push_back(made(name, "{"));
      use(tokens, i + 1, close, depth, out);
      if (is_argument) out.push_back(made(name, "}"));
      i = close;
    }
  }

 private:
  static bool is_value(const Token& token) {
    return token.kind == TokenKind::number || token.kind == TokenKind::name || is_symbol(token, ")");
  }
  static Token made(const Token& from, std::string_view text) {
    Token token = from;
    token.kind = TokenKind::symbol;
    token.text = text;
    return token;
  }
  void stop(const Token& at, const char* why) {
    if (!std::exchange(is_stopped_, true)) source_.report(at.offset, why);
  }

  /// The operations of the name at `at`, with the arguments before `close`; another name is the rule itself.
  void use(std::span<const Token> tokens, std::size_t at, std::size_t close, int depth,
           std::vector<Token>& out) {
    const auto found = known_.find(std::string(tokens[at].text));
    if (found == known_.end()) {
      out.insert(out.end(), tokens.begin() + static_cast<std::ptrdiff_t>(at),
                 tokens.begin() + static_cast<std::ptrdiff_t>(close + 1));
      return;
    }
    if (depth >= deepest) return stop(tokens[at], "operations use each other more than 30 deep");
    const Operations& operations = found->second;
    std::vector<std::vector<Token>> arguments;
    for (std::size_t i = at + 2; i < close;) {
      std::size_t end = i;
      while (end < close && !is_symbol(tokens[end], ","))
        end = opens(tokens[end]) ? partner_of(tokens, end) + 1 : end + 1;
      arguments.emplace_back(tokens.begin() + static_cast<std::ptrdiff_t>(i),
                             tokens.begin() + static_cast<std::ptrdiff_t>(std::min(end, close)));
      i = end + 1;
    }
    if (arguments.size() != operations.parameters.size()) {
      source_.report(tokens[at].offset, "found " + std::to_string(arguments.size()) + " arguments of " +
                                            in_quotes(tokens[at]) + ", expected " +
                                            std::to_string(operations.parameters.size()));
      return;
    }
    std::vector<Token> body;
    for (const Token& token : operations.body) {
      std::size_t number = 0;
      while (number < arguments.size() && operations.parameters[number] != token.text) ++number;
      if (token.kind != TokenKind::name || number == arguments.size()) {
        body.push_back(token);
        continue;
      }
      body.push_back(made(token, "("));
      body.insert(body.end(), arguments[number].begin(), arguments[number].end());
      body.push_back(made(token, ")"));
    }
    expand(body, depth + 1, out);
  }

  ForeignText& source_;
  std::map<std::string, Operations> known_;
  bool is_stopped_ = false;
};

}  // namespace

void expand_shapeml_operations(std::vector<Token>& tokens, ForeignText& source) {
  bool has_sign = false;
  for (const Token& token : tokens) has_sign |= is_symbol(token, "^") || is_symbol(token, "{");
  if (!has_sign) return;
  Expander expander(source);
  const std::vector<Token> plain = expander.without_definitions(tokens);
  std::vector<Token> out;
  expander.expand(plain, 0, out);
  tokens = std::move(out);
}

}  // namespace seedmesh
