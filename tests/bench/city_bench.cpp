/// Cities on one thread: plans of 1 and 16 square kilometres, one of about 100,000 streets with 500,000 lots, the stages of
/// a plan, a GLB of 16 square kilometres with shared houses, and one of about 26,000 different houses, both with
/// their memory in addition to that of a small city.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/generators/city/city.h"
#include "core/pipeline.h"
#include "core/schema/json.h"
#include "generated/params/city.h"
#include "tests/bench/kept_textures.h"
#include "tests/bench/memory.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

city::CityPlan plan_with(const CityParams& params, const Job::Progress& progress = {}) {
  Job::Options options;
  options.threads = 1;
  options.progress = progress;
  Job job(1, options);
  Result<city::CityPlan> plan = city::plan_of(params, job);
  if (!plan) std::abort();
  return *std::move(plan);
}

CityParams square(double metres) {
  CityParams params;
  params.area.size = {metres, metres};
  return params;
}

double streets_of(const city::CityPlan& plan) {
  double streets = 0;
  for (std::uint32_t edge = 0; edge < plan.graph.edges.size(); ++edge)
    streets += plan.graph.is_street(edge) ? 1 : 0;
  return streets;
}

void report_plan(const std::string& name, const CityParams& params, int rounds) {
  double streets = 0, lots = 0;
  const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] {
    const city::CityPlan plan = plan_with(params);
    streets = streets_of(plan);
    lots = static_cast<double>(plan.lots.size());
  });
  bench::report(name, "streets", streets, seconds);
  bench::report(name + ", lots", "lots", lots, seconds);
}

/// The stages of a plan: pieces of streets with growth, graph and faces; blocks; lots with the places of their houses.
void report_stages(const std::string& name, CityParams params, CityDivision method) {
  params.lots.division = method;
  std::map<std::string, std::vector<double>, std::less<>> seconds;
  double streets = 0, blocks = 0, lots = 0;
  for (int round = 0; round < 5; ++round) {
    std::vector<std::pair<std::string, double>> begun;
    const city::CityPlan plan = plan_with(params, [&](std::string_view stage, double) {
      begun.emplace_back(stage, bench::CpuClock::seconds());
    });
    begun.emplace_back("", bench::CpuClock::seconds());
    for (std::size_t i = 0; i + 1 < begun.size(); ++i)
      seconds[begun[i].first].push_back(begun[i + 1].second - begun[i].second);
    streets = streets_of(plan);
    blocks = static_cast<double>(plan.blocks.size());
    lots = static_cast<double>(plan.lots.size());
  }
  const auto median = [&](const char* stage) {
    std::vector<double>& all = seconds[stage];
    std::sort(all.begin(), all.end());
    return all[all.size() / 2];
  };
  bench::report(name + ": growth and graph", "streets", streets, median("streets"));
  bench::report(name + ": blocks", "blocks", blocks, median("blocks"));
  bench::report(name + ": lots and houses", "lots", lots, median("lots"));
}

/// The heights of the streets on hills, for each sample.
void report_grades() {
  CityParams params = square(3000);
  params.maps.height = "12 * sin(x / 4) + 9 * cos(y / 5)";
  const city::CityPlan plan = plan_with(params);
  Job job(1, Job::Options{});
  const double seconds = bench::median_seconds<bench::CpuClock>(
      5, [&] { city::street_heights(plan, *plan.landform, -1e9, city::everywhere, job); });
  bench::report("grades of 9 km2", "samples", static_cast<double>(plan.heights.points.size()), seconds);
}

Request request_of(const Json& parameters, const Limits& limits) {
  const Json body = {{"generator", "city"}, {"seed", 1}, {"parameters", parameters}};
  Result<Request> request = read_request(body.dump(), limits);
  if (!request) std::abort();
  return *std::move(request);
}

Product produced(const Json& parameters, TextureStore& textures) {
  Job::Options options;
  options.threads = 1;
  Result<Product> product = produce(request_of(parameters, {}), options, &textures);
  if (!product) std::abort();
  return *std::move(product);
}

/// Measures the memory of a city after a small one.
void report_memory(const std::string& name, const Json& parameters) {
  bench::KeptTextures textures;
  const auto prepare = [&] {
    Json small = parameters;
    small["area"]["size"] = {200, 200};
    produced(small, textures);
  };
  if (!bench::report_memory(name, prepare, [&] { return produced(parameters, textures).payload.size(); }))
    std::abort();
}

/// Makes the model of a city and reports its bytes and the triangles that it draws.
void report_model(const char* name, const Json& parameters, const Limits& limits = {}) {
  const Request request = request_of(parameters, limits);
  std::uint64_t bytes = 0, triangles = 0;
  Job::Options options;
  options.threads = 1;
  options.limits = limits;
  const double seconds = bench::median_seconds<bench::CpuClock>(3, [&] {
    const Result<Product> product = produce(request, options);
    if (!product) std::abort();
    bytes = product->payload.size();
    triangles = product->statistics.triangles;
  });
  std::printf(
      "{\"name\":\"%s\",\"unit\":\"models\",\"amount\":1,\"seconds\":%.9f,\"bytes\":%llu,\"triangles\":%llu}"
      "\n",
      name, seconds, static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(triangles));
  std::fflush(stdout);
}

/// About 26,000 houses, nearly all different: 100,000 seeds and lots of many sizes.
Json thesis_city() {
  return {
      {"area", {{"size", {5000, 5000}}}},
      {"maps", {{"density", "0.5"}}},
      {"lots", {{"area", {200, 800}}}},
      {"buildings",
       {{"variants", 100'000},
        {"detail", 2},
        {"rules",
         {{{"blueprint", "house"}, {"floors", {1, 3}}, {"front", 2}, {"side", 1}, {"depth", {8, 14}}}}}}}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  // Runs first, while this process is small, because a forked process starts with the memory of its parent.
  report_memory("city of 16 km2", {{"area", {{"size", {4000, 4000}}}}});
  report_memory("city of 26,000 houses", thesis_city());
  if (only == "memory") return 0;
  report_plan("city plan of 1 km2", square(1000), 7);
  report_plan("city plan of 16 km2", square(4000), 5);
  CityParams large = square(12'000);
  large.lots.area = {60, 260};
  large.lots.width = 5;
  report_plan("city plan of 144 km2", large, 1);
  report_stages("plan of 16 km2, recursive", square(4000), CityDivision::recursive);
  report_stages("plan of 16 km2, skeleton", square(4000), CityDivision::skeleton);
  report_grades();
  report_model("city of 16 km2 to GLB", {{"area", {{"size", {4000, 4000}}}}});
  report_model("city of 26,000 houses to GLB", thesis_city());
}
