/// The time of one evaluation of an expression: short forms typical of parametric L-systems, longer code,
/// calls and random draws. The parameter values change with every evaluation, as from module to module.
#include <benchmark/benchmark.h>

#include <array>
#include <string>

#include "core/lang/expression.h"
#include "core/lang/rows.h"

namespace {

using namespace seedmesh;

void evaluate(benchmark::State& state, const char* text) {
  lang::Names names;
  names.bind_slot("l", 0);
  names.bind_slot("w", 1);
  names.bind_constant("r1", 0.9);
  names.bind_constant("wr", 0.707);
  std::vector<lang::TextError> faults;
  lang::Program program;
  std::size_t at = 0;
  const std::string source = text;
  const lang::Expression expression =
      program.parse(lang::tokenize(source, 0, source.size(), faults), at, names, faults);
  if (!faults.empty()) return state.SkipWithError(faults[0].message.c_str());

  std::array<std::array<double, 2>, 64> modules{};
  for (std::size_t i = 0; i < modules.size(); ++i)
    modules[i] = {1 + static_cast<double>(i), 1.0 / static_cast<double>(i + 1)};
  Rng rng = Rng::of_seed(1);
  std::size_t i = 0;
  for (auto step : state) {
    benchmark::DoNotOptimize(program.evaluate(expression, modules[i].data(), rng));
    i = (i + 1) % modules.size();
  }
}

/// The nine expressions of a production of ABOP's tree 2.6, evaluated in turn.
void evaluate_production(benchmark::State& state) {
  lang::Names names;
  names.bind_slot("l", 0);
  names.bind_slot("w", 1);
  for (const auto& [name, value] :
       {std::pair{"r1", 0.9}, {"r2", 0.6}, {"a0", 45.0}, {"d", 137.5}, {"wr", 0.707}}) {
    names.bind_constant(name, value);
  }
  std::vector<lang::TextError> faults;
  lang::Program program;
  std::vector<lang::Expression> expressions;
  for (const std::string source : {"w", "l", "a0", "l*r2", "w*wr", "d", "l*r1", "w*wr"}) {
    std::size_t at = 0;
    expressions.push_back(program.parse(lang::tokenize(source, 0, source.size(), faults), at, names, faults));
  }
  std::array<double, 2> slots = {1, 10};
  Rng rng = Rng::of_seed(1);
  for (auto step : state) {
    for (const lang::Expression& expression : expressions) {
      benchmark::DoNotOptimize(program.evaluate(expression, slots.data(), rng));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(expressions.size()));
}

/// Whole rows of cells, as terrain evaluates them. items_per_second counts cells.
void evaluate_rows(benchmark::State& state, const char* text) {
  constexpr std::size_t width = lang::RowEvaluator::width;
  lang::Names names;
  names.bind_slot("l", 0);
  names.bind_slot("w", 1);
  names.bind_constant("r1", 0.9);
  names.bind_constant("wr", 0.707);
  std::vector<lang::TextError> faults;
  lang::Program program;
  std::size_t at = 0;
  const std::string source = text;
  const lang::Expression expression =
      program.parse(lang::tokenize(source, 0, source.size(), faults), at, names, faults);
  if (!faults.empty()) return state.SkipWithError(faults[0].message.c_str());
  std::vector<double> l(width), w(width), out(width);
  for (std::size_t i = 0; i < width; ++i) {
    l[i] = 1 + static_cast<double>(i);
    w[i] = 1 / l[i];
  }
  const std::vector<const double*> slots{l.data(), w.data()};
  lang::RowEvaluator rows(program, expression);
  for (auto step : state) {
    rows.run(slots, width, {}, out.data());
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(width));
}

BENCHMARK_CAPTURE(evaluate_rows, ten_operations, "l*w + l*r1 - w*wr*(l - w)/(1 + l*l + w)");
BENCHMARK_CAPTURE(evaluate_rows, condition, "l > 10 && w < 0.5");
BENCHMARK_CAPTURE(evaluate_rows, sine, "sin(l)");
BENCHMARK_CAPTURE(evaluate, constant, "r1*wr");
BENCHMARK_CAPTURE(evaluate, slot, "l");
BENCHMARK_CAPTURE(evaluate, slot_times_constant, "l*r1");
BENCHMARK_CAPTURE(evaluate, slot_times_slot, "l*w");
BENCHMARK_CAPTURE(evaluate, comparison, "l > 30");
BENCHMARK_CAPTURE(evaluate, two_operations, "(l+w)/2");
BENCHMARK_CAPTURE(evaluate, condition, "l > 10 && w < 0.5");
BENCHMARK_CAPTURE(evaluate, ten_operations, "l*w + l*r1 - w*wr*(l - w)/(1 + l*l + w)");
BENCHMARK_CAPTURE(evaluate, square, "l^2");
BENCHMARK_CAPTURE(evaluate, power, "l^1.5");
BENCHMARK_CAPTURE(evaluate, modulo, "l % 3");
BENCHMARK_CAPTURE(evaluate, maximum, "max(l, w)");
BENCHMARK_CAPTURE(evaluate, sine, "sin(l)");
BENCHMARK_CAPTURE(evaluate, uniform, "ran(1, 2)");
BENCHMARK_CAPTURE(evaluate, normal, "nran(1, 2)");
BENCHMARK(evaluate_production);

}  // namespace
