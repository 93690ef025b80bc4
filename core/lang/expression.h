#pragma once
/// Arithmetic and conditions, parsed once and evaluated millions of times. Knows neither L-systems nor shape grammars: the
/// caller gives the names that may occur and a slot for each, and the values of the slots when it evaluates.
///
///   expression = or ;                         or  = and { "||" and } ;          and = not { "&&" not } ;
///   not = [ "!" ] comparison ;                comparison = sum [ ("<"|"<="|">"|">="|"=="|"!="|"=") sum ] ;
///   sum = product { ("+"|"-") product } ;     product = unary { ("*"|"/"|"%") unary } ;
///   unary = [ "-"|"+"|"!" ] power ;           power = primary [ ("^"|"**") unary ] ;  right associative
///   primary = number | name | name "(" [ expression { "," expression } ] ")" | "(" expression ")" ;
///
/// All values are double; a condition holds when its value is not 0; comparisons give 1 or 0; && and || stop early.
/// Trigonometric functions take and give degrees. Division by zero and the like give infinities or NaN: the caller
/// decides what to refuse. Results are the same bits on every machine (core/base/math.h).
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/rng.h"
#include "core/lang/lexer.h"

namespace seedmesh::lang {

/// Where names live while expressions are parsed. A name is bound to a slot (a value known at evaluation) or to a constant
/// (folded into the code). Later bindings hide earlier ones of the same name.
class Names {
 public:
  void bind_slot(std::string name, std::uint32_t slot);
  void bind_constant(std::string name, double value);
  void forget_after(std::size_t count);              ///< keeps the first `count` bindings
  std::size_t size() const { return bindings_.size(); }

  struct Binding {
    std::string name;
    bool is_constant = false;
    std::uint32_t slot = 0;
    double value = 0;
  };
  const Binding* find(std::string_view name) const;  ///< null: unknown
  /// The bound name most like `name` for a hint, or empty.
  std::string_view nearest(std::string_view name) const;

 private:
  std::vector<Binding> bindings_;
};

/// A built-in function: one row serves the parser, the evaluator, the docs and GET /v1/vocabulary.
struct Function {
  std::string_view name;
  int arity;                 ///< number of arguments
  std::string_view text;     ///< one sentence for the reader
  std::string_view example;  ///< an expression that the tests evaluate
  double (*call)(const double* arguments, Rng& rng);
  bool random;               ///< draws from the stream: never folded
};
std::span<const Function> functions();

/// A handle to compiled code in a Program.
struct Expression {
  std::uint32_t first = 0, count = 0;  ///< instructions
  bool is_constant = false;            ///< `value` holds everywhere, no code needs to run
  double value = 0;
};

/// Compiled expressions of one grammar, in one flat array of instructions.
class Program {
 public:
  /// Parses tokens from `at` on, leaves `at` on the first token that does not belong, and compiles. On a fault: adds it (at the
  /// offending token; all that can be told at once), moves `at` to the token after the damage, returns a constant 0. Depth beyond
  /// `max_depth` is a fault. Never recurses deeper than max_depth.
  Expression parse(std::span<const Token> tokens, std::size_t& at, const Names& names, std::vector<Fault>& faults,
                   std::uint32_t max_depth = 200);

  /// `slots` as bound when it was parsed. Draws only from `rng`, in the order of evaluation.
  double evaluate(const Expression& expression, const double* slots, Rng& rng) const;

  /// The highest slot that the expression reads plus one, 0 when none.
  std::uint32_t slots_used(const Expression& expression) const;

  bool draws(const Expression& expression) const;  ///< calls a random function

 private:
  struct Instruction {
    std::uint16_t op = 0;
    std::uint16_t argument = 0;
    std::uint32_t target = 0;
    double number = 0;
  };
  std::vector<Instruction> code_;
};

}  // namespace seedmesh::lang
