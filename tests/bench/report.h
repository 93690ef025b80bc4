#pragma once
/// Prints results as JSON, one per line, for tests/bench/bench.mjs.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace seedmesh::bench {

/// Reports that `amount` units took `seconds`.
inline void report(const std::string& name, const char* unit, double amount, double seconds) {
  std::printf("{\"name\":\"%s\",\"unit\":\"%s\",\"amount\":%.0f,\"seconds\":%.9f}\n", name.c_str(), unit,
              amount, seconds);
  std::fflush(stdout);
}

/// Processor time of this process, which other processes on the machine do not affect. For single-threaded
/// work.
struct CpuClock {
  static double seconds() {
    timespec now = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
  }
};

/// Wall time, for multi-threaded work.
struct WallClock {
  static double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
};

/// Returns `rounds` times of `work` in seconds, in ascending order. `work` runs once before the measurement
/// to warm memory and caches.
template <class Clock, class Work>
std::vector<double> timings(int rounds, Work&& work) {
  work();
  std::vector<double> seconds;
  for (int round = 0; round < rounds; ++round) {
    const double start = Clock::seconds();
    work();
    seconds.push_back(Clock::seconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds;
}

template <class Clock, class Work>
double median_seconds(int rounds, Work&& work) {
  return timings<Clock>(rounds, work)[static_cast<std::size_t>(rounds / 2)];
}

/// The minimum time, for multi-threaded work on a machine with other load.
template <class Clock, class Work>
double least_seconds(int rounds, Work&& work) {
  return timings<Clock>(rounds, work).front();
}

/// Returns a size from /proc/self/status in bytes, for example VmRSS or VmHWM.
inline double status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, key.size(), key) == 0)
      return std::strtod(line.c_str() + key.size() + 1, nullptr) * 1024;
  }
  return 0;
}

}  // namespace seedmesh::bench
