/// Random trees, printed with as few brackets as the grammar allows, parsed, and compared with a direct
/// evaluation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "tests/core/lang/expressions.h"

namespace seedmesh::lang {
namespace {

struct Node {
  enum class Kind { number, name, negative, inverse, infix, call };
  Kind kind = Kind::number;
  std::string text;  ///< number, name, operator or function
  std::vector<Node> parts;
};

struct Sign {
  const char* text;
  int rank;
};
constexpr std::array<Sign, 14> signs = {{{"||", 1},
                                         {"&&", 2},
                                         {"<", 3},
                                         {"<=", 3},
                                         {">", 3},
                                         {">=", 3},
                                         {"==", 3},
                                         {"!=", 3},
                                         {"+", 4},
                                         {"-", 4},
                                         {"*", 5},
                                         {"/", 5},
                                         {"%", 5},
                                         {"^", 7}}};
constexpr int unary_rank = 6, primary_rank = 8;

int rank_of(const Node& node) {
  if (node.kind == Node::Kind::negative || node.kind == Node::Kind::inverse) return unary_rank;
  if (node.kind != Node::Kind::infix) return primary_rank;
  for (const Sign& sign : signs) {
    if (node.text == sign.text) return sign.rank;
  }
  return 0;
}

Node random_tree(Rng& rng, int depth) {
  const std::uint32_t choice = depth <= 0 ? rng.below(2) : rng.below(10);
  if (choice == 0) {
    constexpr std::array numbers = {"0", "1", "2", "3.5", ".25", "7.", "1e2", "1e-2"};
    return {Node::Kind::number, numbers[rng.below(numbers.size())], {}};
  }
  if (choice == 1) {
    constexpr std::array names = {"x", "y", "z", "two", "half"};
    return {Node::Kind::name, names[rng.below(names.size())], {}};
  }
  if (choice == 2) return {Node::Kind::negative, "-", {random_tree(rng, depth - 1)}};
  if (choice == 3) return {Node::Kind::inverse, "!", {random_tree(rng, depth - 1)}};
  if (choice == 4) {
    const Function& row = functions()[rng.below(static_cast<std::uint32_t>(functions().size()))];
    Node node = {Node::Kind::call, std::string(row.name), {}};
    for (int i = 0; i < row.arity; ++i) node.parts.push_back(random_tree(rng, depth - 1));
    return node;
  }
  const Sign& sign = signs[rng.below(signs.size())];
  Node left = random_tree(rng, depth - 1);
  return {Node::Kind::infix, sign.text, {std::move(left), random_tree(rng, depth - 1)}};
}

std::string print(const Node& node);

std::string bracketed(const Node& node, bool brackets) {
  return brackets ? "(" + print(node) + ")" : print(node);
}

std::string print(const Node& node) {
  const int rank = rank_of(node);
  switch (node.kind) {
    case Node::Kind::number:
    case Node::Kind::name:
      return node.text;
    case Node::Kind::negative:
    case Node::Kind::inverse:
      return node.text + bracketed(node.parts[0], rank_of(node.parts[0]) < unary_rank);
    case Node::Kind::call: {
      std::string text = node.text + "(";
      for (std::size_t i = 0; i < node.parts.size(); ++i) text += (i > 0 ? ", " : "") + print(node.parts[i]);
      return text + ")";
    }
    case Node::Kind::infix:
      break;
  }
  const int left = rank_of(node.parts[0]), right = rank_of(node.parts[1]);
  const bool is_power = rank == 7, is_comparison = rank == 3;
  const bool left_brackets = is_power || is_comparison ? left <= rank : left < rank;
  const bool right_brackets = is_power ? right < unary_rank : right <= rank;
  return bracketed(node.parts[0], left_brackets) + " " + node.text + " " +
         bracketed(node.parts[1], right_brackets);
}

double infix_value(const std::string& sign, double a, double b) {
  if (sign == "<") return a < b;
  if (sign == "<=") return a <= b;
  if (sign == ">") return a > b;
  if (sign == ">=") return a >= b;
  if (sign == "==") return a == b;
  if (sign == "!=") return a != b;
  if (sign == "+") return a + b;
  if (sign == "-") return a - b;
  if (sign == "*") return a * b;
  if (sign == "/") return a / b;
  return sign == "%" ? modulo(a, b) : power(a, b);
}

double evaluate(const Node& node, const std::array<double, 3>& slots, Rng& rng) {
  const auto part = [&](std::size_t i) { return evaluate(node.parts[i], slots, rng); };
  switch (node.kind) {
    case Node::Kind::number:
      return std::stod(node.text);
    case Node::Kind::name:
      return node.text == "two"    ? 2
             : node.text == "half" ? 0.5
                                   : slots[static_cast<std::size_t>(node.text[0] - 'x')];
    case Node::Kind::negative:
      return -part(0);
    case Node::Kind::inverse:
      return part(0) == 0 ? 1 : 0;
    case Node::Kind::call: {
      std::array<double, max_arity> arguments{};
      for (std::size_t i = 0; i < node.parts.size(); ++i) arguments[i] = part(i);
      for (const Function& row : functions()) {
        if (row.name == node.text && row.arity == static_cast<int>(node.parts.size())) {
          return row.call(arguments.data(), rng);
        }
      }
      return 0;
    }
    case Node::Kind::infix:
      break;
  }
  const double left = part(0);
  if (node.text == "&&") return left != 0 && part(1) != 0 ? 1 : 0;
  if (node.text == "||") return left != 0 || part(1) != 0 ? 1 : 0;
  return infix_value(node.text, left, part(1));
}

TEST(Property, APrintedTreeHasTheValueOfTheTree) {
  Rng rng = Rng::of_seed(2024);
  const Names names = few_names();
  int with_code = 0, not_a_number = 0;
  for (int i = 0; i < 30'000; ++i) {
    const Node tree = random_tree(rng, 1 + i % 6);
    const std::string text = print(tree);
    const Parsed parsed = parse(text, names);
    ASSERT_TRUE(parsed.faults.empty()) << text << ": " << parsed.faults[0].message;
    ASSERT_EQ(parsed.end, text.size()) << text;
    with_code += parsed.expression.form == Expression::Form::code ? 1 : 0;
    for (const std::array<double, 3>& slots : {std::array{3.0, 4.0, 0.0}, std::array{-1.5, 0.1, 1e6}}) {
      Rng ours = Rng::of_seed(9), theirs = ours;
      const double found = parsed.program.evaluate(parsed.expression, slots.data(), ours);
      const double wanted = evaluate(tree, slots, theirs);
      ASSERT_TRUE(found == wanted || (std::isnan(found) && std::isnan(wanted)))
          << text << " " << found << " " << wanted;
      ASSERT_EQ(ours.next(), theirs.next()) << text << " drew another number of times";
      not_a_number += std::isnan(found) ? 1 : 0;
    }
  }
  EXPECT_GT(with_code, 10'000);
  EXPECT_LT(not_a_number, 20'000);
}

TEST(Property, DamagedTextIsRefusedAndNeverReadPastItsEnd) {
  Rng rng = Rng::of_seed(77);
  const Names names = few_names();
  constexpr std::string_view characters = "()+-*/^%!<>=&|,.:;{}[]xyz 019e\"~";
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string text = print(random_tree(rng, 4));
    for (std::uint32_t hits = 1 + rng.below(3); hits > 0; --hits) {
      text[rng.below(static_cast<std::uint32_t>(text.size()))] = characters[rng.below(characters.size())];
    }
    const Parsed parsed = parse(text, names);
    ASSERT_LE(parsed.end, text.size());
    for (const TextError& fault : parsed.faults) ASSERT_LE(fault.offset, text.size());
    refused += parsed.faults.empty() ? 0 : 1;
    parsed.at(3, 4, 0);
  }
  EXPECT_GT(refused, 10'000);
}

}  // namespace
}  // namespace seedmesh::lang
