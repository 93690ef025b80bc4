/// The time of skin() and wires() per triangle or segment, on a synthetic tree whose limbs bend, taper and
/// fork.
#include <benchmark/benchmark.h>

#include "core/geom/plant/skin.h"
#include "tests/core/geom/skeletons.h"

namespace seedmesh {
namespace {

/// About `internodes` internodes in limbs of eight with random side branches, stored depth first as by the
/// turtle.
Limbs synthetic_tree(const Job& job, std::size_t internodes) {
  SkeletonMaker maker(job);
  Rng rng(11);
  struct Tip {
    std::uint32_t joint;
    Frame frame;
    float radius;
  };
  std::vector<Tip> tips{{maker.root({0, 0, 0}), Frame{}, 0.1F}};
  std::vector<Tip> waiting;
  while (maker.limbs.size() < internodes) {
    if (tips.empty()) std::swap(tips, waiting);
    auto [joint, frame, radius] = tips.back();
    tips.pop_back();
    bool is_branch = joint != 0;
    for (int i = 0; i < 8; ++i) {
      frame = roll(turn(frame, math::sincos(rng.uniform(-0.4, 0.4))), math::sincos(rng.uniform(-3, 3)));
      const glm::vec3 to = maker.limbs.position[joint] + glm::vec3(frame.heading * rng.uniform(0.5, 1));
      joint = is_branch ? maker.branch(joint, to, {radius, radius * 0.97F})
                        : maker.grow(joint, to, {radius, radius * 0.97F});
      is_branch = false;
      radius *= 0.97F;
      if (rng.below(4) == 0)
        (waiting.size() < 1000 ? waiting : tips).push_back({joint, turn(frame, math::sincos(0.7)), 0.05F});
    }
    if (tips.empty() && waiting.empty()) tips.push_back({joint, frame, 0.1F});
  }
  return std::move(maker.limbs);
}

void skin_of_a_million_internodes(benchmark::State& state) {
  Limits limits;
  limits.memory_bytes = std::uint64_t{8} << 30U;
  limits.triangles = limits.memory_bytes;
  Job maker(1, Job::Options{.limits = limits});
  const Limbs limbs = synthetic_tree(maker, 1'000'000);
  std::uint64_t triangles = 0;
  for (auto _ : state) {
    Job job(1, Job::Options{.limits = limits, .threads = static_cast<int>(state.range(1))});
    const auto barks = skin(limbs, {.sides = static_cast<int>(state.range(0))}, job);
    triangles += barks[0].mesh.elements();
    benchmark::DoNotOptimize(barks[0].mesh.position.data());
  }
  state.counters["triangles"] = benchmark::Counter(static_cast<double>(triangles),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(skin_of_a_million_internodes)
    ->ArgNames({"sides", "threads"})
    ->Args({6, 1})
    ->Args({8, 1})
    ->Args({6, 2})
    ->Args({8, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void wires_of_seven_million_segments(benchmark::State& state) {
  Limits limits;
  limits.memory_bytes = std::uint64_t{8} << 30U;
  limits.triangles = limits.memory_bytes;
  Job maker(1, Job::Options{.limits = limits});
  const Limbs limbs = synthetic_tree(maker, 7'200'000);
  std::uint64_t segments = 0;
  for (auto _ : state) {
    Job job(1, Job::Options{.limits = limits, .threads = static_cast<int>(state.range(0))});
    const auto barks = wires(limbs, job);
    segments += barks[0].mesh.elements();
  }
  state.counters["segments"] = benchmark::Counter(static_cast<double>(segments),
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(wires_of_seven_million_segments)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace seedmesh
