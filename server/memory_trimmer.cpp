#include "server/memory_trimmer.h"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "core/base/heap.h"

// Read by jemalloc at its start; a variable MALLOC_CONF of the environment takes precedence. With an arena for each
// core, ten times too many requests keep 18 MB in place of 60.
extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "percpu_arena:percpu";
}

namespace seedmesh {
namespace {

constexpr std::chrono::seconds pause{1};
constexpr std::int64_t worth = 4 << 20;  ///< bytes of growth
constexpr int longest_wait = 10;         ///< looks, where requests never pause
// Blocks from this size on come from the kernel by themselves and go back at once. What the end of an arena
// keeps for the next request until MemoryTrimmer looks: to clear its pages anew would take a fifth of the time of
// a small model. More of either, and what bursts of bad requests leave in the arenas stays.
constexpr int mapped = 1 << 20, kept = 4 << 20;

std::int64_t resident() {
  std::int64_t whole = 0, pages = 0;
  std::ifstream("/proc/self/statm") >> whole >> pages;
  return pages * ::sysconf(_SC_PAGESIZE);
}

}  // namespace

void configure_malloc(int workers) {
#ifdef __GLIBC__
  const auto unless_set = [](const char* variable, int parameter, int value) {
    if (std::getenv(variable)) return;  // NOLINT(concurrency-mt-unsafe): the only thread
    ::mallopt(parameter, value);        // NOLINT(concurrency-mt-unsafe)
  };
  unless_set("MALLOC_ARENA_MAX", M_ARENA_MAX, std::max(4, 2 * workers));
  unless_set("MALLOC_MMAP_THRESHOLD_", M_MMAP_THRESHOLD, mapped);
  unless_set("MALLOC_TRIM_THRESHOLD_", M_TRIM_THRESHOLD, kept);
#endif
}

MemoryTrimmer::MemoryTrimmer(std::function<Activity()> activity, std::function<void()> also)
    : activity_(std::move(activity)), also_(std::move(also)), thread_([this] { watch_memory(); }) {}

MemoryTrimmer::~MemoryTrimmer() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ending_changed_.notify_all();
  thread_.join();
}

void MemoryTrimmer::watch_memory() {
  std::unique_lock lock(mutex_);
  std::int64_t after = resident(), least = after;  // after the last time, and ever
  std::uint64_t answered = 0;
  int waited = 0;
  while (!ending_changed_.wait_for(lock, pause, [this] { return ending_; })) {
    const std::int64_t now = resident();
    const Activity activity = activity_();
    least = std::min(least, now);
    ++waited;
    const bool grown = now >= after + worth;
    const bool rested = activity.answered != answered && now >= least + worth &&
                        (activity.in_flight == 0 || waited >= longest_wait);
    if (!grown && !rested) continue;
    lock.unlock();
    also_();
    return_unused_heap();
    lock.lock();
    after = resident();
    answered = activity.answered;
    waited = 0;
  }
}

}  // namespace seedmesh
