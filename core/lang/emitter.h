#pragma once
/// Emits register code for one expression of a Program, called by the parser (parser.cpp). A constant or a slot stays
/// an operand until an operation uses it, so that constants are folded and operations read slots directly. Registers
/// form a stack: each function leaves its result in a constant, a slot or the register `mark`, and frees all registers
/// above that.
#include <array>
#include <cstddef>
#include <limits>

#include "core/lang/expression.h"

namespace seedmesh::lang {

/// Number of registers that one nesting level keeps while the next level is computed. They hold the left
/// operands of a comparison, a sum, a product and a power, and all arguments of a call except the last.
constexpr std::size_t registers_per_level = 4 + (max_arity - 1);

/// Number of registers of one evaluation. They take 12 KiB of the stack.
constexpr std::size_t register_count = registers_per_level * (Program::greatest_depth + 1);

class Program::Emitter {
 public:
  /// A constant, or the slot or register of a value.
  struct Operand {
    Storage storage = Storage::numbers;
    std::uint32_t index = 0;  ///< slot or register
    double value = 0;         ///< value of a constant
    bool is_truth = false;    ///< the value is known to be 0 or 1
    std::uint32_t text = 0;   ///< not 0: the constant is this text, and `value` is NaN

    bool is_constant() const { return storage == Storage::numbers; }
    TaggedValue tagged() const { return text != 0 ? TaggedValue{0, text} : TaggedValue{value, 0}; }
  };
  using Operands = std::array<Operand, max_arity>;

  static Operand constant(double value) { return {Storage::numbers, 0, value, false, 0}; }
  static Operand constant(const TaggedValue& value) {
    if (!value.is_text()) return constant(value.number);
    return {Storage::numbers, 0, std::numeric_limits<double>::quiet_NaN(), false, value.text};
  }
  static Operand slot(std::uint32_t slot) { return {Storage::slots, slot, 0, false, 0}; }

  explicit Emitter(Program& program);

  /// Returns the lowest free register, for the next result.
  std::uint32_t mark() const { return next_register_; }
  void free_from(std::uint32_t mark) { next_register_ = mark; }

  Operand combine(Operation operation, const Operand& left, const Operand& right, std::uint32_t mark);
  Operand call(const Function& row, const Operands& arguments, std::uint32_t mark);
  /// The element `index` of the array of `count` slots from `slot` on.
  Operand element(const Operand& index, std::uint32_t slot, std::uint32_t count, std::uint32_t mark);
  Operand settle(const Operand& operand, std::uint32_t mark);  ///< moves the value of a register to `mark`
  Operand truth(const Operand& operand, std::uint32_t mark);   ///< 1 where the operand is not 0, else 0

  /// The end of the code so far.
  struct Position {
    std::size_t code = 0, numbers = 0;
  };
  Position position() const { return {code_.size(), numbers_.size()}; }
  void forget_after(Position position);
  void forget_all() { forget_after(start_); }

  /// `left && right` and `left || right`: begin_logic(), then the code of the right side, then end_logic() with the
  /// result of begin_logic(). Both sides use the same register. `left` is not a constant.
  Position begin_logic(Operation stop, const Operand& left, std::uint32_t mark);
  Operand end_logic(Position begun, const Operand& right, std::uint32_t mark);

  /// Whether the expression has more than Program::max_operations operations. The operations beyond this
  /// number were not emitted.
  bool is_too_long() const { return is_too_long_; }

  Expression expression_of(const Operand& result);
  static Expression constant_expression(const TaggedValue& value);

 private:
  Operand emit(Instruction instruction, std::uint32_t mark);
  Instruction instruction(Operation operation, const Operand& left);
  std::uint32_t index_of(const Operand& operand);
  bool shorten(Expression& expression) const;

  std::vector<Instruction>& code_;
  std::vector<double>& numbers_;
  std::vector<std::uint32_t>& texts_;
  Position start_;
  std::uint32_t next_register_ = 0;
  bool is_too_long_ = false;
};

}  // namespace seedmesh::lang
