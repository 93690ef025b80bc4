/// Cities on one thread: plans of 1 and 16 square kilometres, one of about 100,000 streets, a GLB of 16 square
/// kilometres with shared houses, and one of about 26,000 different houses.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/generators/city/city.h"
#include "core/pipeline.h"
#include "core/schema/json.h"
#include "generated/params/city.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

city::CityPlan plan_of_square(double metres) {
  CityParams params;
  params.area.size = {metres, metres};
  Job::Options options;
  options.threads = 1;
  Job job(1, options);
  Result<city::CityPlan> plan = city::plan_of(params, job);
  if (!plan) std::abort();
  return *std::move(plan);
}

void report_plan(const std::string& name, double metres, int rounds) {
  double streets = 0, lots = 0;
  const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] {
    const city::CityPlan plan = plan_of_square(metres);
    streets = 0;
    for (std::uint32_t edge = 0; edge < plan.graph.edges.size(); ++edge)
      streets += plan.graph.is_street(edge) ? 1 : 0;
    lots = static_cast<double>(plan.lots.size());
  });
  bench::report(name, "streets", streets, seconds);
  bench::report(name + ", lots", "lots", lots, seconds);
}

/// Makes the model of a city and reports its bytes and the triangles that it draws.
void report_model(const char* name, const Json& parameters, const Limits& limits = {}) {
  const Json body = {{"generator", "city"}, {"seed", 1}, {"parameters", parameters}};
  const Result<Request> request = read_request(body.dump(), limits);
  if (!request) std::abort();
  std::uint64_t bytes = 0, triangles = 0;
  Job::Options options;
  options.threads = 1;
  options.limits = limits;
  const double seconds = bench::median_seconds<bench::CpuClock>(3, [&] {
    const Result<Product> product = produce(*request, options);
    if (!product) std::abort();
    bytes = product->payload.size();
    triangles = product->statistics.triangles;
  });
  std::printf(
      "{\"name\":\"%s\",\"unit\":\"models\",\"amount\":1,\"seconds\":%.9f,\"bytes\":%llu,\"triangles\":%llu}"
      "\n",
      name, seconds, static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(triangles));
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

int main() {
  report_plan("city plan of 1 km2", 1000, 7);
  report_plan("city plan of 16 km2", 4000, 5);
  report_plan("city plan of 144 km2", 12'000, 1);
  report_model("city of 16 km2 to GLB", {{"area", {{"size", {4000, 4000}}}}});
  report_model("city of 26,000 houses to GLB", thesis_city());
}
