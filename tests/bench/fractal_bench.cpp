/// Fractals: the Menger sponge from the request text to the bytes of a GLB, with its memory in addition to
/// the response, and the chaos game.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "core/generators/fractal/chaos.h"
#include "core/pipeline.h"
#include "generated/params/fractal.h"
#include "tests/bench/memory.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

std::string sponge(int rounds, const std::string& surface = "faces") {
  return R"({"generator":"fractal","parameters":{"iterations":)" + std::to_string(rounds) +
         R"(,"surface":")" + surface + "\"}}";
}

Product made(const std::string& text, int threads) {
  const Result<Request> request = read_request(text, Limits{});
  if (!request) std::abort();
  Result<Product> product = produce(*request, {.threads = threads});
  if (!product) std::abort();
  return *std::move(product);
}

void bench_sponge(int rounds, int threads, int repeats) {
  double triangles = 0;
  const double seconds = bench::median_seconds<bench::WallClock>(
      repeats, [&] { triangles = static_cast<double>(made(sponge(rounds), threads).statistics.triangles); });
  bench::report("Menger " + std::to_string(rounds) + (threads == 1 ? ", 1 thread" : ", all cores"),
                "triangles", triangles, seconds);
}

void bench_merged(int rounds) {
  Product product;
  const double seconds =
      bench::median_seconds<bench::WallClock>(5, [&] { product = made(sponge(rounds, "merged"), 1); });
  bench::report("Menger " + std::to_string(rounds) + " merged, 1 thread", "triangles",
                static_cast<double>(product.statistics.triangles), seconds);
}

void bench_memory(int rounds) {
  const auto work = [&] { return made(sponge(rounds), 1).payload.size(); };
  if (!bench::report_memory(
          "Menger " + std::to_string(rounds), [] {}, work))
    std::abort();
}

void bench_chaos() {
  constexpr std::uint64_t points = 20'000'000;
  FractalParams params;
  params.method = FractalMethod::frcm;
  params.instructions = FractalInstructions::fern;
  const fractal::Instructions fern = fractal::instructions_of(params);
  const double seconds = bench::median_seconds<bench::CpuClock>(5, [&] {
    Job job(1, Job::Options{});
    if (fractal::play(fern, fractal::StartPoints(), points, 100, job).position.size() != points) std::abort();
  });
  bench::report("chaos game, 1 thread", "points", static_cast<double>(points), seconds);
}

}  // namespace

int main() {
  bench_memory(4);
  bench_memory(5);
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (const int threads : {1, cores}) {
    bench_sponge(3, threads, 15);
    bench_sponge(4, threads, 9);
    bench_sponge(5, threads, 3);
    if (cores == 1) break;
  }
  bench_merged(4);
  bench_chaos();
}
