#include "core/base/parallel.h"

#include <algorithm>
#include <exception>

#if defined(SEEDMESH_STD_THREADS)
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace seedmesh {
namespace {

#if defined(SEEDMESH_STD_THREADS)
void run(int threads, std::size_t chunks, const std::function<void(std::size_t)>& each) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  auto work = [&] {
    for (std::size_t i = next++; i < chunks; i = next++) {
      try {
        each(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = chunks;
      }
    }
  };
  std::vector<std::jthread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work);
  work();
  pool.clear();
  if (failure) std::rethrow_exception(failure);
}
#else
void run(int threads, std::size_t chunks, const std::function<void(std::size_t)>& each) {
  const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const auto share_out = [&] { tbb::parallel_for(std::size_t{0}, chunks, each, tbb::simple_partitioner()); };
  // All threads that there are belong to the caller's own arena; to make another takes 4 microseconds.
  if (static_cast<std::size_t>(threads) >= allowed) return share_out();
  tbb::task_arena arena(threads);
  arena.execute(share_out);
}
#endif

/// Set on a thread that runs a chunk: what is cut into chunks within one has no threads left.
thread_local bool in_a_chunk = false;

class InAChunk {
 public:
  InAChunk() : before_(in_a_chunk) { in_a_chunk = true; }
  ~InAChunk() { in_a_chunk = before_; }
  InAChunk(const InAChunk&) = delete;
  InAChunk& operator=(const InAChunk&) = delete;

 private:
  bool before_;
};

}  // namespace

void run_both(const Job& job, const std::function<void()>& one, const std::function<void()>& other) {
  if (!has_threads(job)) {
    one();
    return other();
  }
  std::exception_ptr failures[2];
  run(job.threads(), 2, [&](std::size_t i) {
    try {
      (i == 0 ? one : other)();
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

bool has_threads(const Job& job) { return job.threads() > 1 && !in_a_chunk; }

void parallel_for(const Job& job, std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t, std::size_t, std::size_t)>& body) {
  const std::size_t chunks = chunk_count(count, chunk);
  const auto each = [&](std::size_t i) { body(i * chunk, std::min(count, (i + 1) * chunk), i); };
  if (!has_threads(job) || chunks <= 1) {
    for (std::size_t i = 0; i < chunks; ++i) each(i);
  } else {
    run(job.threads(), chunks, [&](std::size_t i) {
      const InAChunk mark;
      each(i);
    });
  }
}

}  // namespace seedmesh
