#pragma once
/// Writes register code for one expression of a Program; the parser (parser.cpp) drives it. A constant or a
/// slot stays an operand until an operation takes it, which folds constants and lets operations read slots in
/// place. Registers are handed out like a stack: each function leaves its result in a constant, a slot or the
/// register `mark`, and gives all registers above that back.
#include <array>
#include <cstddef>

#include "core/lang/expression.h"

namespace seedmesh::lang {

/// What one level of depth can hold while the next is worked out: the left sides of a comparison, a sum, a
/// product and a power, and all arguments of a call but the last.
constexpr std::size_t registers_per_level = 4 + (max_arity - 1);

/// Registers of one evaluation, 12 KiB of stack.
constexpr std::size_t register_count = registers_per_level * (Program::greatest_depth + 1);

class Program::Emitter {
 public:
  /// A value that is known now, or where it will lie.
  struct Operand {
    Place place = Place::numbers;
    std::uint32_t index = 0;  ///< slot or register
    double value = 0;         ///< of a constant
    bool is_truth = false;    ///< can only be 0 or 1

    bool is_constant() const { return place == Place::numbers; }
  };
  using Operands = std::array<Operand, max_arity>;

  static Operand constant(double value) { return {Place::numbers, 0, value, false}; }
  static Operand slot(std::uint32_t slot) { return {Place::slots, slot, 0, false}; }

  explicit Emitter(Program& program);

  /// The lowest register that is free; where the result of what is parsed next may go.
  std::uint32_t mark() const { return next_register_; }
  void free_from(std::uint32_t mark) { next_register_ = mark; }

  Operand combine(Operation operation, const Operand& left, const Operand& right, std::uint32_t mark);
  Operand call(const Function& row, const Operands& arguments, std::uint32_t mark);
  Operand settle(const Operand& operand, std::uint32_t mark);  ///< a register's value moves to `mark`
  Operand truth(const Operand& operand, std::uint32_t mark);   ///< 1 where the operand is not 0, else 0

  /// The end of the code so far, to go back to.
  struct Position {
    std::size_t code = 0, numbers = 0;
  };
  Position position() const { return {code_.size(), numbers_.size()}; }
  void forget_after(Position position);
  void forget_all() { forget_after(start_); }

  /// `left && right` and `left || right`: begin_logic, then the code of the right side, which gets the
  /// register of the left, then end_logic with what begin_logic returned. `left` is no constant.
  Position begin_logic(Operation stop, const Operand& left, std::uint32_t mark);
  Operand end_logic(Position begun, const Operand& right, std::uint32_t mark);

  /// More than Program::max_operations were asked for; those beyond are not there.
  bool is_too_long() const { return is_too_long_; }

  Expression expression_of(const Operand& result);
  static Expression constant_expression(double value);

 private:
  Operand emit(Instruction instruction, std::uint32_t mark);
  Instruction instruction(Operation operation, const Operand& left);
  std::uint32_t index_of(const Operand& operand);
  bool shorten(Expression& expression) const;

  std::vector<Instruction>& code_;
  std::vector<double>& numbers_;
  Position start_;
  std::uint32_t next_register_ = 0;
  bool is_too_long_ = false;
};

}  // namespace seedmesh::lang
