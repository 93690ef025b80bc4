/// Productions of street grammars and all that runs behind them: the lines of the input are productions, and the
/// first one that begins with "density " is the density. Every input ends soon, in a refusal or in a plan whose
/// parts fill the area.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/generators/city/city.h"
#include "generated/params/city.h"

namespace {

using namespace seedmesh;

CityParams params_of(std::string_view text) {
  CityParams params;
  params.area.size = {400, 300};
  params.streets.productions.clear();
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.starts_with("density ")) {
      params.maps.density = std::string(line.substr(8));
    } else if (!line.empty()) {
      params.streets.productions.emplace_back(line);
    }
  }
  return params;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const CityParams params = params_of({reinterpret_cast<const char*>(data), size});
  Job::Options options;
  options.limits.shapes = 50'000;
  Job job(size, options);
  if (!city::check(params, {job, {}}).empty()) return 0;
  try {
    const Result<city::CityPlan> plan = city::plan_of(params, job);
    if (!plan) std::abort();
    double sum = 0;
    for (const city::Part& part : plan->parts) sum += city::area_of(part.rings);
    if (std::abs(sum / city::area_of(plan->area) - 1) > 1e-9) std::abort();
  } catch (const Stop&) {
    // A limit is exceeded, which the pipeline reports to the client.
  }
  return 0;
}
