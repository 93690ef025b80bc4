/// The speed of derivations from the axiom: plain symbols, parameters, contexts. Plain and context-sensitive
/// systems build the word in memory; parametric ones stream it module by module, as generate() does.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/generators/lsystem/context_free_derivation.h"
#include "core/generators/lsystem/grammar.h"
#include "core/generators/lsystem/lsystem.h"
#include "core/generators/lsystem/table.h"
#include "core/generators/lsystem/text.h"
#include "generated/params/lsystem.h"
#include "tests/bench/report.h"
#include "tests/support/context.h"

namespace {

using namespace seedmesh;
using namespace seedmesh::lsystem;

constexpr int rounds = 7;

Limits roomy() {
  Limits limits;
  limits.modules = std::uint64_t{1} << 40U;
  limits.memory_bytes = std::uint64_t{8} << 30U;
  return limits;
}

Grammar compiled(const LsystemParams& params) {
  std::vector<Issue> issues;
  Grammar grammar = compile(params, 0, roomy(), issues);
  if (!issues.empty()) std::abort();
  return grammar;
}

/// A system of plain symbols. The whole word is built in memory, as by derive().
void bench_plain(const std::string& name, const LsystemParams& params, std::uint32_t steps) {
  const Grammar grammar = compiled(params);
  if (!is_plain(grammar)) std::abort();
  double modules = 0;
  const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] {
    Job job(0, {.limits = roomy()});
    modules = static_cast<double>(plain_text(grammar, steps, std::size_t{1} << 30U, job).size());
  });
  bench::report(name, "modules", modules, seconds);
}

/// One symbol moves through a long word, so that every step has to visit every module.
void bench_signal() {
  constexpr std::uint32_t steps = 50;
  constexpr std::size_t length = 900'000;
  LsystemParams params;
  params.axiom = "b" + std::string(length, 'a');
  params.productions = {"b < a -> b", "b -> a"};
  const Grammar grammar = compiled(params);
  if (!TableRewriter::fits(grammar)) std::abort();
  const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] {
    Job job(0, {.limits = roomy()});
    if (TableRewriter(grammar, job).derive(steps).size() != length + 1) std::abort();
  });
  bench::report("context signal", "rewrites", static_cast<double>(length) * steps, seconds);
}

/// Counts modules and reads one bit of each parameter, so that the compiler cannot remove the evaluation of
/// an argument.
struct Counter {
  std::uint64_t modules = 0;
  double sum = 0;
  void module(KindId, const double* parameters, std::uint64_t, std::uint32_t) {
    ++modules;
    sum += parameters[0];
  }
};

/// A context-free system, expanded depth first without storing the word.
void bench_stream(const std::string& name, const LsystemParams& params, std::uint32_t steps) {
  const Grammar grammar = compiled(params);
  Counter counter;
  const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] {
    Job job(0, {.limits = roomy()});
    counter = {};
    ContextFreeDerivation<Counter>(grammar, steps, false, job, counter).run();
  });
  if (!(counter.sum < 1e300)) std::abort();
  bench::report(name, "modules", static_cast<double>(counter.modules), seconds);
}

LsystemParams bush() {
  LsystemParams params;
  params.axiom = "F";
  params.productions = {"F->FF-[-F+F+F]+[+F-F-F]"};
  return params;
}

/// Figure 2.6a of The Algorithmic Beauty of Plants, a tree after Honda.
LsystemParams honda_tree() {
  LsystemParams params;
  params.axiom = "A(1,10)";
  params.productions = {"A(l,w) -> !(w)F(l)[&(a0)B(l*r2,w*wr)]/(d)A(l*r1,w*wr)",
                        "B(l,w) -> !(w)F(l)[-(a2)$C(l*r2,w*wr)]C(l*r1,w*wr)",
                        "C(l,w) -> !(w)F(l)[+(a2)$B(l*r2,w*wr)]B(l*r1,w*wr)"};
  for (const auto& [key, value] : std::vector<std::pair<std::string, double>>{
           {"r1", 0.9}, {"r2", 0.6}, {"a0", 45}, {"a2", 45}, {"d", 137.5}, {"wr", 0.707}}) {
    params.constants[key] = value;
  }
  return params;
}

// Tajić 2009, table 2: systems A, B and C, which took 13, 25 and 1 seconds to draw at depth 15.
LsystemParams tajic(char system) {
  LsystemParams params;
  params.axiom = system == 'A' ? "FFFFFA" : system == 'B' ? "FFFB" : "FA";
  params.productions = system == 'A'   ? std::vector<std::string>{"A -> F[&&A][^^A]///A"}
                       : system == 'B' ? std::vector<std::string>{"B -> F[&B]//F[^^B]///B"}
                                       : std::vector<std::string>{"A -> F/B///B/////B", "B -> F[^F/////A]"};
  params.interpretation = {"A -> F", "B -> F"};
  params.step.value = 0.15;
  params.width.value = 0.04;
  params.sides = 6;
  return params;
}

/// Streams the modules of the word one by one.
void bench_words(char system, std::uint32_t steps) {
  const Grammar grammar = compiled(tajic(system));
  Counter counter;
  const double seconds = bench::median_seconds<bench::CpuClock>(3, [&] {
    Job job(0, {.limits = roomy()});
    counter = {};
    ContextFreeDerivation<Counter>(grammar, steps, false, job, counter).run();
  });
  bench::report(std::string("Tajic ") + system + " n=" + std::to_string(steps) + ", derivation", "modules",
                static_cast<double>(counter.modules), seconds);
}

/// Generates the model with the limits of a service. A refusal is printed instead of a result.
void bench_model(char system, std::uint32_t steps, LsystemParams::Style style) {
  LsystemParams params = tajic(system);
  params.iterations = static_cast<std::int32_t>(steps);
  params.style = style;
  const bool tubes = style == LsystemParams::Style::tubes;
  const std::string name =
      std::string("Tajic ") + system + " n=" + std::to_string(steps) + (tubes ? ", tubes" : ", lines");
  std::uint64_t elements = 0;
  try {
    const double seconds = bench::median_seconds<bench::CpuClock>(3, [&] {
      Job job(0, Job::Options{});
      const Result<Model> model = generate(params, context_of(job));
      if (!model) std::abort();
      elements = 0;
      for (const MeshGroup& group : model->meshes) {
        for (const Primitive& each : group.primitives) elements += each.mesh.index.size() / (tubes ? 3 : 2);
      }
    });
    bench::report(name, tubes ? "triangles" : "segments", static_cast<double>(elements), seconds);
  } catch (const Stop& stop) {
    std::fprintf(stderr, "%s: refused: %s\n", name.c_str(), stop.what());
  }
}

}  // namespace

int main() {
  bench_plain("D0L bush n=7", bush(), 7);
  bench_plain("D0L bush n=8", bush(), 8);
  bench_stream("D0L bush n=8, streamed", bush(), 8);
  bench_stream("parametric tree 2.6a n=19", honda_tree(), 19);
  bench_signal();
  for (const char system : {'A', 'B', 'C'}) {
    for (const std::uint32_t steps : {6U, 9U, 10U, 12U, 14U, 15U}) {
      bench_words(system, steps);
      bench_model(system, steps, LsystemParams::Style::lines);
      bench_model(system, steps, LsystemParams::Style::tubes);
    }
  }
}
