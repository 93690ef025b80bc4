/// The speed of fields, erosion and meshing on two threads, in wall time. `bytes` is the size of the result;
/// bench.mjs compares the speed with copying the same number of bytes.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/generators/terrain/faults.h"
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

Job::Options roomy_options() {
  Job::Options options;
  options.threads = 2;
  options.limits.memory_bytes = std::uint64_t{6} << 30U;
  options.limits.output_bytes = std::uint64_t{3} << 30U;
  return options;
}

Job roomy() { return Job(1, roomy_options()); }

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
    erode_by_droplets(worn, {.droplets = 65'536}, Rng(1), roomy());
  });
  line("65536 droplets 513", "droplets", 65'536, 4.0 * 513 * 513, seconds);
}

/// Value noise of eight octaves with the same samples as in peer_terrain.mjs.
Field peer_hills() {
  constexpr std::int32_t side = 1025;
  constexpr double gain = 0.525;
  Field field(roomy(), side, side, 0);
  for (float& height : field.heights) height = 0;
  const auto hash = [](double x, double z, int octave) {
    const auto whole = [](double number) {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(number));
    };
    std::uint32_t bits =
        whole(x) * 374761393U ^ whole(z) * 668265263U ^ static_cast<std::uint32_t>(octave) * 2147483647U;
    bits = (bits ^ static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> 13)) * 1274126177U;
    return (bits ^ static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> 16)) / 4294967296.0;
  };
  const auto ease = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  double cell = side / 3.0, weight = 1;
  for (int octave = 0; octave < 8; ++octave, cell /= 2, weight *= gain) {
    for (std::int32_t z = 0; z < side; ++z) {
      for (std::int32_t x = 0; x < side; ++x) {
        const double fx = x / cell, fz = z / cell, i = std::floor(fx), j = std::floor(fz);
        const double u = ease(fx - i), v = ease(fz - j);
        const double north = hash(i, j, octave) * (1 - u) + hash(i + 1, j, octave) * u;
        const double south = hash(i, j + 1, octave) * (1 - u) + hash(i + 1, j + 1, octave) * u;
        float& height = field.at(x, z);
        height = static_cast<float>(static_cast<double>(height) + weight * (north * (1 - v) + south * v));
      }
    }
  }
  return field;
}

using Reducer = Triangulation (*)(const Field&, double, Border, Job&);
void bench_reduced(const std::string& name, Reducer reduce) {
  const Field field = peer_hills();
  const Job job = roomy();
  const Range range = range_of(field, job);
  const double error = 0.002 * (static_cast<double>(range.high) - static_cast<double>(range.low));
  double triangles = 0, vertices = 0;
  const double seconds = timed([&] {
    Job own = roomy();
    const Triangulation mesh = reduce(field, error, Border::by_error, own);
    triangles = static_cast<double>(mesh.index.size()) / 3;
    vertices = static_cast<double>(mesh.samples.size());
  });
  line(name, "reduced triangles", triangles, 12 * triangles + 4 * vertices, seconds);
}

/// Geological faults with a slope over two samples, as in the peer.
void bench_faults() {
  constexpr std::int32_t side = 257;
  const FaultPlan plan{.planned = 362, .greatest = 10, .step = FaultStep::cosine, .width = 2};
  const double cells = double{side} * side;
  const double seconds = timed([&] {
    faulted(plan, {0, 0, side, side}, {0, 0, side, side}, 1, Rng(1), roomy());
  });
  line("362 faults 257", "cells and faults", cells * plan.planned, 4 * cells, seconds);
}

void bench_smoothing() {
  Field field = hills(4097);
  const double cells = 4097.0 * 4097;
  line("smooth 4097", "cells", cells, 4 * cells, timed([&] { smooth(field, 40, roomy()); }));
}

/// A complete request. `unit` selects what is counted: triangles or samples.
void bench_request(const char* name, const char* unit, const char* json, double samples) {
  const Result<Request> request = read_request(json, Limits{});
  if (!request) std::abort();
  double bytes = 0, triangles = 0;
  const double seconds = timed([&] {
    const Result<Product> product = produce(*request, roomy_options());
    if (!product) std::abort();
    bytes = static_cast<double>(product->payload.size());
    triangles = static_cast<double>(product->statistics.triangles);
  });
  line(name, unit, samples > 0 ? samples : triangles, bytes, seconds);
}

}  // namespace

// Usage: terrain_bench [words of a name]
int main(int argc, char** argv) {
  struct Bench {
    const char* name;
    void (*run)();
  };
  const Bench all[] = {
      {"copying", bench_copy},
      {"fields", bench_fields},
      {"faults", bench_faults},
      {"smooth", bench_smoothing},
      {"rtin", [] { bench_reduced("RTIN 1025 at .002", rtin); }},
      {"greedy", [] { bench_reduced("greedy 1025 at .002", greedy); }},
      {"grid",
       [] {
         bench_request("diamond-square 4097 to GLB", "grid triangles",
                       R"({"generator":"terrain","parameters":{"iterations":12,"palette":"none"}})", 0);
       }},
      {"levels",
       [] {
         bench_request("four levels of 2049 to GLB", "grid triangles",
                       R"({"generator":"terrain","parameters":{"iterations":11,"palette":"none"},
                           "output":{"profile":"unity","lods":4}})",
                       0);
       }},
      {"maps",
       [] {
         bench_request("diamond-square 4097 to r16", "cells",
                       R"({"generator":"terrain","parameters":{"iterations":12},"output":{"format":"r16"}})",
                       4097.0 * 4097);
         bench_request(
             "diamond-square 1025 to PNG of 16 bits", "cells",
             R"({"generator":"terrain","parameters":{"iterations":10},"output":{"format":"png16"}})",
             1025.0 * 1025);
       }},
  };
  const std::string words = argc > 1 ? argv[1] : "";
  for (const Bench& bench : all) {
    if (std::string(bench.name).find(words) != std::string::npos) bench.run();
  }
}
