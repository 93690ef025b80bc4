#include "core/lang/expression.h"

#include <algorithm>
#include <limits>

#include "core/lang/emitter.h"

namespace seedmesh::lang {

namespace {

/// The slot of an element of an array. `at` is not negative and below the length of the array.
std::size_t element_slot(double first, double at) {
  return static_cast<std::size_t>(first) + static_cast<std::size_t>(at);
}

}  // namespace

double Program::run(const Expression& expression, const double* slots, Rng& rng) const {
  using enum Operation;
  double registers[register_count];  // not initialised: code reads only registers that it has written
  const double* const places[] = {numbers_.data(), slots, registers};
  const Instruction* const first = code_.data() + expression.first;
  const Instruction* const end = first + expression.count;
  for (const Instruction* now = first; now < end; ++now) {
    const double* const left = places[static_cast<std::size_t>(now->left_in)] + now->left;
    const double* const right = places[static_cast<std::size_t>(now->right_in)] + now->right;
    double& into = registers[now->into];
    switch (now->operation) {  // one jump for each operation
      case add:
        into = *left + *right;
        break;
      case subtract:
        into = *left - *right;
        break;
      case multiply:
        into = *left * *right;
        break;
      case divide:
        into = *left / *right;
        break;
      case Operation::modulo:
        into = lang::modulo(*left, *right);
        break;
      case Operation::power:
        into = lang::power(*left, *right);
        break;
      case less:
        into = *left < *right ? 1 : 0;
        break;
      case less_equal:
        into = *left <= *right ? 1 : 0;
        break;
      case greater:
        into = *left > *right ? 1 : 0;
        break;
      case greater_equal:
        into = *left >= *right ? 1 : 0;
        break;
      case equal:
        into = *left == *right ? 1 : 0;
        break;
      case not_equal:
        into = *left != *right ? 1 : 0;
        break;
      case subtract_from:
        into = *right - *left;
        break;
      case divide_into:
        into = *right / *left;
        break;
      case copy:
        into = *left;
        break;
      case call:
        into = functions()[now->right].call(left, rng);
        break;
      case element:
        into = *left >= 0 && *left < right[1] ? slots[element_slot(right[0], *left)]
                                              : std::numeric_limits<double>::quiet_NaN();
        break;
      case stop_if_false:
        into = *left != 0 ? 1 : 0;
        if (into == 0) now = first + now->right - 1;
        break;
      case stop_if_true:
        into = *left != 0 ? 1 : 0;
        if (into != 0) now = first + now->right - 1;
        break;
    }
  }
  return registers[0];
}

namespace {

double number_or_nan(const TaggedValue& value) {
  return value.is_text() ? std::numeric_limits<double>::quiet_NaN() : value.number;
}

}  // namespace

TaggedValue apply(Operation operation, const TaggedValue& left, const TaggedValue& right) {
  if (operation == Operation::equal) return {left == right ? 1.0 : 0.0, 0};
  if (operation == Operation::not_equal) return {left == right ? 0.0 : 1.0, 0};
  return {apply(operation, number_or_nan(left), number_or_nan(right)), 0};
}

TaggedValue Program::evaluate_tagged(const Expression& expression, const TaggedValue* slots, Rng& rng) const {
  switch (expression.form) {
    case Expression::Form::constant:
      return expression.constant();
    case Expression::Form::slot:
      return slots[expression.left];
    case Expression::Form::slot_and_value:
      return apply(expression.operation, slots[expression.left], expression.constant());
    case Expression::Form::slot_and_slot:
      return apply(expression.operation, slots[expression.left], slots[expression.right]);
    case Expression::Form::code:
      break;
  }
  return run_tagged(expression, slots, rng);
}

TaggedValue Program::run_tagged(const Expression& expression, const TaggedValue* slots, Rng& rng) const {
  double numbers[register_count];  // not cleared, as above
  std::uint32_t texts[register_count];
  const auto operand = [&](Storage storage, std::uint32_t index) -> TaggedValue {
    if (storage == Storage::slots) return slots[index];
    const bool is_register = storage == Storage::registers;
    const std::uint32_t text = is_register ? texts[index] : texts_[index];
    return text != 0 ? TaggedValue{0, text} : TaggedValue{is_register ? numbers[index] : numbers_[index], 0};
  };
  const auto call = [&](const Instruction& now, const TaggedValue& first) -> TaggedValue {
    const Function& row = functions()[now.right];
    double arguments[max_arity] = {number_or_nan(first)};
    for (std::uint32_t i = 1; i < static_cast<std::uint32_t>(row.arity); ++i)
      arguments[i] = number_or_nan(operand(Storage::registers, now.left + i));
    if (row.name == "select") return operand(Storage::registers, now.left + (arguments[0] != 0 ? 1 : 2));
    return {row.call(arguments, rng), 0};
  };
  const Instruction* const first = code_.data() + expression.first;
  const Instruction* const end = first + expression.count;
  for (const Instruction* now = first; now < end; ++now) {
    const TaggedValue left = operand(now->left_in, now->left);
    TaggedValue result = left;
    const Instruction* next = now;
    switch (now->operation) {
      case Operation::copy:
        break;
      case Operation::call:
        result = call(*now, left);
        break;
      case Operation::element: {
        const double at = number_or_nan(left);
        const bool is_there = at >= 0 && at < numbers_[now->right + 1];
        result = is_there ? slots[element_slot(numbers_[now->right], at)]
                          : TaggedValue{std::numeric_limits<double>::quiet_NaN(), 0};
        break;
      }
      case Operation::stop_if_false:
      case Operation::stop_if_true:
        result = {number_or_nan(left) != 0 ? 1.0 : 0.0, 0};
        if ((result.number != 0) == (now->operation == Operation::stop_if_true))
          next = first + now->right - 1;
        break;
      default:
        result = apply(now->operation, left, operand(now->right_in, now->right));
    }
    numbers[now->into] = result.number;
    texts[now->into] = result.text;
    now = next;
  }
  return texts[0] != 0 ? TaggedValue{0, texts[0]} : TaggedValue{numbers[0], 0};
}

bool Program::draws(const Expression& expression) const {
  const auto first = code_.begin() + static_cast<std::ptrdiff_t>(expression.first);
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(expression.count),
                     [](const Instruction& now) {
                       return now.operation == Operation::call && functions()[now.right].random;
                     });
}

}  // namespace seedmesh::lang
