#pragma once
/// Arithmetic and conditions, parsed once and evaluated millions of times. Knows neither L-systems nor shape
/// grammars: the caller gives the names that may occur and a slot for each, and the values of the slots when
/// it evaluates.
///
///   expression = or ;                         or  = and { ("||"|"|") and } ;    and = comparison {
///   ("&&"|"&") comparison } ; comparison = sum [ ("<"|"<="|">"|">="|"=="|"!="|"=") sum ] ; sum = product {
///   ("+"|"-") product } ;     product = unary { ("*"|"/"|"%"|"mod") unary } ; unary = { "-"|"+"|"!" } power
///   ; power = primary [ ("^"|"**") unary ] ;  right associative primary = number | dotted | name "(" [
///   expression { "," expression } ] ")" | "(" expression ")" ; dotted = name { "." name } ; without space
///   around the points: one name, as in Scope.sx
///
/// All values are double; a condition holds when its value is not 0; comparisons give 1 or 0; && and || stop
/// early and give 1 or 0. `!` binds like a minus sign, as in C: !a < b is (!a) < b. Comparisons do not chain.
/// `%` is the modulo of mod() (result has the sign of the divisor), and only where an operand follows: in
/// `30% : A` the expression is 30. Trigonometric functions take and give degrees. Division by zero and the
/// like give infinities or NaN: the caller decides what to refuse. Results are the same bits on every machine
/// (core/base/math.h).
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/rng.h"
#include "core/lang/lexer.h"

namespace seedmesh::lang {

/// Where names live while expressions are parsed. A name is bound to a slot (a value known at evaluation) or
/// to a constant (folded into the code). Later bindings hide earlier ones of the same name.
class Names {
 public:
  void bind_slot(std::string name, std::uint32_t slot);
  void bind_constant(std::string name, double value);
  void forget_after(std::size_t count);  ///< keeps the first `count` bindings
  std::size_t size() const { return bindings_.size(); }

  struct Binding {
    std::string name;
    bool is_constant = false;
    std::uint32_t slot = 0;
    double value = 0;
  };
  const Binding* find(std::string_view name) const;  ///< null: unknown; valid until the next change
  /// The constant of this name though a slot hides it; null: there is none.
  const Binding* find_constant(std::string_view name) const;

  /// A function of the user's, written out where it is called. Its body knows its parameters and constants.
  struct Defined {
    std::vector<std::string> parameters;  ///< at most most_parameters
    std::vector<Token> body;              ///< ended by TokenKind::end; the text must outlive the Names
    bool is_sound = true;                 ///< false: its own text has a fault, so calls are not judged
  };
  static constexpr std::size_t most_parameters = 8;
  void define(std::string name, Defined function);  ///< takes the place of an earlier one of the same name
  void spoil(std::string_view name);                ///< is_sound becomes false
  const Defined* find_function(std::string_view name) const;
  /// The bound name most like `name` for a hint, or empty. Looks at the latest 256 bindings.
  std::string_view nearest(std::string_view name) const;
  /// Asked before each hint: false when there were most_hints. A hint costs more than many a text.
  bool may_hint() const { return hints_ < most_hints && ++hints_ > 0; }
  static constexpr std::uint32_t most_hints = 20;

 private:
  void bind(Binding binding);

  std::vector<Binding> bindings_;
  std::map<std::string, std::vector<std::uint32_t>, std::less<>>
      places_;  ///< of each name in bindings_, the latest last
  std::map<std::string, Defined, std::less<>> functions_;
  mutable std::uint32_t hints_ = 0;
};

/// Reads `name ( parameter, ... ) = body` and returns the name; the body is only cut into tokens. Faults: at
/// the token that is wrong, a name that a built-in function has, a parameter twice, too many of them.
std::string read_definition(std::string_view text, Names::Defined& function, std::vector<Fault>& faults);

/// How alike two names are for a hint: 0 = equal, 1 = equal but for case; else 1 for each letter of another
/// case, 2 for each letter put in, left out, exchanged or swapped with its neighbour. Names longer than 64
/// bytes are like nothing.
std::uint32_t name_distance(std::string_view a, std::string_view b);
/// The greatest distance at which a hint for a name of that length is of use.
std::uint32_t hint_distance(std::string_view name);

/// A built-in function: one row serves the parser, the evaluator, the docs and GET /v1/vocabulary. A name may
/// have several rows of different arity (ran); they stand together.
struct Function {
  std::string_view name;
  int arity;                   ///< number of arguments, at most max_arity
  std::string_view arguments;  ///< their names, as the docs print them: "low, high"
  std::string_view text;       ///< one sentence for the reader
  std::string_view example;    ///< an expression that the tests evaluate
  double (*call)(const double* arguments, Rng& rng);
  bool random;  ///< draws from the stream: never folded
};
std::span<const Function> functions();
constexpr int max_arity = 3;

/// The operators `%` and `^`: as mod() and pow().
double modulo(double dividend, double divisor);
double power(double base, double exponent);

enum class Operation : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
  modulo,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  subtract_from,
  divide_into,  ///< right - left and right / left
  copy,
  stop_if_false,
  stop_if_true,
  call,
};

