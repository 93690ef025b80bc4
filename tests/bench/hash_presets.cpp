/// Prints one line a preset: its name and the XXH3 of the bytes that its request makes. The promise behind
/// `seed` is that this table is the same from every compiler, at every level of optimisation, on every CPU
/// and with any number of threads; tests/lint/hashes.sh compares the tables.
///
///   hash_presets [--threads N] [words of a name]
#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline.h"

namespace {

using namespace seedmesh;

std::string hash_of(const Payload& payload) {
  XXH3_state_t* state = XXH3_createState();
  XXH3_128bits_reset(state);
  for (std::span<const std::byte> piece : payload.pieces())
    XXH3_128bits_update(state, piece.data(), piece.size());
  const XXH128_hash_t hash = XXH3_128bits_digest(state);
  XXH3_freeState(state);
  char text[40];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

/// False, after a line on stderr, when the preset is refused.
bool print_hash(const std::string& name, int threads) {
  const auto request = read_preset(name, {}, Limits{});
  if (!request || !*request) {
    std::fprintf(stderr, "%s: not read: %s\n", name.c_str(),
                 request ? request->error().issues.front().message.c_str() : "no such preset");
    return false;
  }
  Job job((*request)->seed(), {.threads = threads});
  const Result<Product> product = produce(**request, job);
  if (!product) {
    std::fprintf(stderr, "%s: refused: %s\n", name.c_str(), product.error().issues.front().message.c_str());
    return false;
  }
  std::printf("%s %s %llu\n", name.c_str(), hash_of(product->payload).c_str(),
              static_cast<unsigned long long>(product->payload.size()));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  int threads = 1;
  std::string_view words;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--threads" && i + 1 < argc) {
      threads = std::atoi(argv[++i]);
    } else {
      words = argv[i];
    }
  }
  if (threads < 1) return 2;

  std::vector<std::string> names;
  for (const PresetInfo& preset : presets()) {
    if (preset.name.find(words) != std::string::npos) names.push_back(preset.name);
  }
  std::sort(names.begin(), names.end());
  bool good = !names.empty();
  for (const std::string& name : names) good = print_hash(name, threads) && good;
  return good ? 0 : 1;
}
