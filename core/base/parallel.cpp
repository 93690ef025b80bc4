#include "core/base/parallel.h"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>

namespace seedmesh {
namespace {

/// True on a thread that runs a chunk.
thread_local bool in_chunk = false;

/// State that the threads of one loop share.
struct Loop {
  std::size_t count;
  const std::function<void(std::size_t)>& each;
  std::atomic<std::size_t> next{0};
  /// Orders the memory of the threads with the caller's. oneTBB does that too, but inside its library, where
  /// ThreadSanitizer does not see it.
  std::atomic<std::size_t> ended{0};
};

/// The part of a loop that one thread does.
class Share {
 public:
  explicit Share(Loop& loop) : loop_(loop) { in_chunk = true; }
  ~Share() {
    in_chunk = false;
    ++loop_.ended;
  }
  Share(const Share&) = delete;
  Share& operator=(const Share&) = delete;

  void run() {
    for (std::size_t i = loop_.next++; i < loop_.count && !tbb::is_current_task_group_canceling();
         i = loop_.next++)
      loop_.each(i);
  }

 private:
  Loop& loop_;
};

}  // namespace

bool has_threads(const Job& job) { return job.threads() > 1 && !in_chunk; }

void parallel_for(const Job& job, std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t, std::size_t, std::size_t)>& body) {
  const std::size_t chunks = chunk_count(count, chunk);
  const auto each = [&](std::size_t i) { body(i * chunk, std::min(count, (i + 1) * chunk), i); };
  const int threads = has_threads(job) ? std::min(job.threads(), tbb::this_task_arena::max_concurrency()) : 1;
  if (threads <= 1 || chunks <= 1) {
    for (std::size_t i = 0; i < chunks; ++i) each(i);
    return;
  }
  Loop loop{chunks, each};
  const auto work = [&loop] { Share(loop).run(); };
  tbb::task_group group;
  for (std::size_t i = 1; i < std::min(static_cast<std::size_t>(threads), chunks); ++i) group.run(work);
  group.run_and_wait(work);
  loop.ended.load();
}

}  // namespace seedmesh
