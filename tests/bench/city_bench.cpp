/// Cities on one thread: plans of 1 and 16 square kilometres, one of about 100,000 streets, and a GLB of 16 square
/// kilometres.
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

void report_model() {
  const Json body = {
      {"generator", "city"}, {"seed", 1}, {"parameters", {{"area", {{"size", {4000, 4000}}}}}}};
  const Result<Request> request = read_request(body.dump(), Limits{});
  if (!request) std::abort();
  std::uint64_t bytes = 0;
  const double seconds = bench::median_seconds<bench::CpuClock>(3, [&] {
    const Result<Product> product = produce(*request, {});
    if (!product) std::abort();
    bytes = product->payload.size();
  });
  std::printf(
      "{\"name\":\"city of 16 km2 to "
      "GLB\",\"unit\":\"models\",\"amount\":1,\"seconds\":%.9f,\"bytes\":%llu}\n",
      seconds, static_cast<unsigned long long>(bytes));
}

}  // namespace

int main() {
  report_plan("city plan of 1 km2", 1000, 7);
  report_plan("city plan of 16 km2", 4000, 5);
  report_plan("city plan of 144 km2", 12'000, 1);
  report_model();
}
