/// The processor time of each preset with a seed that was never asked for, without any cache, on one thread and
/// without compression: what the first request for a model costs, with its textures. Memory is kept between requests as
/// in the server. Also what of it the textures cost:
/// the difference to the same request with stored textures. Usage: cold_bench [presets].
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/base/huge_page_cache.h"
#include "core/pipeline.h"
#include "server/memory_trimmer.h"
#include "tests/bench/kept_textures.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

constexpr int rounds = 3;

/// Generates the preset with this seed, from the text of a request to the bytes of the answer. Returns the durations of
/// its stages.
std::vector<Product::Span> make(const std::string& preset, int seed, TextureStore* textures = nullptr) {
  const std::string text = "{\"preset\":\"" + preset + "\",\"seed\":" + std::to_string(seed) + "}";
  const Result<Request> request = read_request(text, Limits{});
  if (!request) std::abort();
  static const std::shared_ptr<HugePageCache> reserve = std::make_shared<HugePageCache>();
  const Result<Product> product = produce(*request, {.threads = 1, .reserve = reserve}, textures);
  if (!product) std::abort();
  return product->timing;
}

}  // namespace

int main(int count, char** words) {
  configure_malloc(1);
  for (const PresetInfo& preset : presets()) {
    const auto is_named = [&](const char* word) { return preset.name == word; };
    if (count > 1 && std::none_of(words + 1, words + count, is_named)) continue;
    int seed = 7'000'000;
    std::vector<Product::Span> stages;
    const double seconds =
        bench::median_seconds<bench::CpuClock>(rounds, [&] { stages = make(preset.name, ++seed); });
    bench::KeptTextures textures;
    make(preset.name, seed, &textures);
    const double warm =
        bench::median_seconds<bench::CpuClock>(1, [&] { make(preset.name, seed, &textures); });
    std::printf("{\"name\":\"%s\",\"generator\":\"%s\",\"seconds\":%.9f,\"textures\":%.9f,\"stages\":{",
                preset.name.c_str(), preset.generator.c_str(), seconds, std::max(0.0, seconds - warm));
    const char* comma = "";
    for (const Product::Span& stage : stages) {
      std::printf("%s\"%s\":%.3f", comma, stage.name.c_str(), stage.milliseconds);
      comma = ",";
    }
    std::printf("}}\n");
    std::fflush(stdout);
  }
}
