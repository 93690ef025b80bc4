/// How fast fields, erosion and meshes are made. On two threads, by the clock on the wall; `bytes` are those
/// of the result, which bench.mjs compares with copying as many.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/generators/terrain/filters.h"
#include "core/generators/terrain/noise.h"
#include "core/generators/terrain/subdivide.h"
#include "core/generators/terrain/triangulation.h"
#include "core/pipeline.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;
using namespace seedmesh::terrain;

constexpr int rounds = 5;

Job roomy() {
  Job::Options options;
  options.threads = 2;
  options.limits.memory_bytes = std::uint64_t{6} << 30U;
  options.limits.output_bytes = std::uint64_t{3} << 30U;
  return Job(1, options);
}

void line(const std::string& name, const char* unit, double amount, double bytes, double seconds) {
  std::printf("{\"name\":\"%s\",\"unit\":\"%s\",\"amount\":%.0f,\"bytes\":%.0f,\"seconds\":%.9f}\n",
              name.c_str(), unit, amount, bytes, seconds);
  std::fflush(stdout);
}

template <class Work>
double timed(Work&& work) {
  return bench::median_seconds<bench::WallClock>(rounds, work);
}

Field diamonds(int iterations) {
  const std::int32_t side = (1 << iterations) + 1;
  const SquareSubdivision plan{.rounds = iterations, .amplitude = 100, .falloff = 0.574};
  return subdivide(plan, World::bounded, {0, 0, side, side}, Rng(1), roomy());
}

Field hills(std::int32_t side) {
  NoisePlan plan;
  plan.amplitude = 100;
  plan.gain = 0.5;
  plan.wavelength = side / 3.0;
  return noisy(plan, {0, 0, side, side}, 1, Rng(1), roomy());
}

void bench_copy() {
  const std::size_t size = std::size_t{256} << 20U;
  std::vector<char> from(size, 1), to(size, 2);
  const double seconds = timed([&] { std::memcpy(to.data(), from.data(), size); });
  if (to[size / 2] != 1) std::abort();
  line("copying", "bytes", static_cast<double>(size), static_cast<double>(size), seconds);
}

void bench_fields() {
  const double cells = 4097.0 * 4097;
  line("diamond-square 4097", "cells", cells, 4 * cells, timed([] { diamonds(12); }));
  const double noise_cells = 1025.0 * 1025;
  line("fBm of 8 octaves 1025", "cells", noise_cells, 4 * noise_cells, timed([] { hills(1025); }));
  const Field ground = hills(513);
  Field worn = hills(513);
  const double seconds = timed([&] {
    std::memcpy(worn.heights.data(), ground.heights.data(), ground.heights.bytes());
    erode(worn, {.droplets = 65'536}, Rng(1), roomy());
  });
  line("65536 droplets 513", "droplets", 65'536, 4.0 * 513 * 513, seconds);
}

using Reducer = Triangulation (*)(const Field&, double, Border, Job&);
void bench_reduced(const std::string& name, Reducer reduce) {
  const Field field = hills(1025);
  const Job job = roomy();
  const Range range = range_of(field, job);
  const double error = 0.002 * static_cast<double>(range.high - range.low);
  double triangles = 0, vertices = 0;
  const double seconds = timed([&] {
    Job own = roomy();
    const Triangulation mesh = reduce(field, error, Border::by_error, own);
    triangles = static_cast<double>(mesh.index.size()) / 3;
    vertices = static_cast<double>(mesh.samples.size());
  });
  line(name, "reduced triangles", triangles, 12 * triangles + 4 * vertices, seconds);
}

void bench_mesh() {
  const Result<Request> request =
      read_request(R"({"generator":"terrain","parameters":{"iterations":12,"palette":"none"}})", Limits{});
  if (!request) std::abort();
  double bytes = 0, triangles = 0;
  const double seconds = timed([&] {
    Job job = roomy();
    const Result<Product> product = produce(*request, job);
    if (!product) std::abort();
    bytes = static_cast<double>(product->payload.size());
    triangles = static_cast<double>(product->statistics.triangles);
  });
  line("diamond-square 4097 to GLB", "grid triangles", triangles, bytes, seconds);
}

}  // namespace

int main() {
  bench_copy();
  bench_fields();
  bench_reduced("RTIN 1025 at .002", rtin);
  bench_reduced("greedy 1025 at .002", greedy);
  bench_mesh();
}
