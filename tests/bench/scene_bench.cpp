/// The speed of placing, listing and writing scenes on two threads, in wall time, and their memory in
/// addition to the response size.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/generators/scene/candidate_positions.h"
#include "core/pipeline.h"
#include "core/schema/json.h"
#include "tests/bench/kept_textures.h"
#include "tests/bench/memory.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

// The first round warms memory and caches. The number of further rounds depends on the time limit, with a
// minimum of one.
constexpr std::size_t most_rounds = 5;
constexpr double enough_seconds = 4;

Job::Options roomy_options() {
  Job::Options options;
  options.threads = 2;
  options.limits.memory_bytes = std::uint64_t{6} << 30U;
  options.limits.output_bytes = std::uint64_t{3} << 30U;
  return options;
}

Job roomy() { return Job(1, roomy_options()); }

/// Wall time, and processor time of all threads, which other processes on the machine hardly affect.
struct Seconds {
  double wall = 0, cores = 0;
};

template <class Work>
Seconds timed(Work&& work) {
  const auto once = [&] {
    const Seconds start{bench::WallClock::seconds(), bench::CpuClock::seconds()};
    work();
    return Seconds{bench::WallClock::seconds() - start.wall, bench::CpuClock::seconds() - start.cores};
  };
  const double fitting = std::floor(enough_seconds / std::max(once().wall, 1e-3));
  std::vector<Seconds> rounds(std::clamp<std::size_t>(static_cast<std::size_t>(fitting), 1, most_rounds));
  for (Seconds& each : rounds) each = once();
  const auto middle = rounds.begin() + static_cast<std::ptrdiff_t>(rounds.size() / 2);
  std::nth_element(rounds.begin(), middle, rounds.end(),
                   [](const Seconds& a, const Seconds& b) { return a.wall < b.wall; });
  return *middle;
}

/// `bytes` is the response size, or 0 if no response is written.
void print(const std::string& name, const char* unit, double amount, double bytes, const Seconds& seconds) {
  std::printf(
      "{\"name\":\"%s\",\"unit\":\"%s\",\"amount\":%.0f,\"bytes\":%.0f,\"seconds\":%.9f,\"cores\":%.9f}\n",
      name.c_str(), unit, amount, bytes, seconds.wall, seconds.cores);
  std::fflush(stdout);
}

void bench_poisson() {
  const scene::Extent ground{glm::dvec2(-500), glm::dvec2(500)};
  double places = 0;
  const Seconds seconds = timed([&] {
    places = static_cast<double>(scene::poisson_disk(ground, ground, 0.82, Rng(1), roomy()).size());
  });
  print("Poisson disk", "places", places, 0, seconds);
}

/// Returns the response size in bytes, or 0 if the request is refused.
double made(const Json& json, Seconds& seconds) {
  const Result<Request> request = read_request(json.dump(), Limits{});
  if (!request) return 0;
  double bytes = 0;
  seconds = timed([&] {
    const Result<Product> product = produce(*request, roomy_options());
    if (!product) std::abort();
    bytes = static_cast<double>(product->payload.size());
  });
  return bytes;
}

void report_made(const std::string& name, const char* unit, double amount, const Json& json) {
  Seconds seconds;
  const double bytes = made(json, seconds);
  if (bytes > 0) print(name, unit, amount, bytes, seconds);
}

Json tree(int levels) {
  return {{"preset", "proctree_0"}, {"parameters", {{"mLevels", levels}, {"mSegments", 6}}}};
}

/// Smooth noise (gain 0.5) with one sample per 2 m, simplified to an error of 0.002 of its range of 206 m.
Json terrain(int resolution = 1025) {
  return {{"generator", "terrain"},
          {"parameters",
           {{"algorithm", "fbm"},
            {"resolution", resolution},
            {"size", 2000},
            {"amplitude", 120},
            {"hurst", 1},
            {"mesh", "greedy"},
            {"max_error", 0.41}}}};
}

