#pragma once
/// The parser of expressions as trees, for value_tree.cpp and tree_names.cpp.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/generators/building/value_tree.h"

namespace seedmesh::building {

constexpr int deepest_tree = 200;
constexpr std::size_t most_tree_nodes = 1'000'000;

/// Binary operators by how tightly they bind.
struct Infix {
  std::string_view sign;
  int level;
  lang::Operation operation;
};
inline constexpr Infix infixes[] = {
    {"==", 0, lang::Operation::equal},   {"!=", 0, lang::Operation::not_equal},
    {"<", 0, lang::Operation::less},     {"<=", 0, lang::Operation::less_equal},
    {">", 0, lang::Operation::greater},  {">=", 0, lang::Operation::greater_equal},
    {"=", 0, lang::Operation::equal},    {"+", 1, lang::Operation::add},
    {"-", 1, lang::Operation::subtract}, {"*", 2, lang::Operation::multiply},
    {"/", 2, lang::Operation::divide},   {"%", 2, lang::Operation::modulo},
    {"mod", 2, lang::Operation::modulo},
};

class TreeParser {
  using Kind = ValueNode::Kind;
  using Token = lang::Token;
  using TokenKind = lang::TokenKind;
  using Operation = lang::Operation;

 public:
  TreeParser(Parser& p, std::size_t from, std::size_t to) : p_(p), at_(from), to_(to) {}

  std::vector<std::pair<std::string, std::uint32_t>> locals;  ///< parameters and values of with(...)

  std::uint32_t value() {
    if (!enter()) return 0;
    const std::uint32_t root = is_name("case") || is_name("else") || is_weight() ? cases() : either();
    --depth_;
    return root;
  }
  bool is_done() const { return at_ >= to_; }
  const Token& here() const { return p_.tokens.at(std::min(at_, to_)); }

 private:
  bool enter() {
    if (++depth_ <= deepest_tree) return true;
    add_error(p_, here(), "the expression is nested more than 200 deep");
    at_ = to_;
    --depth_;
    return false;
  }
  bool is(std::string_view symbol) const { return at_ < to_ && p_.tokens.is(at_, symbol); }
  bool is_name(std::string_view name) const { return at_ < to_ && p_.tokens.is_name(at_, name); }
  bool take(std::string_view symbol) {
    if (!is(symbol)) return false;
    ++at_;
    return true;
  }
  void expect(std::string_view symbol) {
    if (!take(symbol)) unexpected(lang::in_quotes(symbol));
  }
  void unexpected(const std::string& wanted) {
    add_error(p_, here(), "found " + in_quotes(here()) + ", expected " + wanted);
    at_ = to_;
  }

  std::uint32_t add(ValueNode node, const std::vector<std::uint32_t>& operands = {}) {
    if (p_.grammar.value_nodes.size() >= most_tree_nodes) {
      add_error(p_, here(), "the rules have more than 1,000,000 operations");
      at_ = to_;
      return 0;
    }
    node.first = static_cast<std::uint32_t>(p_.grammar.value_operands.size());
    node.count = static_cast<std::uint32_t>(operands.size());
    p_.grammar.value_operands.insert(p_.grammar.value_operands.end(), operands.begin(), operands.end());
    p_.grammar.value_nodes.push_back(node);
    return static_cast<std::uint32_t>(p_.grammar.value_nodes.size()) - 1;
  }
  ValueNode node(Kind kind, std::size_t token) const {
    ValueNode out;
    out.kind = kind;
    out.offset = static_cast<std::uint32_t>(p_.tokens.at(token).offset);
    return out;
  }
  std::uint32_t constant(std::size_t token, lang::TaggedValue value) {
    ValueNode out = node(Kind::constant, token);
    out.constant = value;
    return add(out);
  }

  /// Whether a percentage begins here: 30% : value
  bool is_weight() const {
    const std::size_t behind = p_.tokens.after_expression(at_);
    return behind > at_ && behind + 1 < to_ && p_.tokens.is(behind, "%") && p_.tokens.is(behind + 1, ":");
  }

  /// case a: x case b: y else: z, and 30%: x else: y. Cases inside a case end with their else.
  std::uint32_t cases() {
    const std::size_t begin = at_;
    const bool is_case = is_name("case");
    std::vector<std::uint32_t> operands;
    while (at_ < to_ && (is_case ? is_name("case") : is_weight())) {
      if (is_case) ++at_;
      operands.push_back(either());
      if (!is_case) expect("%");
      expect(":");
      operands.push_back(value());
    }
    if (is_name("else")) {
      ++at_;
      expect(":");
      operands.push_back(value());
    } else {
      add_error(p_, p_.tokens.at(begin), "found cases without else, expected a value for every case");
      at_ = to_;
    }
    return add(node(is_case ? Kind::choose : Kind::weigh, begin), operands);
  }

  std::uint32_t either() {
    std::uint32_t left = both();
    while (is("||")) {
      const std::size_t sign = at_++;
      left = add(node(Kind::either, sign), {left, both()});
    }
    return left;
  }
  std::uint32_t both() {
    std::uint32_t left = binary(0);
    while (is("&&")) {
      const std::size_t sign = at_++;
      left = add(node(Kind::both, sign), {left, binary(0)});
    }
    return left;
  }

