#pragma once
/// Expressions: arithmetic and conditions, parsed once and evaluated millions of times. They depend on no grammar:
/// the caller binds names to slots before parsing, and gives the values of the slots for each evaluation.
///
///   expression = or ;
///   or         = and { ("||" | "|") and } ;
///   and        = comparison { ("&&" | "&") comparison } ;
///   comparison = sum [ ("<" | "<=" | ">" | ">=" | "==" | "!=" | "=") sum ] ;
///   sum        = product { ("+" | "-") product } ;
///   product    = unary { ("*" | "/" | "%" | "mod") unary } ;
///   unary      = { "-" | "+" | "!" } power ;
///   power      = primary [ ("^" | "**") unary ] ;        right associative
///   primary    = number | dotted | name "(" [ expression { "," expression } ] ")" | "(" expression ")" ;
///   dotted     = name { "." name } | array "[" expression "]" ;   without spaces: one name, as in Scope.sx
///
/// All values are doubles. A condition is true if its value is not 0; comparisons give 1 or 0. && and || give 1 or 0
/// and do not evaluate the right side if the left one decides. `!` binds like a minus sign, as in C: !a < b is
/// (!a) < b. Comparisons do not chain. The index of an array is truncated to a whole number; outside of the array the
/// result is NaN. `%` is mod(), whose result has the sign of the divisor; it is an operator only
/// before an operand, so that the expression of `30% : A` is 30. Angles are in degrees. Division by zero gives an
/// infinity or NaN, and the caller decides what to refuse. Results have the same bits on every machine
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

/// A number or a text. A text is represented by its number, from 1, in a table of the caller.
struct TaggedValue {
  double number = 0;
  std::uint32_t text = 0;  ///< 0: the value is a number

  bool is_text() const { return text != 0; }
  friend auto operator<=>(const TaggedValue&, const TaggedValue&) = default;
};

/// The names that expressions may use. A name is bound to a slot, whose value is given at evaluation, or to a
/// constant, which is folded into the code. Later bindings hide earlier ones of the same name.
class Names {
 public:
  void bind_slot(std::string name, std::uint32_t slot);
  void bind_constant(std::string name, double value);
  /// An array of `count` values, at least 1, in the slots from `slot` on.
  void bind_array(std::string name, std::uint32_t slot, std::uint32_t count);
  void forget_after(std::size_t count);  ///< keeps the first `count` bindings
  std::size_t size() const { return bindings_.size(); }

  struct Binding {
    std::string name;
    bool is_constant = false;
    std::uint32_t slot = 0;
    double value = 0;
    std::uint32_t count = 0;  ///< number of the elements of an array; 0: the name is a value
  };
  const Binding* find(std::string_view name) const;  ///< null if unknown; valid until the next change
  /// The latest constant of this name, even if a slot hides it; null if there is none.
  const Binding* find_constant(std::string_view name) const;

  /// A user-defined function. Calls are expanded inline; its body can use its parameters and constants.
  struct Defined {
    std::vector<std::string> parameters;  ///< at most most_parameters
    std::vector<Token> body;              ///< ends with TokenKind::end; its text has to outlive the Names
    bool is_valid = true;                 ///< false after an error in its text: calls are not checked
  };
  static constexpr std::size_t most_parameters = 8;
  void define(std::string name, Defined function);  ///< replaces an earlier one of the same name
  void mark_invalid(std::string_view name);         ///< sets is_valid to false
  const Defined* find_function(std::string_view name) const;
  /// The bound name most similar to `name`, for a hint, or an empty text. Compares the latest 256 bindings.
  std::string_view nearest(std::string_view name) const;
  /// Returns false after most_hints calls. Call it before each nearest(), because nearest() is expensive.
  bool may_hint() const { return hints_ < most_hints && ++hints_ > 0; }
  static constexpr std::uint32_t most_hints = 20;

 private:
  void bind(Binding binding);

  std::vector<Binding> bindings_;
  std::map<std::string, std::vector<std::uint32_t>, std::less<>>
      indices_;  ///< indices of each name into bindings_, the latest last
  std::map<std::string, Defined, std::less<>> functions_;
  mutable std::uint32_t hints_ = 0;
};

/// Reads `name ( parameter, ... ) = body` and returns the name. The body is split into tokens but not parsed. Errors:
/// a token that is not expected, the name of a built-in function, a repeated parameter, too many parameters.
std::string read_definition(std::string_view text, Names::Defined& function, std::vector<TextError>& errors);

/// The distance of two names, for hints. Equal names have 0, and names that differ only in case have 1. Otherwise each
/// letter of another case adds 1, and each inserted, missing, changed or swapped letter adds 2. Names of more than
/// 64 bytes have a distance beyond every hint.
std::uint32_t name_distance(std::string_view a, std::string_view b);
/// The greatest distance of a useful hint for `name`.
std::uint32_t hint_distance(std::string_view name);

