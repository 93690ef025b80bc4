#pragma once
/// The memory of one request, measured in a process of its own.
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

#include "tests/bench/report.h"

namespace seedmesh::bench {

/// Forks a process that calls `prepare` and then `work`, which returns the bytes of its result. Reports them and the peak
/// of the resident memory during `work` less that before. Call it while this process is small. Returns false if the
/// result is empty.
template <class Prepare, class Work>
bool report_memory(const std::string& name, Prepare&& prepare, Work&& work) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    prepare();
    std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak
    const double idle = status_bytes("VmRSS");
    const std::size_t bytes = work();
    if (bytes == 0) _exit(1);
    std::printf("{\"name\":\"memory: %s\",\"unit\":\"bytes\",\"amount\":%zu,\"peak_less_idle\":%.0f}\n",
                name.c_str(), bytes, status_bytes("VmHWM") - idle);
    std::fflush(stdout);
    _exit(0);
  }
  int status = 1;
  waitpid(child, &status, 0);
  return status == 0;
}

}  // namespace seedmesh::bench
