#pragma once
/// Returns to the system the memory that requests have left free in the arenas of the allocator.
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace seedmesh {

/// Configures glibc malloc, which a program without jemalloc uses. Blocks of at least 1 MiB are unmapped when
/// they are freed. More than 4 MiB of free memory at the end of an arena is returned to the system. There are
/// at most max(4, 2 * workers) arenas. By default glibc raises these thresholds while it runs, to up to 32 and
/// 64 MiB, and uses up to eight arenas for each core. Call it before the first thread is started. A variable
/// MALLOC_... of the environment takes precedence.
void configure_malloc(int workers);

/// While an object exists, its thread reads the resident memory of the process every second. It returns the
/// free memory of the arenas to the system in two cases:
/// - The resident memory has grown by 4 MiB since the last return.
/// - Requests have been answered since then, the resident memory is 4 MiB above its minimum, and either no
///   request is in flight or ten seconds have passed.
class MemoryTrimmer {
 public:
  struct Activity {
    std::uint64_t answered = 0;  ///< requests, ever
    std::int64_t in_flight = 0;
  };

  /// `also` is called before the memory of the arenas is returned; it empties other stores of free memory, such as
  /// HugePageCache.
  MemoryTrimmer(std::function<Activity()> activity, std::function<void()> also);
  ~MemoryTrimmer();
  MemoryTrimmer(const MemoryTrimmer&) = delete;
  MemoryTrimmer& operator=(const MemoryTrimmer&) = delete;

 private:
  void watch_memory();

  const std::function<Activity()> activity_;
  const std::function<void()> also_;
  std::mutex mutex_;
  std::condition_variable ending_changed_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace seedmesh