/// A handle to compiled code in a Program. Constants, single slots and one operation on a slot need no code.
struct Expression {
  /// How evaluate() gets the value.
  enum class Form : std::uint8_t { constant, slot, slot_and_value, slot_and_slot, code };

  std::uint32_t first = 0, count = 0;  ///< instructions
  bool is_constant = false;            ///< `value` holds everywhere, no code needs to run
  Form form = Form::constant;
  Operation operation = Operation::copy;  ///< of the two middle forms
  double value = 0;
  std::uint32_t left = 0, right = 0;  ///< slots
};

/// Compiled expressions of one grammar, in one flat array of instructions. evaluate() may run in many threads
/// at once.
class Program {
 public:
  /// An expression with more operations than this (after folding) is a fault: it bounds the time of one
  /// evaluation.
  static constexpr std::uint32_t max_operations = 1'000;
  /// Functions of the user's that are written out may come to so many tokens in one program; more are a
  /// fault: a long function that is called in every line would else be read as often.
  static constexpr std::uint64_t max_written_out = 4'000'000;
  /// The greatest depth that max_depth may ask for; more counts as this.
  static constexpr std::uint32_t greatest_depth = 256;

  /// Parses tokens from `at` on, leaves `at` on the first token that does not belong, and compiles. On a
  /// fault: adds it (at the offending token; all that can be told at once, in the order of the text, at most
  /// max_faults), moves `at` to the first token after the damage that is one of , ; : ) ] } { or an arrow
  /// outside brackets opened here, or the end; returns a constant 0. Depth (of brackets, calls, signs and
  /// powers) beyond `max_depth` is a fault. Never recurses deeper than max_depth.
  Expression parse(std::span<const Token> tokens, std::size_t& at, const Names& names,
                   std::vector<Fault>& faults, std::uint32_t max_depth = 200);

  /// `slots` as bound when it was parsed; at least slots_used() of them. Draws only from `rng`, in the order
  /// of evaluation: left to right, nothing where && or || stopped before. Allocates nothing. About 2 ns for a
  /// constant, a slot or one operation on slots and constants; otherwise about 5 ns, 3 ns for each operation
  /// and up to 100 ns for a transcendental function.
  double evaluate(const Expression& expression, const double* slots, Rng& rng) const;

  /// The highest slot that the expression reads plus one, 0 when none.
  std::uint32_t slots_used(const Expression& expression) const;

  bool draws(const Expression& expression) const;  ///< calls a random function

 private:
  class Parser;
  class Emitter;

  /// Where an operand lies: in the numbers of the program, in the slots of the caller, in a register of the
  /// evaluation.
  enum class Place : std::uint8_t { numbers, slots, registers };

  /// registers[into] = left operation right. A call has its first argument at `left`, the others behind it,
  /// and its row of functions() in `right`; stop_if_* goes to instruction `right` of the expression with the
  /// truth of `left`.
  struct Instruction {
    Operation operation = Operation::copy;
    Place left_place = Place::registers, right_place = Place::registers;
    std::uint16_t into = 0;
    std::uint32_t left = 0, right = 0;
  };

  double run(const Expression& expression, const double* slots, Rng& rng) const;

  std::vector<Instruction> code_;
  std::vector<double> numbers_;
  std::uint64_t written_out_ = 0;  ///< tokens of functions so far
};

/// One operation of the kinds that need no code; defined here so that the common case costs no call.
inline double apply(Operation operation, double left, double right) {
  switch (operation) {
    case Operation::add:
      return left + right;
    case Operation::subtract:
      return left - right;
    case Operation::multiply:
      return left * right;
    case Operation::divide:
      return left / right;
    case Operation::less:
      return left < right ? 1 : 0;
    case Operation::less_equal:
      return left <= right ? 1 : 0;
    case Operation::greater:
      return left > right ? 1 : 0;
    case Operation::greater_equal:
      return left >= right ? 1 : 0;
    case Operation::equal:
      return left == right ? 1 : 0;
    case Operation::not_equal:
      return left != right ? 1 : 0;
    case Operation::subtract_from:
      return right - left;
    case Operation::divide_into:
      return right / left;
    case Operation::modulo:
      return modulo(left, right);
    case Operation::power:
      return power(left, right);
    case Operation::copy:
    case Operation::stop_if_false:
    case Operation::stop_if_true:
    case Operation::call:
      break;
  }
  return left;
}

inline double Program::evaluate(const Expression& expression, const double* slots, Rng& rng) const {
  switch (expression.form) {
    case Expression::Form::constant:
      return expression.value;
    case Expression::Form::slot:
      return slots[expression.left];
    case Expression::Form::slot_and_value:
      return apply(expression.operation, slots[expression.left], expression.value);
    case Expression::Form::slot_and_slot:
      return apply(expression.operation, slots[expression.left], slots[expression.right]);
    case Expression::Form::code:
      break;
  }
  return run(expression, slots, rng);
}

}  // namespace seedmesh::lang
