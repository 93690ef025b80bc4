#include "core/import/shapeml_expand.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace seedmesh {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr int deepest = 30;
constexpr std::size_t most_tokens = 1'000'000, most_calls = 1'000;

/// The definition of a name: the tokens between the braces, and the names of the parameters.
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

/// A rule with parameters that are operations (`^name` in its successor): it is written once for each set of operations.
struct OperationRule {
  std::vector<std::vector<Token>> definitions;  ///< of `rule Name(...) ... ;`
  std::vector<std::string_view> parameters;
  std::vector<std::uint8_t> is_operation;  ///< for each parameter
};

/// A call, and the number of one of its arguments.
struct Argument {
  std::string_view name;
  int index = 0;
};

class Expander {
 public:
  Expander(std::set<std::string>& made_names, ForeignText& source) : texts_(made_names), source_(source) {}

  /// The tokens without rules that take operations, which are kept here.
  std::vector<Token> without_operation_rules(std::span<const Token> tokens) {
    std::vector<Token> out;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      const std::size_t end = end_of_rule(tokens, i);
      const std::vector<std::string_view> parameters =
          end > i ? parameters_of(tokens, i + 2) : std::vector<std::string_view>();
      std::vector<std::uint8_t> is_operation(parameters.size(), 0);
      std::vector<std::string_view> around;  // brackets: in those of expressions, the sign is a power
      std::vector<Argument> arguments;       // what stands before them, and the argument at the token
      for (std::size_t k = i; k + 1 < end; ++k) {
        if (opens(tokens[k])) {
          around.push_back(tokens[k].text);
          arguments.push_back({tokens[k - 1].text, 0});
        }
        if (closes(tokens[k]) && !around.empty()) {
          around.pop_back();
          arguments.pop_back();
        }
        if (is_symbol(tokens[k], ",") && !arguments.empty()) ++arguments.back().index;
        const auto used = std::ranges::find(parameters, tokens[k + 1].text);
        const bool is_value_of = !around.empty() && around.back() == "(" && is_value(tokens[k - 1]);
        const bool is_body = is_body_of_split(tokens, k + 1, arguments);
        if (used != parameters.end() && ((is_symbol(tokens[k], "^") && !is_value_of) || is_body))
          is_operation[static_cast<std::size_t>(used - parameters.begin())] = 1;
      }
      if (std::ranges::find(is_operation, 1) == is_operation.end()) {
        out.push_back(tokens[i]);
        continue;
      }
      OperationRule& rule = rules_[std::string(tokens[i + 1].text)];
      rule.parameters = parameters;
      rule.is_operation.resize(parameters.size(), 0);
      for (std::size_t k = 0; k < parameters.size(); ++k) rule.is_operation[k] |= is_operation[k];
      rule.definitions.emplace_back(tokens.begin() + static_cast<std::ptrdiff_t>(i),
                                    tokens.begin() + static_cast<std::ptrdiff_t>(end));
      i = end - 1;
    }
    return out;
  }

  /// Writes the rules that calls with operations need, before the end of the tokens.
  void add_called_rules(std::vector<Token>& out) {
    const Token end = out.back();
    out.pop_back();
    for (std::size_t next = 0; next < calls_.size() && !is_stopped_; ++next) {
      const Call call = calls_[next];  // a copy: expansion can add calls
      const OperationRule& rule = rules_.find(call.rule)->second;
      for (const std::vector<Token>& definition : rule.definitions) {
        std::vector<Token> own;
        const std::size_t open = 2, close = partner_of(definition, open);
        own.insert(own.end(), definition.begin(), definition.begin() + open);
        own[1].text = *texts_.insert(call.name).first;
        add_list(definition, open, rule, own);
        own.insert(own.end(), definition.begin() + static_cast<std::ptrdiff_t>(close + 1), definition.end());
        const auto outer = std::exchange(bound_, call.operations);
        expand(own, 0, out);
        bound_ = outer;
      }
    }
    out.push_back(end);
  }

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
      if (const std::size_t behind = call_of_rule(tokens, i, out); behind > i) {
        i = behind - 1;
        continue;
      }
      // A constant of operations as an argument of a split.
      const Operations* const named =
          tokens[i].kind == TokenKind::name ? operations_named(tokens[i].text) : nullptr;
      const bool is_body = named != nullptr && named->parameters.empty() && i > 0 &&
                           is_symbol(tokens[i - 1], ",") && i + 1 < tokens.size() &&
                           (is_symbol(tokens[i + 1], ",") || is_symbol(tokens[i + 1], ")"));
      if (is_body) {
        out.push_back(made(tokens[i], "{"));
        use(tokens, i, i, depth, out);
        out.push_back(made(tokens[i], "}"));
        continue;
      }
      const bool is_use = is_symbol(tokens[i], "^") && i + 1 < tokens.size() &&
                          tokens[i + 1].kind == TokenKind::name &&
                          (i == 0 || is_symbol(tokens[i - 1], ",") || is_symbol(tokens[i - 1], "(") ||
                           !is_value(tokens[i - 1]) || operations_named(tokens[i + 1].text) != nullptr);
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
  /// Whether the token alone is an argument of a split or of a repetition that consists of operations.
  static bool is_body_of_split(std::span<const Token> tokens, std::size_t i,
                               const std::vector<Argument>& arguments) {
    if (arguments.empty() || tokens[i].kind != TokenKind::name || !is_symbol(tokens[i - 1], ","))
      return false;
    if (!is_symbol(tokens[i + 1], ",") && !is_symbol(tokens[i + 1], ")")) return false;
    const auto& [name, index] = arguments.back();
    if (name.starts_with("splitRepeat") || name.starts_with("repeat")) return index == 1;
    if (name == "splitFace") return index % 2 == 1;
    return name.starts_with("split") && index >= 2 && index % 2 == 0;
  }
  /// Behind the rule that begins at `i`; `i`: none does.
  static std::size_t end_of_rule(std::span<const Token> tokens, std::size_t i) {
    const bool begins = tokens[i].kind == TokenKind::name && tokens[i].text == "rule" &&
                        i + 2 < tokens.size() && tokens[i + 1].kind == TokenKind::name &&
                        is_symbol(tokens[i + 2], "(");
    if (!begins) return i;
    std::size_t k = i + 2;
    while (k < tokens.size() && !is_symbol(tokens[k], "{"))
      k = opens(tokens[k]) ? partner_of(tokens, k) + 1 : k + 1;
    if (k >= tokens.size()) return i;
    const std::size_t close = partner_of(tokens, k);
    return close + 1 < tokens.size() && is_symbol(tokens[close + 1], ";") ? close + 2 : close + 1;
  }
  /// The names in the list that opens at `open`.
  static std::vector<std::string_view> parameters_of(std::span<const Token> tokens, std::size_t open) {
    std::vector<std::string_view> out;
    const std::size_t close = partner_of(tokens, open);
    for (std::size_t k = open + 1; k < close; ++k) {
      if (tokens[k].kind == TokenKind::name) out.push_back(tokens[k].text);
    }
    return out;
  }
  /// The arguments of the list that opens at `open`.
  static std::vector<std::vector<Token>> arguments_of(std::span<const Token> tokens, std::size_t open) {
    const std::size_t close = partner_of(tokens, open);
    std::vector<std::vector<Token>> out;
    for (std::size_t i = open + 1; i < close;) {
      std::size_t end = i;
      while (end < close && !is_symbol(tokens[end], ","))
        end = opens(tokens[end]) ? partner_of(tokens, end) + 1 : end + 1;
      out.emplace_back(tokens.begin() + static_cast<std::ptrdiff_t>(i),
                       tokens.begin() + static_cast<std::ptrdiff_t>(std::min(end, close)));
      i = end + 1;
    }
    return out;
  }
  /// The list that opens at `open` without the parameters or arguments that are operations.
  static void add_list(std::span<const Token> tokens, std::size_t open, const OperationRule& rule,
                       std::vector<Token>& out) {
    const std::vector<std::vector<Token>> arguments = arguments_of(tokens, open);
    std::vector<Token> list;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
      if (rule.is_operation[k] != 0) continue;
      if (!list.empty()) list.push_back(made(tokens[open], ","));
      list.insert(list.end(), arguments[k].begin(), arguments[k].end());
    }
    if (list.empty()) return;
    out.push_back(tokens[open]);
    out.insert(out.end(), list.begin(), list.end());
    out.push_back(made(tokens[open], ")"));
  }

  /// Writes a call of a rule that takes operations. Returns the token behind it; `i`: it is none.
  std::size_t call_of_rule(std::span<const Token> tokens, std::size_t i, std::vector<Token>& out) {
    if (tokens[i].kind != TokenKind::name || i + 1 >= tokens.size() || !is_symbol(tokens[i + 1], "("))
      return i;
    const auto found = rules_.find(std::string(tokens[i].text));
    if (found == rules_.end()) return i;
    const std::vector<std::vector<Token>> arguments = arguments_of(tokens, i + 1);
    if (arguments.size() != found->second.parameters.size()) return i;
    Call call{found->first, {}, {}};
    std::string key = found->first;
    for (std::size_t k = 0; k < arguments.size(); ++k) {
      if (found->second.is_operation[k] == 0) continue;
      const Token& first = arguments[k].front();
      Operations operations;
      if (is_symbol(first, "{") && arguments[k].size() > 1) {
        operations.body.assign(arguments[k].begin() + 1, arguments[k].end() - 1);
        key += "/" + std::to_string(first.offset);
      } else {
        const Operations* const known = operations_named(first.text);
        if (known == nullptr) return i;
        operations = *known;
        key += "/" + std::string(first.text);
      }
      call.operations.insert_or_assign(std::string(found->second.parameters[k]), std::move(operations));
    }
    const auto [name, is_new] =
        names_.try_emplace(key, found->first + "_with_" + std::to_string(names_.size()));
    if (is_new) {
      if (calls_.size() >= most_calls) stop(tokens[i], "more than 1,000 rules take operations");
      call.name = name->second;
      calls_.push_back(std::move(call));
    }
    out.push_back(tokens[i]);
    out.back().text = *texts_.insert(name->second).first;
    add_list(tokens, i + 1, found->second, out);
    return partner_of(tokens, i + 1) + 1;
  }

  const Operations* operations_named(std::string_view name) const {
    if (const auto own = bound_.find(std::string(name)); own != bound_.end()) return &own->second;
    const auto found = known_.find(std::string(name));
    return found == known_.end() ? nullptr : &found->second;
  }

  void stop(const Token& at, const char* why) {
    if (!std::exchange(is_stopped_, true)) source_.report(at.offset, why);
  }

  /// The operations of the name at `at`, with the arguments before `close`; another name is the rule itself.
  void use(std::span<const Token> tokens, std::size_t at, std::size_t close, int depth,
           std::vector<Token>& out) {
    const Operations* const found = operations_named(tokens[at].text);
    if (found == nullptr) {
      out.insert(out.end(), tokens.begin() + static_cast<std::ptrdiff_t>(at),
                 tokens.begin() + static_cast<std::ptrdiff_t>(close + 1));
      return;
    }
    if (depth >= deepest) return stop(tokens[at], "operations use each other more than 30 deep");
    const Operations operations = *found;  // a copy: expansion can add names
    const std::vector<std::vector<Token>> arguments =
        close > at ? arguments_of(tokens, at + 1) : std::vector<std::vector<Token>>();
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

  /// A rule that is written for certain operations.
  struct Call {
    std::string rule, name;
    std::map<std::string, Operations> operations;  ///< by parameter
  };

  std::set<std::string>& texts_;  ///< what tokens of made names point to
  ForeignText& source_;
  std::map<std::string, Operations> known_, bound_;
  std::map<std::string, OperationRule> rules_;
  std::map<std::string, std::string> names_;  ///< of the written rules, by rule and operations
  std::vector<Call> calls_;
  bool is_stopped_ = false;
};

}  // namespace

void expand_shapeml_operations(std::vector<Token>& tokens, std::set<std::string>& made_names,
                               ForeignText& source) {
  bool has_sign = false;
  for (const Token& token : tokens) has_sign |= is_symbol(token, "^") || is_symbol(token, "{");
  if (!has_sign) return;
  Expander expander(made_names, source);
  const std::vector<Token> plain = expander.without_operation_rules(expander.without_definitions(tokens));
  std::vector<Token> out;
  expander.expand(plain, 0, out);
  expander.add_called_rules(out);
  tokens = std::move(out);
}

}  // namespace seedmesh