Json list(int placements) {
  const Json cube = {{"generator", "fractal"}, {"parameters", {{"iterations", 0}}}};
  return {{"generator", "scene"},
          {"parameters",
           {{"ground", {{"size", 4000}}},
            {"layers", {{{"model", cube}, {"place", {{"method", "scatter"}, {"count", placements}}}}}}}},
          {"output", {{"format", "placements"}}}};
}

/// 16 tree models on a terrain.
Json forest(int trees, int resolution, const Json& output = Json::object()) {
  return {{"generator", "scene"},
          {"output", output},
          {"parameters",
           {{"terrain", terrain(resolution)},
            {"layers",
             {{{"model", tree(4)},
               {"variants", 16},
               {"place", {{"method", "scatter"}, {"count", trees}, {"slope", {{"to", 40}}}}},
               {"scale", {0.7, 1.3}}}}}}}};
}

void bench_forest() {
  Json json = forest(100'000, 1025);
  report_made("100,000 trees on 1025 x 1025 as nodes", "trees", 100'000, json);
  json["output"] = {{"profile", "web"}};
  report_made("100,000 trees on 1025 x 1025 for the web", "trees", 100'000, json);
  json["parameters"]["camera"] = {{"position", {0, 60, 1000}}};
  report_made("the same for a camera, far ones as pictures", "trees", 100'000, json);
  json["parameters"].erase("camera");
  json["output"]["impostor"] = true;
  json["output"]["max_triangles"] = 20'000'000;
  report_made("the same within 20 M triangles", "trees", 100'000, json);
}

Product produced(const Json& json, TextureStore& textures) {
  const Result<Request> request = read_request(json.dump(), Limits{});
  if (!request) std::abort();
  Result<Product> product = produce(*request, roomy_options(), &textures);
  if (!product) std::abort();
  return *std::move(product);
}

/// Measures the memory of a large scene after a small one of the same models.
void bench_memory(const std::string& name, const Json& small, const Json& large) {
  bench::KeptTextures textures;
  const auto prepare = [&] { produced(small, textures); };
  if (!bench::report_memory(name, prepare, [&] { return produced(large, textures).payload.size(); }))
    std::abort();
}

/// The same plants with a skeleton and the animation.
void bench_animation(int count) {
  const Json model = {{"preset", "growing_tree"}, {"parameters", {{"sides", 5}, {"iterations", 5}}}};
  const Json place = {{"method", "scatter"}, {"count", count}};
  report_made("growth animation of " + std::to_string(count) + " trees of 4 models", "trees", count,
              {{"generator", "scene"},
               {"parameters", {{"layers", {{{"model", model}, {"variants", 4}, {"place", place}}}}}},
               {"output", {{"textures", "none"}, {"animation", "growth"}}}});
}

/// Every tree is a separate model with its own age.
void bench_growth(int count) {
  Json positions = Json::array();
  for (int i = 0; i < count; ++i)
    positions.push_back({{"at", {i % 25 * 3 - 36, i / 25 * 3 - 30}}, {"age", 3 + i % 4 * 0.5}});
  const Json model = {{"preset", "growing_tree"}, {"parameters", {{"sides", 5}}}};
  report_made("one growth step of " + std::to_string(count) + " trees", "trees", count,
              {{"generator", "scene"},
               {"parameters",
                {{"age", 4.25},
                 {"layers",
                  {{{"model", model},
                    {"variants", 1},
                    {"place", {{"method", "positions"}, {"positions", positions}}}}}}}},
               {"output", {{"textures", "none"}}}});
}

}  // namespace

int main(int argc, char** argv) {
  // Runs first, while this process is small, because a forked process starts with the memory of its parent.
  const Json web = {{"profile", "web"}};
  bench_memory("100,000 trees as nodes", forest(100, 65), forest(100'000, 1025));
  bench_memory("100,000 trees for the web", forest(100, 65, web), forest(100'000, 1025, web));
  bench_memory("1 M placements as list", list(100), list(1'000'000));
  if (argc > 1 && std::string(argv[1]) == "memory") return 0;
  bench_poisson();
  report_made("1 M placements as list", "placements", 1e6, list(1'000'000));
  bench_forest();
  bench_growth(50);
  bench_growth(500);
  bench_animation(50);
  bench_animation(500);
}
