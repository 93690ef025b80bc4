#include "core/lang/rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/lang/emitter.h"

namespace seedmesh::lang {
namespace {

/// Cells that one step of a loop reads before it writes any. The result may therefore overwrite an operand, and
/// compilers still use vector instructions.
constexpr std::size_t lane = 8;
static_assert(RowEvaluator::width % lane == 0);

using Lane = std::array<double, lane>;

Lane read(const double* row) {
  Lane cells;
  std::memcpy(cells.data(), row, sizeof(cells));
  return cells;
}

/// out[i] = operation(rows[0][i], rows[1][i], ...), up to the next multiple of `lane`.
template <class Operate, class... Rows>
void each_cell(std::size_t count, double* out, const Operate& operate, const Rows*... rows) {
  for (std::size_t i = 0; i < count; i += lane) {
    Lane result;
    const auto fill = [&](const auto&... cells) {
      for (std::size_t k = 0; k < lane; ++k) result[k] = operate(cells[k]...);
    };
    fill(read(rows + i)...);
    std::memcpy(out + i, result.data(), sizeof(result));
  }
}

void combine(Operation operation, std::size_t count, const double* left, const double* right, double* out) {
  const auto run = [&](const auto& operate) { each_cell(count, out, operate, left, right); };
  switch (operation) {
    case Operation::add:
      return run([](double a, double b) { return a + b; });
    case Operation::subtract:
      return run([](double a, double b) { return a - b; });
    case Operation::multiply:
      return run([](double a, double b) { return a * b; });
    case Operation::divide:
      return run([](double a, double b) { return a / b; });
    case Operation::subtract_from:
      return run([](double a, double b) { return b - a; });
    case Operation::divide_into:
      return run([](double a, double b) { return b / a; });
    case Operation::less:
      return run([](double a, double b) { return a < b ? 1.0 : 0.0; });
    case Operation::less_equal:
      return run([](double a, double b) { return a <= b ? 1.0 : 0.0; });
    case Operation::greater:
      return run([](double a, double b) { return a > b ? 1.0 : 0.0; });
    case Operation::greater_equal:
      return run([](double a, double b) { return a >= b ? 1.0 : 0.0; });
    case Operation::equal:
      return run([](double a, double b) { return a == b ? 1.0 : 0.0; });
    case Operation::not_equal:
      return run([](double a, double b) { return a != b ? 1.0 : 0.0; });
    default:
      for (std::size_t i = 0; i < count; ++i) out[i] = apply(operation, left[i], right[i]);
  }
}

/// Runs a function that has a loop of its own, with the same results as its row of functions(). False: it has none.
bool run_simple(std::string_view name, std::size_t count, const double* first, double* out) {
  const auto argument = [first](std::size_t index) { return first + index * RowEvaluator::width; };
  const auto least = [](double a, double b) { return b < a ? b : a; };
  const auto greatest = [](double a, double b) { return a < b ? b : a; };
  if (name == "abs" || name == "fabs") {
    each_cell(
        count, out, [](double a) { return std::abs(a); }, first);
  } else if (name == "sqrt") {
    each_cell(
        count, out, [](double a) { return std::sqrt(a); }, first);
  } else if (name == "min") {
    each_cell(count, out, least, first, argument(1));
  } else if (name == "max") {
    each_cell(count, out, greatest, first, argument(1));
  } else if (name == "clamp") {
    each_cell(
        count, out, [&](double a, double b, double c) { return least(greatest(a, b), c); }, first,
        argument(1), argument(2));
  } else if (name == "lerp") {
    each_cell(
        count, out, [](double a, double b, double c) { return a + (b - a) * c; }, first, argument(1),
        argument(2));
  } else if (name == "select") {
    each_cell(
        count, out, [](double a, double b, double c) { return a != 0 ? b : c; }, first, argument(1),
        argument(2));
  } else {
    return false;
  }
  return true;
}

}  // namespace

/// What one run works on.
struct RowEvaluator::Cells {
  std::span<const double* const> slots;
  std::size_t count;
  std::span<Rng> rngs;
};

RowEvaluator::RowEvaluator(const Program& program, const Expression& expression)
    : program_(program), expression_(expression) {
  if (expression.form == Expression::Form::slot_and_value) {
    constants_.assign(width, expression.value);
    return;
  }
  if (expression.form != Expression::Form::code) return;
  std::size_t registers = 1;
  const auto count_register = [&](Storage storage, std::size_t index) {
    if (storage == Storage::registers) registers = std::max(registers, index + max_arity);
  };
  for (std::uint32_t i = 0; i < expression.count; ++i) {
    const Instruction& now = program.code_[expression.first + i];
    registers = std::max(registers, static_cast<std::size_t>(now.into) + 1);
    count_register(now.left_in, now.left);
    if (now.left_in == Storage::numbers) add_constant(now.left, program.numbers_[now.left]);
    const bool has_right = now.operation != Operation::call && now.operation != Operation::element;
    if (!has_right) continue;
    count_register(now.right_in, now.right);
    if (now.right_in == Storage::numbers) add_constant(now.right, program.numbers_[now.right]);
  }
  registers_.resize(registers * width);
}

void RowEvaluator::add_constant(std::uint32_t index, double value) {
  if (constant_rows_.empty()) first_number_ = index;
  // Operands are numbered in the order of the code, except those of brackets, which may come earlier.
  if (index < first_number_) {
    constant_rows_.insert(constant_rows_.begin(), first_number_ - index, 0);
    first_number_ = index;
  }
  if (constant_rows_.size() <= index - first_number_) constant_rows_.resize(index - first_number_ + 1);
  constant_rows_[index - first_number_] = static_cast<std::uint32_t>(constants_.size() / width);
  constants_.resize(constants_.size() + width, value);
}

const double* RowEvaluator::row_of(Storage storage, std::uint32_t index, const Cells& cells) const {
  if (storage == Storage::slots) return cells.slots[index];
  if (storage == Storage::registers) return registers_.data() + index * width;
  return constants_.data() + constant_rows_[index - first_number_] * width;
}

void RowEvaluator::call(const Instruction& now, const Cells& cells) {
  const Function& function = functions()[now.right];
  double* const out = register_row(now.into);
  const double* const first = row_of(now.left_in, now.left, cells);
  if (run_simple(function.name, cells.count, first, out)) return;
  Rng none(0);
  std::array<double, max_arity> arguments{};
  const auto arity = static_cast<std::size_t>(function.arity);
  for (std::size_t i = 0; i < cells.count; ++i) {
    for (std::size_t k = 0; k < arity; ++k) arguments[k] = first[k * width + i];
    out[i] = function.call(arguments.data(), function.random ? cells.rngs[i] : none);
  }
}

void RowEvaluator::element(const Instruction& now, const Cells& cells) {
  const double first = program_.numbers_[now.right], size = program_.numbers_[now.right + 1];
  const double* const index = row_of(now.left_in, now.left, cells);
  double* const out = register_row(now.into);
  for (std::size_t i = 0; i < cells.count; ++i) {
    const bool is_there = index[i] >= 0 && index[i] < size;
    out[i] = is_there ? cells.slots[static_cast<std::size_t>(first) + static_cast<std::size_t>(index[i])][i]
                      : std::numeric_limits<double>::quiet_NaN();
  }
}

void RowEvaluator::run_code(const Instruction* first, const Instruction* end, const Cells& cells) {
  const Instruction* const begin = program_.code_.data() + expression_.first;
  for (const Instruction* now = first; now < end; ++now) {
    double* const out = register_row(now->into);
    switch (now->operation) {
      case Operation::copy:
        std::copy_n(row_of(now->left_in, now->left, cells), width, out);
        break;
      case Operation::call:
        call(*now, cells);
        break;
      case Operation::element:
        element(*now, cells);
        break;
      case Operation::stop_if_false:
      case Operation::stop_if_true: {
        // The right side follows, and leaves its truth in the same register.
        std::array<double, width> left;
        std::copy_n(row_of(now->left_in, now->left, cells), width, left.data());
        const bool is_and = now->operation == Operation::stop_if_false;
        const Instruction* const behind = begin + now->right;
        run_code(now + 1, behind, cells);
        each_cell(
            cells.count, out,
            [is_and](double a, double b) {
              return is_and ? (a != 0 && b != 0 ? 1.0 : 0.0) : (a != 0 || b != 0 ? 1.0 : 0.0);
            },
            left.data(), static_cast<const double*>(out));
        now = behind - 1;
        break;
      }
      default:
        combine(now->operation, cells.count, row_of(now->left_in, now->left, cells),
                row_of(now->right_in, now->right, cells), out);
    }
  }
}

void RowEvaluator::run(std::span<const double* const> slots, std::size_t count, std::span<Rng> rngs,
                       double* out) {
  const Expression& e = expression_;
  switch (e.form) {
    case Expression::Form::constant:
      std::fill_n(out, width, e.value);
      return;
    case Expression::Form::slot:
      std::copy_n(slots[e.left], width, out);
      return;
    case Expression::Form::slot_and_value:
      return combine(e.operation, count, slots[e.left], constants_.data(), out);
    case Expression::Form::slot_and_slot:
      return combine(e.operation, count, slots[e.left], slots[e.right], out);
    case Expression::Form::code:
      break;
  }
  const Instruction* const first = program_.code_.data() + e.first;
  run_code(first, first + e.count, {slots, count, rngs});
  std::copy_n(registers_.data(), width, out);
}

}  // namespace seedmesh::lang
