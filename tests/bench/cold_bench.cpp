/// The processor time of each preset with a seed that was never asked for, without any cache, on one thread and
/// without compression: what the first request for a model costs, with its textures. Usage: cold_bench [presets].
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/pipeline.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

constexpr int rounds = 3;

/// Generates the preset with this seed, from the text of a request to the bytes of the answer.
void make(const std::string& preset, int seed) {
  const std::string text = "{\"preset\":\"" + preset + "\",\"seed\":" + std::to_string(seed) + "}";
  const Result<Request> request = read_request(text, Limits{});
  if (!request || !produce(*request, {.threads = 1})) std::abort();
}

}  // namespace

int main(int count, char** words) {
  for (const PresetInfo& preset : presets()) {
    const auto is_named = [&](const char* word) { return preset.name == word; };
    if (count > 1 && std::none_of(words + 1, words + count, is_named)) continue;
    int seed = 7'000'000;
    const double seconds = bench::median_seconds<bench::CpuClock>(rounds, [&] { make(preset.name, ++seed); });
    std::printf("{\"name\":\"%s\",\"seconds\":%.9f}\n", preset.name.c_str(), seconds);
    std::fflush(stdout);
  }
}
