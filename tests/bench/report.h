#pragma once
/// One figure a line, as JSON, for tests/bench/bench.mjs to gather.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace seedmesh::bench {

/// `amount` of `unit` took `seconds`.
inline void report(const std::string& name, const char* unit, double amount, double seconds) {
  std::printf("{\"name\":\"%s\",\"unit\":\"%s\",\"amount\":%.0f,\"seconds\":%.9f}\n", name.c_str(), unit,
              amount, seconds);
  std::fflush(stdout);
}

/// The median of `rounds` timings of `work`, in seconds. `work` runs once before, so that memory and caches
/// are warm.
template <class Work>
double median_seconds(int rounds, Work&& work) {
  using Clock = std::chrono::steady_clock;
  work();
  std::vector<double> seconds;
  for (int round = 0; round < rounds; ++round) {
    const auto start = Clock::now();
    work();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + rounds / 2, seconds.end());
  return seconds[static_cast<std::size_t>(rounds / 2)];
}

}  // namespace seedmesh::bench
