#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <new>

#if defined(SEEDMESH_STD_THREADS)
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
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
/// All threads that there are belong to the caller's own arena; to make another takes 4 microseconds.
bool is_for_all(int threads) {
  return static_cast<std::size_t>(threads) >=
         tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

void run(int threads, std::size_t chunks, const std::function<void(std::size_t)>& each) {
  const auto share_out = [&] { tbb::parallel_for(std::size_t{0}, chunks, each, tbb::simple_partitioner()); };
  if (is_for_all(threads)) return share_out();
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

#if defined(SEEDMESH_STD_THREADS)
struct KeepAwake::Waiters {};
KeepAwake::KeepAwake(const Job&) {}
KeepAwake::~KeepAwake() = default;
class Released {};
#else
namespace {
// How long a thread waits for work, and how often it looks at the clock.
constexpr std::chrono::microseconds longest_wait{300};
constexpr int waits_a_look = 64;
// What takes a millisecond has no use for more.
constexpr int most_waiters = 7;

void wait_a_little() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("isb");
#endif
}

}  // namespace

/// Tasks that do nothing as long as there is nothing to do.
struct KeepAwake::Waiters {
  explicit Waiters(int count) : wanted(count) {}
  ~Waiters() {
    release();
    group.wait();
  }
  void hold() noexcept {
    const std::uint64_t own = ++turn;
    try {
      for (int i = 0; i < wanted; ++i) group.run([this, own] { wait_for_work(own); });
    } catch (const std::bad_alloc&) {  // then they go to sleep
    }
  }
  void release() { ++turn; }
  void wait_for_work(std::uint64_t own) const {
    const auto end = std::chrono::steady_clock::now() + longest_wait;
    do {
      for (int i = 0; i < waits_a_look && turn == own; ++i) wait_a_little();
    } while (turn == own && std::chrono::steady_clock::now() < end);
  }

  int wanted;
  std::atomic<std::uint64_t> turn{0};  ///< another than a task's own: there is work
  tbb::task_group group;
};

namespace {
/// Of the thread whose helpers are kept awake.
thread_local KeepAwake* keeper = nullptr;
thread_local int working = 0;
}  // namespace

KeepAwake::KeepAwake(const Job& job) {
  if (!has_threads(job) || keeper || !is_for_all(job.threads())) return;
  waiters_ = std::make_unique<Waiters>(std::min(most_waiters, tbb::this_task_arena::max_concurrency() - 1));
  keeper = this;
  waiters_->hold();
}

KeepAwake::~KeepAwake() {
  if (keeper == this) keeper = nullptr;
}

/// While there is work for them.
class Released {
 public:
  Released() : keeper_(keeper) {
    if (keeper_ && working++ == 0) keeper_->waiters_->release();
  }
  ~Released() {
    if (keeper_ && --working == 0) keeper_->waiters_->hold();
  }
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

 private:
  KeepAwake* keeper_;
};
#endif

void run_both(const Job& job, const std::function<void()>& one, const std::function<void()>& other) {
  if (!has_threads(job)) {
    one();
    return other();
  }
  [[maybe_unused]] const Released released;
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
    [[maybe_unused]] const Released released;
    run(job.threads(), chunks, [&](std::size_t i) {
      const InAChunk mark;
      each(i);
    });
  }
}

}  // namespace seedmesh
