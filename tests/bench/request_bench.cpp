/// From the request text to the bytes of a GLB: the time per triangle of the three largest presets of each
/// generator, and the memory of one large response in addition to its own size.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "core/pipeline.h"
#include "tests/bench/memory.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

struct Sized {
  std::string name;
  std::uint64_t triangles = 0;
  std::uint64_t bytes = 0;
};

Sized made(const std::string& name, const Request& request, int threads) {
  const Result<Product> product = produce(request, {.threads = threads});
  if (!product) return {name, 0, 0};
  return {name, product->statistics.triangles, product->payload.size()};
}

/// The largest presets of each generator, in descending order.
std::vector<Sized> biggest_presets(std::size_t count) {
  std::map<std::string, std::vector<Sized>> by_generator;
  for (const PresetInfo& preset : presets()) {
    const auto request = read_preset(preset.name, {}, Limits{});
    if (request && *request) by_generator[preset.generator].push_back(made(preset.name, **request, 1));
  }
  std::vector<Sized> biggest;
  for (auto& [generator, all] : by_generator) {
    std::sort(all.begin(), all.end(), [](const Sized& a, const Sized& b) {
      return a.triangles != b.triangles ? a.triangles > b.triangles : a.name < b.name;
    });
    all.resize(std::min(all.size(), count));
    biggest.insert(biggest.end(), all.begin(), all.end());
  }
  return biggest;
}

template <class Clock>
void bench_preset(const Sized& preset, int threads) {
  const std::string text = preset_json(preset.name).value();
  const double seconds = bench::median_seconds<Clock>(15, [&] {
    const Result<Request> request = read_request(text, Limits{});
    if (!request || made(preset.name, *request, threads).triangles != preset.triangles) std::abort();
  });
  const char* const unit = threads == 1 ? ", 1 thread" : ", all cores";
  bench::report("request to GLB: " + preset.name + unit, "triangles", static_cast<double>(preset.triangles),
                seconds);
}

/// Measures the memory of the preset with this number of iterations. Returns false if the response is smaller than
/// required or refused.
bool bench_memory(const std::string& name, int iterations, std::uint64_t least_bytes) {
  const auto work = [&]() -> std::size_t {
    const auto request = read_preset(name, {{"iterations", std::to_string(iterations)}}, Limits{});
    if (!request || !*request) return 0;
    const Result<Product> product =
        produce(**request, {.threads = static_cast<int>(std::thread::hardware_concurrency())});
    return product && product->payload.size() >= least_bytes ? product->payload.size() : 0;
  };
  const std::string title = name + ", " + std::to_string(iterations) + " iterations";
  return bench::report_memory(
      title, [] {}, work);
}

int iterations_of(const std::string& name) {
  const std::string text = preset_json(name).value();
  const std::size_t at = text.find("\"iterations\":");
  return at == std::string::npos ? 1 : std::atoi(text.c_str() + at + 13);
}

}  // namespace

int main() {
  const std::vector<Sized> biggest = biggest_presets(3);
  // Runs first, while this process is small, because a forked process starts with the memory of its parent.
  for (const Sized& preset : biggest) {
    constexpr std::uint64_t big = 50'000'000;
    const int from = iterations_of(preset.name);
    for (int more = 0; more < 8 && !bench_memory(preset.name, from + more, big); ++more) {
    }
  }
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (const Sized& preset : biggest) {
    bench_preset<bench::CpuClock>(preset, 1);
    if (cores > 1) bench_preset<bench::WallClock>(preset, cores);
  }
}