  /// Whether a comparison of each value of an array begins here, as in `table .== "lamp"`.
  bool is_each() const { return at_ < to_ && p_.tokens.is_each_comparison(at_); }
  const Infix* infix(int level) const {
    if (at_ >= to_) return nullptr;
    const Token& token = is_each() ? p_.tokens.at(at_ + 1) : here();
    for (const Infix& each : infixes) {
      if (each.level == level && token.text == each.sign &&
          (token.kind == TokenKind::symbol || each.sign == "mod")) {
        // The sign of a weight, as in `30% : A`, has no operand.
        if (each.sign == "%" && p_.tokens.is(at_ + 1, ":")) return nullptr;
        return &each;
      }
    }
    return nullptr;
  }
  std::uint32_t binary(int level) {
    if (level == 3) return unary();
    std::uint32_t left = binary(level + 1);
    while (const Infix* const found = infix(level)) {
      const bool is_mask = is_each();
      if (is_mask) ++at_;
      ValueNode out = node(is_mask ? Kind::mask : Kind::binary, at_++);
      out.operation = found->operation;
      left = add(out, {left, binary(level + 1)});
    }
    return left;
  }
  std::uint32_t unary() {
    if (!is("-") && !is("!") && !is("+")) return power();
    if (!enter()) return 0;
    const std::size_t sign = at_++;
    std::uint32_t inner = unary();
    --depth_;
    if (p_.tokens.is(sign, "+")) return inner;
    return add(node(p_.tokens.is(sign, "-") ? Kind::negate : Kind::invert, sign), {inner});
  }
  std::uint32_t power() {
    const std::uint32_t base = postfix();
    if (!is("^")) return base;
    ValueNode out = node(Kind::binary, at_++);
    out.operation = Operation::power;
    if (!enter()) return 0;
    const std::uint32_t exponent = unary();
    --depth_;
    return add(out, {base, exponent});
  }
  std::uint32_t postfix() {
    std::uint32_t out = primary();
    while (is("[")) {
      const std::size_t open = at_++;
      std::vector<std::uint32_t> operands{out, places()};
      if (take(",")) operands.push_back(places());
      expect("]");
      out = add(node(Kind::index, open), operands);
    }
    return out;
  }

  /// An index: a number, a list of numbers, a range such as 0:3, or a comparison of each value (table .== 3).
  std::uint32_t places() {
    const std::size_t begin = at_;
    std::vector<std::uint32_t> values{value()};
    while (values.size() < 3 && take(":")) values.push_back(value());
    return values.size() == 1 ? values[0] : add(node(Kind::range, begin), values);
  }

  std::uint32_t primary() {
    const std::size_t begin = at_;
    if (at_ >= to_) {
      unexpected("a value");
      return 0;
    }
    const Token& token = here();
    if (token.kind == TokenKind::number) {
      ++at_;
      return constant(begin, {token.number, 0});
    }
    if (token.kind == TokenKind::string) {
      ++at_;
      return constant(begin, {0, p_.grammar.texts.id_of(lang::string_value(token))});
    }
    if (take("(")) {
      const std::uint32_t inner = value();
      expect(")");
      return inner;
    }
    if (is("[")) return array();
    if (token.kind == TokenKind::name) return name();
    unexpected("a value");
    return 0;
  }

  /// [1, 2; 3, 4], [0:3] or [0:0.5:3]
  std::uint32_t array() {
    const std::size_t begin = at_++;
    ValueNode out = node(Kind::array, begin);
    std::vector<std::uint32_t> values;
    std::uint32_t in_row = 0;
    if (take("]")) return add(out);
    while (at_ < to_) {
      values.push_back(value());
      ++in_row;
      if (values.size() <= 2 && is(":")) {
        ++at_;
        out.kind = Kind::range;
        continue;
      }
      if (take(";")) {
        if (out.id == 0) out.id = in_row;
        if (in_row != out.id) add_error(p_, here(), "found rows of different lengths in an array");
        in_row = 0;
      } else if (!take(",")) {
        break;
      }
    }
    if (out.id != 0 && in_row != 0 && in_row != out.id)
      add_error(p_, here(), "found rows of different lengths in an array");
    expect("]");
    return add(out, values);
  }

  std::string dotted_name();
  std::vector<std::uint32_t> arguments(bool takes_words);
  bool is_known_name() const;
  std::uint32_t name();
  std::uint32_t user_function(std::size_t begin, const std::string& name);
  std::uint32_t function_body(const RuleFunction& function, std::size_t done,
                              std::vector<std::pair<std::string, std::uint32_t>> known);
  std::uint32_t special_function(std::size_t begin, std::uint32_t number);
  std::uint32_t built_in_function(std::size_t begin, const std::string& name);
  bool query(std::size_t begin, const std::string& name, std::uint32_t& out);
  /// comp(fe){ front = 3 | all : 1 }
  std::uint32_t components();

 public:
  void check_end() {
    if (at_ < to_) unexpected("an operator or the end of the expression");
  }
  void allow_selectors() { in_selector_ = true; }

 private:
  Parser& p_;
  std::size_t at_, to_;
  int depth_ = 0;
  bool in_selector_ = false;
};

}  // namespace seedmesh::building
