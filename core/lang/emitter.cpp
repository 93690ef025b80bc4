#include "core/lang/emitter.h"

#include <algorithm>
#include <cassert>

namespace seedmesh::lang {
namespace {

/// The operation with its sides exchanged; `copy` if there is none.
Operation mirrored(Operation operation) {
  switch (operation) {
    case Operation::add:
    case Operation::multiply:
    case Operation::equal:
    case Operation::not_equal:
      return operation;
    case Operation::subtract:
      return Operation::subtract_from;
    case Operation::divide:
      return Operation::divide_into;
    case Operation::less:
      return Operation::greater;
    case Operation::less_equal:
      return Operation::greater_equal;
    case Operation::greater:
      return Operation::less;
    case Operation::greater_equal:
      return Operation::less_equal;
    default:
      return Operation::copy;
  }
}

bool has_two_sides(Operation operation) { return operation <= Operation::not_equal; }

}  // namespace

Program::Emitter::Emitter(Program& program)
    : code_(program.code_), numbers_(program.numbers_), texts_(program.texts_), start_(position()) {}

Program::Emitter::Operand Program::Emitter::combine(Operation operation, const Operand& left,
                                                    const Operand& right, std::uint32_t mark) {
  next_register_ = mark;
  if (left.is_constant() && right.is_constant())
    return constant(apply(operation, left.tagged(), right.tagged()));
  Instruction both = instruction(operation, left);
  both.right_in = right.storage;
  both.right = index_of(right);
  Operand result = emit(both, mark);
  result.is_truth = operation >= Operation::less && operation <= Operation::not_equal;
  return result;
}

Program::Emitter::Operand Program::Emitter::call(const Function& row, const Operands& arguments,
                                                 std::uint32_t mark) {
  const auto arity = static_cast<std::size_t>(row.arity);
  const auto* const end = arguments.begin() + arity;
  next_register_ = mark;
  const bool folds =
      !row.random && std::all_of(arguments.begin(), end, [](const Operand& a) { return a.is_constant(); });
  if (folds && row.name == "select") return arguments[arguments[0].value != 0 ? 1 : 2];
  if (folds) {
    std::array<double, max_arity> values{};
    std::transform(arguments.begin(), end, values.begin(), [](const Operand& a) { return a.value; });
    Rng unused(0);
    return constant(row.call(values.data(), unused));
  }
  Operand first = {Storage::registers, mark, 0, false, 0};
  if (arity == 1) {
    first = arguments[0];  // no copy needed
  } else {
    for (std::uint32_t i = 0; i < arity; ++i) {
      // The register may be that of a parameter.
      const bool in_place = arguments[i].storage == Storage::registers && arguments[i].index == mark + i;
      if (!in_place) emit(instruction(Operation::copy, arguments[i]), mark + i);
    }
  }
  Instruction calling = instruction(Operation::call, first);
  calling.right = static_cast<std::uint32_t>(&row - functions().data());
  return emit(calling, mark);
}

Program::Emitter::Operand Program::Emitter::element(const Operand& index, std::uint32_t slot,
                                                    std::uint32_t count, std::uint32_t mark) {
  next_register_ = mark;
  if (index.is_constant() && index.text == 0 && index.value >= 0 && index.value < count) {
    return Operand{Storage::slots, slot + static_cast<std::uint32_t>(index.value), 0, false, 0};
  }
  Instruction made = instruction(Operation::element, index);
  made.right_in = Storage::numbers;
  made.right = index_of(constant(slot));
  index_of(constant(count));  // follows it
  return emit(made, mark);
}

Program::Emitter::Operand Program::Emitter::settle(const Operand& operand, std::uint32_t mark) {
  next_register_ = mark;
  if (operand.storage != Storage::registers) return operand;
  next_register_ = mark + 1;
  if (operand.index == mark) return operand;
  Operand moved = emit(instruction(Operation::copy, operand), mark);
  moved.is_truth = operand.is_truth;
  return moved;
}

Program::Emitter::Operand Program::Emitter::truth(const Operand& operand, std::uint32_t mark) {
  return operand.is_truth ? operand : combine(Operation::not_equal, operand, constant(0), mark);
}

void Program::Emitter::forget_after(Position position) {
  code_.resize(position.code);
  numbers_.resize(position.numbers);
  texts_.resize(position.numbers);
}

Program::Emitter::Position Program::Emitter::begin_logic(Operation stop, const Operand& left,
                                                         std::uint32_t mark) {
  const Position begun = position();
  emit(instruction(stop, left), mark);
  next_register_ = mark;
  return begun;
}

Program::Emitter::Operand Program::Emitter::end_logic(Position begun, const Operand& right,
                                                      std::uint32_t mark) {
  const Operand value = truth(right, mark);
  Operand result = {Storage::registers, mark, 0, true, 0};
  if (value.is_constant()) emit(instruction(Operation::copy, value), mark);
  next_register_ = mark + 1;
  if (!is_too_long_) code_[begun.code].right = static_cast<std::uint32_t>(code_.size() - start_.code);
  return result;
}

Program::Instruction Program::Emitter::instruction(Operation operation, const Operand& left) {
  Instruction made;
  made.operation = operation;
  made.left_in = left.storage;
  made.left = index_of(left);
  return made;
}

Program::Emitter::Operand Program::Emitter::emit(Instruction instruction, std::uint32_t mark) {
  assert(mark < register_count);
  next_register_ = mark + 1;
  instruction.into = static_cast<std::uint16_t>(mark);
  is_too_long_ = is_too_long_ || code_.size() - start_.code >= max_operations;
  if (!is_too_long_) code_.push_back(instruction);
  return {Storage::registers, mark, 0, false, 0};
}

std::uint32_t Program::Emitter::index_of(const Operand& operand) {
  if (!operand.is_constant()) return operand.index;
  if (!is_too_long_) {
    numbers_.push_back(operand.value);
    texts_.push_back(operand.text);
  }
  return static_cast<std::uint32_t>(numbers_.size() - 1);
}

Expression Program::Emitter::constant_expression(const TaggedValue& value) {
  Expression expression;
  expression.is_constant = true;
  expression.value = value.is_text() ? std::numeric_limits<double>::quiet_NaN() : value.number;
  expression.text = value.text;
  return expression;
}

Expression Program::Emitter::expression_of(const Operand& result) {
  if (result.is_constant()) return constant_expression(result.tagged());
  Expression expression;
  if (result.storage == Storage::slots) {
    expression.form = Expression::Form::slot;
    expression.left = result.index;
    return expression;
  }
  assert(result.index == 0);
  if (code_.size() == start_.code + 1 && shorten(expression)) {
    forget_all();
    return expression;
  }
  expression.form = Expression::Form::code;
  expression.first = static_cast<std::uint32_t>(start_.code);
  expression.count = static_cast<std::uint32_t>(code_.size() - start_.code);
  return expression;
}

/// Moves a single operation on slots and numbers from the code into the handle; false if it has no such form.
bool Program::Emitter::shorten(Expression& expression) const {
  const Instruction& only = code_.back();
  if (!has_two_sides(only.operation)) return false;
  const bool swaps = only.left_in == Storage::numbers;
  const Operation operation = swaps ? mirrored(only.operation) : only.operation;
  if (operation == Operation::copy) return false;

  expression.operation = operation;
  expression.left = swaps ? only.right : only.left;
  if (only.left_in == Storage::slots && only.right_in == Storage::slots) {
    expression.form = Expression::Form::slot_and_slot;
    expression.right = only.right;
  } else {
    expression.form = Expression::Form::slot_and_value;
    const std::uint32_t constant = swaps ? only.left : only.right;
    expression.value = numbers_[constant];
    expression.text = texts_[constant];
  }
  return true;
}

}  // namespace seedmesh::lang
