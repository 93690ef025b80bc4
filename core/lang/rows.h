#pragma once
/// Evaluates one expression for many cells at once. Each operation runs over a whole row of cells before the
/// next one, so that simple operations use vector instructions. Used for fields of numbers, for which
/// Program::evaluate() would spend most of its time choosing operations.
#include <cstddef>
#include <span>
#include <vector>

#include "core/lang/expression.h"

namespace seedmesh::lang {

class RowEvaluator {
 public:
  /// Cells of a full row. All rows have this capacity, whatever the number of cells in use.
  static constexpr std::size_t width = 512;

  /// The program has to outlive the evaluator and may not change. Allocates a row for each register and constant.
  RowEvaluator(const Program& program, const Expression& expression);

  /// Writes the values of `count` cells, at most `width`, to `out`, which has the capacity of a row. `slots` has a row
  /// for each slot that the expression reads. If the expression draws random numbers, `rngs` has a generator
  /// for each cell, and the order of draws is that of Program::evaluate(). Otherwise `rngs` may be empty. The
  /// results have the same bits as those of Program::evaluate(), except that both sides of && and || are
  /// always evaluated. Cost: about 0.5 ns for an arithmetic operation and cell; functions other than abs,
  /// sqrt, min, max, clamp, lerp and select cost as much as in Program::evaluate().
  void run(std::span<const double* const> slots, std::size_t count, std::span<Rng> rngs, double* out);

 private:
  using Instruction = Program::Instruction;
  using Storage = Program::Storage;
  struct Cells;

  void add_constant(std::uint32_t index, double value);
  const double* row_of(Storage storage, std::uint32_t index, const Cells& cells) const;
  double* register_row(std::uint32_t index) { return registers_.data() + index * width; }
  void run_code(const Instruction* first, const Instruction* end, const Cells& cells);
  void call(const Instruction& now, const Cells& cells);
  void element(const Instruction& now, const Cells& cells);

  const Program& program_;
  const Expression& expression_;
  std::vector<double> registers_, constants_;
  std::vector<std::uint32_t> constant_rows_;  ///< rows of numbers_, from the first used number on
  std::uint32_t first_number_ = 0;
};

}  // namespace seedmesh::lang