/// A built-in function, for the parser, the evaluator, the docs and GET /v1/vocabulary. A name may have
/// several adjacent rows with different numbers of arguments, as the function ran() has.
struct Function {
  std::string_view name;
  int arity;                   ///< number of arguments, at most max_arity
  std::string_view arguments;  ///< their names, for the docs: "low, high"
  std::string_view text;       ///< one sentence for the docs
  std::string_view example;    ///< an expression that the tests evaluate
  double (*call)(const double* arguments, Rng& rng);
  bool random;  ///< draws random numbers, so that it is never folded
};
std::span<const Function> functions();
constexpr int max_arity = 3;

/// The operators `%` and `^`.
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
  element,  ///< the element `left` of the array whose first slot and count are the numbers from `right` on
};

/// A handle to compiled code in a Program. A constant, a slot, and one operation on a slot need no code.
struct Expression {
  /// What evaluate() has to do.
  enum class Form : std::uint8_t { constant, slot, slot_and_value, slot_and_slot, code };

  std::uint32_t first = 0, count = 0;  ///< instructions
  bool is_constant = false;            ///< its value is always `value`
  Form form = Form::constant;
  Operation operation = Operation::copy;  ///< operation of slot_and_value and slot_and_slot
  double value = 0;
  std::uint32_t text = 0;             ///< not 0: the constant is this text, and `value` is NaN
  std::uint32_t left = 0, right = 0;  ///< slots

  TaggedValue constant() const { return text != 0 ? TaggedValue{0, text} : TaggedValue{value, 0}; }
};

/// The compiled expressions of one grammar, in one array of instructions. evaluate() is thread-safe.
class Program {
 public:
  /// The most operations of an expression after folding, which bounds the time of one evaluation.
  static constexpr std::uint32_t max_operations = 1'000;
  /// The most tokens that calls of defined functions may add to one program. This bounds the cost of a long
  /// function that is called often.
  static constexpr std::uint64_t max_expanded = 4'000'000;
  /// The greatest useful value of max_depth; a larger one counts as this.
  static constexpr std::uint32_t greatest_depth = 256;

  /// Parses and compiles the expression that begins at token `at`, and moves `at` to the first token behind it.
  /// If there are errors, it adds them in the order of the text, at most max_errors, and returns the constant
  /// 0. It then moves `at` to the first of these that is outside of brackets opened in the expression: one of
  /// , ; : ) ] } { or an arrow, or the end. Brackets, calls, signs and powers deeper than `max_depth` are an
  /// error. Recurses at most max_depth deep.
  Expression parse(std::span<const Token> tokens, std::size_t& at, const Names& names,
                   std::vector<TextError>& errors, std::uint32_t max_depth = 200);

  /// Returns the value of the expression. `slots` has the value of each name, by the number to which Names binds it. Draws random
  /// numbers from `rng` in the order of evaluation, from left to right. Allocates nothing. Cost: about 2 ns for a
  /// constant, a slot or one operation; otherwise 5 ns, 3 ns for each operation and up to 100 ns for a transcendental
  /// function.
  double evaluate(const Expression& expression, const double* slots, Rng& rng) const;

  /// The same if values may be texts. == and != compare texts; a text equals no number; select() passes texts
  /// on. All other operations and functions take a text as NaN. Cost: about twice that of evaluate().
  TaggedValue evaluate_tagged(const Expression& expression, const TaggedValue* slots, Rng& rng) const;

  bool draws(const Expression& expression) const;  ///< calls a random function

 private:
  class Parser;
  class Emitter;
  friend class RowEvaluator;  // rows.h

  /// Where an operand is stored: in the numbers of the program, in the slots of the caller, or in the
  /// registers of the evaluation.
  enum class Storage : std::uint8_t { numbers, slots, registers };

  /// registers[into] = left operation right. A call has its first argument at `left`, the others behind it, and its row
  /// of functions() in `right`. stop_if_* stores the truth of `left` and jumps to instruction `right` if it decides.
  struct Instruction {
    Operation operation = Operation::copy;
    Storage left_in = Storage::registers, right_in = Storage::registers;
    std::uint16_t into = 0;
    std::uint32_t left = 0, right = 0;
  };

  double run(const Expression& expression, const double* slots, Rng& rng) const;
  TaggedValue run_tagged(const Expression& expression, const TaggedValue* slots, Rng& rng) const;

  std::vector<Instruction> code_;
  std::vector<double> numbers_;
  std::vector<std::uint32_t> texts_;  ///< for each of numbers_, its text, or 0 if it is a number
  std::uint64_t expanded_ = 0;        ///< tokens of functions so far
};

/// One binary operation. Inline, because most evaluations are only this.
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
    case Operation::element:
      break;
  }
  return left;
}

TaggedValue apply(Operation operation, const TaggedValue& left, const TaggedValue& right);

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
