/// The time of pictures of 512 pixels on one thread, from the request to the bytes of WebP, with textures in the cache as
/// in a server that runs. With the name of a preset as argument, the time of each of its stages.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "core/pipeline.h"
#include "tests/bench/kept_textures.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

constexpr int rounds = 15;

struct Subject {
  std::string name, preset;
  Overrides overrides;
};

Request request_of(const Subject& subject) {
  const auto request = read_preset(subject.preset, subject.overrides, Limits{});
  if (!request || !*request) {
    std::fprintf(stderr, "%s cannot be requested\n", subject.preset.c_str());
    std::abort();
  }
  return **request;
}

Product drawn(const Request& request, bench::KeptTextures& textures) {
  Result<Product> product = draw_picture(request, PictureOptions{}, {.threads = 1}, &textures);
  if (!product) std::abort();
  return *std::move(product);
}

void bench_subject(const Subject& subject) {
  const Request request = request_of(subject);
  bench::KeptTextures textures;
  const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] { drawn(request, textures); });
  bench::report(subject.name, "pictures", 1, seconds);
}

void print_stages(const std::string& preset) {
  const Request request = request_of({"", preset, {}});
  bench::KeptTextures textures;
  std::map<std::string, double> least;
  for (int round = 0; round < rounds; ++round) {
    const Product product = drawn(request, textures);
    for (const auto& [name, milliseconds] : product.timing) {
      const auto [place, is_new] = least.emplace(name, milliseconds);
      if (!is_new) place->second = std::min(place->second, milliseconds);
    }
    if (round == 0) std::printf("%s: %lu triangles\n", preset.c_str(), product.statistics.triangles);
  }
  for (const auto& [name, milliseconds] : least) std::printf("  %s %.1f ms\n", name.c_str(), milliseconds);
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 1) {
    for (int i = 1; i < count; ++i) print_stages(arguments[i]);
    return 0;
  }
  bench_subject({"picture of a maple", "maple", {}});  // 43,000 triangles
  bench_subject({"picture of a birch", "birch", {}});  // 65,000 triangles
  bench_subject({"picture of an oak", "oak", {}});     // 95,000
  bench_subject({"picture of a house", "house", {}});
  bench_subject({"picture of the edge of a village", "village_edge", {}});
  return 0;
}
