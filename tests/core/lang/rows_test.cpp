#include "core/lang/rows.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>

namespace seedmesh::lang {
namespace {

constexpr std::size_t slots = 3;

/// Values of three slots in many cells: small and large numbers, whole ones, zeros, and an infinity.
double value_of(std::size_t slot, std::size_t cell) {
  if (cell % 17 == slot) return 0;
  if (cell % 23 == slot) return 1 / 0.0;
  const Rng rng = Rng(7).at(slot).at(cell);
  Rng draw = rng;
  const double value = draw.uniform(-8, 8);
  return cell % 3 == 0 ? static_cast<double>(static_cast<int>(value)) : value;
}

void expect_same_bits(const std::string& text, std::size_t count) {
  Names names;
  names.bind_slot("x", 0);
  names.bind_slot("y", 1);
  names.bind_slot("z", 2);
  names.bind_array("list", 0, 3);
  std::vector<TextError> errors;
  const std::vector<Token> tokens = tokenize(text, 0, text.size(), errors);
  Program program;
  std::size_t at = 0;
  const Expression expression = program.parse(tokens, at, names, errors);
  ASSERT_TRUE(errors.empty()) << text << ": " << errors[0].message;
  std::vector<std::vector<double>> rows(slots, std::vector<double>(RowEvaluator::width, 3));
  std::vector<const double*> pointers;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    for (std::size_t cell = 0; cell < count; ++cell) rows[slot][cell] = value_of(slot, cell);
    pointers.push_back(rows[slot].data());
  }
  std::vector<Rng> rngs;
  for (std::size_t cell = 0; cell < count; ++cell) rngs.push_back(Rng(5).at(cell));
  std::vector<double> out(RowEvaluator::width);
  RowEvaluator evaluator(program, expression);
  evaluator.run(pointers, count, rngs, out.data());
  for (std::size_t cell = 0; cell < count; ++cell) {
    const double values[slots] = {rows[0][cell], rows[1][cell], rows[2][cell]};
    Rng rng = Rng(5).at(cell);
    const double expected = program.evaluate(expression, values, rng);
    const bool are_nan = out[cell] != out[cell] && expected != expected;
    EXPECT_TRUE(are_nan || std::bit_cast<std::uint64_t>(out[cell]) == std::bit_cast<std::uint64_t>(expected))
        << text << " in cell " << cell << ": " << out[cell] << ", expected " << expected;
  }
}

TEST(Rows, HaveTheBitsOfSingleEvaluations) {
  for (const char* text : {"4",
                           "x",
                           "x + 1",
                           "1 - x",
                           "x / y",
                           "2 / x",
                           "x * y - z * (x - 2 * y) / (1 + z ^ 2)",
                           "x % 3",
                           "mod(y, x)",
                           "x < y",
                           "3 >= x",
                           "(x > 0) + (y == 0) * 2 + (z != 1) * 4 + (x <= z) * 8",
                           "-x",
                           "!x",
                           "abs(x) + fabs(y - z)",
                           "sqrt(x + 5)",
                           "min(x, y) + max(y, z)",
                           "clamp(x, y, z)",
                           "lerp(x, y, 0.25)",
                           "select(x > y, x * 2, y / 3)",
                           "sin(x * 40) + cos(y) * tan(z)",
                           "floor(x) + ceil(y) + round(z)",
                           "pow(abs(x), 1.5)",
                           "x && y",
                           "x || y",
                           "x > 0 && y > 0 || z > 0 && !x",
                           "(x > 1 && 2) + (0 || y)",
                           "1 + (x > 0 && (y > 0 || z > 0 && x < y)) * 5",
                           "list[1] + list[x]",
                           "ran(x) + ran(2, 3) * nran(0, 1)",
                           "isnan(x - y) + isinf(z)"}) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{13}, RowEvaluator::width})
      expect_same_bits(text, count);
  }
}

}  // namespace
}  // namespace seedmesh::lang
