#include "core/lang/expression.h"

#include <algorithm>

#include "core/lang/emitter.h"

namespace seedmesh::lang {

double Program::run(const Expression& expression, const double* slots, Rng& rng) const {
  using enum Operation;
  double registers[register_count];  // not cleared: code reads no register that it has not written
  const double* const places[] = {numbers_.data(), slots, registers};
  const Instruction* const first = code_.data() + expression.first;
  const Instruction* const end = first + expression.count;
  for (const Instruction* now = first; now < end; ++now) {
    const double* const left = places[static_cast<std::size_t>(now->left_place)] + now->left;
    const double* const right = places[static_cast<std::size_t>(now->right_place)] + now->right;
    double& into = registers[now->into];
    switch (now->operation) {  // each case by itself, so that it becomes one jump
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

std::uint32_t Program::slots_used(const Expression& expression) const {
  using enum Expression::Form;
  if (expression.form == slot || expression.form == slot_and_value) return expression.left + 1;
  if (expression.form == slot_and_slot) return std::max(expression.left, expression.right) + 1;
  std::uint32_t used = 0;
  for (std::uint32_t i = 0; i < expression.count; ++i) {
    const Instruction& now = code_[expression.first + i];
    if (now.left_place == Place::slots) used = std::max(used, now.left + 1);
    if (now.right_place == Place::slots) used = std::max(used, now.right + 1);
  }
  return used;
}

bool Program::draws(const Expression& expression) const {
  const auto first = code_.begin() + static_cast<std::ptrdiff_t>(expression.first);
  return std::any_of(first, first + static_cast<std::ptrdiff_t>(expression.count),
                     [](const Instruction& now) {
                       return now.operation == Operation::call && functions()[now.right].random;
                     });
}

}  // namespace seedmesh::lang
