/// Trees of each model, from the request text to the bytes of a GLB: the time per triangle of bark and leaves
/// together, and the memory of large trees in addition to the response size. Textures are cached between
/// requests, as in the server. Usage: tree_bench [preset [rounds [threads]]] runs one preset for a profiler;
/// the preset `small` is a tree of 20,000 triangles.

#include <cstdlib>
#include <string>

#include "core/base/huge_page_cache.h"
#include "core/pipeline.h"
#include "server/memory_trimmer.h"
#include "tests/bench/kept_textures.h"
#include "tests/bench/memory.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

bench::KeptTextures& textures() {
  static bench::KeptTextures kept;
  return kept;
}

/// The configuration of the service.
const std::shared_ptr<HugePageCache>& reserve() {
  static const auto kept = std::make_shared<HugePageCache>();
  return kept;
}

std::uint64_t triangles_of(const std::string& text, int threads = 1) {
  const Result<Request> request = read_request(text, Limits{});
  if (!request) std::abort();
  const Result<Product> product = produce(*request, {.threads = threads, .reserve = reserve()}, &textures());
  if (!product) std::abort();
  return product->statistics.triangles;
}

constexpr const char* small_tree =
    R"({"preset":"quaking_aspen","parameters":{"1Branches":22,"2Branches":18,"Leaves":22}})";

std::string preset_text(const std::string& preset) { return "{\"preset\":\"" + preset + "\"}"; }

void bench_tree(const std::string& name, const std::string& text, int rounds = 15) {
  const std::uint64_t triangles = triangles_of(text);
  const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] { triangles_of(text); });
  bench::report("tree to GLB: " + name, "triangles", static_cast<double>(triangles), seconds);
}

/// The minimum wall time until the response is complete.
void bench_answer(const std::string& name, const std::string& text, int threads, int rounds) {
  const std::uint64_t triangles = triangles_of(text, threads);
  const double seconds = bench::least_seconds<bench::WallClock>(rounds, [&] { triangles_of(text, threads); });
  bench::report("tree to GLB on the wall: " + name + ", threads " + std::to_string(threads), "triangles",
                static_cast<double>(triangles), seconds);
}

/// Measures the memory of a tree after a small one with the same textures.
void bench_memory(const std::string& name, const std::string& small, const std::string& text) {
  const auto prepare = [&] {
    triangles_of(small);
    reserve()->clear();  // as in an idle service
  };
  const auto work = [&]() -> std::size_t {
    const Result<Request> request = read_request(text, Limits{});
    if (!request) return 0;
    const Result<Product> product = produce(*request, {.reserve = reserve()}, &textures());
    return product ? product->payload.size() : 0;
  };
  if (!bench::report_memory(name, prepare, work)) std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  configure_malloc(2);  // memory pages are recycled as in the service
  if (argc > 1) {
    const std::string name = argv[1], text = name == "small" ? small_tree : preset_text(name);
    const int rounds = argc > 2 ? std::atoi(argv[2]) : 15;
    if (argc > 3) {
      bench_answer(name, text, std::atoi(argv[3]), rounds);
    } else {
      bench_tree(name, text, rounds);
    }
    return 0;
  }
  // Runs first, while this process is small, because a forked process starts with the memory of its parent.
  bench_memory("an oak with mesh leaves", R"({"preset":"oak"})",
               R"({"preset":"oak","parameters":{"leaf":{"build":"mesh"}}})");
  bench_memory("a row of 12 oaks", R"({"preset":"oak"})", R"({"preset":"oak","output":{"variants":12}})");
  bench_memory("three birches with mesh leaves", R"({"preset":"birch"})",
               R"({"preset":"birch","parameters":{"leaf":{"build":"mesh"}},"output":{"variants":3}})");
  bench_tree("20,000 triangles", small_tree, 41);
  for (const int threads : {1, 2}) bench_answer("20,000 triangles", small_tree, threads, 101);
  for (const char* preset : {"quaking_aspen", "oak", "birch", "black_oak", "black_tupelo", "weeping_willow",
                             "proctree_0", "proctree_3", "spruce"})
    bench_tree(preset, preset_text(preset));
}
