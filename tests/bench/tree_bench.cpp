/// From the text of a request to the bytes of a GLB for trees of each model: time a triangle, bark and leaves
/// together. Textures are kept from one request to the next, as the server keeps them.
#include <cstdlib>
#include <map>
#include <string>

#include "core/base/texture_store.h"
#include "core/pipeline.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

class Kept : public TextureStore {
 public:
  std::shared_ptr<const void> find(const std::string& key) override {
    const auto found = all_.find(key);
    return found == all_.end() ? nullptr : found->second;
  }
  void keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t) override {
    all_.emplace(key, std::move(value));
  }

 private:
  std::map<std::string, std::shared_ptr<const void>> all_;
};

std::uint64_t triangles_of(const std::string& text) {
  static Kept textures;
  const Result<Request> request = read_request(text, Limits{});
  if (!request) std::abort();
  Job job(request->seed(), Job::Options{});
  const Result<Product> product = produce(*request, job, &textures);
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
