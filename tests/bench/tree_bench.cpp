/// From the text of a request to the bytes of a GLB for trees of each model: time a triangle, bark and leaves
/// together.
#include <cstdlib>
#include <string>

#include "core/pipeline.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

std::uint64_t triangles_of(const std::string& text) {
  const Result<Request> request = read_request(text, Limits{});
  if (!request) std::abort();
  Job job(request->seed(), Job::Options{});
  const Result<Product> product = produce(*request, job);
  if (!product) std::abort();
  return product->statistics.triangles;
}

void bench_tree(const std::string& preset) {
  const std::string text = "{\"preset\":\"" + preset + "\"}";
  const std::uint64_t triangles = triangles_of(text);
  const double seconds = bench::median_seconds<bench::CpuClock>(15, [&] { triangles_of(text); });
  bench::report("tree to GLB: " + preset, "triangles", static_cast<double>(triangles), seconds);
}

}  // namespace

int main() {
  for (const char* preset :
       {"quaking_aspen", "oak", "birch", "weeping_willow", "proctree_0", "proctree_3", "spruce"})
    bench_tree(preset);
}
